// Parser of Sinumerik expressions: text to operations in postfix order.
#include "formats/readers/sinumerik_expression.h"

#include "llvm/ADT/SmallString.h"
#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringSwitch.h"

#include <cstdlib>

namespace ncvet {

namespace {

bool isNameLetter(char c) { return llvm::isAlpha(c) || c == '_'; }
bool isNameCharacter(char c) { return llvm::isAlnum(c) || c == '_'; }

/// An operator with two operands; the higher its strength, the tighter it binds.
struct Binary {
  Op op = Op::Unknown;
  unsigned strength = 0;
  unsigned length = 0;
};

constexpr unsigned comparisonStrength = 1, andStrength = 5, strongest = 10;

/// The operator at the head of `text`; strength 0: there is none.
Binary binaryAt(llvm::StringRef text) {
  switch (text.empty() ? 0 : text[0]) {
  case '=':
    return text.startswith("==") ? Binary{Op::Equal, comparisonStrength, 2} : Binary();
  case '<':
    return text.startswith("<<")   ? Binary{Op::Opaque, 2, 2}
           : text.startswith("<>") ? Binary{Op::NotEqual, comparisonStrength, 2}
           : text.startswith("<=") ? Binary{Op::LessEqual, comparisonStrength, 2}
                                   : Binary{Op::Less, comparisonStrength, 1};
  case '>':
    return text.startswith(">=") ? Binary{Op::GreaterEqual, comparisonStrength, 2}
                                 : Binary{Op::Greater, comparisonStrength, 1};
  case ':':
    return {Op::Opaque, 2, 1};
  case '+':
    return {Op::Add, 9, 1};
  case '-':
    return {Op::Subtract, 9, 1};
  case '*':
    return {Op::Multiply, strongest, 1};
  case '/':
    return {Op::Divide, strongest, 1};
  default:
    break;
  }
  const llvm::StringRef name = text.take_while(isNameCharacter);
  if (name.size() < 2 || name.size() > 5)
    return {};
  Binary found = llvm::StringSwitch<Binary>(name.upper())
                     .Case("OR", {Op::Or, 3, 0})
                     .Case("XOR", {Op::Xor, 4, 0})
                     .Case("AND", {Op::And, andStrength, 0})
                     .Case("B_OR", {Op::Or, 6, 0})
                     .Case("B_XOR", {Op::Xor, 7, 0})
                     .Case("B_AND", {Op::And, 8, 0})
                     .Case("DIV", {Op::IntegerDivide, strongest, 0})
                     .Case("MOD", {Op::Modulo, strongest, 0})
                     .Default({});
  found.length = unsigned(name.size());
  return found;
}

bool isLogical(const Binary &binary) { return binary.strength >= 3 && binary.strength <= 5; }

/// A function with one number in and one number out.
Op functionOf(llvm::StringRef upper) {
  return llvm::StringSwitch<Op>(upper)
      .Case("SIN", Op::Sin)
      .Case("COS", Op::Cos)
      .Case("TAN", Op::Tan)
      .Case("ASIN", Op::Asin)
      .Case("ACOS", Op::Acos)
      .Case("SQRT", Op::Sqrt)
      .Case("ABS", Op::Abs)
      .Case("POT", Op::Square)
      .Case("TRUNC", Op::Truncate)
      .Case("ROUND", Op::Round)
      .Case("ROUNDUP", Op::Fup)
      .Case("LN", Op::Ln)
      .Case("EXP", Op::Exp)
      .Default(Op::Unknown);
}

/// `SQR(2)`: one letter off a function, and no function itself.
bool isMisspelt(llvm::StringRef upper) {
  // Functions that look like another one.
  for (const char *other : {"ASIN", "ACOS", "ATAN2", "MINVAL", "MAXVAL", "AC", "IC", "DC", "ACP",
                            "ACN", "CROT", "CROTS", "SPI", "POSM"})
    if (upper == other)
      return false;
  for (const char *function : {"SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN2", "SQRT", "ABS", "POT",
                               "TRUNC", "ROUND", "ROUNDUP", "EXP", "MINVAL", "MAXVAL"})
    if (upper.size() > 2 && upper.edit_distance(function, true, 1) == 1)
      return true;
  return false;
}

} // namespace

llvm::StringRef SinumerikExpression::identifier() const {
  return llvm::StringRef(at_, size_t(end_ - at_)).take_while(isNameCharacter);
}

template <typename Parse>
uint16_t SinumerikExpression::read(Parse parse) {
  skipBlanks();
  const char *begin = at_;
  Expression result;
  result.first = uint32_t(block_.operations.size());
  result.begin = uint32_t(begin - base_);
  ambiguous_ = false;
  const bool good = parse();
  if (!good) {
    block_.operations.resize(result.first);
    emit(Op::Unknown, begin);
    // Go on behind what belongs to the expression: at the next blank outside brackets.
    int depth = 0;
    const char *p = begin;
    for (; p < end_ && *p != '\n' && *p != '\r' && *p != ';'; ++p) {
      if (*p == '(' || *p == '[')
        ++depth;
      else if (*p == ')' || *p == ']') {
        if (--depth < 0)
          break;
      } else if (depth <= 0 && (*p == ' ' || *p == ',') && p > begin) {
        break;
      }
    }
    if (p > at_)
      at_ = p;
    block_.issues.push_back(
        {depth > 0 ? SyntaxIssueKind::UnbalancedBracket : SyntaxIssueKind::BadExpression,
         uint32_t(begin - base_), uint32_t(at_ - base_)});
  } else if (ambiguous_) {
    block_.issues.push_back(
        {SyntaxIssueKind::AmbiguousExpression, uint32_t(begin - base_), uint32_t(at_ - base_)});
  }
  result.bad = !good || ambiguous_;
  result.count = uint32_t(block_.operations.size()) - result.first;
  result.end = uint32_t(at_ - base_);
  if (block_.expressions.size() >= noExpression - 1)
    return uint16_t(block_.expressions.size() - 1);
  block_.expressions.push_back(result);
  return uint16_t(block_.expressions.size() - 1);
}

uint16_t SinumerikExpression::parse() {
  return read([this] { return group(0); });
}

uint16_t SinumerikExpression::parseCondition() {
  const uint16_t index = parse();
  const char *sign = at_;
  while (sign < end_ && (*sign == ' ' || *sign == '\t'))
    ++sign;
  if (sign == end_ || *sign != '=' || index + 1u != block_.expressions.size())
    return index;
  block_.issues.push_back(
      {SyntaxIssueKind::AssignmentInTest, uint32_t(sign - base_), uint32_t(sign - base_) + 1});
  at_ = sign + 1;
  const uint16_t right = parse();
  // Both sides lie behind each other: they become one comparison.
  Expression &whole = block_.expressions[index];
  if (right != index) {
    whole.count += block_.expressions[right].count;
    whole.bad |= block_.expressions[right].bad;
    block_.expressions.pop_back();
  }
  emit(Op::Equal, sign);
  ++whole.count;
  whole.end = uint32_t(at_ - base_);
  return index;
}

uint16_t SinumerikExpression::parseValue(WordReading &reading) {
  reading = WordReading::Modal;
  return read([&] {
    const llvm::StringRef head = identifier();
    const char *behind = head.end();
    while (behind < end_ && *behind == ' ')
      ++behind;
    if ((head.size() == 2 || head.size() == 3) && behind < end_ && *behind == '(')
      reading = llvm::StringSwitch<WordReading>(head.upper())
                    .Case("AC", WordReading::Absolute)
                    .Case("IC", WordReading::Incremental)
                    .Case("DC", WordReading::RotaryShortest)
                    .Case("ACP", WordReading::RotaryPositive)
                    .Case("ACN", WordReading::RotaryNegative)
                    .Default(WordReading::Modal);
    if (reading == WordReading::Modal)
      return group(0);
    at_ = behind + 1;
    if (!group(1))
      return false;
    skipBlanks();
    if (at_ == end_ || *at_ != ')')
      return false;
    ++at_;
    return true;
  });
}

uint16_t SinumerikExpression::parseTarget() {
  return read([this] {
    const char *begin = at_;
    if (at_ < end_ && *at_ == '$') {
      ++at_;
      const llvm::StringRef system = identifier();
      at_ = system.end();
      if (system.empty() || !skipIndices())
        return false;
      emit(Op::Number, begin, double(variableKey({begin, size_t(system.end() - begin)})));
      return true;
    }
    const llvm::StringRef name = identifier();
    if (name.empty())
      return false;
    at_ = name.end();
    int64_t parameter = 0;
    if ((name[0] | 32) == 'r' && name.size() > 1 && name.size() < 10 &&
        !name.drop_front().getAsInteger(10, parameter)) {
      emit(Op::Number, begin, double(elementKey(variableKey("R"), parameter)));
      return true;
    }
    const uint64_t key = variableKey(name);
    if (at_ == end_ || *at_ != '[') {
      emit(Op::Number, begin, double(key));
      return true;
    }
    const int count = indices(0);
    if (count == 1)
      emit(Op::ElementKey, begin, double(key));
    else if (count > 1)
      emit(Op::Opaque, begin, count);
    return count > 0;
  });
}

/// What stands in one pair of brackets.
bool SinumerikExpression::group(unsigned depth) {
  Seen seen;
  if (!level(depth, comparisonStrength, seen))
    return false;
  ambiguous_ |= seen.comparison && seen.logical;
  return true;
}

/// Operands and operators at least as strong as `strength`, grouped from the left.
bool SinumerikExpression::level(unsigned depth, unsigned strength, Seen &seen) {
  if (!unary(depth, seen))
    return false;
  for (;;) {
    const char *const before = at_;
    skipBlanks();
    const Binary binary = binaryAt({at_, size_t(end_ - at_)});
    if (binary.strength < strength) { // none, or one for an outer level
      at_ = before;
      return true;
    }
    const char *const at = at_;
    at_ += binary.length;
    seen.comparison |= binary.strength == comparisonStrength;
    seen.logical |= isLogical(binary);
    if (!level(depth, binary.strength + 1, seen))
      return false;
    emit(binary.op, at, binary.op == Op::Opaque ? 2 : 0);
  }
}

bool SinumerikExpression::unary(unsigned depth, Seen &seen) {
  skipBlanks();
  if (at_ == end_ || depth > maxDepth)
    return false;
  const char *const at = at_;
  if (*at_ == '-' || *at_ == '+') {
    const bool negative = *at_++ == '-';
    if (!unary(depth + 1, seen))
      return false;
    if (negative)
      emit(Op::Negate, at);
    return true;
  }
  if (const llvm::StringRef word = identifier(); word.equals_insensitive("NOT")) {
    at_ = word.end();
    seen.logical = true;
    if (!unary(depth + 1, seen))
      return false;
    emit(Op::Not, at);
    return true;
  } else if (word.equals_insensitive("B_NOT")) {
    at_ = word.end();
    if (!unary(depth + 1, seen))
      return false;
    emit(Op::Opaque, at, 1);
    return true;
  }
  return operand(depth);
}

bool SinumerikExpression::operand(unsigned depth) {
  const char c = *at_;
  if (llvm::isDigit(c) || c == '.')
    return number();
  if (c == '\'')
    return constant();
  if (c == '"')
    return text();
  if (c == '(') {
    ++at_;
    if (!group(depth + 1))
      return false;
    skipBlanks();
    if (at_ == end_ || *at_ != ')')
      return false;
    ++at_;
    return true;
  }
  if (c == '$' || isNameLetter(c))
    return name(depth);
  return false;
}

/// `12`, `1.5`, `.5`, `1.5EX-3`.
bool SinumerikExpression::number() {
  const char *const begin = at_;
  while (at_ < end_ && llvm::isDigit(*at_))
    ++at_;
  if (at_ < end_ && *at_ == '.') {
    ++at_;
    while (at_ < end_ && llvm::isDigit(*at_))
      ++at_;
  }
  if (at_ - begin == 1 && *begin == '.')
    return false;
  llvm::SmallString<32> digits(llvm::StringRef(begin, size_t(at_ - begin)).take_front(40));
  const char *p = at_;
  if (end_ - p > 2 && (p[0] | 32) == 'e' && (p[1] | 32) == 'x') {
    p += 2;
    const char *const exponent = p;
    if (*p == '-' || *p == '+')
      ++p;
    const char *const first = p;
    while (p < end_ && llvm::isDigit(*p))
      ++p;
    if (p > first && p - first < 4) {
      digits += 'e';
      digits += llvm::StringRef(exponent, size_t(p - exponent));
      at_ = p;
    }
  }
  emit(Op::Number, begin, std::strtod(digits.c_str(), nullptr));
  return true;
}

/// `'H1F'`, `'B101'`, `'A'`.
bool SinumerikExpression::constant() {
  const char *const begin = at_++;
  const char *p = at_;
  while (p < end_ && *p != '\'' && *p != '\n' && *p != '\r')
    ++p;
  if (p == end_ || *p != '\'')
    return false;
  const llvm::StringRef inside(at_, size_t(p - at_));
  at_ = p + 1;
  uint64_t value = 0;
  const char kind = inside.empty() ? '\0' : char(inside[0] & ~32);
  if ((kind == 'H' && !inside.drop_front().getAsInteger(16, value)) ||
      (kind == 'B' && !inside.drop_front().getAsInteger(2, value)))
    emit(Op::Number, begin, double(value));
  else
    emit(Op::Opaque, begin);
  return true;
}

bool SinumerikExpression::text() {
  const char *const begin = at_++;
  while (at_ < end_ && *at_ != '"' && *at_ != '\n' && *at_ != '\r')
    ++at_;
  if (at_ == end_ || *at_ != '"')
    return false;
  ++at_;
  emit(Op::Opaque, begin);
  return true;
}

/// A variable, an element of an array, a function.
bool SinumerikExpression::name(unsigned depth) {
  const char *const begin = at_;
  if (*at_ == '$') {
    ++at_;
    const llvm::StringRef system = identifier();
    at_ = system.end();
    if (system.empty() || !skipIndices())
      return false;
    emit(Op::Opaque, begin);
    return true;
  }
  const llvm::StringRef name = identifier();
  at_ = name.end();
  int64_t parameter = 0;
  if ((name[0] | 32) == 'r' && name.size() > 1 && name.size() < 10 &&
      !name.drop_front().getAsInteger(10, parameter)) {
    emit(Op::Variable, begin, double(elementKey(variableKey("R"), parameter)));
    return true;
  }
  if (at_ < end_ && *at_ == '[') {
    const int count = indices(depth + 1);
    if (count == 1)
      emit(Op::ElementAt, begin, double(variableKey(name)));
    else if (count > 1)
      emit(Op::Opaque, begin, count);
    return count > 0;
  }
  const char *behind = at_;
  while (behind < end_ && *behind == ' ')
    ++behind;
  if (behind < end_ && *behind == '(') {
    at_ = behind;
    return function(depth, name, begin);
  }
  if (name.size() == 1) { // the name of an axis
    emit(Op::Opaque, begin);
    return true;
  }
  if (name.equals_insensitive("TRUE") || name.equals_insensitive("FALSE"))
    emit(Op::Number, begin, name.size() == 4);
  else
    emit(Op::Variable, begin, double(variableKey(name)));
  return true;
}

bool SinumerikExpression::function(unsigned depth, llvm::StringRef name, const char *begin) {
  const int count = arguments(depth + 1);
  if (count < 0)
    return false;
  const std::string upper = name.upper();
  const Op unary = functionOf(upper);
  if (unary != Op::Unknown && count == 1)
    emit(unary, begin);
  else if (upper == "ATAN2" && count == 2)
    emit(Op::Atan2, begin);
  else if (upper == "MINVAL" && count == 2)
    emit(Op::Minimum, begin);
  else if (upper == "MAXVAL" && count == 2)
    emit(Op::Maximum, begin);
  else if (unary != Op::Unknown)
    return false; // a number of arguments that the function does not take
  else {
    if (isMisspelt(upper))
      block_.issues.push_back({SyntaxIssueKind::UnknownWord, uint32_t(begin - base_),
                               uint32_t(begin + name.size() - base_)});
    emit(Op::Opaque, begin, count);
  }
  return true;
}

int SinumerikExpression::indices(unsigned depth) {
  ++at_; // the bracket
  for (int count = 0;;) {
    if (!group(depth + 1))
      return -1;
    ++count;
    skipBlanks();
    if (at_ < end_ && *at_ == ']') {
      ++at_;
      return count;
    }
    if (at_ == end_ || *at_ != ',')
      return -1;
    ++at_;
  }
}

int SinumerikExpression::arguments(unsigned depth) {
  ++at_; // the parenthesis
  skipBlanks();
  if (at_ < end_ && *at_ == ')') {
    ++at_;
    return 0;
  }
  for (int count = 0;;) {
    skipBlanks();
    if (at_ < end_ && (*at_ == ',' || *at_ == ')'))
      emit(Op::Opaque, at_); // left out
    else if (!group(depth + 1))
      return -1;
    ++count;
    skipBlanks();
    if (at_ < end_ && *at_ == ')') {
      ++at_;
      return count;
    }
    if (at_ == end_ || *at_ != ',')
      return -1;
    ++at_;
  }
}

/// `[1,X,TR]` of a system variable: which element it is does not matter.
bool SinumerikExpression::skipIndices() {
  if (at_ == end_ || *at_ != '[')
    return true;
  int depth = 0;
  for (const char *p = at_; p < end_ && *p != '\n' && *p != '\r' && *p != ';'; ++p) {
    depth += *p == '[';
    depth -= *p == ']';
    if (depth == 0) {
      at_ = p + 1;
      return true;
    }
  }
  return false;
}

} // namespace ncvet
