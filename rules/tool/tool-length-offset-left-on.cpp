// Length compensation that is still on at a tool change, a machine move or the program's end.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class ToolLengthOffsetLeftOn final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().group(StandardGroup::LengthOffset) != noGroup &&
        !to.dialect().facts->tools.lengthReplaced)
      to.onChange({EventKind::ToolChange, EventKind::ProgramEnd, EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const char *where = nullptr;
    switch (event.kind) {
    case EventKind::ToolChange:
      where = "the tool is changed";
      break;
    case EventKind::ProgramEnd:
      where = "the program ends";
      break;
    default:
      // Only machine moves along the tool axis depend on it.
      if (!event.inMachineCoordinates() ||
          !(event.axes >> unsigned(toolAxis(ctx.dialect(), ctx.after())) & 1))
        return sleepInShape();
      where = "the tool axis goes to a machine position";
    }
    // At an end the block's own G49 counts; a change comes before whatever else its block switches.
    const MachineState &state = event.kind == EventKind::ToolChange ? ctx.before() : ctx.after();
    const Truth on = state.isActive(ctx.dialect(), StandardGroup::LengthOffset,
                                    {Action::LengthPositive, Action::LengthNegative});
    const CodeInfo *code = state.activeCode(ctx.dialect(), StandardGroup::LengthOffset);
    if (on != Truth::Yes || !code || state.lengthOffset == 0 ||
        (event.kind != EventKind::ProgramEnd && isReplaced(ctx)))
      return;
    if (auto finding = event.word ? ctx.report(*event.word) : ctx.report(ctx.blockRange())) {
      finding
          .message("{0} with `{1}` still on: the next move in the tool axis is off by the tool's "
                   "length",
                   where, code->name)
          .note(state.origin.of(StatePart::LengthOffset), "the length offset is switched on here");
      if (event.kind == EventKind::Motion || code->opposite == noCode)
        return;
      const std::string &off = ctx.dialect().codes[code->opposite].name;
      finding.fix(FixSafety::Unsafe, "insert `" + off + "` before this block",
                  ctx.insertBlockBefore(off));
    }
  }

private:
  /// The next move along the tool axis switches another length on, or goes to the machine's zero
  /// again; or the program ends before one, where it is told.
  static bool isReplaced(const RuleContext &ctx) {
    constexpr unsigned furthest = 30; // blocks
    const auto tool = unsigned(toolAxis(ctx.dialect(), ctx.after()));
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < furthest; ++i) {
      if (!ahead.next(next))
        return ahead.isOver();
      if (findCode(ctx.dialect(), next,
                   {Action::LengthPositive, Action::LengthNegative, Action::LengthOff,
                    Action::ReferenceReturn, Action::MachineMove}))
        return true;
      if (axesOf(ctx.dialect(), next) >> tool & 1)
        return false;
    }
    return false;
  }
};

} // namespace
NCVET_RULE(ToolLengthOffsetLeftOn, tool_length_offset_left_on)
} // namespace ncvet
