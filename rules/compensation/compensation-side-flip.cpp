// The side of compensation changed without switching it off in between.
#include "analyzer/facts/ending_code.h"
#include "formats/dialect/control_facts.h"
#include "interp/evaluate/tool_data.h"

namespace ncvet {
namespace {

class CompensationSideFlip final : public Rule {
public:
  void listen(Subscriptions &to) override {
    again_ = to.dialect().facts->compensation.sideCalledOnce;
    to.on(EventKind::OffsetWord);
    to.onAction({Action::CompensationLeft, Action::CompensationRight});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::OffsetWord)
      atOffset(event, ctx);
    else
      atCode(event, ctx);
  }

private:
  bool again_ = false; ///< a second code of the same side is reported as well

  void atCode(const Event &event, RuleContext &ctx) const {
    const CodeInfo &code = ctx.code(event);
    const Action other = code.action == Action::CompensationLeft ? Action::CompensationRight
                                                                 : Action::CompensationLeft;
    const uint64_t set = ctx.before().active(ctx.dialect(), StandardGroup::Compensation);
    if (set == groupUnset || ctx.find({Action::CompensationOff}))
      return;
    const Truth flips = ctx.before().isActive(ctx.dialect(), StandardGroup::Compensation, {other});
    const CodeInfo *was = ctx.before().activeCode(ctx.dialect(), StandardGroup::Compensation);
    if (!ctx.before().origin.of(StatePart::Compensation).known())
      return;
    if (flips == Truth::No) {
      if (again_ && was && was->action == code.action && ctx.before().compensation == phaseOn)
        again(event, code, ctx);
      return;
    }
    if (auto finding = ctx.report(event, flips == Truth::Yes)) {
      const std::string off = compensationOffCode(ctx.dialect(), ctx.before());
      finding
          .message("`{0}` while {1} is on: the tool changes the side without `{2}` and crosses "
                   "the contour",
                   code.name, was ? "`" + was->name + "`" : std::string("the other side"), off)
          .note(ctx.before().origin.of(StatePart::Compensation), "the other side is selected here")
          .fix(FixSafety::Unsafe, "insert `" + off + "` before this block",
               ctx.insertBlockBefore(off));
    }
  }

  static void again(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` while compensation is on already: it starts anew in the middle of the "
                   "contour",
                   code.name)
          .note(ctx.before().origin.of(StatePart::Compensation),
                "compensation is switched on here");
  }

  /// An offset of the other sign swaps the sides as well.
  static void atOffset(const Event &event, RuleContext &ctx) {
    if (ctx.dialect().isLathe() || ctx.before().compensation != phaseOn ||
        ctx.after().compensationActive(ctx.dialect()) != Truth::Yes ||
        event.word->address != letterAddress('D'))
      return;
    const auto was = compensationRadius(ctx.dialect(), ctx.machine(), ctx.before());
    const auto now = compensationRadius(ctx.dialect(), ctx.machine(), ctx.after());
    if (!was || !now || *was * *now >= 0)
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` has a radius of the other sign: the tool changes the side without "
                   "`G40` and crosses the contour",
                   ctx.text(*event.word))
          .note(ctx.before().origin.of(StatePart::RadiusOffset), "the offset so far is set here");
  }
};

} // namespace
NCVET_RULE(CompensationSideFlip, compensation_side_flip)
} // namespace ncvet
