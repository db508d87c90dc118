// Parser of Macro B and RS274/NGC expressions: text to operations in postfix order.
#pragma once

#include "formats/dialect/dialect.h"
#include "formats/readers/expression_parser.h"

namespace ncvet {

/// Reads one expression into `block.operations`. Never fails: a bad expression is marked, gets an
/// issue, and its value is unknown.
class MacroExpression : public ExpressionParser {
public:
  enum class Form : uint8_t {
    Full,          ///< operators allowed: the right side of an assignment
    Operand,       ///< one operand: number, variable, function or bracket, with sign
    VariableNumber ///< `#` and what names the variable; the value is the variable's number
  };

  explicit MacroExpression(const BlockCursor &from) : ExpressionParser(from) {}

  /// Bytes of the operator, spelled with letters, at the head of `text`; 0: there is none.
  static size_t namesOperator(llvm::StringRef text);
  /// Whether these letters are the name of a function.
  static bool namesFunction(llvm::StringRef letters);
  /// Index into `block.expressions` of the expression read.
  uint16_t parse(Form form, Arithmetic arithmetic);

private:
  Rest afterBad(const char *begin) const;
  /// What a pair of brackets holds.
  bool group(unsigned depth);
  bool level(unsigned depth, unsigned strength);
  bool operand(unsigned depth);
  /// `[#16 (OFFSET)]`: the control takes comments out of a block before it reads it; LinuxCNC does
  /// not. False: the comment is not closed.
  bool passComment() {
    skipBlanks();
    if (ngc_ || at_ >= end_ || *at_ != '(')
      return true;
    while (at_ < end_ && *at_ != ')' && !isLineEnd(*at_))
      ++at_;
    return take(')');
  }
  bool variable(unsigned depth);
  bool named(Op op);
  bool bracketedName(Op op);
  bool passBrackets();
  bool function30(unsigned depth, bool &good);
  bool exists();
  void emitNgc(Op op, const char *at);
  void emitTruth(const char *at);
  bool number();
  bool function(unsigned depth);

  /// Operators between one pair of brackets.
  struct Used {
    unsigned comparisons = 0;
    bool logic = false;
  };
  Used used_;              ///< between the brackets that are read
  bool ambiguous_ = false; ///< AND or OR between comparisons without brackets of their own
  bool names_ = false;     ///< variables have names, and POW, AX, AXNUM and PRM are known
  bool ngc_ = false;       ///< the expressions are those of RS274/NGC
  bool decimals_ = false;  ///< the number of a variable may have decimals
};

} // namespace ncvet
