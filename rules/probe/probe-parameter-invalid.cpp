// A measuring cycle with values that it cannot work with.
#include "analyzer/facts/measuring_series.h"
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct ProbeParameterInvalidMemory {
  SourceRange end;       ///< of the series; used up by the next feed move
  Origin feed;           ///< the feed of that moment
  Origin fast;           ///< a feed of which that was said
  unsigned axes = 0;     ///< bit per word of the move along an axis
  unsigned wanted = 0;   ///< bit per word of the move along an axis
  SourceRange qualified; ///< the first measurement of the series that finds such errors
};

class ProbeParameterInvalid final : public StatefulRule<ProbeParameterInvalidMemory> {
public:
  /// The tables say the rest; what they say is reported for it.
  void listen(Subscriptions &to) override {
    for (const CodeInfo &code : to.dialect().codes)
      if (endsSeries(code, to.dialect()))
        ends_ = true;
    if (!ends_)
      return;
    fastest_ = to.dialect().facts->limits.probeFeed;
    to.onCode([&](const CodeInfo &code) { return turnsSeries(code, to.dialect()); });
    to.onMoves({MotionKind::Feed, MotionKind::ArcCw, MotionKind::ArcCcw});
    to.on({EventKind::CycleRun, EventKind::ProgramEnd});
  }

  /// After the series the feed of measuring may still be in force.
  void on(const Event &event, RuleContext &ctx) const override {
    const Origin &feed = ctx.after().origin.of(StatePart::Feed);
    if (event.kind == EventKind::ProgramEnd)
      return oneAxis(ctx);
    if (event.kind == EventKind::Code && ctx.code(event).effect.on) {
      memory().feed = feed; // the control sets one of its own
      memory().end = {};
      return;
    }
    if (event.kind == EventKind::CycleRun) {
      if (event.code == noCode)
        return;
      const CodeInfo &code = ctx.code(event);
      if (code.cycle == CycleKind::Measure) {
        tooFast(code, event, ctx);
        return axes(code, event, ctx);
      }
      if (!code.needsFeed)
        return;
    }
    if (event.kind == EventKind::Code) {
      oneAxis(ctx);
      memory().end = ctx.range(*event.word);
      memory().feed = feed;
      return;
    }
    if (!memory().end.end || event.code == noCode || event.inMachineCoordinates() ||
        ctx.block().begin < memory().end.begin)
      return;
    if (feed.known() && feed.begin == memory().feed.begin && feed.file == memory().feed.file &&
        !ctx.block().has(letterAddress('F')) && !ctx.before().may(Fact::UnknownCode))
      if (auto finding = ctx.report(ctx.blockRange()))
        finding.severity(Severity::Warning)
            .message("this move feeds with an F from before the end of measuring: what holds "
                     "after it is not stated")
            .note(memory().end, "the series ends here");
    memory().end = {};
  }

private:
  /// A feed that was given after the series began.
  void tooFast(const CodeInfo &code, const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const Origin &origin = state.origin.of(StatePart::Feed);
    if (fastest_ <= 0 || !state.feed.get().isConstant() || state.feed.get().value() <= fastest_ ||
        !origin.known() || origin == memory().feed || origin == memory().fast ||
        state.activeAction(ctx.dialect(), StandardGroup::FeedMode) != Action::FeedPerMinute)
      return;
    memory().fast = origin; // said once
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` touches at a feed of {1:f0}: above {2:f0} the result is no longer exact",
                   code.name, state.feed.get().value(), fastest_)
          .note(origin, "the feed is given here");
  }

  /// A cycle that finds an error along each axis of the plane, one at a time.
  void axes(const CodeInfo &code, const Event &event, RuleContext &ctx) const {
    unsigned place = 0;
    for (const WordSpec &spec : code.words) {
      if (spec.role != Role::Shift || !spec.variable)
        continue;
      const Value way = ctx.after().commons.get(spec.variable);
      if (!way.isConstant() || way.number.value() != 0)
        memory().axes |= 1u << place;
      memory().wanted |= 1u << place++;
    }
    if (place && !memory().qualified.end)
      memory().qualified = event.word ? ctx.range(*event.word) : ctx.blockRange();
  }

  void oneAxis(RuleContext &ctx) const {
    const bool one = memory().qualified.end && memory().axes && memory().axes != memory().wanted;
    if (one && ctx.callDepth() == 0)
      if (auto finding = ctx.report(memory().qualified))
        finding.severity(Severity::Warning)
            .message("this series finds the error of the probe along one axis only: the other one "
                     "keeps what was found some day");
    memory().qualified = {};
    memory().axes = memory().wanted = 0;
  }

  double fastest_ = 0; ///< feed, mm/min; 0: any
  bool ends_ = false;
};

} // namespace
NCVET_RULE(ProbeParameterInvalid, probe_parameter_invalid)
} // namespace ncvet
