// A division by zero, or a function of a value outside its domain.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class VariableDomainError final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::DomainError); }

  void on(const Event &event, RuleContext &ctx) const override {
    const auto at = event.place();
    if (!ctx.dialect().facts->variables.tangentHasPoles &&
        llvm::any_of(ctx.block().operations,
                     [&](const ExpressionOp &op) { return op.op == Op::Tan && op.offset == at; }))
      return;
    SourceRange range{ctx.source().id(), at, at + 1};
    for (const Expression &expression : ctx.block().expressions)
      if (expression.begin <= at && at < expression.end)
        range = ctx.range(expression);
    if (auto finding = ctx.report(range, event.certain))
      finding.message("`{0}` divides by zero or takes a function of a value that it does not have: "
                      "the control stops with an alarm",
                      ctx.text(range));
  }
};

} // namespace
NCVET_RULE(VariableDomainError, variable_domain_error)
} // namespace ncvet
