// Roughing leaves an allowance that no finishing pass removes.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"

namespace ncvet {
namespace {

class TurningFinishPassMissing final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on({EventKind::ProgramEnd, EventKind::CycleRun}); }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &before = ctx.before();
    const Origin &origin = before.origin.of(StatePart::Roughing);
    if (event.kind == EventKind::CycleRun)
      return replaced(event, ctx);
    if (before.roughFirst < 0 || ctx.callDepth() != 0 || ctx.dialect().profileRunsThrough ||
        before.may(Fact::UnknownCode) || !origin.known() || origin.file != ctx.source().id())
      return;
    report(origin.range(), before.roughFirst, before.roughLast, "the program ends here", ctx);
  }

private:
  /// Another contour is roughed while the one before is not finished: it is to be finished later.
  static void replaced(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    const Flow &flow = ctx.outcome().flow;
    const Origin &origin = before.origin.of(StatePart::Roughing);
    if (flow.kind != FlowKind::Profile || event.code == noCode || before.roughFirst < 0 ||
        ctx.code(event).cycle == CycleKind::Finish || flow.first == before.roughFirst ||
        ctx.dialect().profileRunsThrough || before.may(Fact::UnknownCode) || !origin.known() ||
        origin.file != ctx.source().id() || isFinished(origin, before.roughFirst, ctx))
      return;
    report(origin.range(), before.roughFirst, before.roughLast, "the next contour is roughed here",
           ctx);
  }

  /// Whether a finishing cycle of the program names the contour, or one that cannot be read does.
  static bool isFinished(const Origin &roughing, int64_t first, const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(roughing.begin);
    if (program.end - program.body > longest)
      return true;
    for (const Block &block : blocks(ctx.index(), program.body, program.end)) {
      if (!block.items.empty() ||
          findCode(ctx.dialect(), block,
                   {Action::CallProgram, Action::CallLocal, Action::MacroCall}))
        return true;
      const Word *word = block.find('P');
      if (!word || (word->isNumber() && word->value() != double(first)))
        continue;
      // A code that roughs by itself finishes where its block says nothing of roughing.
      const bool roughs = block.hasAny(lettersMask("UWFD"));
      for (const CodeIndex index : codesOf(ctx.dialect(), block)) {
        const CodeInfo &code = ctx.dialect().codes[index];
        const bool finishes = code.cycle == CycleKind::Finish ||
                              llvm::any_of(code.variants, [&](const Variant &variant) {
                                return ctx.dialect().codes[variant.code].cycle == CycleKind::Finish;
                              });
        const bool mayRough = code.cycle != CycleKind::None && code.cycle != CycleKind::Finish;
        if (finishes && !(mayRough && roughs))
          return true;
      }
    }
    return false;
  }

  static constexpr uint32_t longest = 200000; ///< bytes: no longer program is looked through

  static void report(SourceRange at, int64_t first, int64_t last, const char *end,
                     RuleContext &ctx) {
    // The cycle's own words tell whether it left anything.
    Block block;
    ctx.index().read(ctx.source().lines().lineBegin(at.begin), block);
    bool leaves = false;
    std::string name = ctx.source().text(at.begin, at.end).str();
    for (const CodeIndex index : codesOf(ctx.dialect(), block))
      name = ctx.dialect().codes[index].name;
    for (const Word &word : block.words)
      if (word.address == letterAddress('U') || word.address == letterAddress('W'))
        leaves |= !word.isNumber() || word.mantissa != 0;
    if (!leaves)
      return;
    if (auto finding = ctx.report(at))
      finding
          .message(
              "`{0}` leaves an allowance along N{1} to N{2}, and no finishing cycle removes it",
              name, first, last)
          .note(ctx.blockRange(), end);
  }
};

} // namespace
NCVET_RULE(TurningFinishPassMissing, turning_finish_pass_missing)
} // namespace ncvet
