// Numbers as hints and help show them.
#include "lsp/features/number_text.h"

#include "llvm/ADT/StringRef.h"
#include "llvm/Support/Format.h"
#include "llvm/Support/raw_ostream.h"

namespace ncvet::lsp {

std::string numberText(double value) {
  constexpr double most = 1e15; // larger ones have no decimal places
  std::string text;
  llvm::raw_string_ostream out(text);
  if (!(std::fabs(value) < most)) {
    out << llvm::format("%g", value);
    return out.str();
  }
  out << llvm::format("%.4f", value);
  out.flush();
  llvm::StringRef shown = llvm::StringRef(text).rtrim('0').rtrim('.');
  return shown == "-0" ? "0" : shown.str();
}

std::string intervalText(const Interval &interval) {
  if (interval.isConstant())
    return numberText(interval.value());
  if (interval.isBounded())
    return numberText(interval.lo) + " to " + numberText(interval.hi);
  if (std::isfinite(interval.lo))
    return "at least " + numberText(interval.lo);
  if (std::isfinite(interval.hi))
    return "at most " + numberText(interval.hi);
  return {};
}

} // namespace ncvet::lsp
