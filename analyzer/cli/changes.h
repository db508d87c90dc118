// Changed lines: what a patch or a commit range touches, and the findings that it concerns.
#pragma once

#include "formats/reports/report.h"

#include "llvm/ADT/StringMap.h"
#include "llvm/Support/Error.h"

#include <utility>
#include <vector>

namespace ncvet::cli {

/// Lines of files that a change wrote, or that are beside what it took away.
class ChangedLines {
public:
  /// Reads a unified diff whose paths are relative to `root`. An error names the line that is no
  /// part of one.
  static llvm::Expected<ChangedLines> ofPatch(llvm::StringRef patch, llvm::StringRef root);
  /// What differs from `commit` in the working tree of the current folder, with files that git does
  /// not know yet. Errors are those of git, in one line.
  static llvm::Expected<ChangedLines> since(const std::string &commit);

  /// Whether the place is in changed lines.
  bool touches(const SourceFile &file, const SourceRange &range) const;
  /// Whether the finding, a place that explains it or a step of the path to it is in changed lines.
  bool concern(const SourceSet &sources, const Finding &finding) const;

private:
  void add(llvm::StringRef root, llvm::StringRef path, uint32_t first, uint32_t last);

  using Lines = std::vector<std::pair<uint32_t, uint32_t>>; ///< first and last
  llvm::StringMap<Lines> files_;
};

/// The nearest folder upward with a `.git`; the current folder when there is none.
std::string projectRoot();

} // namespace ncvet::cli
