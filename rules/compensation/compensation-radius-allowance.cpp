// Compensation with a negative radius, which swaps its sides, and a stock that is left set.
#include "analyzer/left_on.h"
#include "interp/tool_data.h"

namespace ncvet {
namespace {

class CompensationRadiusAllowance final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::CompensationMove, EventKind::OffsetWord});
    listenForLeftOn(id, to);
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind == EventKind::ProgramEnd || event.kind == EventKind::ToolChange)
      return reportLeftOn(id, event, ctx);
    const Dialect &dialect = ctx.dialect();
    const CodeInfo *code = ctx.after().activeCode(dialect, StandardGroup::Compensation);
    if (!code ||
        (code->action != Action::CompensationLeft && code->action != Action::CompensationRight))
      return;
    if (event.kind == EventKind::OffsetWord &&
        ((ctx.outcome().kinds & bitOf(EventKind::CompensationMove)) ||
         event.word->address != letterAddress('D') || ctx.before().compensation != phaseOn))
      return;
    const ToolData *tool = compensatingTool(dialect, ctx.machine(), ctx.after());
    if (!tool || !tool->radius || *tool->radius >= 0)
      return;
    const CodeUse *use = ctx.find({Action::CompensationLeft, Action::CompensationRight});
    const SourceRange where = event.word ? ctx.range(*event.word)
                              : use      ? ctx.range(*use->word)
                                         : ctx.blockRange();
    if (auto finding = ctx.report(where, event.certain)) {
      const bool left = code->action == Action::CompensationLeft;
      finding
          .message(
              "`{0}` with a radius of {1} mm: a negative radius swaps the sides, the tool runs "
              "on the {2} of the contour",
              code->name, *tool->radius, left ? "right" : "left")
          .note(dialect.isLathe() ? ctx.after().origin.tool : ctx.after().origin.radiusOffset,
                dialect.isLathe() ? "the offset is called here" : "the offset is selected here");
    }
  }

private:
  static constexpr llvm::StringLiteral id{"compensation-radius-allowance"};
};

} // namespace
NCVET_RULE(CompensationRadiusAllowance, compensation_radius_allowance)
} // namespace ncvet
