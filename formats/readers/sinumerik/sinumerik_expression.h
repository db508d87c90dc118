// Parser of Sinumerik expressions: text to operations in postfix order.
#pragma once

#include "formats/readers/expression_parser.h"

namespace ncvet {

/// Reads one expression into `block.operations`. Never fails: a bad expression is marked, gets an
/// issue, and its value is unknown. Operators in the order of the control: comparisons bind weakest
/// of all, below AND and OR.
class SinumerikExpression : public ExpressionParser {
public:
  explicit SinumerikExpression(const BlockCursor &from) : ExpressionParser(from) {}

  /// Index into `block.expressions` of the expression read.
  uint16_t parse();
  /// The same for a condition: `=` is taken as the `==` that it was meant to be, with an issue.
  uint16_t parseCondition();
  /// A value of a word: perhaps inside AC(..), IC(..), DC(..), ACP(..), ACN(..).
  uint16_t parseValue(WordReading &reading);
  /// What names a variable, as its key: `R1`, `NAME`, `FIELD[R2+1]`, `$TC_DP6[1,1]`.
  uint16_t parseTarget();

private:
  /// Which kinds of operators are side by side in one pair of brackets.
  struct Seen {
    bool comparison = false;
    bool logical = false;
  };

  template <typename Parse>
  uint16_t read(Parse parse);
  Rest afterBad(const char *begin) const;
  bool group(unsigned depth);
  bool level(unsigned depth, unsigned strength, Seen &seen);
  void makeTruth(const char *at);
  bool unary(unsigned depth, Seen &seen);
  bool operand(unsigned depth);
  bool number();
  bool constant();
  bool text();
  static llvm::StringRef withoutGluedWord(llvm::StringRef name);
  bool name(unsigned depth);
  bool function(unsigned depth, llvm::StringRef name, const char *begin);
  /// Index list in brackets; -1: it could not be read.
  int indices(unsigned depth);
  /// Argument list in parentheses; -1: it could not be read.
  int arguments(unsigned depth);
  /// Index list of the array with this key, and the operation that it means.
  bool elements(unsigned depth, Op op, uint64_t array, const char *begin);
  bool skipIndices();
  /// Steps over a system variable, the cursor is at its `$`; gives its name with the `$`, empty: it
  /// cannot be read.
  llvm::StringRef system();
  bool isInAction(const char *at) const;
  llvm::StringRef identifier() const;

  bool ambiguous_ = false;
  size_t truthEnd_ = 0; ///< operations of the block after the last AND, OR or XOR
};

} // namespace ncvet
