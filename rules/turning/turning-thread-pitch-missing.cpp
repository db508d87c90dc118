// A thread is cut with a feed that was not given as its pitch.
#include "analyzer/lookahead.h"
#include "analyzer/word_checks.h"

namespace ncvet {
namespace {

class TurningThreadPitchMissing final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::CycleRun, EventKind::Motion});
    to.onCode([](const CodeInfo &code) { return addressesOf(code, Role::Lead) != 0; });
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.code == noCode || ctx.before().profile == 1)
      return;
    if (event.kind == EventKind::Code) {
      reportWordRanges(ctx, event, [](const CodeInfo &of, const WordSpec &spec, Breach) {
        return topicOf(of, spec) == WordTopic::Lead;
      });
      return;
    }
    const CodeInfo &code = ctx.code(event);
    const bool thread = event.kind == EventKind::CycleRun ? cutsThread(code.cycle)
                                                          : event.motion == MotionKind::Thread;
    if (!thread)
      return;
    const AddressMask lead = addressesOf(code, Role::Lead);
    if (!lead || ctx.block().hasAny(lead) || ctx.before().may(Fact::UnknownCode))
      return;
    const MachineState &before = ctx.before();
    if (before.must(Fact::FeedIsLead) && before.must(Fact::FeedSet))
      return;
    const Word *word = nullptr;
    for (const CodeUse &use : ctx.codes())
      if (use.code == event.code)
        word = use.word;
    const bool certain = event.certain && !before.may(Fact::FeedIsLead);
    if (auto finding = ctx.report(word ? ctx.range(*word) : ctx.blockRange(), certain)) {
      if (before.must(Fact::FeedSet))
        finding.message(
            "`{0}` cuts a thread without {1} of its own: the feed of line {2} becomes the pitch",
            code.name, ctx.dialect().alternatives(lead),
            lineOf(ctx, before.origin.of(StatePart::Feed)));
      else
        finding.message("`{0}` cuts a thread, and its pitch {1} is not given", code.name,
                        ctx.dialect().alternatives(lead));
      finding.note(before.origin.of(StatePart::Feed), "the feed in force is set here");
    }
  }
};

} // namespace
NCVET_RULE(TurningThreadPitchMissing, turning_thread_pitch_missing)
} // namespace ncvet
