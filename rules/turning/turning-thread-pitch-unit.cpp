// Pitch or depth of a thread is given in the wrong unit, in two units, or in a doubtful feed mode.
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class TurningThreadPitchUnit final : public Rule {
  static constexpr llvm::StringLiteral id = "turning-thread-pitch-unit";

public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::CycleRun, EventKind::Motion});
    to.onNotices(id);
    inchE_ = to.dialect().facts->turning.leadInInchesByE;
    greatestInches_ = to.number("greatestInches", 0.5);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    if (event.kind == EventKind::Code) {
      ctx.reportNotices(id, event);
      return;
    }
    const CodeInfo &code = ctx.code(event);
    const bool thread = event.kind == EventKind::CycleRun ? cutsThread(code.cycle)
                                                          : event.motion == MotionKind::Thread;
    if (!thread)
      return sleepInShape();
    const MachineState &state = ctx.after();
    const Word *word = ctx.codeWord(event);
    if (!word)
      return;
    const AddressMask lead = addressesOf(code, Role::Lead);
    // Where the lead is no F, what F means says nothing of it.
    if (!(lead & maskOf('F')))
      return;
    if (const Word *e = ctx.block().find('E'); inchE_ && e && (lead & maskOf('E'))) {
      const Interval value = ctx.value(*e);
      if (value.isConstant() && value.value() > greatestInches_ &&
          state.activeAction(ctx.dialect(), StandardGroup::Units) == Action::Metric)
        if (auto finding = ctx.report(*e, event.certain))
          finding.message(
              "`{0}` is a lead in inches, and this program is metric: a lead in millimetres is "
              "given by F",
              ctx.text(*e));
    }
    if (state.active(ctx.dialect(), StandardGroup::FeedMode) == groupUnset ||
        state.isActive(ctx.dialect(), StandardGroup::FeedMode, {Action::FeedPerMinute}) !=
            Truth::Yes)
      return;
    if (auto finding = ctx.report(*word, event.certain))
      finding
          .message("`{0}` reads its lead per revolution, but feed per minute is active", code.name)
          .note(state.originOf(ctx.dialect(), StandardGroup::FeedMode),
                "feed per minute is selected here");
  }

private:
  bool inchE_ = false;
  double greatestInches_ = 0.5;
};

} // namespace
NCVET_RULE(TurningThreadPitchUnit, turning_thread_pitch_unit)
} // namespace ncvet
