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
    if (code.action != Action::LengthPositive && code.action != Action::LengthNegative)
      return;
    if (ctx.after().lengthOffset != notSet)
      return ofToolBefore(event, ctx);
    if (ctx.dialect().offsetsOfTool) // without a number the length is that of the tool
      return;
    if (auto finding = ctx.report(event, !ctx.after().may(Fact::UnknownCode)))
      finding.message(
          "`{0}` without an H, and none was programmed before: the length offset is zero",
          code.name);
  }

private:
  /// The H in force was given for the tool before this one.
  static void ofToolBefore(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    const Origin &tool = before.origin.of(StatePart::Tool);
    const Origin &offset = before.origin.of(StatePart::LengthOffset);
    if (ctx.after().lengthOffset <= 0 || ctx.block().has(letterAddress('H')) ||
        ctx.dialect().offsetsOfTool || ctx.find({Action::ToolChange}) ||
        !before.must(Fact::ToolCalled) || before.may(Fact::LengthSinceTool) ||
        before.may(Fact::UnknownCode) || !tool.known() || !offset.known() ||
        tool.file != offset.file || offset.begin >= tool.begin)
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding
          .message(
              "`{0}` without an H takes H{1} of the tool before: the tool goes too deep, or not "
              "deep enough, by the difference of their lengths",
              ctx.code(event).name, int(ctx.after().lengthOffset))
          .note(tool, "the tool is changed here")
          .note(offset, "the offset is programmed here");
  }

  static constexpr const char *id = "tool-length-offset-incomplete";
};

} // namespace
NCVET_RULE(ToolLengthOffsetIncomplete, tool_length_offset_incomplete)
} // namespace ncvet
