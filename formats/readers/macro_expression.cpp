// Parser of Macro B expressions: text to operations in postfix order.
#include "formats/readers/macro_expression.h"

#include <cstdlib>
#include <cstring>

namespace ncvet {

namespace {

bool isDigit(char c) { return uint8_t(c - '0') < 10; }

struct FunctionName {
  const char *name;
  Op op;
};
constexpr FunctionName functions[] = {{"SIN", Op::Sin},   {"COS", Op::Cos},   {"TAN", Op::Tan},
                                      {"ASIN", Op::Asin}, {"ACOS", Op::Acos}, {"ATAN", Op::Atan},
                                      {"SQRT", Op::Sqrt}, {"SQR", Op::Sqrt},  {"ABS", Op::Abs},
                                      {"BIN", Op::Bin},   {"BCD", Op::Bcd},   {"ROUND", Op::Round},
                                      {"RND", Op::Round}, {"FIX", Op::Fix},   {"FUP", Op::Fup},
                                      {"LN", Op::Ln},     {"EXP", Op::Exp},   {"ADP", Op::Adp}};

} // namespace

void MacroExpression::skipBlanks() {
  while (at_ < end_ && (*at_ == ' ' || *at_ == '\t'))
    ++at_;
}

bool MacroExpression::letters(const char *word) const {
  const size_t length = strlen(word);
  if (size_t(end_ - at_) < length)
    return false;
  for (size_t i = 0; i < length; ++i)
    if ((at_[i] & ~32) != word[i])
      return false;
  return true;
}

void MacroExpression::emit(Op op, const char *at, double value) {
  block_.operations.push_back({op, uint32_t(at - base_), value});
}

uint16_t MacroExpression::parse(Form form) {
  skipBlanks();
  const char *begin = at_;
  Expression result;
  result.first = uint32_t(block_.operations.size());
  result.begin = uint32_t(begin - base_);
  bool good = false;
  switch (form) {
  case Form::Full:
    good = comparison(0);
    break;
  case Form::Operand:
    good = operand(0);
    break;
  case Form::VariableNumber:
    if (at_ < end_ && *at_ == '#') {
      ++at_;
      // The variable's number, not its value.
      skipBlanks();
      if (at_ < end_ && *at_ == '[')
        good = operand(1);
      else if (at_ < end_ && *at_ == '#')
        good = variable(1);
      else
        good = number();
    }
    break;
  }
  if (!good) {
    result.bad = true;
    block_.operations.resize(result.first);
    emit(Op::Unknown, begin);
    // Go on behind what belongs to the expression: at the next blank outside brackets.
    int depth = 0;
    const char *p = begin;
    while (p < end_ && *p != '\n' && *p != '\r' && *p != '(' && *p != ';') {
      if (*p == '[')
        ++depth;
      else if (*p == ']')
        --depth;
      else if (depth <= 0 && *p == ' ' && p > begin)
        break;
      ++p;
    }
    if (p > at_)
      at_ = p;
    block_.issues.push_back(
        {depth ? SyntaxIssueKind::UnbalancedBracket : SyntaxIssueKind::BadExpression,
         uint32_t(begin - base_), uint32_t(at_ - base_)});
  }
  result.count = uint32_t(block_.operations.size()) - result.first;
  result.end = uint32_t(at_ - base_);
  if (block_.expressions.size() >= noExpression - 1)
    return uint16_t(block_.expressions.size() - 1);
  block_.expressions.push_back(result);
  return uint16_t(block_.expressions.size() - 1);
}

bool MacroExpression::comparison(unsigned depth) {
  if (!sum(depth))
    return false;
  for (;;) {
    skipBlanks();
    const char *at = at_;
    Op op;
    if (letters("EQ"))
      op = Op::Equal;
    else if (letters("NE"))
      op = Op::NotEqual;
    else if (letters("GT"))
      op = Op::Greater;
    else if (letters("GE"))
      op = Op::GreaterEqual;
    else if (letters("LT"))
      op = Op::Less;
    else if (letters("LE"))
      op = Op::LessEqual;
    else
      return true;
    at_ += 2;
    if (!sum(depth))
      return false;
    emit(op, at);
  }
}

// `+ - OR XOR` bind alike, and looser than `* / AND MOD`.
bool MacroExpression::sum(unsigned depth) {
  if (!product(depth))
    return false;
  for (;;) {
    skipBlanks();
    const char *at = at_;
    Op op;
    unsigned length = 1;
    if (at_ < end_ && *at_ == '+')
      op = Op::Add;
    else if (at_ < end_ && *at_ == '-')
      op = Op::Subtract;
    else if (letters("OR")) {
      op = Op::Or;
      length = 2;
    } else if (letters("XOR")) {
      op = Op::Xor;
      length = 3;
    } else
      return true;
    at_ += length;
    if (!product(depth))
      return false;
    emit(op, at);
  }
}

bool MacroExpression::product(unsigned depth) {
  if (!operand(depth))
    return false;
  for (;;) {
    skipBlanks();
    const char *at = at_;
    Op op;
    unsigned length = 1;
    if (at_ < end_ && *at_ == '*')
      op = Op::Multiply;
    else if (at_ < end_ && *at_ == '/')
      op = Op::Divide;
    else if (letters("AND")) {
      op = Op::And;
      length = 3;
    } else if (letters("MOD")) {
      op = Op::Modulo;
      length = 3;
    } else
      return true;
    at_ += length;
    if (!operand(depth))
      return false;
    emit(op, at);
  }
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
    ++at_;
    if (!comparison(depth + 1))
      return false;
    skipBlanks();
    // `[[#1 EQ 1] AND [#2 EQ 2]]`: logic between comparisons.
    if (at_ >= end_ || *at_ != ']')
      return false;
    ++at_;
    return true;
  }
  if (isDigit(*at_) || *at_ == '.')
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
  if (isDigit(*at_)) {
    double value = 0;
    while (at_ < end_ && isDigit(*at_))
      value = value * 10 + (*at_++ - '0');
    if (value == 0)
      emit(Op::Vacant, at);
    else
      emit(Op::Variable, at, value);
    return true;
  }
  if (*at_ == '[') {
    if (at_ + 1 < end_ && at_[1] == '#' && at_ + 2 < end_ && at_[2] == '_') {
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
    while (at_ < end_ && (*at_ == '_' || isDigit(*at_) || uint8_t((*at_ | 32) - 'a') < 26))
      ++at_;
    emit(Op::Unknown, at);
    return true;
  }
  return false;
}

bool MacroExpression::number() {
  const char *at = at_;
  double mantissa = 0;
  double scale = 1;
  bool any = false;
  while (at_ < end_ && isDigit(*at_)) {
    mantissa = mantissa * 10 + (*at_++ - '0');
    any = true;
  }
  if (at_ < end_ && *at_ == '.') {
    ++at_;
    while (at_ < end_ && isDigit(*at_)) {
      if (scale < 1e15) {
        mantissa = mantissa * 10 + (*at_ - '0');
        scale *= 10;
      }
      ++at_;
      any = true;
    }
  }
  if (!any)
    return false;
  emit(Op::Number, at, mantissa / scale);
  return true;
}

bool MacroExpression::function(unsigned depth) {
  const char *at = at_;
  for (const FunctionName &entry : functions) {
    if (!letters(entry.name))
      continue;
    const size_t length = strlen(entry.name);
    const char *p = at_ + length;
    while (p < end_ && *p == ' ')
      ++p;
    if (p >= end_ || *p != '[')
      continue;
    at_ = p + 1;
    if (!comparison(depth + 1))
      return false;
    skipBlanks();
    bool two = false;
    if (at_ < end_ && *at_ == ',') { // ATAN[y,x]
      ++at_;
      if (!comparison(depth + 1))
        return false;
      skipBlanks();
      two = true;
    }
    if (at_ >= end_ || *at_ != ']')
      return false;
    ++at_;
    if (entry.op == Op::Atan) {
      skipBlanks();
      if (!two && at_ < end_ && *at_ == '/') { // ATAN[y]/[x]
        ++at_;
        if (!operand(depth + 1))
          return false;
        two = true;
      }
      emit(two ? Op::Atan2 : Op::Atan, at);
    } else {
      emit(two ? Op::Unknown : entry.op, at);
      if (two)
        return false;
    }
    return true;
  }
  return false;
}

} // namespace ncvet
