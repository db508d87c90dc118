// The passes of a thread do not fit its depth, or do not go deeper.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/length_text.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/path_ahead.h"
#include "analyzer/facts/thread_passes.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "formats/dialect/measure.h"
#include "formats/text/number_text.h"
#include "interp/evaluate/cycle_parameters.h"

#include <cmath>

namespace ncvet {
namespace {

class TurningThreadCutPlan final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    firstCutSeverity_ =
        to.dialect().facts->turning.refusesDeepFirstCut ? Severity::Error : Severity::Warning;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const CodeInfo &code = ctx.code(event);
    if (code.cycle == CycleKind::ThreadMulti)
      multi(event, code, ctx);
    else if (code.cycle == CycleKind::ThreadPass)
      pass(event, code, ctx);
    else if (code.cycle == CycleKind::ThreadInfeed)
      unlikeLead(event, code, ctx);
    else
      sleepInShape();
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
        (heightWord->has(wordPoint) ||
         (last->value() == std::floor(last->value()) && !hasPoint(data, ctx))))
      return;
    if (auto finding = ctx.report(*heightWord, event.certain))
      finding
          .message("the finishing allowance of {0} is not smaller than the thread `{1}` of "
                   "`{2}`: nothing is left for the other passes",
                   shortLength(ctx, last->value()), ctx.text(*heightWord), code.name)
          .note(before.origin.of(StatePart::PendingCycle), "the data block");
  }

  /// Whether the allowance of the data block is written with a point.
  static bool hasPoint(const CodeInfo &data, const RuleContext &ctx) {
    Block block;
    readBlockOf(ctx, ctx.before().origin.of(StatePart::PendingCycle), block);
    const Word *const allowance = wordOf(block, data, Role::AllowanceX);
    return allowance && allowance->has(wordPoint);
  }

  /// Threads of one start are about 0.6 times as deep as their lead; those of several starts are
  /// less deep, and none is deeper than its lead: a point or a zero was lost. True when that is
  /// said.
  static bool unlikeLead(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    constexpr double deepest = 1.3, least = 0.07;
    const Word *const heightWord = wordOf(ctx.block(), code, Role::Height);
    const Word *const lead = wordOf(ctx.block(), code, Role::Lead);
    const auto unit = millimetresPer(ctx.dialect(), ctx.before());
    if (!heightWord || !lead || lead->address == letterAddress('E') || !unit)
      return false;
    const ExecutedBlock executed = executedBlock(ctx);
    const auto height = CycleParameters(executed, code).length(Measure::Height, Role::Height);
    const Interval pitch = ctx.value(*lead);
    if (!height || !height->isConstant() || height->value() <= 0 || !pitch.isConstant() ||
        pitch.value() <= 0)
      return false;
    const double ratio = height->value() / (pitch.value() * *unit);
    // Where the table does not say that the depth counts on the radius it may be that of both
    // sides.
    const double most = code.cycle == CycleKind::ThreadInfeed ? 2 * deepest : deepest;
    if (ratio < most && ratio > least)
      return false;
    if (auto finding = ctx.report(*heightWord, event.certain))
      finding.severity(Severity::Warning)
          .message("a thread of {0} with the lead `{1}` is {2} than any thread: was a point or a "
                   "zero lost?",
                   shortLength(ctx, height->value()), ctx.text(*lead),
                   ratio > 1 ? "deeper" : "less deep");
    return true;
  }

  void multi(const Event &event, const CodeInfo &code, RuleContext &ctx) const {
    if (unlikeLead(event, code, ctx))
      return;
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
              ctx.text(*firstWord), code.name, shortNumber(*least))
          .note(before.origin.of(StatePart::PendingCycle), "the data block");
  }

  static void pass(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    const Interval &start = ctx.after().cycleStart[0];
    const auto unit = millimetresPer(ctx.dialect(), ctx.after());
    const Word *x = ctx.block().findAny(diameterWords);
    if (changesLead(event, code, ctx))
      return;
    if (!x || !goesOn(event, ctx) || !event.certain || !start.isConstant() || !unit ||
        before.inMachineCoordinates(Axis::X))
      return;
    const double from = start.value() / *unit;
    const auto kept = diameterKept(before.cycle, from), given = diameterOf(*x, ctx, from);
    if (!kept || !given)
      return;
    const double last = *kept, now = *given;
    if (std::fabs(now - last) < sameDiameter) {
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
    if (from == last)
      return;
    if (outside ? now < last : now > last)
      return atOnce(*x, std::fabs(now - last), ctx);
    if (outside ? now >= from : now <= from)
      return; // beyond the start: it is the start that is not clear, or no pass is meant
    if (comesCloser(ctx, now, from))
      return;
    if (auto finding = ctx.report(*x))
      finding
          .message("the pass at `{0}` of `{1}` is less deep than the one before at X{2}: it cuts "
                   "nothing",
                   ctx.text(*x), code.name, shortNumber(last))
          .note(before.origin.of(StatePart::Cycle), code.name + " becomes active here");
  }

  /// `G92 X29. Z-20. F2.` and then `X28.4 F1.5`: the next pass has another lead.
  static bool changesLead(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    const Block &block = ctx.block();
    const CycleWords &words = ctx.before().cycle;
    const AddressMask lead = addressesOf(code, Role::Lead);
    const Word *const own = block.hasAny(lead) ? block.findAny(lead) : nullptr;
    if (!own || !event.certain || ctx.find({Action::Cycle}) || !block.hasAny(diameterWords) ||
        block.hasAny(lettersMask("ZW")))
      return false;
    const char letter = char('A' + own->address);
    const Interval value = ctx.value(*own);
    if (!words.has(letter) || !value.isConstant() || std::isnan(words.get(letter)) ||
        value.value() == words.get(letter))
      return false;
    if (auto finding = ctx.report(*own))
      finding.severity(Severity::Warning)
          .message("`{0}` is another lead than that of the passes before: this one cuts across the "
                   "thread of `{1}`",
                   ctx.text(*own), code.name)
          .note(ctx.before().origin.of(StatePart::Cycle), code.name + " becomes active here");
    return true;
  }

  /// One pass takes more than the lead of the thread is long.
  static void atOnce(const Word &x, double deeper, RuleContext &ctx) {
    constexpr double sides = 2;
    const CycleWords &words = ctx.before().cycle;
    const double lead = words.has('F') ? std::fabs(words.get('F')) : NAN;
    const double depth = deeper / sides;
    if (std::isnan(lead) || lead == 0 || depth <= lead)
      return;
    if (auto finding = ctx.report(x))
      finding.severity(Severity::Warning)
          .message("the pass at `{0}` goes {1} deeper at once, more than the lead of the thread: "
                   "was a digit lost?",
                   ctx.text(x), shortNumber(depth));
  }

  /// The passes before and after this one all come closer to the start: it is the start that is
  /// wrong, as another rule says.
  static bool comesCloser(const RuleContext &ctx, double now, double from) {
    constexpr unsigned mostBlocks = 30; // threads have fewer passes
    unsigned others = 0;
    double last = now;
    for (const double pass : threadPassesAhead(ctx, from)) {
      if (std::fabs(pass - from) > std::fabs(last - from))
        return false;
      last = pass;
      ++others;
    }
    last = now;
    Block block;
    bool more = readPrevious(ctx, block);
    for (unsigned i = 0; more && i < mostBlocks; ++i, more = readBack(ctx, block)) {
      const CodeInfo *cycle = findCode(ctx.dialect(), block, {Action::Cycle});
      const Word *x = block.findAny(diameterWords);
      if (!block.items.empty() || (block.has(letterAddress('G')) && !cycle))
        return false;
      const auto pass = x ? diameterOf(*x, ctx, from) : std::nullopt;
      if (pass && std::fabs(*pass - from) < std::fabs(last - from))
        return false;
      others += pass.has_value();
      last = pass.value_or(last);
      if (cycle)
        break;
    }
    return others > 1; // of two passes it may be the second
  }

  static constexpr AddressMask diameterWords = maskOf('X') | maskOf('U');
  static constexpr double sameDiameter = 1e-6;

  /// Whether the block is a further pass of the list: it gives a diameter alone, or it writes the
  /// cycle once more for the same thread.
  static bool goesOn(const Event &event, const RuleContext &ctx) {
    const Block &block = ctx.block();
    const CycleWords &words = ctx.before().cycle;
    const bool again = ctx.find({Action::Cycle});
    if (!again)
      return !block.hasAny(lettersMask("ZWQFE"));
    const CodeInfo *running = ctx.before().activeCode(ctx.dialect(), StandardGroup::Motion);
    if (running != &ctx.code(event) ||
        (block.has(letterAddress('X')) && block.has(letterAddress('U'))))
      return false;
    for (const Word &word : block.words) {
      if (!(lettersMask("ZWFEIKQR") & maskOf(word.address)))
        continue;
      const Interval value = ctx.value(word);
      const char letter = char('A' + word.address);
      if (!words.has(letter) || !value.isConstant() || value.value() != words.get(letter))
        return false; // another thread, or another start of it
    }
    return true;
  }

  /// The diameter that the list has reached, in units of the program; increments count from the
  /// start point.
  static std::optional<double> diameterKept(const CycleWords &words, double from) {
    if (words.has('X') == words.has('U'))
      return std::nullopt;
    const double end = words.has('X') ? words.get('X') : from + words.get('U');
    return std::isnan(end) ? std::nullopt : std::optional(end);
  }

  static std::optional<double> diameterOf(const Word &word, const RuleContext &ctx, double from) {
    const Interval value = ctx.value(word);
    if (!value.isConstant())
      return std::nullopt;
    return word.address == letterAddress('U') ? from + value.value() : value.value();
  }

  /// Whether a later pass of the list is deeper than `x`.
  static bool deeperFollows(const RuleContext &ctx, double x, double from) {
    return llvm::any_of(threadPassesAhead(ctx, from), [&](double pass) {
      return from > x ? pass < x - sameDiameter : pass > x + sameDiameter;
    });
  }

  Severity firstCutSeverity_ = Severity::Warning;
};

} // namespace
NCVET_RULE(TurningThreadCutPlan, turning_thread_cut_plan)
} // namespace ncvet
