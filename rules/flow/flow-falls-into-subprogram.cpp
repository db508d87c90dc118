// The main flow runs on into a local subprogram.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <set>

namespace ncvet {
namespace {

struct FlowFallsIntoSubprogramMemory {
  std::set<std::pair<FileId, uint32_t>> called; ///< by file and label of a `sub`
};

class FlowFallsIntoSubprogram final : public StatefulRule<FlowFallsIntoSubprogramMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::FlowIssue);
    if (to.dialect().lexical.flowWords)
      to.on(EventKind::Statement);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Statement)
      return flowWord(event, ctx.block().items[event.item()], ctx);
    if (event.flowIssue() != FlowIssue::RunsIntoSubprogram)
      return;
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding.message("the program runs on into this subprogram: there is no `M30` before it")
          .fix(FixSafety::Unsafe, "insert `M30` before the subprogram",
               {{ctx.flowRange().file, ctx.flowRange().begin, ctx.flowRange().begin}, "M30\n"});
  }

private:
  /// `o1 sub` is passed over, unless a call has read it from further up: then the interpreter takes
  /// it for a second one.
  void flowWord(const Event &event, const Item &item, RuleContext &ctx) const {
    if (!item.label || (item.kind == ItemKind::Structure && item.structure != Structure::Sub))
      return sleepAtBlock();
    const std::pair<FileId, uint32_t> key{ctx.source().id(), item.label};
    if (item.kind == ItemKind::Call) {
      memory().called.insert(key);
      return;
    }
    if (item.kind != ItemKind::Structure || item.structure != Structure::Sub ||
        ctx.callDepth() > 0 || !memory().called.count(key))
      return;
    const SourceRange range = ctx.range(item);
    if (auto finding = ctx.report(range, event.certain))
      finding.message("the program runs into `{0}` after a call of it: the interpreter stops; a "
                      "subprogram belongs before its first call or after the program's end",
                      ctx.text(range));
  }
};

} // namespace
NCVET_RULE(FlowFallsIntoSubprogram, flow_falls_into_subprogram)
} // namespace ncvet
