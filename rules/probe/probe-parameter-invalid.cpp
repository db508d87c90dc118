// A measuring cycle with values that it cannot work with.
#include "analyzer/facts/measuring_series.h"
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class ProbeParameterInvalid final : public Rule {
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

  /// Behind the series the feed of measuring may still be in force.
  void on(const Event &event, RuleContext &ctx) override {
    const Origin &feed = ctx.after().origin.of(StatePart::Feed);
    if (event.kind == EventKind::ProgramEnd)
      return oneAxis(ctx);
    if (event.kind == EventKind::Code && ctx.code(event).effect.on) {
      feed_ = feed; // the control sets one of its own
      end_ = {};
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
      end_ = ctx.range(*event.word);
      feed_ = feed;
      return;
    }
    if (!end_.end || event.code == noCode || event.number || ctx.block().begin < end_.begin)
      return;
    if (feed.known() && feed.begin == feed_.begin && feed.file == feed_.file &&
        !ctx.block().has(letterAddress('F')) && !ctx.before().may(Fact::UnknownCode))
      if (auto finding = ctx.report(ctx.blockRange()))
        finding.severity(Severity::Warning)
            .message("this move feeds with an F from before the end of measuring: what holds "
                     "behind it is not stated")
            .note(end_, "the series ends here");
    end_ = {};
  }
  void remember(RuleMemory &memory) const override {
    memory(end_, feed_, fast_, axes_, wanted_, qualified_);
  }

private:
  /// A feed that was given behind the begin of the series.
  void tooFast(const CodeInfo &code, const Event &event, RuleContext &ctx) {
    const MachineState &state = ctx.after();
    const Origin &origin = state.origin.of(StatePart::Feed);
    if (!fastest_ || !state.feed.get().isConstant() || state.feed.get().value() <= fastest_ ||
        !origin.known() || origin == feed_ || origin == fast_ ||
        state.activeAction(ctx.dialect(), StandardGroup::FeedMode) != Action::FeedPerMinute)
      return;
    fast_ = origin; // said once
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` touches at a feed of {1:f0}: above {2:f0} the result is no longer exact",
                   code.name, state.feed.get().value(), fastest_)
          .note(origin, "the feed is given here");
  }

  /// A cycle that finds an error along each axis of the plane, one at a time.
  void axes(const CodeInfo &code, const Event &event, RuleContext &ctx) {
    unsigned place = 0;
    for (const WordSpec &spec : code.words) {
      if (spec.role != Role::Shift || !spec.variable)
        continue;
      const Value way = ctx.after().commons.get(spec.variable);
      if (!way.isConstant() || way.number.value() != 0)
        axes_ |= 1u << place;
      wanted_ |= 1u << place++;
    }
    if (place && !qualified_.end)
      qualified_ = event.word ? ctx.range(*event.word) : ctx.blockRange();
  }

  void oneAxis(RuleContext &ctx) {
    const bool one = qualified_.end && axes_ && axes_ != wanted_;
    if (one && ctx.callDepth() == 0)
      if (auto finding = ctx.report(qualified_))
        finding.severity(Severity::Warning)
            .message("this series finds the error of the probe along one axis only: the other one "
                     "keeps what was found some day");
    qualified_ = {};
    axes_ = wanted_ = 0;
  }

  double fastest_ = 0;             ///< feed, mm/min; 0: any
  Origin fast_;                    ///< a feed of which that was said
  unsigned axes_ = 0, wanted_ = 0; ///< bit per word of the way along an axis
  SourceRange qualified_;          ///< the first measurement of the series that finds such errors
  bool ends_ = false;
  SourceRange end_; ///< of the series; used up by the next feed move
  Origin feed_;     ///< the feed of that moment
};

} // namespace
NCVET_RULE(ProbeParameterInvalid, probe_parameter_invalid)
} // namespace ncvet
