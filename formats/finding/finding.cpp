// A finding: the names of its severities and certainties.
#include "formats/finding/finding.h"

#include "llvm/ADT/StringSwitch.h"

namespace ncvet {

llvm::StringRef toString(Severity severity) {
  switch (severity) {
  case Severity::Style:
    return "style";
  case Severity::Warning:
    return "warning";
  case Severity::Error:
    return "error";
  }
  llvm_unreachable("no such severity");
}

llvm::StringRef toString(Certainty certainty) {
  return certainty == Certainty::Definite ? "definite" : "possible";
}

llvm::StringRef toString(FixSafety safety) { return safety == FixSafety::Safe ? "safe" : "unsafe"; }

std::optional<Severity> parseSeverity(llvm::StringRef text) {
  return llvm::StringSwitch<std::optional<Severity>>(text)
      .Case("style", Severity::Style)
      .Case("warning", Severity::Warning)
      .Case("error", Severity::Error)
      .Default(std::nullopt);
}

} // namespace ncvet
