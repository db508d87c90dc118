// A tool cuts dry although others of the program are cooled.
#include "analyzer/facts/lookahead.h"

#include <vector>

namespace ncvet {
namespace {

struct ModalCoolantMissingMemory {
  SourceRange dry;              ///< first cut of the tool in use, while the coolant was off
  std::vector<SourceRange> all; ///< those of all tools
  bool cooled = false;          ///< some tool of the program has cut with coolant
};

class ModalCoolantMissing final : public StatefulRule<ModalCoolantMissingMemory> {
public:
  void listen(Subscriptions &to) override {
    for (size_t i = 0; i < to.dialect().switches.size(); ++i)
      if (to.dialect().switches[i].id == "coolant")
        coolant_ = unsigned(i);
    if (!coolant_)
      return;
    to.on({EventKind::ToolChange, EventKind::ProgramEnd});
    to.onChange({EventKind::Motion, EventKind::CycleRun});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::ToolChange)
      memory().dry = {};
    else if (event.kind == EventKind::ProgramEnd)
      atEnd(ctx);
    else if (cuts(event))
      atCut(ctx);
  }

private:
  /// Most tools of a program that are remembered; more is no program of a machine.
  static constexpr size_t most = 200;

  void atCut(RuleContext &ctx) const {
    const MachineState &after = ctx.after();
    if (after.switchMayBeOn(*coolant_)) {
      memory().cooled = true;
    } else if (!memory().dry.end && !ctx.before().may(Fact::CutSinceTool) &&
               after.must(Fact::ToolCalled) && !after.may(Fact::UnknownCode) &&
               memory().all.size() < most) {
      memory().dry = ctx.blockRange();
      memory().all.push_back(memory().dry);
    }
  }

  void atEnd(RuleContext &ctx) const {
    if (ctx.callDepth() == 0 && memory().cooled && !ctx.after().may(Fact::UnknownCode))
      for (const SourceRange &cut : memory().all)
        if (cut.file == ctx.source().id())
          if (auto finding = ctx.report(cut))
            finding.message("this tool begins to cut without coolant, which others of the program "
                            "have");
    memory().all.clear();
  }

  static bool cuts(const Event &event) {
    return event.code != noCode &&
           (event.kind == EventKind::CycleRun
                ? event.axes != 0
                : isFeed(event.motion) || event.motion == MotionKind::Thread);
  }

  std::optional<unsigned> coolant_; ///< number of the switch
};

} // namespace
NCVET_RULE(ModalCoolantMissing, modal_coolant_missing)
} // namespace ncvet
