// Parser of ECS expressions: text to operations in postfix order.
#pragma once

#include "formats/readers/expression_parser.h"

namespace ncvet {

/// Reads one expression into `block.operations`. Never fails: a bad expression is marked, gets an
/// issue, and its value is unknown. `**` binds tightest, then the sign, `* / //`, `+ -`.
class EcsExpression : public ExpressionParser {
public:
  explicit EcsExpression(const BlockCursor &from) : ExpressionParser(from) {}

  /// Index into `block.expressions` of the expression read.
  uint16_t parse();
  /// What names a variable, as its key: `R1`, `V1025`, `#271`, `ENT`, `%CON`.
  uint16_t parseTarget();

private:
  template <typename Parse>
  uint16_t read(Parse parse);
  Rest afterBad(const char *begin) const;
  void ambiguous(const char *begin); ///< what was read since `begin` may be grouped otherwise
  BinaryOperator nextBinary() const;
  bool sum(unsigned depth);
  bool product(unsigned depth);
  bool factor(unsigned depth);
  bool atom(unsigned depth);
  bool name(unsigned depth);
  /// Key of the current variable; 0: there is none.
  uint64_t variable();
};

} // namespace ncvet
