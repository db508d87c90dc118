// A length offset code without its number, or without the axis along which it acts.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class ToolLengthOffsetIncomplete final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onNotices(id);
    to.onAction({Action::LengthPositive, Action::LengthNegative});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    ctx.reportNotices(id, event);
    const CodeInfo &code = ctx.code(event);
    if ((code.action != Action::LengthPositive && code.action != Action::LengthNegative) ||
        ctx.after().lengthOffset != notSet)
      return;
    if (auto finding = ctx.report(event, !ctx.after().may(Fact::UnknownCode)))
      finding.message(
          "`{0}` without an H, and none was programmed before: the length offset is zero",
          code.name);
  }

private:
  static constexpr const char *id = "tool-length-offset-incomplete";
};

} // namespace
NCVET_RULE(ToolLengthOffsetIncomplete, tool_length_offset_incomplete)
} // namespace ncvet
