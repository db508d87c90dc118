// The run-out mode of a thread is not stated, or shortens the full thread.
#include "analyzer/facts/lookahead.h"
#include "formats/text/number_text.h"

namespace ncvet {
namespace {

class TurningThreadChamferMode final : public Rule {
public:
  void listen(Subscriptions &to) override {
    for (size_t i = 0; i < to.dialect().groups.size(); ++i)
      if (to.dialect().groups[i].id == "thread-chamfer")
        group_ = GroupIndex(i);
    if (group_ != noGroup)
      to.on({EventKind::CycleRun});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || !cutsThread(ctx.code(event).cycle))
      return;
    const Word *word = ctx.codeWord(event);
    if (!word)
      return;
    const MachineState &state = ctx.after();
    const CodeInfo &code = ctx.code(event);
    const GroupInfo &group = ctx.dialect().groups[group_];
    if (!(state.isStated(group_))) {
      std::string names;
      for (const CodeIndex member : group.members)
        names += (names.empty() ? "" : " or ") + ctx.dialect().codes[member].name;
      if (auto finding = ctx.report(*word, event.certain && !(state.mayBeStated(group_))))
        finding.message("`{0}` ends as an earlier program left the run-out: {1} is not stated",
                        code.name, names);
      return;
    }
    for (const CodeIndex member : group.members) {
      const CodeInfo &mode = ctx.dialect().codes[member];
      if (mode.opposite == noCode || state.group(group_) != uint64_t(1) << mode.bit)
        continue;
      const auto pitches = ctx.machine().number("setting95");
      if (auto finding = ctx.report(*word, event.certain))
        finding
            .message("`{0}` with {1} leaves the work {2} pitches before its end: the full thread "
                     "is shorter",
                     code.name, mode.name, shortNumber(pitches.value_or(1)))
            .note(state.origin.ofGroup(group_), mode.name + " becomes active here");
    }
  }

private:
  GroupIndex group_ = noGroup;
};

} // namespace
NCVET_RULE(TurningThreadChamferMode, turning_thread_chamfer_mode)
} // namespace ncvet
