// What the parsers of expressions share: the frame of an expression, brackets, operators.
#pragma once

#include "formats/readers/block_cursor.h"
#include "formats/readers/plain_number.h"

namespace ncvet {

/// An operator between two operands.
struct BinaryOperator {
  Op op = Op::Unknown;
  unsigned strength = 0; ///< the higher it is, the tighter the operator binds; 0: there is none
  unsigned length = 0;   ///< bytes of its spelling
};

/// Turns the text of one expression into operations in postfix order. A language's parser derives
/// from it and adds its operands and operators.
class ExpressionParser : protected BlockCursor {
public:
  using BlockCursor::position;

protected:
  /// Brackets nest at most this deep: more is no program, and recursion must be bounded.
  static constexpr unsigned maxDepth = 64;

  /// Where reading goes on after a bad expression.
  struct Rest {
    const char *begin;
    bool unbalanced; ///< the expression is bad because a bracket lacks its other half
  };

  explicit ExpressionParser(const BlockCursor &from) : BlockCursor(from) {}

  const char *afterBlanks(const char *p) const {
    while (p < end_ && (*p == ' ' || *p == '\t'))
      ++p;
    return p;
  }
  void skipBlanks() { at_ = afterBlanks(at_); }
  /// Where the bracket may be that makes a name a function.
  const char *afterSpaces(const char *p) const {
    while (p < end_ && *p == ' ')
      ++p;
    return p;
  }
  /// Steps over blanks, and over `c` after them; false: it is not there.
  bool take(char c) {
    skipBlanks();
    if (at_ == end_ || *at_ != c)
      return false;
    ++at_;
    return true;
  }
  /// Steps over digits, perhaps with a point among them, where one of both is next; false: a
  /// point alone.
  bool takeDigits() {
    const char *const begin = at_;
    skipDigits();
    if (at_ < end_ && *at_ == '.') {
      ++at_;
      skipDigits();
    }
    return at_ - begin > 1 || *begin != '.';
  }

  void emit(Op op, const char *at, double value = 0) {
    block_.operations.push_back({op, offset(at), value});
  }

  /// The operators after an operand that was read, as far as they are at least as strong as
  /// `strength`, grouped from the left. `find` gives the current operator; `apply`, which gets it
  /// and its place, reads the operand after it and emits it.
  template <typename Find, typename Apply>
  bool operators(unsigned strength, Find find, Apply apply) {
    for (;;) {
      const char *const before = at_;
      skipBlanks();
      const BinaryOperator found = find();
      if (found.strength < strength) { // none, or one for an outer level
        at_ = before;
        return true;
      }
      const char *const at = at_;
      at_ += found.length;
      if (!apply(found, at))
        return false;
    }
  }

  /// An expression that begins here, after blanks.
  Expression open() {
    skipBlanks();
    Expression expression;
    expression.first = uint32_t(block_.operations.size());
    expression.begin = offset(at_);
    return expression;
  }
  /// It could not be read: its value is unknown, and reading goes on after it.
  void fail(Expression &expression, Rest rest);
  /// It ends here. Gives its index; a block that holds more than can be counted gives its last one
  /// again.
  uint16_t close(const Expression &expression) {
    if (block_.expressions.size() < noExpression - 1) {
      // Written in its place: a copy of what was just written piece by piece would wait for it.
      Expression &place = block_.expressions.emplace_back();
      place.first = expression.first;
      place.count = uint32_t(block_.operations.size()) - expression.first;
      place.begin = expression.begin;
      place.end = offset(at_);
      place.bad = expression.bad;
    }
    return uint16_t(block_.expressions.size() - 1);
  }

private:
  void skipDigits() {
    while (at_ < end_ && isNumberDigit(*at_))
      ++at_;
  }
};

} // namespace ncvet
