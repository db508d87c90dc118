// An offset number that is not the tool's own.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class ToolOffsetMismatch final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().isLathe())
      to.on(EventKind::ToolWord);
    else
      to.on(EventKind::OffsetWord);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &state = ctx.after();
    const Word &word = *event.word;
    if (event.kind == EventKind::ToolWord) {
      if (!event.toolNumber().isConstant() || event.toolNumber().value() < 100)
        return;
      const auto whole = int64_t(event.toolNumber().value());
      const int64_t tool = whole / 100, offset = whole % 100;
      if (tool == offset || offset == 0 || tool > 99)
        return;
      if (auto finding = ctx.report(word)) {
        finding.message("`{0}` calls tool {1} with offset {2}: it runs with another tool's data",
                        ctx.text(word), tool, offset);
        if (word.isNumber())
          finding.fix(FixSafety::Unsafe, "use the tool's own offset",
                      ctx.replace(ctx.range(word), llvm::formatv("T{0:d2}{0:d2}", tool).str()));
      }
      return;
    }
    // A tool's own edges are numbered from 1; an H still names a tool of the table.
    if (ctx.dialect().offsetsOfTool && word.address != letterAddress('H'))
      return;
    const int32_t tool = state.tool != notSet ? state.tool : state.preselected;
    if (!event.offset().isConstant() || tool <= 0 || event.offset().value() == 0 ||
        event.offset().value() == tool)
      return;
    if (auto finding = ctx.report(word)) {
      finding
          .message("`{0}` is not the offset of tool {1}: it runs with another tool's data",
                   ctx.text(word), tool)
          .note(state.origin.of(StatePart::Tool), "the tool is called here");
      if (word.isNumber())
        finding.fix(FixSafety::Unsafe, "use the tool's own number",
                    ctx.replace({ctx.source().id(), word.offset + 1, ctx.block().endOf(word)},
                                std::to_string(tool)));
    }
  }
};

} // namespace
NCVET_RULE(ToolOffsetMismatch, tool_offset_mismatch)
} // namespace ncvet
