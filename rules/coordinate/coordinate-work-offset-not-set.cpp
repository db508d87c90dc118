// The tool moves in work coordinates before a work offset was selected.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {
namespace {

struct CoordinateWorkOffsetNotSetMemory {
  bool reported = false; ///< every further move says the same again
};

class CoordinateWorkOffsetNotSet final : public StatefulRule<CoordinateWorkOffsetNotSetMemory> {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().group(StandardGroup::WorkOffset) != noGroup &&
        (!to.dialect().isLathe() || to.flag("lathes", true)))
      to.onChange({EventKind::Motion, EventKind::CycleRun});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &state = ctx.after();
    if ((state.must(Fact::WorkOffsetStated) && !isNone(ctx)) ||
        event.motion == MotionKind::Reference || event.inMachineCoordinates() || !event.axes)
      return sleepInShape();
    if (memory().reported)
      return;
    // A preset makes a coordinate system of its own; increments need none.
    if (state.origin.of(StatePart::Preset).known() || state.may(Fact::UnknownCode))
      return;
    // The block that the control runs before every program may have selected it.
    if (ctx.machine().option("priorityBlock") &&
        ctx.dialect().groups[ctx.dialect().group(StandardGroup::WorkOffset)].initial != 0xFF)
      return;
    const AddressMask absolute = ctx.dialect().axisWords & ~ctx.dialect().incrementWords;
    const Word *word = ctx.block().findAny(absolute);
    if (!word || word->has(wordNoValue) ||
        (state.active(ctx.dialect(), StandardGroup::Distance) != groupUnset &&
         state.isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental}) !=
             Truth::No))
      return;
    memory().reported = true;
    auto finding = ctx.report(*word, isNone(ctx) || !state.may(Fact::WorkOffsetStated));
    if (!finding)
      return;
    const std::string offset = firstOffset(ctx.dialect());
    finding
        .message("`{0}` is driven before the program has selected a work offset", ctx.text(*word))
        .fix(FixSafety::Unsafe, "write `" + offset + "` before it",
             ctx.insertBefore(word->offset, isAfterBlank(*word, ctx) ? offset + " " : offset));
  }

private:
  /// Programs without blanks between words get none.
  static bool isAfterBlank(const Word &word, const RuleContext &ctx) {
    return word.offset == 0 || llvm::isSpace(ctx.source().text()[word.offset - 1]);
  }

  /// The code in force is the one that takes all offsets away.
  static bool isNone(const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const CodeInfo *active = ctx.after().activeCode(dialect, StandardGroup::WorkOffset);
    return active && !llvm::StringRef(active->name).startswith("G54") &&
           dialect.groups[dialect.group(StandardGroup::WorkOffset)].initial == active->bit;
  }

  /// `G54`, or `G54.01` where the origins have numbers.
  static std::string firstOffset(const Dialect &dialect) {
    for (const CodeIndex member : dialect.groups[dialect.group(StandardGroup::WorkOffset)].members)
      if (llvm::StringRef(dialect.codes[member].name).startswith("G54"))
        return dialect.codes[member].name;
    return "G54";
  }
};

} // namespace
NCVET_RULE(CoordinateWorkOffsetNotSet, coordinate_work_offset_not_set)
} // namespace ncvet
