// Parser of ECS expressions: text to operations in postfix order.
#include "formats/readers/ecs/ecs_expression.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringSwitch.h"

#include <cstdlib>

namespace ncvet {

namespace {
bool isBlank(char c) { return c == ' ' || c == '\t'; }
bool isNameCharacter(char c) { return llvm::isAlnum(c); }

constexpr unsigned sumStrength = 1, productStrength = 2;

Op functionOf(llvm::StringRef upper) {
  return llvm::StringSwitch<Op>(upper)
      .Case("SIN", Op::Sin)
      .Case("COS", Op::Cos)
      .Case("TAN", Op::Tan)
      .Case("ASN", Op::Asin)
      .Case("ACS", Op::Acos)
      .Case("ATN", Op::Atan)
      .Case("SQR", Op::Sqrt)
      .Case("ABS", Op::Abs)
      .Case("RND", Op::Round)
      .Cases("FTI", "FTL", Op::Truncate)
      .Default(Op::Unknown);
}
} // namespace

/// After what belongs to a bad expression: at a separator or bracket outside of its own.
ExpressionParser::Rest EcsExpression::afterBad(const char *begin) const {
  int depth = 0;
  const char *p = begin;
  for (; p < end_ && !isLineEnd(*p) && *p != '{'; ++p) {
    if (*p == '(')
      ++depth;
    else if (*p == ')' && --depth < 0)
      break;
    else if (depth <= 0 && (*p == '>' || *p == ';' || *p == ',' || *p == ':' || *p == ' ') &&
             p > begin)
      break;
    else if (*p == '<' && p > begin)
      break;
  }
  return {p, depth > 0};
}

template <typename Parse>
uint16_t EcsExpression::read(Parse parse) {
  Expression result = open();
  const char *const begin = at_;
  if (!parse())
    fail(result, afterBad(begin));
  return close(result);
}

uint16_t EcsExpression::parse() {
  return read([this] { return sum(0); });
}

uint16_t EcsExpression::parseTarget() {
  return read([this] {
    const char *const begin = at_;
    const uint64_t key = variable();
    if (!key)
      return false;
    emit(Op::Number, begin, double(key));
    return true;
  });
}

void EcsExpression::ambiguous(const char *begin) {
  issue(SyntaxIssueKind::AmbiguousExpression, begin, at_);
}

BinaryOperator EcsExpression::nextBinary() const {
  if (at_ == end_)
    return {};
  switch (*at_) {
  case '+':
    return {Op::Add, sumStrength, 1};
  case '-':
    return {Op::Subtract, sumStrength, 1};
  case '*':
    return {Op::Multiply, productStrength, 1};
  case '/':
    if (at_ + 1 < end_ && at_[1] == '/')
      return {Op::Modulo, productStrength, 2};
    return {Op::Divide, productStrength, 1};
  default:
    break;
  }
  if (const unsigned dash = typographicMinus(at_, end_))
    return {Op::Subtract, sumStrength, dash};
  return {};
}

bool EcsExpression::sum(unsigned depth) {
  const auto apply = [&](const BinaryOperator &binary, const char *at) {
    // `X=R1 -5` looks like a value and something else.
    const bool continues =
        binary.op == Op::Subtract && depth == 0 && isBlank(at[-1]) && at_ < end_ && *at_ != ' ';
    if (const unsigned dash = typographicMinus(at, end_))
      issue(SyntaxIssueKind::TypographicMinus, at, at + dash);
    if (!product(depth))
      return false;
    if (continues)
      ambiguous(at);
    emit(binary.op, at);
    return true;
  };
  return product(depth) && operators(
                               sumStrength, [this] { return nextBinary(); }, apply);
}

bool EcsExpression::product(unsigned depth) {
  skipBlanks();
  const char *const begin = at_;
  unsigned count = 0;
  bool remainders = false, told = false;
  const auto apply = [&](const BinaryOperator &binary, const char *at) {
    if (!factor(depth))
      return false;
    remainders |= binary.op == Op::Modulo;
    if (++count > 1 && remainders && !told) { // no manual says which of them goes first
      ambiguous(begin);
      told = true;
    }
    emit(binary.op, at);
    return true;
  };
  return factor(depth) && operators(
                              productStrength, [this] { return nextBinary(); }, apply);
}

/// The sign binds more than the power: -2**2 is -4.
bool EcsExpression::factor(unsigned depth) {
  skipBlanks();
  if (at_ == end_ || depth > maxDepth)
    return false;
  const char *const at = at_;
  const unsigned dash = typographicMinus(at_, end_);
  if (*at_ == '-' || *at_ == '+' || dash) {
    at_ += dash ? dash : 1;
    if (dash)
      issue(SyntaxIssueKind::TypographicMinus, at, at_);
    else if (const char *const digits = afterBlanks(at_);
             digits > at_ && digits < end_ && isNumberDigit(*digits))
      issue(SyntaxIssueKind::BlankInNumber, at, digits + 1);
    const bool atomic = at_ < end_ && *at_ != '(';
    const size_t operations = block_.operations.size();
    if (!factor(depth + 1))
      return false;
    if (*at != '+') {
      if (atomic && block_.operations.size() > operations &&
          block_.operations.back().op == Op::Power)
        ambiguous(at); // `-2**2`
      emit(Op::Negate, at);
    }
    return true;
  }
  if (!atom(depth))
    return false;
  const char *const before = at_;
  skipBlanks();
  if (at_ + 1 < end_ && at_[0] == '*' && at_[1] == '*') {
    const char *const power = at_;
    at_ += 2;
    skipBlanks();
    const bool atomic = at_ < end_ && *at_ != '(';
    const size_t operations = block_.operations.size();
    if (!factor(depth + 1))
      return false;
    if (atomic && block_.operations.size() > operations && block_.operations.back().op == Op::Power)
      ambiguous(at); // `2**3**2`
    emit(Op::Power, power);
    return true;
  }
  at_ = before;
  return true;
}

bool EcsExpression::atom(unsigned depth) {
  const char *const begin = at_;
  if (isNumberDigit(*at_) || *at_ == '.') {
    if (!takeDigits())
      return false;
    const std::string digits(begin, size_t(std::min<ptrdiff_t>(at_ - begin, 40)));
    emit(Op::Number, begin, std::strtod(digits.c_str(), nullptr));
    return true;
  }
  if (*at_ == '(') {
    ++at_;
    return sum(depth + 1) && take(')');
  }
  return name(depth);
}

uint64_t EcsExpression::variable() {
  if (at_ == end_)
    return 0;
  const char *const begin = at_;
  const char letter = char(*at_ & ~32);
  if (*at_ == '#' || letter == 'R' || letter == 'V') {
    const char *p = at_ + 1;
    int64_t number = 0;
    while (p < end_ && isNumberDigit(*p) && number < 100'000'000)
      number = number * 10 + (*p++ - '0');
    if (p > at_ + 1 && (p == end_ || !isNameCharacter(*p))) {
      at_ = p;
      return elementKey(variableKey({begin, 1}), number);
    }
  }
  while (at_ < end_ && *at_ == '%' && at_ - begin < 2)
    ++at_;
  if (at_ == end_ || !llvm::isAlpha(*at_)) {
    at_ = begin;
    return 0;
  }
  while (at_ < end_ && isNameCharacter(*at_))
    ++at_;
  return variableKey({begin, size_t(at_ - begin)});
}

bool EcsExpression::name(unsigned depth) {
  const char *const begin = at_;
  const llvm::StringRef word = llvm::StringRef(at_, size_t(end_ - at_)).take_while(isNameCharacter);
  block_.lowerCase |= llvm::any_of(word, [](char c) { return c >= 'a' && c <= 'z'; });
  const char *const after = afterSpaces(word.end());
  if (!word.empty() && after < end_ && *after == '(') {
    const Op function = functionOf(word.upper());
    at_ = after + 1;
    if (!sum(depth + 1) || !take(')'))
      return false;
    if (function == Op::Unknown) {
      issue(SyntaxIssueKind::UnknownWord, begin, word.end());
      emit(Op::Opaque, begin, 1);
    } else {
      emit(function, begin);
    }
    return true;
  }
  const uint64_t key = variable();
  if (!key)
    return false;
  emit(Op::Variable, begin, double(key));
  return true;
}

} // namespace ncvet
