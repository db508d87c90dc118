// Parser of Macro B expressions: text to operations in postfix order.
#pragma once

#include "formats/readers/block.h"

namespace ncvet {

/// Reads one expression into `block.operations`. Never fails: a bad expression is marked, gets an
/// issue, and its value is unknown.
class MacroExpression {
public:
  enum class Form : uint8_t {
    Full,          ///< operators allowed: the right side of an assignment
    Operand,       ///< one operand: number, variable, function or bracket, with sign
    VariableNumber ///< `#` and what names the variable; the value is the variable's number
  };

  MacroExpression(const char *base, const char *at, const char *end, Block &block)
      : base_(base), at_(at), end_(end), block_(block) {}

  /// Index into `block.expressions` of the expression read.
  uint16_t parse(Form form);
  const char *position() const { return at_; }

private:
  /// Brackets nest at most this deep: more is no program, and recursion must be bounded.
  static constexpr unsigned maxDepth = 64;

  bool comparison(unsigned depth);
  bool sum(unsigned depth);
  bool product(unsigned depth);
  bool operand(unsigned depth);
  bool variable(unsigned depth);
  bool number();
  bool function(unsigned depth);
  void skipBlanks();
  bool letters(const char *word) const;
  void emit(Op op, const char *at, double value = 0);

  const char *base_;
  const char *at_;
  const char *end_;
  Block &block_;
};

} // namespace ncvet
