// A variable that the control itself uses, or loses.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class StyleVariableChoice final : public Rule {
public:
  void listen(Subscriptions &to) override {
    from_ = int64_t(to.option("volatileFrom", 0));
    if (from_)
      to.on(EventKind::Statement);
  }

  void on(const Event &event, RuleContext &ctx) override {
    const Item &item = ctx.block().items[size_t(event.number)];
    if (item.kind != ItemKind::Assignment)
      return;
    const SourceRange range{ctx.source().id(), item.nameBegin, item.nameEnd};
    llvm::StringRef name = ctx.text(range).trim();
    if (name.startswith("#")) {
      if (auto finding = ctx.report(range))
        finding.message("`{0}` is written by its number: the name of the variable says what it is",
                        name);
      return;
    }
    int64_t index = 0;
    if (!name.consume_front("R") || name.getAsInteger(10, index) || index < from_)
      return;
    if (auto finding = ctx.report(range))
      finding.message("`R{0}` is lost at power-off: R0 to R999 keep their values", index);
  }

  int64_t from_ = 0; ///< parameters from here on do not keep their values
};

} // namespace
NCVET_RULE(StyleVariableChoice, style_variable_choice)
} // namespace ncvet
