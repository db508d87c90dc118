// Parser of Sinumerik expressions: text to operations in postfix order.
#include "formats/readers/sinumerik/sinumerik_expression.h"

#include "formats/readers/sinumerik/sinumerik_functions.h"

#include "llvm/ADT/SmallString.h"
#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringSwitch.h"

#include <cstdlib>

namespace ncvet {

namespace {

bool isNameLetter(char c) { return llvm::isAlpha(c) || c == '_'; }
bool isNameCharacter(char c) { return llvm::isAlnum(c) || c == '_'; }

constexpr unsigned comparisonStrength = 1, chainStrength = 2, andStrength = 5, strongest = 10;

/// The operator at the head of `text`; strength 0: there is none.
BinaryOperator binaryAt(llvm::StringRef text) {
  switch (text.empty() ? 0 : text[0]) {
  case '=':
    return text.startswith("==") ? BinaryOperator{Op::Equal, comparisonStrength, 2}
                                 : BinaryOperator();
  case '<':
    return text.startswith("<<")   ? BinaryOperator{Op::Opaque, chainStrength, 2}
           : text.startswith("<>") ? BinaryOperator{Op::NotEqual, comparisonStrength, 2}
           : text.startswith("<=") ? BinaryOperator{Op::LessEqual, comparisonStrength, 2}
                                   : BinaryOperator{Op::Less, comparisonStrength, 1};
  case '>':
    return text.startswith(">=") ? BinaryOperator{Op::GreaterEqual, comparisonStrength, 2}
                                 : BinaryOperator{Op::Greater, comparisonStrength, 1};
  case ':':
    return {Op::Opaque, chainStrength, 1};
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
  BinaryOperator found = llvm::StringSwitch<BinaryOperator>(name.upper())
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

bool isLogical(const BinaryOperator &binary) {
  return binary.strength >= 3 && binary.strength <= 5;
}

/// Key of `R12`; 0: the name is another.
uint64_t parameterKey(llvm::StringRef name) {
  int64_t parameter = 0;
  if ((name[0] | 32) != 'r' || name.size() < 2 || name.size() >= 10 ||
      name.drop_front().getAsInteger(10, parameter))
    return 0;
  return elementKey(variableKey("R"), parameter);
}

} // namespace

llvm::StringRef SinumerikExpression::identifier() const {
  return llvm::StringRef(at_, size_t(end_ - at_)).take_while(isNameCharacter);
}

/// After what belongs to a bad expression: at the first blank outside brackets that comes after
/// what could be read, or at a jump, which is part of none.
ExpressionParser::Rest SinumerikExpression::afterBad(const char *begin) const {
  int depth = 0;
  const char *p = begin;
  for (; p < end_ && !isLineEnd(*p) && *p != ';'; ++p) {
    if (p > begin && !isNameCharacter(p[-1]) &&
        llvm::StringRef(p, size_t(end_ - p)).startswith_insensitive("GOTO"))
      break;
    if (*p == '(' || *p == '[')
      ++depth;
    else if (*p == ')' || *p == ']') {
      if (--depth < 0)
        break;
    } else if (depth <= 0 && (*p == ' ' || *p == ',') && p > begin && p >= at_) {
      break;
    }
  }
  return {p, depth > 0};
}

template <typename Parse>
uint16_t SinumerikExpression::read(Parse parse) {
  Expression result = open();
  const char *const begin = at_;
  ambiguous_ = false;
  if (!parse()) {
    fail(result, afterBad(begin));
  } else if (ambiguous_) {
    issue(SyntaxIssueKind::AmbiguousExpression, begin, at_);
    result.bad = true;
  }
  return close(result);
}

uint16_t SinumerikExpression::parse() {
  return read([this] { return group(0); });
}

uint16_t SinumerikExpression::parseCondition() {
  const uint16_t index = parse();
  const char *const sign = afterBlanks(at_);
  if (sign == end_ || *sign != '=' || index + 1u != block_.expressions.size())
    return index;
  issue(SyntaxIssueKind::AssignmentInTest, sign, sign + 1);
  at_ = sign + 1;
  const uint16_t right = parse();
  // Both sides follow each other: they become one comparison.
  Expression &whole = block_.expressions[index];
  if (right != index) {
    whole.count += block_.expressions[right].count;
    whole.bad |= block_.expressions[right].bad;
    block_.expressions.pop_back();
  }
  emit(Op::Equal, sign);
  ++whole.count;
  whole.end = offset(at_);
  return index;
}

/// `AC`, `IC`, `DC`, `ACP`, `ACN`: says how the value in brackets after it counts.
static bool isReading(llvm::StringRef name) {
  return llvm::StringSwitch<bool>(name.upper())
      .Cases("AC", "IC", "DC", "ACP", "ACN", true)
      .Default(false);
}

uint16_t SinumerikExpression::parseValue(WordReading &reading) {
  reading = WordReading::Modal;
  return read([&] {
    const llvm::StringRef head = identifier();
    const char *const after = afterSpaces(head.end());
    if ((head.size() == 2 || head.size() == 3) && after < end_ && *after == '(')
      reading = llvm::StringSwitch<WordReading>(head.upper())
                    .Case("AC", WordReading::Absolute)
                    .Case("IC", WordReading::Incremental)
                    .Case("DC", WordReading::RotaryShortest)
                    .Case("ACP", WordReading::RotaryPositive)
                    .Case("ACN", WordReading::RotaryNegative)
                    .Default(WordReading::Modal);
    if (reading == WordReading::Modal)
      return isReading(head) ? false : group(0);
    at_ = after + 1;
    return group(1) && take(')');
  });
}

uint16_t SinumerikExpression::parseTarget() {
  return read([this] {
    const char *const begin = at_;
    if (at_ < end_ && *at_ == '$') {
      const llvm::StringRef name = system();
      if (name.empty())
        return false;
      // `$TC_DP6[2,1]` is a variable of its own; one whose index is computed may be any of its
      // name.
      const llvm::StringRef whole(begin, size_t(at_ - begin));
      const bool plain =
          whole.drop_front(name.size()).find_first_not_of("[]0123456789,") == llvm::StringRef::npos;
      emit(Op::Number, begin, double(variableKey(plain ? whole : name)));
      return true;
    }
    const llvm::StringRef name = identifier();
    if (name.empty())
      return false;
    at_ = name.end();
    if (const uint64_t key = parameterKey(name)) {
      emit(Op::Number, begin, double(key));
      return true;
    }
    const uint64_t key = variableKey(name);
    if (at_ == end_ || *at_ != '[') {
      emit(Op::Number, begin, double(key));
      return true;
    }
    return elements(0, Op::ElementKey, key, begin);
  });
}

/// What is in one pair of brackets.
bool SinumerikExpression::group(unsigned depth) {
  Seen seen;
  if (!level(depth, comparisonStrength, seen))
    return false;
  ambiguous_ |= seen.comparison && seen.logical;
  return true;
}

/// AND, OR and XOR ask of each side whether it is 0: `5 AND 2` is true, where `5 B_AND 2` has no
/// bit.
void SinumerikExpression::makeTruth(const char *at) {
  const Op last = block_.operations.back().op;
  if ((last >= Op::Equal && last <= Op::LessEqual) || last == Op::Not ||
      block_.operations.size() == truthEnd_)
    return;
  emit(Op::Not, at);
  emit(Op::Not, at);
}

/// Operands and operators at least as strong as `strength`, grouped from the left.
bool SinumerikExpression::level(unsigned depth, unsigned strength, Seen &seen) {
  const auto apply = [&](const BinaryOperator &binary, const char *at) {
    seen.comparison |= binary.strength == comparisonStrength;
    const bool logical = isLogical(binary);
    seen.logical |= logical;
    if (logical)
      makeTruth(at);
    if (!level(depth, binary.strength + 1, seen))
      return false;
    if (logical)
      makeTruth(at);
    emit(binary.op, at, binary.op == Op::Opaque ? 2 : 0);
    if (logical)
      truthEnd_ = block_.operations.size();
    return true;
  };
  return unary(depth, seen) && operators(
                                   strength,
                                   [this] {
                                     return binaryAt({at_, size_t(end_ - at_)});
                                   },
                                   apply);
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
  if (end_ - at_ > 1 && at_[0] == '<' && at_[1] == '<') {
    // `<<R1`: a chain of one link makes a text of a number.
    at_ += 2;
    if (!unary(depth + 1, seen))
      return false;
    emit(Op::Opaque, at, 1);
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
    return group(depth + 1) && take(')');
  }
  if (c == '$' || isNameLetter(c))
    return name(depth);
  return false;
}

/// `12`, `1.5`, `.5`, `1.5EX-3`.
bool SinumerikExpression::number() {
  const char *const begin = at_;
  if (!takeDigits())
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
  while (p < end_ && *p != '\'' && !isLineEnd(*p))
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
  else if ((kind == 'H' && !llvm::all_of(inside.drop_front(), llvm::isHexDigit)) ||
           (kind == 'B' && inside.drop_front().find_first_not_of("01") != llvm::StringRef::npos))
    return false; // `'B102'`
  else
    emit(Op::Opaque, begin);
  return true;
}

bool SinumerikExpression::text() {
  const char *const begin = at_++;
  while (at_ < end_ && *at_ != '"' && !isLineEnd(*at_))
    ++at_;
  if (at_ == end_ || *at_ != '"')
    return false;
  ++at_;
  emit(Op::Opaque, begin);
  return true;
}

/// `R24Y=` in `X=R24Y=5`, `R8F100.`: a word follows without a blank, for no name has a digit
/// second.
llvm::StringRef SinumerikExpression::withoutGluedWord(llvm::StringRef name) {
  const llvm::StringRef parameter =
      name.take_front(1 + name.drop_front().take_while(llvm::isDigit).size());
  return parameter.size() < name.size() && parameterKey(parameter) ? parameter : name;
}

/// A variable, an element of an array, a function.
bool SinumerikExpression::name(unsigned depth) {
  const char *const begin = at_;
  if (*at_ == '$') {
    if (system().empty())
      return false;
    emit(Op::Opaque, begin);
    return true;
  }
  const llvm::StringRef name = withoutGluedWord(identifier());
  at_ = name.end();
  if (const uint64_t key = parameterKey(name)) {
    emit(Op::Variable, begin, double(key));
    return true;
  }
  if (at_ < end_ && *at_ == '[')
    return elements(depth + 1, Op::ElementAt, variableKey(name), begin);
  const char *const after = afterSpaces(at_);
  if (after < end_ && *after == '(') {
    at_ = after;
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
  const Op unary = sinumerikFunction(upper);
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
    if (isMisspeltFunction(upper))
      issue(SyntaxIssueKind::UnknownWord, begin, begin + name.size());
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
    if (take(']'))
      return count;
    if (!take(','))
      return -1;
  }
}

int SinumerikExpression::arguments(unsigned depth) {
  ++at_; // the parenthesis
  if (take(')'))
    return 0;
  for (int count = 0;;) {
    skipBlanks();
    if (at_ < end_ && (*at_ == ',' || *at_ == ')'))
      emit(Op::Opaque, at_); // left out
    else if (!group(depth + 1))
      return -1;
    ++count;
    if (take(')'))
      return count;
    if (!take(','))
      return -1;
  }
}

bool SinumerikExpression::elements(unsigned depth, Op op, uint64_t array, const char *begin) {
  const int count = indices(depth);
  if (count == 1)
    emit(op, begin, double(array));
  else if (count > 1)
    emit(Op::Opaque, begin, count);
  return count > 0;
}

llvm::StringRef SinumerikExpression::system() {
  const char *const begin = at_++;
  if (at_ < end_ && *at_ == '$' && isInAction(begin))
    ++at_; // read anew while the axes move
  const llvm::StringRef name = identifier();
  at_ = name.end();
  if (name.empty() || !skipIndices())
    return {};
  return {begin, size_t(name.end() - begin)};
}

/// `[1,X,TR]` of a system variable: which element it is does not matter.
bool SinumerikExpression::skipIndices() {
  if (at_ == end_ || *at_ != '[')
    return true;
  int depth = 0;
  for (const char *p = at_; p < end_ && !isLineEnd(*p) && *p != ';'; ++p) {
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
