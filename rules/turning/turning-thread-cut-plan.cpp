// The passes of a thread do not fit its depth, or do not go deeper.
#include "analyzer/path_ahead.h"
#include "formats/dialect/measure.h"
#include "interp/cycle_parameters.h"

#include <cmath>

namespace ncvet {
namespace {

class TurningThreadCutPlan final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    firstCutSeverity_ =
        to.option("firstCutIsError", 0) != 0 ? std::optional(Severity::Error) : std::nullopt;
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.code == noCode)
      return;
    const CodeInfo &code = ctx.code(event);
    if (code.cycle == CycleKind::ThreadMulti)
      multi(event, code, ctx);
    else if (code.cycle == CycleKind::ThreadPass)
      pass(event, code, ctx);
  }

private:
  /// The last passes take as much as the whole thread is deep.
  static void allowance(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    if (before.pendingCycle == noCode || !code.twoBlock)
      return;
    const CodeInfo &data = ctx.dialect().codes[before.pendingCycle];
    const Word *heightWord = wordOf(ctx.block(), code, Role::Height);
    const ExecutedBlock executed = executedBlock(ctx);
    const CycleParameters parameters(executed, code);
    if (!heightWord || !data.twoBlock || !formulaOf(data, Measure::LastCut))
      return;
    const auto last = parameters.length(Measure::LastCut);
    const auto height = parameters.length(Measure::Height, Role::Height);
    if (!last || !height || !last->isConstant() || !height->isConstant() || height->value() <= 0 ||
        last->value() < height->value())
      return;
    // Where the depth counts in micrometres, so may the allowance that has no point.
    if (formulaOf(code, Measure::Height) &&
        (heightWord->has(wordPoint) || last->value() == std::floor(last->value())))
      return;
    if (auto finding = ctx.report(*heightWord, event.certain))
      finding
          .message("the finishing allowance of {0} mm is not smaller than the thread `{1}` of "
                   "`{2}`: nothing is left for the other passes",
                   text(last->value()), ctx.text(*heightWord), code.name)
          .note(before.origin.of(StatePart::PendingCycle), "the data block");
  }
  static std::string text(double value) {
    return llvm::formatv("{0}", llvm::format("%g", value)).str();
  }

  void multi(const Event &event, const CodeInfo &code, RuleContext &ctx) const {
    allowance(event, code, ctx);
    const Word *firstWord = wordOf(ctx.block(), code, Role::FirstCut);
    const Word *heightWord = wordOf(ctx.block(), code, Role::Height);
    const auto first = valueOf(ctx, code, Role::FirstCut);
    const auto height = valueOf(ctx, code, Role::Height);
    // A point tells millimetres from micrometres; values that are written differently do not
    // compare.
    if (!firstWord || !first || *first <= 0)
      return;
    if (heightWord && height && *height > 0 && *first > *height &&
        firstWord->has(wordPoint) == heightWord->has(wordPoint)) {
      if (auto finding = ctx.report(*firstWord, event.certain))
        finding
            .message("the first cut `{0}` of `{1}` is deeper than the whole thread `{2}`",
                     ctx.text(*firstWord), code.name, ctx.text(*heightWord))
            .severity(firstCutSeverity_)
            .note(ctx.range(*heightWord), "the depth of the thread");
      return;
    }
    const MachineState &before = ctx.before();
    if (before.pendingCycle == noCode || !event.word)
      return;
    const CodeInfo &data = ctx.dialect().codes[before.pendingCycle];
    const auto least = kept(before, data, Role::LeastCut);
    if (!least || *least <= *first)
      return;
    if (auto finding = ctx.report(*firstWord, event.certain))
      finding
          .message(
              "the first cut `{0}` of `{1}` is smaller than the least cut {2} of its data block",
              ctx.text(*firstWord), code.name,
              llvm::formatv("{0}", llvm::format("%g", *least)).str())
          .note(before.origin.of(StatePart::PendingCycle), "the data block");
  }

  static void pass(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    for (const CodeUse &use : ctx.codes())
      if (ctx.code(use).action == Action::Cycle)
        return;
    const Word *x = ctx.block().find('X');
    if (!x || ctx.block().hasAny(lettersMask("ZWQUFE")) || !before.cycle.has('X') || !event.certain)
      return;
    const double last = before.cycle.get('X');
    const Interval now = ctx.value(*x);
    const Interval &start = ctx.after().cycleStart[0];
    const auto unit = millimetresPer(ctx.dialect(), ctx.after());
    if (!now.isConstant() || std::isnan(last) || !start.isConstant() || !unit ||
        before.inMachineCoordinates(Axis::X))
      return;
    const double from = start.value() / *unit;
    if (now.value() == last) {
      if (!deeperFollows(ctx, last, from))
        return;
      if (auto finding = ctx.report(*x))
        finding
            .message("`{0}` cuts the last pass of `{1}` once more, although deeper passes follow",
                     ctx.text(*x), code.name)
            .severity(Severity::Style)
            .note(before.origin.of(StatePart::Cycle), code.name + " becomes active here");
      return;
    }
    const bool outside = from > last;
    if (from == last || (outside ? now.value() < last : now.value() > last))
      return;
    if (auto finding = ctx.report(*x))
      finding
          .message("the pass at `{0}` of `{1}` is less deep than the one before at X{2}: it cuts "
                   "nothing",
                   ctx.text(*x), code.name, llvm::formatv("{0}", llvm::format("%g", last)).str())
          .note(before.origin.of(StatePart::Cycle), code.name + " becomes active here");
  }

  /// Whether a later pass of the list is deeper than `x`.
  static bool deeperFollows(const RuleContext &ctx, double x, double from) {
    Block next;
    bool more = readNext(ctx, next);
    for (unsigned i = 0; more && i < 30; ++i, more = readOn(ctx, next)) {
      if (next.hasAny(maskOf('G') | maskOf('T')) || !next.items.empty())
        return false;
      const Word *word = next.find('X');
      if (word && word->isNumber() && (from > x ? word->value() < x : word->value() > x))
        return true;
    }
    return false;
  }

  std::optional<Severity> firstCutSeverity_;
};

} // namespace
NCVET_RULE(TurningThreadCutPlan, turning_thread_cut_plan)
} // namespace ncvet
