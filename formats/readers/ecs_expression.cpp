// Parser of ECS expressions: text to operations in postfix order.
#include "formats/readers/ecs_expression.h"

#include "formats/readers/plain_number.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringSwitch.h"

#include <cstdlib>

namespace ncvet {

namespace {
bool isNameCharacter(char c) { return llvm::isAlnum(c); }

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

template <typename Parse>
uint16_t EcsExpression::read(Parse parse) {
  skipBlanks();
  const char *const begin = at_;
  Expression result;
  result.first = uint32_t(block_.operations.size());
  result.begin = uint32_t(begin - base_);
  if (!parse()) {
    block_.operations.resize(result.first);
    emit(Op::Unknown, begin);
    result.bad = true;
    // Go on behind what belongs to the expression: at a separator or bracket outside of its own.
    int depth = 0;
    const char *p = begin;
    for (; p < end_ && *p != '\n' && *p != '\r' && *p != '{'; ++p) {
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
    if (p > at_)
      at_ = p;
    block_.issues.push_back(
        {depth > 0 ? SyntaxIssueKind::UnbalancedBracket : SyntaxIssueKind::BadExpression,
         uint32_t(begin - base_), uint32_t(at_ - base_)});
  }
  result.count = uint32_t(block_.operations.size()) - result.first;
  result.end = uint32_t(at_ - base_);
  if (block_.expressions.size() >= noExpression - 1)
    return uint16_t(block_.expressions.size() - 1);
  block_.expressions.push_back(result);
  return uint16_t(block_.expressions.size() - 1);
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
  block_.issues.push_back(
      {SyntaxIssueKind::AmbiguousExpression, uint32_t(begin - base_), uint32_t(at_ - base_)});
}

bool EcsExpression::sum(unsigned depth) {
  if (!product(depth))
    return false;
  for (;;) {
    const char *const before = at_;
    skipBlanks();
    unsigned length = 0;
    const bool minus = at_ < end_ && (*at_ == '-' || (length = typographicMinus(at_, end_)) > 0);
    if (at_ == end_ || (*at_ != '+' && !minus)) {
      at_ = before;
      return true;
    }
    const char *const at = at_;
    at_ += length ? length : 1;
    const bool continues = minus && depth == 0 && at > before && at_ < end_ && *at_ != ' ';
    if (!product(depth))
      return false;
    if (continues) // `X=R1 -5` looks like a value and something else
      ambiguous(at);
    emit(minus ? Op::Subtract : Op::Add, at);
  }
}

bool EcsExpression::product(unsigned depth) {
  skipBlanks();
  const char *const begin = at_;
  if (!factor(depth))
    return false;
  unsigned operators = 0;
  bool remainders = false, told = false;
  for (;;) {
    const char *const before = at_;
    skipBlanks();
    if (at_ == end_ || (*at_ != '*' && *at_ != '/')) {
      at_ = before;
      return true;
    }
    const char *const at = at_;
    const bool remainder = *at_ == '/' && at_ + 1 < end_ && at_[1] == '/';
    at_ += remainder ? 2 : 1;
    if (!factor(depth))
      return false;
    remainders |= remainder;
    if (++operators > 1 && remainders && !told) { // no manual says which of them goes first
      ambiguous(begin);
      told = true;
    }
    emit(remainder ? Op::Modulo : *at == '*' ? Op::Multiply : Op::Divide, at);
  }
}

/// The sign stands above the power: -2**2 is -4.
bool EcsExpression::factor(unsigned depth) {
  skipBlanks();
  if (at_ == end_ || depth > maxDepth)
    return false;
  const char *const at = at_;
  const unsigned dash = typographicMinus(at_, end_);
  if (*at_ == '-' || *at_ == '+' || dash) {
    at_ += dash ? dash : 1;
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
    if (!factor(depth + 1))
      return false;
    emit(Op::Power, power);
    return true;
  }
  at_ = before;
  return true;
}

bool EcsExpression::atom(unsigned depth) {
  const char *const begin = at_;
  if (isNumberDigit(*at_) || *at_ == '.') {
    while (at_ < end_ && isNumberDigit(*at_))
      ++at_;
    if (at_ < end_ && *at_ == '.') {
      ++at_;
      while (at_ < end_ && isNumberDigit(*at_))
        ++at_;
    }
    if (at_ - begin == 1 && *begin == '.')
      return false;
    const std::string digits(begin, size_t(std::min<ptrdiff_t>(at_ - begin, 40)));
    emit(Op::Number, begin, std::strtod(digits.c_str(), nullptr));
    return true;
  }
  if (*at_ == '(') {
    ++at_;
    if (!sum(depth + 1))
      return false;
    skipBlanks();
    if (at_ == end_ || *at_ != ')')
      return false;
    ++at_;
    return true;
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
  const char *behind = word.end();
  while (behind < end_ && *behind == ' ')
    ++behind;
  if (!word.empty() && behind < end_ && *behind == '(') {
    const Op function = functionOf(word.upper());
    at_ = behind + 1;
    if (!sum(depth + 1))
      return false;
    skipBlanks();
    if (at_ == end_ || *at_ != ')')
      return false;
    ++at_;
    if (function == Op::Unknown) {
      block_.issues.push_back(
          {SyntaxIssueKind::UnknownWord, uint32_t(begin - base_), uint32_t(word.end() - base_)});
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
