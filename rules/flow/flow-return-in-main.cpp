// A return code is reached in a program that nobody called.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FlowReturnInMain final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::FlowIssue); }

  void on(const Event &event, RuleContext &ctx) override {
    // `/M99` in front of M30 is the usual switch between one part and many.
    if (FlowIssue(event.number) != FlowIssue::ReturnInMain || ctx.block().skip >= 0)
      return;
    // Macros have numbers of their own range; their callers may be anywhere.
    constexpr int64_t firstMacro = 8000;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    const bool named = !ctx.dialect().mainExtensions.empty();
    if (program.number >= firstMacro || (named && program.kind != ProgramKind::Main))
      return;
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding
          .message(
              named ? "`{0}` ends a main program: it is the end of a subprogram, and M30 that of "
                      "a main program"
                    : "`{0}` in a program that nobody calls: it starts again from the top without "
                      "end",
              ctx.text(ctx.flowRange()))
          .fix(FixSafety::Unsafe, "write `M30`", ctx.replace(ctx.flowRange(), "M30"));
  }
};

} // namespace
NCVET_RULE(FlowReturnInMain, flow_return_in_main)
} // namespace ncvet
