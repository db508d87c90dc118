// A word of a canned or turning cycle has a value that the cycle does not take.
#include "analyzer/lookahead.h"
#include "analyzer/word_checks.h"

namespace ncvet {
namespace {

constexpr llvm::StringLiteral id = "cycle-parameter-out-of-range";

class CycleParameterOutOfRange final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.handleNotices();
    to.on(EventKind::CycleRun);
    to.onCode([](const CodeInfo &code) {
      return code.action == Action::Cycle ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.code == noCode)
      return;
    // A later block of a modal cycle may give a word anew.
    if (event.kind == EventKind::CycleRun &&
        llvm::any_of(ctx.codes(), [&](const CodeUse &use) { return use.code == event.code; }))
      return;
    reportWordRanges(ctx, event, [](const CodeInfo &code, const WordSpec &spec, Breach) {
      return code.action == Action::Cycle && topicOf(code, spec) == WordTopic::Cycle;
    });
    if (event.kind != EventKind::Code)
      return;
    packedThread(event, ctx);
    ctx.reportNotices(id, event);
  }

private:
  /// The data block of a thread packs three fields of two digits: finishing passes, run-out, angle.
  static void packedThread(const Event &event, RuleContext &ctx) {
    const CodeInfo &code = ctx.code(event);
    if (code.cycle != CycleKind::ThreadMulti || !code.twoBlock)
      return;
    const Word *word = wordOf(ctx.block(), code, Role::ThreadForm);
    const auto value = valueOf(ctx, code, Role::ThreadForm);
    if (!word || !value || *value < 0 || *value > 999999 || word->has(wordPoint))
      return;
    const auto packed = int64_t(*value);
    constexpr int64_t angles[] = {0, 29, 30, 55, 60, 80};
    const bool angleFits = llvm::is_contained(angles, packed % 100);
    if (packed >= 10000 && angleFits)
      return;
    if (auto finding = ctx.report(*word, event.certain))
      finding.message(
          packed < 10000
              ? "`{0}` of `{1}` has no finishing pass: it packs passes, run-out and angle, two "
                "digits each"
              : "`{0}` of `{1}` ends with a flank angle that the control does not have: it "
                "knows 80, 60, 55, 30, 29 and 0",
          ctx.text(*word), code.name);
  }
};

} // namespace
NCVET_RULE(CycleParameterOutOfRange, cycle_parameter_out_of_range)
} // namespace ncvet
