// A machine-coordinate move is not at rapid, or leads to the wrong side of machine zero.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <algorithm>

namespace ncvet {
namespace {

class CoordinateMachineMoveSuspicious final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::Motion});
    positive_ = to.flag("positive", true);
    feed_ = to.flag("feed", true);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (!event.inMachineCoordinates())
      return sleepInShape();
    const CodeUse *use = ctx.find({Action::MachineMove});
    if (!use)
      return;
    if (const char *how =
            feed_ && event.code != noCode && event.certain && !ctx.find({Action::Linear})
                ? wayOf(ctx.code(event))
                : nullptr) {
      if (auto finding = ctx.report(*use->word))
        finding
            .message("`{0}` moves by the active code `{1}`: {2}", ctx.text(*use->word),
                     ctx.code(event).name, how)
            .note(ctx.before().originOf(ctx.dialect(), StandardGroup::Motion),
                  "`" + ctx.code(event).name + "` becomes active here")
            .fix(FixSafety::Unsafe, "write `G00` before it",
                 ctx.insertBefore(use->word->offset, "G00 "));
      return;
    }
    if (!positive_)
      return;
    for (const Word &word : ctx.block().words) {
      const AddressInfo &address = ctx.dialect().addresses[word.address];
      if (address.kind != AddressKind::Axis || address.unit != AddressUnit::Length)
        continue;
      const Interval value = ctx.value(word);
      const AxisLimits &limits = ctx.machine().axes[unsigned(address.axis)];
      if (!value.isConstant() || value.value() <= (limits.max ? std::max(*limits.max, 0.0) : 0.0))
        continue;
      if (limits.max)
        continue; // beyond the travel: limit-axis-travel says it
      if (auto finding = ctx.report(word))
        finding.message(
            "`{0}` in machine coordinates: machine zero is the end of travel, positions "
            "are negative",
            ctx.text(word));
      return;
    }
  }

private:
  /// How the block moves when this code is in force; null: at rapid, or nobody knows.
  static const char *wayOf(const CodeInfo &code) {
    switch (code.action) {
    case Action::Linear:
      return "this move is made at feed";
    case Action::Thread:
      return "this move cuts a thread";
    case Action::Cycle: // a cycle of the motion group, which only a motion code ends
      return "G00 has not ended this cycle, and the move is no rapid";
    default:
      return nullptr;
    }
  }

  bool positive_ = true;
  bool feed_ = true; ///< the active motion code decides how the block moves
};

} // namespace
NCVET_RULE(CoordinateMachineMoveSuspicious, coordinate_machine_move_suspicious)
} // namespace ncvet
