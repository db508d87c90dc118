// A code that works only with an option of the machine that the profile does not confirm.
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <set>

namespace ncvet {
namespace {

struct BlockOptionRequiredMemory {
  Aside<SourceRange> lastTool;
  Aside<std::optional<SourceRange>> told; ///< of all tools of the program the first
};

class BlockOptionRequired final : public StatefulRule<BlockOptionRequiredMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onNotices(id);
    needsCode_ = to.flag("changeNeedsCode");
    if (const CodeInfo *change = firstCodeWith(to.dialect(), Action::ToolChange))
      change_ = change->name;
    if (!to.dialect().toolChangeByT && !to.dialect().isLathe() && !change_.empty())
      to.onChange({EventKind::ToolWord, EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code)
      return ctx.reportNotices(id, event);
    if (event.kind == EventKind::ToolWord) {
      if (event.word)
        memory().lastTool.note() = ctx.range(*event.word);
      return;
    }
    toolByItself(event, ctx);
  }

private:
  static constexpr llvm::StringLiteral id{"block-option-required"};

  /// The change is in the block of the tool, in letters that the control does not read: `MO6`.
  bool isUnreadable(const RuleContext &ctx) const {
    const SourceRange tool = memory().lastTool.look();
    if (tool.empty() || tool.file != ctx.source().id())
      return false;
    Block block;
    ctx.index().read(ctx.source().lines().lineBegin(tool.begin), block);
    return !block.issues.empty();
  }

  /// The first tool is only named, and the tool moves: that works where T itself changes it.
  void toolByItself(const Event &event, RuleContext &ctx) const {
    const MachineState &before = ctx.before();
    if (event.motion == MotionKind::Reference || ctx.after().tool != notSet ||
        before.preselected == notSet || before.may(Fact::ToolCalled) ||
        before.may(Fact::UnknownCode) || ctx.find({Action::MachineMove}) || isUnreadable(ctx))
      return sleepInShape();
    const SourceRange lastTool = memory().lastTool.look();
    std::optional<SourceRange> &told = memory().told.look();
    if (lastTool.empty() || (told && !(*told == lastTool)))
      return;
    if (turns(before, ctx.dialect())) { // for the rest of its work, in whatever plane
      memory().lastTool.note() = {};
      return;
    }
    told = lastTool;
    auto finding = ctx.report(lastTool, event.certain);
    if (!finding)
      return;
    if (needsCode_ && changesNone(ctx))
      finding.severity(Severity::Warning)
          .message("`{0}` has no `{1}`, nor has any other tool of the program: T alone changes no "
                   "tool here, and one does the work of all",
                   ctx.text(lastTool), change_);
    else
      finding
          .message("`{0}` has no `{1}`: it changes the tool only on a machine that is set up so",
                   ctx.text(lastTool), change_)
          .severity(Severity::Style);
  }

  /// The program names several tools, and neither changes one nor calls who might.
  static bool changesNone(const RuleContext &ctx) {
    std::set<int64_t> tools;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &block : blocks(ctx.index(), program.body, program.end)) {
      if (!block.items.empty() ||
          findCode(ctx.dialect(), block,
                   {Action::ToolChange, Action::CallProgram, Action::CallLocal, Action::MacroCall,
                    Action::MacroModal}))
        return false;
      if (const Word *const tool = block.find(letterAddress('T')); tool && tool->isNumber())
        tools.insert(int64_t(tool->value()));
    }
    return tools.size() > 1;
  }

  /// A turret changes by T: on a control for mills and lathes the program's modes say which it is.
  static bool turns(const MachineState &state, const Dialect &dialect) {
    const GroupIndex diameters = dialect.group(StandardGroup::Diameter);
    return state.isActive(dialect, StandardGroup::Plane, {Action::PlaneZX}) == Truth::Yes ||
           (diameters != noGroup &&
            state.mayBeStated(diameters)); // a driven tool, in its own plane
  }

  std::string change_;
  bool needsCode_ = false; ///< no machine with the control changes its tool by T alone
};

} // namespace
NCVET_RULE(BlockOptionRequired, block_option_required)
} // namespace ncvet
