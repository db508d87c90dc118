// Numbers as messages show them.
#include "formats/text/number_text.h"

#include "llvm/Support/Format.h"
#include "llvm/Support/raw_ostream.h"

namespace ncvet {

std::string shortNumber(double value) {
  std::string text;
  llvm::raw_string_ostream(text) << llvm::format("%g", value);
  return text;
}

} // namespace ncvet
