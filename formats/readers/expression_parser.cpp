// What the parsers of expressions share: bad expressions.
#include "formats/readers/expression_parser.h"

#include <algorithm>

namespace ncvet {

void ExpressionParser::fail(Expression &expression, Rest rest) {
  const char *const begin = base_ + expression.begin;
  block_.operations.resize(expression.first);
  emit(Op::Unknown, begin);
  expression.bad = true;
  at_ = std::max(at_, rest.begin);
  issue(rest.unbalanced ? SyntaxIssueKind::UnbalancedBracket : SyntaxIssueKind::BadExpression,
        begin, at_);
}

} // namespace ncvet
