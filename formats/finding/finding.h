// A finding: what a rule has to say about one place of a program. Plain data that knows no rule and
// no sink.
#pragma once

#include "formats/text/edit.h"

#include "llvm/ADT/SmallVector.h"

#include <optional>
#include <string>

namespace ncvet {

/// Index of a rule in the run's list of `RuleInfo`.
using RuleId = uint16_t;

enum class Severity : uint8_t { Style, Warning, Error };
/// Definite: every path to the block breaks the rule. Possible: some path does.
enum class Certainty : uint8_t { Possible, Definite };
/// Safe: the text alone changes, the meaning cannot. Unsafe: needs a look.
enum class FixSafety : uint8_t { Safe, Unsafe };

/// A further place that explains a finding ("G83 becomes active here").
struct Note {
  SourceRange range;
  std::string message;
};

/// One step of the path that leads to a finding: a call, a jump taken, a block skipped.
struct PathStep {
  SourceRange range;
  std::string message;
};

struct Fix {
  std::string description;
  FixSafety safety = FixSafety::Unsafe;
  llvm::SmallVector<TextEdit, 1> edits;
};

struct Finding {
  RuleId rule = 0;
  Severity severity = Severity::Warning;
  Certainty certainty = Certainty::Definite;
  SourceRange range;
  std::string message; ///< one line, lower case, no final period
  llvm::SmallVector<Note, 1> notes;
  llvm::SmallVector<PathStep, 2> path;
  std::optional<Fix> fix;
  uint64_t fingerprint = 0; ///< see `Fingerprints`; filled once, after all rules have run
  bool suppressed = false;  ///< by a comment in the program
  bool baselined = false;   ///< known from the baseline
};

llvm::StringRef toString(Severity severity);
llvm::StringRef toString(Certainty certainty);
llvm::StringRef toString(FixSafety safety);
/// `error`, `warning` or `style`; none for anything else.
std::optional<Severity> parseSeverity(llvm::StringRef text);

/// What a report must know of a rule. Made from the rule's page when ncvet is built.
struct RuleInfo {
  llvm::StringRef id;
  llvm::StringRef category;
  llvm::StringRef summary; ///< one sentence: what is reported
  llvm::StringRef help;    ///< the whole page, Markdown
  Severity severity = Severity::Warning;
  bool enabledByDefault = true;
  llvm::StringRef fix; ///< "safe", "unsafe" or "none"
  /// Rules whose finding on the same block is dropped when this one speaks, as it names the cause.
  llvm::ArrayRef<llvm::StringRef> subsumes;
  bool unreachable = false; ///< what it reports is not executed
};

} // namespace ncvet
