// A system variable that the control alone writes.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class VariableReadOnlyWrite final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().readOnly.empty())
      to.on(EventKind::Statement);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const Item &item = ctx.block().items[event.item()];
    if (item.kind != ItemKind::Assignment)
      return;
    const SourceRange range{ctx.source().id(), item.nameBegin, item.nameEnd};
    const llvm::StringRef name = ctx.text(range).split('[').first;
    for (const std::string &readOnly : ctx.dialect().readOnly)
      if (name.equals_insensitive(readOnly) ||
          (llvm::StringRef(readOnly).endswith("_") && name.startswith_insensitive(readOnly)))
        if (auto finding = ctx.report(range))
          finding.message("`{0}` can only be read: the control refuses the block", name);
  }
};

} // namespace
NCVET_RULE(VariableReadOnlyWrite, variable_read_only_write)
} // namespace ncvet
