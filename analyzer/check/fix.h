// Fixes: applied round by round until nothing is left to fix, and never at the price of a finding.
#pragma once

#include "analyzer/check/checker.h"

#include <set>

namespace ncvet {

struct FixedText {
  std::string text;     ///< equal to the source's when nothing was fixed
  unsigned applied = 0; ///< number of fixes
  unsigned rounds = 0;
  std::map<RuleId, unsigned> byRule; ///< the fixes of each rule
  bool unsureControl = false;        ///< nothing was fixed: the control is a guess
  size_t refused = 0;                ///< fixes that would have done what they do not say
  bool stoppedEarly = false; ///< the rounds were used up while there was still something to fix
};

/// Applies the safe fixes to the text of `file`, with `unsafe` the others too; suppressed findings
/// are left alone. Fixes that touch each other, and fixes of several rules on one line, are applied
/// one after the other, each on the text that the one before left. Fixes after which there are more
/// findings of any rule than before are not applied (new advice does not count when an error or a
/// warning is mended), and neither are those that change what the machine does otherwise than they
/// say: see `keepsItsPromise`. A text whose control is a guess is
/// left alone. At most a hundred rounds. Called programs are those of `open` before those on disk.
FixedText fixText(Session &session, const SourceFile &file, bool unsafe,
                  const std::shared_ptr<const SourceSet::Overlay> &open = nullptr);

/// One of the findings of a file.
struct FindingPlace {
  RuleId rule = 0;
  uint32_t begin = 0, end = 0;

  friend auto operator<=>(const FindingPlace &, const FindingPlace &) = default;
};

/// Of findings in `file` those whose fix holds what it says, as `fixText` sees it: all at once
/// where they go together, else one by one, and of these no more than some.
std::set<FindingPlace> fixesThatHold(Session &session, const SourceFile &file,
                                     llvm::ArrayRef<FindingPlace> findings,
                                     const std::shared_ptr<const SourceSet::Overlay> &open);

/// Replaces the file on disk in one step: at any time it holds the old text or the new one. A link
/// stays a link; permissions are kept.
llvm::Error replaceFile(llvm::StringRef path, llvm::StringRef text);

} // namespace ncvet
