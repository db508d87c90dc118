// Parser of Sinumerik expressions: text to operations in postfix order.
#pragma once

#include "formats/readers/block.h"

namespace ncvet {

/// Reads one expression into `block.operations`. Never fails: a bad expression is marked, gets an
/// issue, and its value is unknown. Operators in the order of the control: comparisons bind weakest
/// of all, below AND and OR.
class SinumerikExpression {
public:
  SinumerikExpression(const char *base, const char *at, const char *end, Block &block)
      : base_(base), at_(at), end_(end), block_(block) {}

  /// Index into `block.expressions` of the expression read.
  uint16_t parse();
  /// The same for a condition: `=` is taken as the `==` that it was meant to be, with an issue.
  uint16_t parseCondition();
  /// A value of a word: perhaps inside AC(..), IC(..), DC(..), ACP(..), ACN(..).
  uint16_t parseValue(WordReading &reading);
  /// What names a variable, as its key: `R1`, `NAME`, `FIELD[R2+1]`, `$TC_DP6[1,1]`.
  uint16_t parseTarget();
  const char *position() const { return at_; }

private:
  /// Brackets nest at most this deep: more is no program, and recursion must be bounded.
  static constexpr unsigned maxDepth = 64;
  /// Which kinds of operators stand side by side in one pair of brackets.
  struct Seen {
    bool comparison = false;
    bool logical = false;
  };

  template <typename Parse>
  uint16_t read(Parse parse);
  bool group(unsigned depth);
  bool level(unsigned depth, unsigned strength, Seen &seen);
  bool unary(unsigned depth, Seen &seen);
  bool operand(unsigned depth);
  bool number();
  bool constant();
  bool text();
  bool name(unsigned depth);
  bool function(unsigned depth, llvm::StringRef name, const char *begin);
  /// Index list in brackets; -1: it could not be read.
  int indices(unsigned depth);
  /// Argument list in parentheses; -1: it could not be read.
  int arguments(unsigned depth);
  bool skipIndices();
  void skipBlanks() {
    while (at_ < end_ && (*at_ == ' ' || *at_ == '\t'))
      ++at_;
  }
  llvm::StringRef identifier() const;
  void emit(Op op, const char *at, double value = 0) {
    block_.operations.push_back({op, uint32_t(at - base_), value});
  }

  const char *base_;
  const char *at_;
  const char *end_;
  Block &block_;
  bool ambiguous_ = false;
};

} // namespace ncvet
