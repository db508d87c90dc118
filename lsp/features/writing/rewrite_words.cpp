// Words that rewritings put in the place of others.
#include "lsp/features/writing/rewrite_words.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/Format.h"
#include "llvm/Support/raw_ostream.h"

#include <cmath>

namespace ncvet::lsp {

namespace {

std::string decimalText(double value, bool wantsPoint) {
  constexpr unsigned mostDecimals = 6, usualDecimals = 4;
  constexpr double rounding = 1e-9; // of sums of decimal numbers
  unsigned decimals = 0;
  double scale = 1;
  while (decimals < mostDecimals &&
         std::fabs(value * scale - std::round(value * scale)) > rounding * scale) {
    ++decimals;
    scale *= 10;
  }
  if (decimals == mostDecimals)
    decimals = usualDecimals;
  std::string text;
  llvm::raw_string_ostream(text) << llvm::format("%.*f", int(decimals), value);
  if (decimals > 0) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.')
      text.pop_back();
  }
  if (text == "-0")
    text = "0";
  if (wantsPoint && text.find('.') == std::string::npos)
    text += '.';
  return text;
}

} // namespace

std::string coordinateText(const Dialect &dialect, const Word &word, double value) {
  return decimalText(value, word.has(wordPoint) || dialect.addresses[word.address].pointAdvised);
}

std::string coordinateText(const Dialect &dialect, AddressId address, double value, bool pointed) {
  return decimalText(value, pointed || dialect.addresses[address].pointAdvised);
}

AddressId addressOf(const Dialect &dialect, AddressKind kind, Axis axis) {
  for (size_t i = 0; i < dialect.addresses.size(); ++i)
    if (dialect.addresses[i].kind == kind && dialect.addresses[i].axis == axis)
      return AddressId(i);
  return noAddress;
}

const CodeInfo *codeFor(const Dialect &dialect, StandardGroup which, Action action) {
  const GroupIndex group = dialect.group(which);
  if (group == noGroup)
    return nullptr;
  const CodeInfo *least = nullptr;
  for (const CodeIndex index : dialect.groups[group].members) {
    const CodeInfo &code = dialect.codes[index];
    if (code.letter == 'G' && code.action == action && (!least || code.number < least->number))
      least = &code;
  }
  return least;
}

const CodeInfo *gCodeOf(const Dialect &dialect, const Word &word) {
  if (word.address != letterAddress('G') || !word.isNumber())
    return nullptr;
  const CodeIndex code = dialect.find('G', word.codeNumber());
  return code == noCode ? nullptr : &dialect.codes[code];
}

const CodeInfo *counterpart(const Dialect &dialect, const CodeInfo &code, Action action) {
  const CodeInfo *nearest = nullptr;
  const auto distance = [&](const CodeInfo &one) {
    return std::abs(int(one.number) - int(code.number));
  };
  for (const CodeIndex index : dialect.groups[code.group].members) {
    const CodeInfo &one = dialect.codes[index];
    if (one.action == action && one.letter == code.letter &&
        (!nearest || distance(one) < distance(*nearest)))
      nearest = &one;
  }
  return nearest;
}

std::string codeDigits(const CodeInfo &code, llvm::StringRef old) {
  std::string digits = std::to_string(code.number / 10);
  const size_t width = old.take_while(llvm::isDigit).size();
  if (old.startswith("0") && digits.size() < width)
    digits.insert(0, width - digits.size(), '0');
  if (code.number % 10)
    digits += "." + std::to_string(code.number % 10);
  return digits;
}

llvm::StringRef digitsOf(llvm::StringRef text, const Block &block, const Word &word,
                         const Dialect &dialect) {
  const llvm::StringRef whole = text.slice(word.offset, block.endOf(word)).rtrim(" \t");
  llvm::StringRef value = whole;
  for (size_t i = dialect.addressName(word.address).size(); i > 0; --i) // `, R 2` is `,R2`
    value = value.ltrim(" \t").drop_front();
  value = value.ltrim(" \t");
  if (value.startswith("="))
    value = value.drop_front().ltrim(" \t");
  return value;
}

} // namespace ncvet::lsp
