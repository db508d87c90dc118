// Parser of ECS expressions: text to operations in postfix order.
#pragma once

#include "formats/readers/block.h"

namespace ncvet {

/// Reads one expression into `block.operations`. Never fails: a bad expression is marked, gets an
/// issue, and its value is unknown. `**` binds tightest, then the sign, `* / //`, `+ -`.
class EcsExpression {
public:
  EcsExpression(const char *base, const char *at, const char *end, Block &block)
      : base_(base), at_(at), end_(end), block_(block) {}

  /// Index into `block.expressions` of the expression read.
  uint16_t parse();
  /// What names a variable, as its key: `R1`, `V1025`, `#271`, `ENT`, `%CON`.
  uint16_t parseTarget();
  const char *position() const { return at_; }

private:
  /// Brackets nest at most this deep: more is no program, and recursion must be bounded.
  static constexpr unsigned maxDepth = 64;

  template <typename Parse>
  uint16_t read(Parse parse);
  void ambiguous(const char *begin); ///< what was read since `begin` may be grouped otherwise
  bool sum(unsigned depth);
  bool product(unsigned depth);
  bool factor(unsigned depth);
  bool atom(unsigned depth);
  bool name(unsigned depth);
  /// Key of the variable at hand; 0: there is none.
  uint64_t variable();
  void skipBlanks() {
    while (at_ < end_ && (*at_ == ' ' || *at_ == '\t'))
      ++at_;
  }
  void emit(Op op, const char *at, double value = 0) {
    block_.operations.push_back({op, uint32_t(at - base_), value});
  }

  const char *base_;
  const char *at_;
  const char *end_;
  Block &block_;
};

} // namespace ncvet
