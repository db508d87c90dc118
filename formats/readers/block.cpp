// A block of a part program in the one form that all readers produce.
#include "formats/readers/block.h"

namespace ncvet {

uint32_t Word::codeNumber() const {
  constexpr uint32_t none = 0xFFFFFF;
  if (!isNumber() || mantissa < 0 || mantissa > 99999)
    return none;
  if (decimals == 0)
    return uint32_t(mantissa) * 10;
  if (decimals == 1)
    return uint32_t(mantissa);
  // G84.20 is G84.2.
  int64_t number = mantissa;
  unsigned left = decimals;
  while (left > 1 && number % 10 == 0) {
    number /= 10;
    --left;
  }
  return left == 1 ? uint32_t(number) : none;
}

void Block::clear() {
  kind = BlockKind::Normal;
  skip = -1;
  lowerCase = tapeInside = false;
  numberIsFirst = true;
  number = program = -1;
  numberBegin = numberEnd = headerBegin = headerEnd = 0;
  nameBegin = nameEnd = labelBegin = labelEnd = 0;
  mainBlock = false;
  addresses = repeated = pointed = pointless = plain = 0;
  words.clear();
  items.clear();
  arguments.clear();
  expressions.clear();
  operations.clear();
  comments.clear();
  issues.clear();
}

const Word *Block::find(AddressId address) const {
  if (!has(address))
    return nullptr;
  for (const Word &word : words)
    if (word.address == address)
      return &word;
  return nullptr;
}

const Word *Block::argument(unsigned position) const {
  if (!has(argumentAddress))
    return nullptr;
  bool called = false;
  for (const Word &word : words) {
    if (word.address == argumentAddress) {
      called = true;
      if (--position == 0)
        return &word;
    } else if (called && word.address == keywordAddress) {
      return nullptr; // another call begins, whose arguments are its own
    }
  }
  return nullptr;
}

std::optional<double> Block::numberIn(uint16_t expression) const {
  if (expression >= expressions.size())
    return std::nullopt;
  const Expression &number = expressions[expression];
  if (number.bad || number.count != 1 || operations[number.first].op != Op::Number)
    return std::nullopt;
  return operations[number.first].value;
}

uint64_t Block::keyOf(uint16_t expression) const {
  if (expression >= expressions.size() || expressions[expression].count != 1)
    return 0;
  const ExpressionOp &op = operations[expressions[expression].first];
  return op.op == Op::Number && op.value >= 0 ? uint64_t(op.value) : 0;
}

uint64_t Block::variableOf(uint16_t expression) const {
  if (expression >= expressions.size() || expressions[expression].count != 1)
    return 0;
  const ExpressionOp &op = operations[expressions[expression].first];
  return op.op == Op::Variable ? uint64_t(op.value) : 0;
}

const Word *Block::findAny(AddressMask mask) const {
  if (!hasAny(mask))
    return nullptr;
  for (const Word &word : words)
    if (mask & maskOf(word.address))
      return &word;
  return nullptr;
}

uint32_t Block::endOf(const Word &word) const {
  if (word.has(wordExpression))
    return expressions[size_t(word.mantissa)].end;
  if (word.length < 255)
    return word.offset + word.length;
  // Longer than its length field: it ends where the next word begins, or with the block.
  uint32_t limit = end;
  for (const Word &other : words)
    if (other.offset > word.offset && other.offset < limit)
      limit = other.offset;
  return limit;
}

} // namespace ncvet
