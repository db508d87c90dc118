// A return code is reached in a program that nobody called.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct FlowReturnInMainMemory {
  bool opened = false; ///< this one has
};

class FlowReturnInMain final : public StatefulRule<FlowReturnInMainMemory> {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().facts->program.returnRestarts)
      return;
    to.on(EventKind::FlowIssue);
    to.onAction({Action::Reset});
    opens_ = llvm::any_of(to.dialect().codes,
                          [](const CodeInfo &code) { return code.action == Action::Reset; });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code) {
      memory().opened |= ctx.callDepth() == 0;
      return;
    }
    // `/M99` before M30 is the usual switch between one part and many.
    if (event.flowIssue() != FlowIssue::ReturnInMain || ctx.block().skip >= 0)
      return;
    // Macros have numbers of their own range; their callers may be anywhere.
    constexpr int64_t firstMacro = 8000;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    const bool named = !ctx.dialect().mainExtensions.empty();
    // Neither zero point nor tool nor spindle: a piece that some other program calls.
    const MachineState &end = ctx.after();
    const bool piece = !end.must(Fact::ToolCalled) && !end.must(Fact::SpindleStated) &&
                       !end.must(Fact::WorkOffsetStated);
    if (program.number >= firstMacro || (piece && !named && !opens_) ||
        (named && program.kind != ProgramKind::Main) || (opens_ && !memory().opened))
      return;
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding
          .message(
              named || opens_
                  ? "`{0}` ends a main program: it is the end of a subprogram, and M30 that of "
                    "a main program"
                  : "`{0}` in a program that nobody calls: it starts again from the top without "
                    "end",
              ctx.text(ctx.flowRange()))
          .fix(FixSafety::Unsafe, "write `M30`", ctx.replace(ctx.flowRange(), "M30"));
  }

private:
  bool opens_ = false; ///< main programs open with a code that resets the control
};

} // namespace
NCVET_RULE(FlowReturnInMain, flow_return_in_main)
} // namespace ncvet
