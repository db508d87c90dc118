// A tool's section that cannot be started on its own: it moves with what an earlier one has set.
#include "analyzer/rule/rule.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {
namespace {

struct ProgramRestartUnsafeMemory {
  bool pending = false; ///< a further tool was called and has not moved
};

class ProgramRestartUnsafe final : public StatefulRule<ProgramRestartUnsafeMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::ToolChange);
    to.onChange({EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::ToolChange) {
      memory().pending = ctx.callDepth() == 0 && ctx.before().must(Fact::Cut);
      return;
    }
    if (!memory().pending || event.motion == MotionKind::Reference ||
        event.inMachineCoordinates() || !event.axes || ctx.callDepth() > 0)
      return;
    memory().pending = false;
    const MachineState &after = ctx.after();
    const Origin &tool = after.origin.of(StatePart::Tool);
    if (after.may(Fact::UnknownCode) || !tool.known() || tool.file != ctx.source().id())
      return;
    llvm::SmallVector<std::string, 3> names;
    Origin first;
    for (const StandardGroup which :
         {StandardGroup::WorkOffset, StandardGroup::Distance, StandardGroup::Motion}) {
      const CodeInfo *const code = after.activeCode(ctx.dialect(), which);
      const Origin origin = after.originOf(ctx.dialect(), which);
      if (!code || !origin.known() || origin.file != tool.file || origin.begin >= tool.begin)
        continue;
      names.push_back("`" + code->name + "`");
      if (!first.known())
        first = origin;
    }
    if (names.empty())
      return;
    if (auto finding = ctx.report(ctx.blockRange(), event.certain))
      finding
          .message("this tool moves with {0} of an earlier section: after a start at its call they "
                   "may not be in force",
                   llvm::join(names, ", "))
          .note(tool, "the tool is called here")
          .note(first, "the first of them is set here");
  }
};

} // namespace
NCVET_RULE(ProgramRestartUnsafe, program_restart_unsafe)
} // namespace ncvet
