// Parser of Macro B and RS274/NGC expressions: text to operations in postfix order.
#include "formats/readers/iso/macro_expression.h"

#include "formats/dialect/variable_key.h"
#include "formats/readers/block_scanner.h"

#include "llvm/ADT/SmallString.h"
#include "llvm/ADT/StringExtras.h"

#include <utility>

namespace ncvet {

namespace {

struct FunctionName {
  llvm::StringLiteral name;
  Op op;
};
constexpr FunctionName functions[] = {
    {"SIN", Op::Sin},   {"COS", Op::Cos},   {"TAN", Op::Tan},      {"ASIN", Op::Asin},
    {"ACOS", Op::Acos}, {"ATAN", Op::Atan}, {"SQRT", Op::Sqrt},    {"SQR", Op::Sqrt},
    {"ABS", Op::Abs},   {"BIN", Op::Bin},   {"BCD", Op::Bcd},      {"ROUND", Op::Round},
    {"RND", Op::Round}, {"FIX", Op::Fix},   {"FUP", Op::Fup},      {"LN", Op::Ln},
    {"EXP", Op::Exp},   {"ADP", Op::Adp},   {"EXISTS", Op::Exists}};

constexpr unsigned comparisonStrength = 1, sumStrength = 2, productStrength = 3;

/// An operator that is spelled with letters.
struct OperatorName {
  llvm::StringLiteral name;
  Op op;
  unsigned strength;
};
constexpr OperatorName operatorNames[] = {{"EQ", Op::Equal, comparisonStrength},
                                          {"NE", Op::NotEqual, comparisonStrength},
                                          {"GT", Op::Greater, comparisonStrength},
                                          {"GE", Op::GreaterEqual, comparisonStrength},
                                          {"LT", Op::Less, comparisonStrength},
                                          {"LE", Op::LessEqual, comparisonStrength},
                                          {"OR", Op::Or, sumStrength},
                                          {"XOR", Op::Xor, sumStrength},
                                          {"AND", Op::And, productStrength},
                                          {"MOD", Op::Modulo, productStrength}};

/// Of RS274/NGC (LinuxCNC 2.9, section 11.4.6), where logic binds weakest and `**` strongest; what
/// is between them binds by one more than above.
constexpr unsigned ngcLogic = 1, ngcPower = 5;

/// Whether `text` begins with this word of capitals, written in any case.
bool beginsWith(llvm::StringRef text, llvm::StringRef word) {
  if (text.size() < word.size())
    return false;
  for (size_t i = 0; i < word.size(); ++i)
    if ((text[i] & ~32) != word[i])
      return false;
  return true;
}

/// The operator at the head of `text`; strength 0: there is none. `+ - OR XOR` bind alike, and
/// looser than `* / AND MOD`; comparisons bind weakest.
BinaryOperator binaryAt(llvm::StringRef text) {
  switch (text.empty() ? '\0' : text[0]) {
  case '+':
    return {Op::Add, sumStrength, 1};
  case '-':
    return {Op::Subtract, sumStrength, 1};
  case '*':
    return {Op::Multiply, productStrength, 1};
  case '/':
    return {Op::Divide, productStrength, 1};
  default:
    break;
  }
  if (text.empty() || !llvm::isAlpha(text[0])) // most expressions end here
    return {};
  for (const OperatorName &entry : operatorNames)
    if (beginsWith(text, entry.name))
      return {entry.op, entry.strength, unsigned(entry.name.size())};
  return {};
}

/// The same of RS274/NGC.
BinaryOperator ngcBinaryAt(llvm::StringRef text) {
  if (text.startswith("**"))
    return {Op::Power, ngcPower, 2};
  BinaryOperator found = binaryAt(text);
  switch (found.op) {
  case Op::And:
  case Op::Or:
  case Op::Xor:
    found.strength = ngcLogic;
    break;
  case Op::Modulo:
    found.op = Op::FloorModulo;
    [[fallthrough]];
  default:
    found.strength += found.strength ? 1 : 0;
  }
  return found;
}

} // namespace

/// After what belongs to a bad expression: at the next blank outside brackets.
ExpressionParser::Rest MacroExpression::afterBad(const char *begin) const {
  int depth = 0;
  const char *p = begin;
  for (; p < end_ && !isLineEnd(*p) && *p != '(' && *p != ';'; ++p) {
    if (*p == '[')
      ++depth;
    else if (*p == ']')
      --depth;
    else if (depth <= 0 && *p == ' ' && p > begin)
      break;
  }
  return {p, depth != 0};
}

bool MacroExpression::namesFunction(llvm::StringRef letters) {
  return llvm::any_of(
      functions, [&](const FunctionName &entry) { return letters.equals_insensitive(entry.name); });
}

size_t MacroExpression::namesOperator(llvm::StringRef text) {
  return !text.empty() && llvm::isAlpha(text[0]) ? binaryAt(text).length : 0;
}

uint16_t MacroExpression::parse(Form form, Arithmetic arithmetic) {
  ngc_ = arithmetic == Arithmetic::Ngc;
  names_ = arithmetic == Arithmetic::MacroB30;
  decimals_ = arithmetic == Arithmetic::MacroBDecimal;
  Expression result = open();
  const char *const begin = at_;
  bool good = false;
  ambiguous_ = false;
  switch (form) {
  case Form::Full:
    good = ngc_ ? operand(0) : group(0); // (there only brackets hold operators)
    if (good)
      skipBlanks(); // the right side of an assignment ends where the next thing begins
    break;
  case Form::Operand:
    good = operand(0);
    break;
  case Form::VariableNumber:
    if (names_ && at_ < end_ && *at_ == '[')
      good = bracketedName(Op::Number);
    else if (at_ < end_ && *at_ == '#') {
      ++at_;
      // The variable's number, not its value.
      skipBlanks();
      if (at_ < end_ && *at_ == '[')
        good = operand(1);
      else if (at_ < end_ && *at_ == '#')
        good = variable(1);
      else if (ngc_ && at_ < end_ && *at_ == '<')
        good = named(Op::Number);
      else
        good = number();
    }
    break;
  }
  if (!good) {
    fail(result, afterBad(begin));
  } else if (ambiguous_) {
    issue(SyntaxIssueKind::AmbiguousExpression, begin, at_);
    result.bad = true;
  }
  return close(result);
}

bool MacroExpression::group(unsigned depth) {
  if (ngc_)
    return level(depth, ngcLogic);
  const Used outside = std::exchange(used_, Used());
  const bool good = level(depth, comparisonStrength);
  ambiguous_ |= names_ && used_.logic && used_.comparisons > 1;
  used_ = outside;
  return good;
}

/// What an operator of RS274/NGC makes of its two operands.
void MacroExpression::emitNgc(Op op, const char *at) {
  // Two values are equal when they differ by less (LinuxCNC 2.9, section 11.4.7).
  constexpr double tolerance = 0.0001;
  switch (op) {
  case Op::Equal:
  case Op::NotEqual:
    emit(Op::Subtract, at);
    emit(Op::Abs, at);
    emit(Op::Number, at, tolerance);
    emit(op == Op::Equal ? Op::Less : Op::GreaterEqual, at);
    return;
  case Op::And:
  case Op::Or:
  case Op::Xor:
    emitTruth(at);
    [[fallthrough]];
  default:
    emit(op, at);
  }
}

/// 1 for every value but zero.
void MacroExpression::emitTruth(const char *at) {
  emit(Op::Number, at, 0);
  emit(Op::NotEqual, at);
}

/// Operands and operators at least as strong as `strength`, grouped from the left.
bool MacroExpression::level(unsigned depth, unsigned strength) {
  const auto find = [this] {
    const llvm::StringRef rest(at_, size_t(end_ - at_));
    return ngc_ ? ngcBinaryAt(rest) : binaryAt(rest);
  };
  const auto apply = [&](const BinaryOperator &binary, const char *at) {
    const bool strongest = binary.strength == (ngc_ ? ngcPower : productStrength);
    if (ngc_ && binary.strength == ngcLogic)
      emitTruth(at);
    if (!(strongest ? operand(depth) : level(depth, binary.strength + 1)))
      return false;
    used_.comparisons += binary.strength == comparisonStrength;
    used_.logic |= binary.op == Op::And || binary.op == Op::Or || binary.op == Op::Xor;
    if (ngc_)
      emitNgc(binary.op, at);
    else
      emit(binary.op, at);
    return true;
  };
  return operand(depth) && operators(strength, find, apply);
}

bool MacroExpression::operand(unsigned depth) {
  skipBlanks();
  if (at_ >= end_ || depth > maxDepth)
    return false;
  const char *at = at_;
  if (*at_ == '-' || *at_ == '+') {
    const bool negative = *at_ == '-';
    ++at_;
    if (!operand(depth + 1))
      return false;
    if (negative)
      emit(Op::Negate, at);
    return true;
  }
  if (*at_ == '#')
    return variable(depth);
  if (*at_ == '[') {
    const char *const inside = afterBlanks(at_ + 1);
    if (names_ && inside + 1 < end_ && *inside == '#' && (inside[1] == '_' || isLetter(inside[1])))
      return bracketedName(Op::Variable);
    ++at_;
    return group(depth + 1) && passComment() && take(']');
  }
  if (isNumberDigit(*at_) || *at_ == '.')
    return number();
  return function(depth);
}

bool MacroExpression::variable(unsigned depth) {
  if (depth > maxDepth)
    return false;
  const char *at = at_;
  ++at_; // #
  skipBlanks();
  if (at_ >= end_)
    return false;
  if (isNumberDigit(*at_)) {
    double value = 0;
    while (at_ < end_ && isNumberDigit(*at_))
      value = value * 10 + (*at_++ - '0');
    if (decimals_ && at_ < end_ && *at_ == '.') { // one value of a list of the control's own
      ++at_;
      while (at_ < end_ && isNumberDigit(*at_))
        ++at_;
      emit(Op::Unknown, at);
      return true;
    }
    if (value == 0)
      emit(Op::Vacant, at);
    else
      emit(Op::Variable, at, value);
    return true;
  }
  if (ngc_ && *at_ == '<')
    return named(Op::Variable);
  if (*at_ == '[') {
    if (!ngc_ && at_ + 1 < end_ && at_[1] == '#' && at_ + 2 < end_ && at_[2] == '_') {
      // `#[#_NAME]`: a system variable by name; its value is unknown.
      while (at_ < end_ && *at_ != ']' && *at_ != '\n' && *at_ != '\r')
        ++at_;
      if (at_ >= end_ || *at_ != ']')
        return false;
      ++at_;
      emit(Op::Unknown, at);
      return true;
    }
    if (!operand(depth + 1))
      return false;
    emit(Op::VariableAt, at);
    return true;
  }
  if (*at_ == '#') {
    if (!variable(depth + 1))
      return false;
    emit(Op::VariableAt, at);
    return true;
  }
  if (*at_ == '_') {
    while (at_ < end_ && (*at_ == '_' || isNumberDigit(*at_) || uint8_t((*at_ | 32) - 'a') < 26))
      ++at_;
    emit(Op::Unknown, at);
    return true;
  }
  return false;
}

/// `<name>`: `op` with the key of a variable with a name; blanks in it do not count.
bool MacroExpression::named(Op op) {
  const char *at = at_++;
  llvm::SmallString<32> name;
  for (; at_ < end_ && *at_ != '>' && !isLineEnd(*at_); ++at_)
    if (*at_ != ' ' && *at_ != '\t')
      name += *at_;
  if (at_ >= end_ || *at_ != '>' || name.empty())
    return false;
  ++at_;
  // What the machine is set up with, and its signals (LinuxCNC 2.9, INI and HAL access): values
  // that no program gives.
  if (op == Op::Variable && (beginsWith(name, "_INI[") || beginsWith(name, "_HAL["))) {
    emit(Op::Unknown, at);
    return true;
  }
  emit(op, at, double(name[0] == '_' ? sharedVariableKey(name) : variableKey(name)));
  return true;
}

/// `[#NAME]`, `[#_NAME[2]]`: `op` with the key of a variable with a name; those of the control,
/// whose names begin with `_`, have values that no program gives.
bool MacroExpression::bracketedName(Op op) {
  const char *const at = at_;
  if (!take('[') || !take('#'))
    return false;
  const char *const name = at_;
  while (at_ < end_ && (*at_ == '_' || isNumberDigit(*at_) || isLetter(*at_)))
    ++at_;
  const llvm::StringRef text(name, size_t(at_ - name));
  const bool element = at_ < end_ && *at_ == '[';
  if (element && !passBrackets())
    return false;
  if (text.empty() || !take(']'))
    return false;
  if (op == Op::Variable && (element || text[0] == '_'))
    emit(Op::Unknown, at);
  else
    emit(op, at, double(sharedVariableKey(text)));
  return true;
}

/// Steps over the bracket that opens here and all that it holds.
bool MacroExpression::passBrackets() {
  int depth = 0;
  for (; at_ < end_ && !isLineEnd(*at_); ++at_) {
    depth += *at_ == '[' ? 1 : *at_ == ']' ? -1 : 0;
    if (depth == 0) {
      ++at_;
      return true;
    }
  }
  return false;
}

/// POW and what asks the control for an axis or a parameter; false, with nothing read: none of them
/// is here.
bool MacroExpression::function30(unsigned depth, bool &good) {
  const char *const at = at_;
  constexpr llvm::StringLiteral asks[] = {"AXNUM", "AX", "PRM"};
  const llvm::StringRef rest(at_, size_t(end_ - at_));
  const auto opens = [&](llvm::StringRef name) {
    const char *const bracket = afterSpaces(at_ + std::min(name.size(), rest.size()));
    return beginsWith(rest, name) && bracket < end_ && *bracket == '[';
  };
  for (const llvm::StringLiteral name : asks)
    if (opens(name)) {
      at_ = afterSpaces(at_ + name.size());
      good = passBrackets();
      if (good && at_ + 1 < end_ && *at_ == '/' && at_[1] == '[') { // PRM[1320]/[2]
        ++at_;
        good = passBrackets();
      }
      emit(Op::Unknown, at);
      return true;
    }
  if (!opens("POW"))
    return false;
  at_ = afterSpaces(at_ + 3) + 1;
  good = group(depth + 1) && take(',') && group(depth + 1) && take(']');
  emit(Op::Power, at);
  return true;
}

/// `#<name>]` after EXISTS and its bracket; a parameter by its number is always there.
bool MacroExpression::exists() {
  if (!ngc_ || !take('#'))
    return false;
  skipBlanks();
  if (const char *const at = at_; at_ < end_ && isNumberDigit(*at_)) {
    if (!number())
      return false;
    emit(Op::Unknown, at);
    return take(']');
  }
  return at_ < end_ && *at_ == '<' && named(Op::Exists) && take(']');
}

bool MacroExpression::number() {
  const char *at = at_;
  double mantissa = 0;
  double scale = 1;
  bool any = false;
  // Blanks inside a number do not count where the language has none.
  const auto pass = [&] {
    const char *const p = ngc_ ? afterBlanks(at_) : at_;
    if (p < end_ && (isNumberDigit(*p) || *p == '.'))
      at_ = p;
  };
  while (at_ < end_ && isNumberDigit(*at_)) {
    mantissa = mantissa * 10 + (*at_++ - '0');
    any = true;
    pass();
  }
  if (at_ < end_ && *at_ == '.') {
    ++at_;
    pass();
    while (at_ < end_ && isNumberDigit(*at_)) {
      if (scale < 1e15) {
        mantissa = mantissa * 10 + (*at_ - '0');
        scale *= 10;
      }
      ++at_;
      any = true;
      pass();
    }
  }
  if (!any)
    return false;
  emit(Op::Number, at, mantissa / scale);
  return true;
}

bool MacroExpression::function(unsigned depth) {
  const char *at = at_;
  if (bool good = false; names_ && function30(depth, good))
    return good;
  for (const FunctionName &entry : functions) {
    const llvm::StringRef text(at_, size_t(end_ - at_));
    // Of a name that only one function has the first two letters stand for it (0i and later).
    constexpr size_t letters = 2;
    const bool isShort = names_ && entry.name.size() > letters && text.size() > letters &&
                         text[letters] == '[' && beginsWith(text, entry.name.take_front(letters));
    if (!isShort && !beginsWith(text, entry.name))
      continue;
    const char *const after = at_ + (isShort ? letters : entry.name.size());
    const char *const bracket = ngc_ ? afterBlanks(after) : afterSpaces(after);
    if (bracket == end_ || *bracket != '[')
      continue;
    at_ = bracket + 1;
    if (entry.op == Op::Exists)
      return exists();
    if (!group(depth + 1))
      return false;
    bool two = !ngc_ && take(','); // ATAN[y,x]
    if ((two && !group(depth + 1)) || !take(']'))
      return false;
    if (entry.op == Op::Atan) {
      skipBlanks();
      if (!two && take('/')) { // ATAN[y]/[x]
        if (!operand(depth + 1))
          return false;
        two = true;
      }
      if (ngc_ && !two)
        return false;
      emit(two ? Op::Atan2 : Op::Atan, at);
    } else {
      const Op own = ngc_ && entry.op == Op::Fix   ? Op::Floor
                     : ngc_ && entry.op == Op::Fup ? Op::Ceiling
                                                   : entry.op;
      emit(two ? Op::Unknown : own, at);
      if (two)
        return false;
    }
    return true;
  }
  return false;
}

} // namespace ncvet
