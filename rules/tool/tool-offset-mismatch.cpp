// An offset number that is not the tool's own.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/offset_habits.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct ToolOffsetMismatchMemory {
  SourceRange waits; ///< an edge that is programmed while its tool waits for its change
};

class ToolOffsetMismatch final : public StatefulRule<ToolOffsetMismatchMemory> {
public:
  void listen(Subscriptions &to) override {
    onlyOtherTools_ = to.flag("onlyOtherTools");
    ownStep_ = int64_t(to.number("ownStep", 0));
    radiusOfTool_ = to.flag("radiusOfTool");
    if (to.dialect().isLathe())
      to.on(EventKind::ToolWord);
    else
      to.on(EventKind::OffsetWord);
    if (!to.dialect().isLathe() && !to.dialect().facts->tools.cuttingEdges &&
        !to.dialect().zeros.systems)
      to.onAction({Action::CompensationLeft, Action::CompensationRight, Action::LengthNegative});
    edges_ = to.dialect().facts->tools.cuttingEdges && !to.dialect().toolChangeByT;
    if (edges_) {
      to.on({EventKind::ToolChange, EventKind::ToolWord});
      to.onChange({EventKind::Motion});
    }
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (edges_)
      return edge(event, ctx);
    if (event.kind == EventKind::Code && ctx.code(event).action == Action::LengthNegative)
      return subtracted(event, ctx);
    if (event.kind == EventKind::Code)
      return radiusOfOther(event, ctx);
    const MachineState &state = ctx.after();
    const Word &word = *event.word;
    if (event.kind == EventKind::ToolWord)
      return station(event, ctx);
    if (ctx.before().switches.areOn(ctx.dialect().dataSwitches)) // what is in the block are data
      return;
    if (ctx.dialect().offsetsOfTool && word.address != letterAddress('H') && isOfEdge(event, ctx))
      return;
    // An offset that is added is another one by its nature.
    if (ctx.find({Action::LengthAdd}))
      return sleepInShape();
    const int32_t tool = state.tool != notSet ? state.tool : state.preselected;
    if (!event.offset().isConstant() || tool <= 0 || event.offset().value() == 0 ||
        event.offset().value() == tool)
      return sleepInShape();
    if ((onlyOtherTools_ && !habits_.isTool(int64_t(event.offset().value()), ctx) &&
         !habits_.breaksHabit(word, ctx)))
      return;
    if (auto finding = ctx.report(word)) {
      if (isOfOtherTool(word, ctx) || habits_.isSlip(word, ctx))
        finding.severity(Severity::Warning);
      else if (isFurtherOne(int64_t(event.offset().value()), tool))
        finding.severity(Severity::Style);
      if (isOfWaiting(event, ctx)) {
        finding.severity(Severity::Warning)
            .message("`{0}` is the offset of T{1}, which still waits for its change: tool {2} is "
                     "in the spindle",
                     ctx.text(word), int(state.preselected), tool)
            .note(state.origin.of(StatePart::Preselected), "the tool is named here");
        return;
      }
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

private:
  /// T4 has H14 and H24 too.
  bool isFurtherOne(int64_t offset, int64_t tool) const {
    return ownStep_ > 0 && offset > tool && (offset - tool) % ownStep_ == 0;
  }

  /// The number is that of another tool of the file: no scheme of numbers has that.
  bool isOfOtherTool(const Word &word, const RuleContext &ctx) const {
    return word.address == letterAddress('H') && word.isNumber() &&
           habits_.isTool(int64_t(word.value()), ctx);
  }

  /// `G44 H2` where all other tools have G43.
  void subtracted(const Event &event, RuleContext &ctx) const {
    if (!habits_.subtractsOnce(ctx))
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding.severity(Severity::Warning)
          .message("`{0}` subtracts the length of the tool, which the program adds for the others: "
                   "the tool goes too deep by twice its length",
                   ctx.text(*event.word));
  }

  /// `T0305` on a lathe: station and offset.
  void station(const Event &event, RuleContext &ctx) const {
    const Word &word = *event.word;
    if (!event.toolNumber().isConstant() || event.toolNumber().value() < 100)
      return;
    const auto whole = int64_t(event.toolNumber().value());
    const int64_t tool = whole / 100, offset = whole % 100;
    if (tool == offset || offset == 0 || tool > 99 ||
        (ownStep_ > 0 && (offset - tool) % ownStep_ == 0))
      return;
    const bool slip = habits_.isOnlyStation(tool, offset, ctx);
    if (onlyOtherTools_ && !slip)
      return;
    if (auto finding = ctx.report(word)) {
      if (slip)
        finding.severity(Severity::Warning);
      finding.message("`{0}` calls tool {1} with offset {2}: it runs with another tool's data",
                      ctx.text(word), tool, offset);
      if (word.isNumber())
        finding.fix(FixSafety::Unsafe, "use the tool's own offset",
                    ctx.replace(ctx.range(word), formatted("T{0:d2}{0:d2}", tool)));
    }
  }

  bool radiusOfTool_ = false; ///< a D names a tool of the table, as an H does

  /// A tool's own edges are numbered from 1. Where a D names a tool of the table, as an H does,
  /// that of a compensation counts when it is the number of a tool of the file.
  bool isOfEdge(const Event &event, const RuleContext &ctx) const {
    return !radiusOfTool_ || !event.offset().isConstant() ||
           !habits_.isTool(int64_t(event.offset().value()), ctx) ||
           llvm::none_of(ctx.codes(), [&](const CodeUse &use) {
             return addressesOf(ctx.code(use), Role::Offset) & maskOf(event.word->address);
           });
  }

  /// `G41 X5.` without a D: the number that is in force was given for the tool before.
  static void radiusOfOther(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before(), &after = ctx.after();
    const Origin &given = after.origin.of(StatePart::RadiusOffset);
    const Origin &tool = after.origin.of(StatePart::Tool);
    if (ctx.block().has(letterAddress('D')) || after.radiusOffset <= 0 || after.tool <= 0 ||
        after.radiusOffset == after.tool || before.may(Fact::UnknownCode) || !given.known() ||
        !tool.known() || given.file != tool.file || given.begin >= tool.begin)
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` works with D{1}, which was given for another tool: tool {2} has none of "
                   "its own",
                   ctx.text(*event.word), int(after.radiusOffset), int(after.tool))
          .note(given, "the number is given here")
          .note(tool, "the tool is changed here");
  }

  /// The length of a tool that was named and not changed in.
  static bool isOfWaiting(const Event &event, const RuleContext &ctx) {
    const MachineState &state = ctx.after();
    return event.word->address == letterAddress('H') && state.tool > 0 && state.preselected > 0 &&
           event.offset().value() == state.preselected && !state.may(Fact::UnknownCode);
  }

  bool edges_ = false; ///< a tool comes with edges, of which its change takes the first

  /// `T2`, `D2`, `M6`: the change takes the first edge again.
  void edge(const Event &event, RuleContext &ctx) const {
    if (event.kind != EventKind::OffsetWord && event.kind != EventKind::ToolChange) {
      memory().waits = {};
      return;
    }
    if (event.kind == EventKind::OffsetWord) {
      const bool further = event.offset().isConstant() && event.offset().value() > 1;
      if (event.word->address != letterAddress('D') || ctx.find({Action::ToolChange}))
        return;
      memory().waits =
          further && ctx.after().preselected != notSet ? ctx.range(*event.word) : SourceRange();
      return;
    }
    const SourceRange waits = std::exchange(memory().waits, {});
    if (waits.empty() || ctx.block().has(letterAddress('D')) || givesEdge(ctx))
      return;
    if (auto finding = ctx.report(waits))
      finding.severity(Severity::Warning)
          .message("`{0}` comes before the change of its tool, which takes edge 1 again",
                   ctx.text(waits))
          .note(ctx.blockRange(), "the tool is changed here");
  }

  /// Whether the program gives the edge anew before it moves.
  static bool givesEdge(const RuleContext &ctx) {
    constexpr unsigned furthest = 8; // blocks
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < furthest && ahead.next(next); ++i) {
      if (next.has(letterAddress('D')))
        return true;
      if (next.hasAny(ctx.dialect().axisWords))
        return false;
    }
    return true; // the text does not tell
  }

  OffsetHabits habits_;
  bool onlyOtherTools_ = false; ///< numbers that no tool of the file has are a shop's scheme
  int64_t ownStep_ = 0;         ///< offsets of one tool lie so far apart; 0: a tool has one
};

} // namespace
NCVET_RULE(ToolOffsetMismatch, tool_offset_mismatch)
} // namespace ncvet
