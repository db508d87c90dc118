// Names of G and M codes: letter, whole number and at most one decimal.
#include "formats/dialect/code_name.h"

#include "llvm/ADT/StringExtras.h"

#include <cstdio>

namespace ncvet {

std::optional<CodeName> parseCodeName(llvm::StringRef text) {
  if (text.empty() || (text.front() != 'G' && text.front() != 'M'))
    return std::nullopt;
  CodeName name;
  name.letter = text.front();
  auto [whole, decimal] = text.drop_front().split('.');
  uint32_t number = 0;
  if (whole.empty() || whole.size() > 4 || !llvm::all_of(whole, llvm::isDigit) ||
      whole.getAsInteger(10, number) || number > maxCodeNumber)
    return std::nullopt;
  if (text.contains('.') && (decimal.size() != 1 || !llvm::isDigit(decimal.front())))
    return std::nullopt;
  name.numberTimesTen = number * 10;
  if (!decimal.empty())
    name.numberTimesTen += uint32_t(decimal.front() - '0');
  if (name.numberTimesTen > UINT16_MAX)
    return std::nullopt;
  return name;
}

std::string toString(const CodeName &name) {
  char text[16];
  unsigned number = name.numberTimesTen / 10, decimal = name.numberTimesTen % 10;
  if (decimal)
    snprintf(text, sizeof text, "%c%02u.%u", name.letter, number, decimal);
  else
    snprintf(text, sizeof text, "%c%02u", name.letter, number);
  return text;
}

} // namespace ncvet
