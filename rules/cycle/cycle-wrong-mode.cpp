// A cycle runs under a mode that it does not work in.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

#include <set>

namespace ncvet {
namespace {

struct CycleWrongModeMemory {
  std::set<std::pair<FileId, uint32_t>> told;
};

class CycleWrongMode final : public StatefulRule<CycleWrongModeMemory> {
  static constexpr llvm::StringLiteral id = "cycle-wrong-mode";

public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    to.onNotices(id);
    // Where the table speaks of the code under incremental distances, a hole under them counts too.
    places_ = to.flag("places");
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    if (event.kind == EventKind::Code) {
      ctx.reportNotices(id, event);
      return;
    }
    const CodeInfo &code = ctx.code(event);
    if (places_)
      return incremental(event, ctx);
    if (code.cycle != CycleKind::BackBore || ctx.dialect().facts->cycles.backBoreAtAnyLevel ||
        ctx.dialect().group(StandardGroup::ReturnLevel) == noGroup ||
        ctx.after().active(ctx.dialect(), StandardGroup::ReturnLevel) == groupUnset)
      return sleepInShape();
    const Truth toR =
        ctx.after().isActive(ctx.dialect(), StandardGroup::ReturnLevel, {Action::ReturnR});
    if (toR != Truth::Yes)
      return;
    const Word *named = ctx.codeWord(event), *word = named ? named : event.word;
    if (!word)
      return;
    if (auto finding = ctx.report(*word, event.certain))
      finding
          .message("back boring `{0}` runs with return to R: the tool would stop inside the bore",
                   code.name)
          .note(ctx.after().originOf(ctx.dialect(), StandardGroup::ReturnLevel),
                "return to R is selected here");
  }

private:
  /// Distances were switched on between the cycle's block and this place: once for each time.
  void incremental(const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const Dialect &dialect = ctx.dialect();
    if (state.isActive(dialect, StandardGroup::Distance, {Action::Incremental}) != Truth::Yes ||
        ctx.find({Action::Cycle}))
      return;
    const Origin on = state.originOf(dialect, StandardGroup::Distance);
    const Origin cycle = ctx.before().origin.of(StatePart::Cycle);
    if (!on.known() || !cycle.known() || on.file != cycle.file || on.begin <= cycle.begin ||
        !memory().told.insert({on.file, on.begin}).second)
      return;
    if (auto finding = ctx.report(ctx.blockRange(), event.certain))
      finding.severity(Severity::Warning)
          .message("`{0}` is a distance to the next place of `{1}`, whose heights stay coordinates",
                   ctx.text(ctx.blockRange()), ctx.code(event).name)
          .note(on, "distances are switched on here");
  }

  bool places_ = false; ///< holes under incremental distances are reported
};

} // namespace
NCVET_RULE(CycleWrongMode, cycle_wrong_mode)
} // namespace ncvet
