// Axis words come before any motion code of the program.
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {
namespace {

struct MotionModeNotSetMemory {
  bool reported = false; ///< the blocks after it say the same thing again
};

class MotionModeNotSet final : public StatefulRule<MotionModeNotSetMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::Motion});
    implicit_ = to.flag("implicit");
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (implicit_ && !memory().reported)
      return powerOn(event, ctx);
    if (!implicit_ && event.code != noCode)
      return sleepInShape();
    // Only where the power-on mode is not documented and nothing at all was stated.
    // A move to a place of the machine is made at rapid, whatever is in force.
    if (event.code != noCode || event.motion == MotionKind::Reference ||
        event.inMachineCoordinates() || memory().reported ||
        ctx.dialect().group(StandardGroup::Motion) == noGroup ||
        ctx.after().active(ctx.dialect(), StandardGroup::Motion) != groupUnset ||
        ctx.after().may(Fact::UnknownCode))
      return;
    const Word *word = ctx.block().findAny(ctx.dialect().axisWords);
    if (!word || word->has(wordNoValue) || namesAxesAlone(ctx.dialect(), ctx.block()))
      return;
    memory().reported = true;
    const GroupIndex group = ctx.dialect().group(StandardGroup::Motion);
    const bool ended = ctx.after().isStated(group); // a code has ended the one in force
    if (auto finding = ctx.report(*word))
      finding
          .message(ended ? "`{0}` moves while no motion code is in force: the control stops"
                         : "`{0}` comes before any motion code: the power-on mode decides "
                           "between rapid and feed",
                   ctx.text(*word))
          .fix(FixSafety::Unsafe, "write `G0` before it", ctx.insertBefore(word->offset, "G0 "));
  }

private:
  /// The power-on mode is documented, and it feeds: whoever leaves the code out rarely knows.
  void powerOn(const Event &event, RuleContext &ctx) const {
    const GroupIndex group = ctx.dialect().group(StandardGroup::Motion);
    const Word *word = ctx.block().findAny(ctx.dialect().axisWords);
    if (group == noGroup || (ctx.after().mayBeStated(group)) || !word ||
        event.inMachineCoordinates() || event.motion == MotionKind::Reference ||
        ctx.after().may(Fact::UnknownCode) || event.code == noCode || ctx.callDepth() > 0 ||
        ctx.before().profile != ProfileMode::Off)
      return;
    memory().reported = true;
    const std::string &code = ctx.code(event).name;
    if (auto finding = ctx.report(*word))
      finding.message("`{0}` comes before any motion code: it runs as `{1}`", ctx.text(*word), code)
          .fix(FixSafety::Unsafe, "write `" + code + "` before it",
               ctx.insertBefore(word->offset, code + " "));
  }

  bool implicit_ = false;
};

} // namespace
NCVET_RULE(MotionModeNotSet, motion_mode_not_set)
} // namespace ncvet
