// Calls inside calls go deeper than the control can follow.
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct FlowNestingTooDeepMemory {
  bool structures = false;
};

class FlowNestingTooDeep final : public StatefulRule<FlowNestingTooDeepMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::FlowIssue, EventKind::Statement});
    macros_ = to.dialect().facts->limits.macroDepth;
    if (macros_)
      to.onAction({Action::MacroCall});
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    const unsigned most = ctx.dialect().limits.structureDepth;
    if (!most || !memory().structures)
      return;
    unsigned depth = 0;
    for (const Block &block : blocks(file.reader)) {
      for (const Item &item : block.items) {
        if (item.kind != ItemKind::Structure)
          continue;
        depth -= depth > 0 && closesBracket(item.structure);
        if (!opensBracket(item.structure) || ++depth != most + 1)
          continue;
        if (auto finding = ctx.report(SourceRange{file.source.id(), item.begin, item.end}))
          finding.message("this is structure {0} in another, the control follows {1}: it stops "
                          "here",
                          depth, most);
      }
    }
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code)
      return macro(event, ctx);
    if (event.kind == EventKind::Statement) {
      memory().structures |= ctx.block().items[event.item()].kind == ItemKind::Structure;
      return sleepAtBlock();
    }
    if (event.flowIssue() != FlowIssue::TooDeep)
      return;
    auto finding = ctx.report(ctx.flowRange(), event.certain);
    if (!finding)
      return;
    const Flow &flow = ctx.outcome().flow;
    if (flow.kind == FlowKind::Repeat && ctx.dialect().limits.repeatDepth) {
      const unsigned most = ctx.dialect().limits.repeatDepth;
      finding.message("`{0}` is repeat {1} in another, the control follows {2}: it stops here",
                      ctx.text(ctx.flowRange()), most + 1, most);
      return;
    }
    finding.message("`{0}` is call level {1}, the control follows {2}: it stops here",
                    ctx.text(ctx.flowRange()), ctx.callDepth() + 1, ctx.dialect().limits.callDepth);
  }

private:
  unsigned macros_ = 0; ///< levels of macros; 0: those of all calls

  /// Levels of macros are counted apart from those of subprograms.
  void macro(const Event &event, RuleContext &ctx) const {
    unsigned level = 1;
    for (const CallSite *call = ctx.caller(); call; call = call->before)
      level += call->macro;
    if (level != macros_ + 1)
      return sleepAtBlock();
    if (auto finding = ctx.report(event))
      finding.message("`{0}` is level {1} of macros, the control follows {2}: it stops here",
                      ctx.text(*event.word), level, macros_);
  }
};

} // namespace
NCVET_RULE(FlowNestingTooDeep, flow_nesting_too_deep)
} // namespace ncvet
