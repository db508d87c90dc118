// Roughing leaves an allowance that no finishing pass removes.
#include "analyzer/lookahead.h"

namespace ncvet {
namespace {

class TurningFinishPassMissing final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::ProgramEnd); }

  void on(const Event &, RuleContext &ctx) override {
    const MachineState &before = ctx.before();
    const Origin &origin = before.origin.of(StatePart::Roughing);
    if (before.roughFirst < 0 || ctx.callDepth() != 0 || ctx.dialect().profileRunsThrough ||
        before.may(Fact::UnknownCode) || !origin.known() || origin.file != ctx.source().id())
      return;
    // The cycle's own words tell whether it left anything.
    Block block;
    ctx.index().read(ctx.source().lines().lineBegin(origin.begin), block);
    bool leaves = false;
    std::string name = ctx.source().text(origin.begin, origin.end).str();
    for (const CodeIndex index : codesOf(ctx.dialect(), block))
      name = ctx.dialect().codes[index].name;
    for (const Word &word : block.words)
      if (word.address == letterAddress('U') || word.address == letterAddress('W'))
        leaves |= !word.isNumber() || word.mantissa != 0;
    if (!leaves)
      return;
    if (auto finding = ctx.report(origin.range()))
      finding
          .message(
              "`{0}` leaves an allowance along N{1} to N{2}, and no finishing cycle removes it",
              name, before.roughFirst, before.roughLast)
          .note(ctx.blockRange(), "the program ends here");
  }
};

} // namespace
NCVET_RULE(TurningFinishPassMissing, turning_finish_pass_missing)
} // namespace ncvet
