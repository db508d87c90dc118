// An actual value is read before the moves in front of it are done.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class VariableReadAhead final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().readAhead.empty())
      to.on(EventKind::Statement);
  }

  void on(const Event &event, RuleContext &ctx) override {
    const Item &item = ctx.block().items[size_t(event.number)];
    if (item.kind != ItemKind::Assignment || item.value == noExpression)
      return;
    const Expression &value = ctx.block().expressions[item.value];
    const SourceRange range{ctx.source().id(), value.begin, value.end};
    const llvm::StringRef text = ctx.text(range);
    const bool ahead = llvm::any_of(ctx.dialect().readAhead, [&](const std::string &name) {
      return text.contains_insensitive(name);
    });
    if (!ahead || !movesBefore(ctx))
      return;
    if (auto finding = ctx.report(range))
      finding.message("`{0}` is read while the moves in front of it still run: `STOPRE` makes the "
                      "control wait for them",
                      text);
  }

private:
  /// A move stands in front, in plain order, and nothing that waits for it.
  static bool movesBefore(RuleContext &ctx) {
    constexpr unsigned lookBack = 20;
    Block block;
    uint32_t at = ctx.block().begin;
    const ProgramInfo &program = ctx.index().programAt(at);
    for (unsigned i = 0; i < lookBack && at > program.body; ++i) {
      at = ctx.source().lines().lineBegin(at - 1);
      ctx.index().read(at, block);
      if (block.hasLabel() || ctx.text(SourceRange{ctx.source().id(), block.begin, block.end})
                                  .contains_insensitive("STOPRE"))
        return false;
      if (block.hasAny(ctx.dialect().axisWords))
        return llvm::none_of(block.items,
                             [](const Item &one) { return one.kind == ItemKind::Structure; });
      for (const Item &item : block.items)
        if (item.kind != ItemKind::Assignment)
          return false;
    }
    return false;
  }
};

} // namespace
NCVET_RULE(VariableReadAhead, variable_read_ahead)
} // namespace ncvet
