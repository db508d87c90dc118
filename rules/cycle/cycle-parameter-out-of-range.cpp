// A word of a canned or turning cycle has a value that the cycle does not take.
#include "analyzer/facts/length_text.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/path_ahead.h"
#include "analyzer/facts/turning_profile.h"
#include "analyzer/facts/word_checks.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "interp/evaluate/cycle_parameters.h"

namespace ncvet {
namespace {

struct CycleParameterOutOfRangeMemory {
  KeptFaults faults;
};

class CycleParameterOutOfRange final : public StatefulRule<CycleParameterOutOfRangeMemory> {
  static constexpr llvm::StringLiteral id = "cycle-parameter-out-of-range";

public:
  void listen(Subscriptions &to) override {
    to.handleNotices();
    to.on(EventKind::CycleRun);
    to.onCode([](const CodeInfo &code) {
      return code.action == Action::Cycle ||
             llvm::any_of(code.words,
                          [&](const WordSpec &w) {
                            return !w.characters.empty() || topicOf(code, w) == WordTopic::Cycle;
                          }) ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    if (event.kind == EventKind::CycleRun && ctx.code(event).cycle == CycleKind::RoughTurn)
      wholeStock(event, ctx);
    // A later block of a modal cycle may give a word anew.
    if (event.kind == EventKind::CycleRun &&
        (ctx.codeWord(event) || !namesRange(ctx.block(), ctx.code(event))))
      return sleepInShape();
    // With one argument too many it is not known which of them is in the wrong place.
    if (const uint8_t most = ctx.code(event).arguments; most && ctx.block().argument(most + 1u))
      return;
    reportWordRanges(ctx, event, [](const CodeInfo &code, const WordSpec &spec, Breach) {
      return topicOf(code, spec) == WordTopic::Cycle;
    });
    reportKeptRanges(ctx, event, memory().faults, [](const CodeInfo &code, const WordSpec &spec) {
      return topicOf(code, spec) == WordTopic::Cycle;
    });
    if (event.kind != EventKind::Code)
      return;
    packedThread(event, ctx);
    for (const WordSpec &spec : ctx.code(event).words)
      if (!spec.characters.empty())
        characters(spec, ctx);
    ctx.reportNotices(id, event);
  }

private:
  /// A depth of cut that is more than all that roughing takes away: one pass cuts it all.
  static void wholeStock(const Event &event, RuleContext &ctx) {
    constexpr double heavy = 5, most = 100; // mm, of the radius; more counts in increments
    const Interval &start = ctx.after().at(Axis::X);
    if (ctx.outcome().flow.kind != FlowKind::Profile || !event.certain || !start.isConstant())
      return;
    const ExecutedBlock executed = executedBlock(ctx);
    const auto depth = CycleParameters(executed, ctx.code(event)).length(Role::CutDepth);
    if (!depth || !depth->isConstant() || depth->value() <= heavy || depth->value() > most)
      return;
    const Profile profile = readProfile(ctx);
    if (!profile.known || !profile.minX || profile.side != Side::Outside)
      return;
    const double stock = (start.value() - *profile.minX) / ctx.dialect().lengthsPerUnit(Axis::X);
    if (stock <= 0 || depth->value() <= stock)
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("the depth of cut of `{0}` is {1}, and all that it roughs is {2}: one pass cuts "
                   "it all",
                   ctx.code(event).name, shortLength(ctx, depth->value()), shortLength(ctx, stock))
          .note(profile.blocks.front().range, "the profile begins here");
  }

  /// A text of other characters than the control can make.
  static void characters(const WordSpec &spec, RuleContext &ctx) {
    const Word *word = wordFor(ctx.block(), spec);
    if (!word)
      return;
    const llvm::StringRef allowed = spec.characters;
    const auto known = [&](char c) {
      for (size_t i = 0; i < allowed.size(); ++i) {
        const bool range = i + 2 < allowed.size() && allowed[i + 1] == '-';
        if (range ? c >= allowed[i] && c <= allowed[i + 2] : c == allowed[i])
          return true;
        i += range ? 2 : 0;
      }
      return false;
    };
    const Block &block = ctx.block();
    if (word->has(wordExpression) && size_t(word->mantissa) < block.expressions.size()) {
      const Expression &e = block.expressions[size_t(word->mantissa)];
      if (e.count == 1 && block.operations[e.first].op == Op::Variable)
        return; // the value of a variable
    }
    const llvm::StringRef text = ctx.text(*word).trim('"');
    const auto *const bad = llvm::find_if(text, [&](char c) { return !known(c); });
    if (bad == text.end())
      return;
    if (auto finding = ctx.report(*word))
      finding.message("`{0}` has a character that the control cannot make here: {1} are known",
                      ctx.source().displayText(text), spec.characters);
  }

  /// The data block of a thread packs three fields of two digits: finishing passes, run-out, angle.
  static void packedThread(const Event &event, RuleContext &ctx) {
    const CodeInfo &code = ctx.code(event);
    if (code.cycle != CycleKind::ThreadMulti || !code.twoBlock)
      return;
    const Word *word = wordOf(ctx.block(), code, Role::ThreadForm);
    const auto value = valueOf(ctx, code, Role::ThreadForm);
    if (!word || !value || *value < 0 || !word->isNumber())
      return;
    const llvm::StringRef digits = ctx.text(*word).drop_front().trim();
    constexpr size_t packedDigits = 6;
    if (word->has(wordPoint)) {
      if (auto finding = ctx.report(*word, event.certain))
        finding.message("`{0}` of `{1}` packs passes, run-out and angle into six digits: it takes "
                        "no decimal point",
                        ctx.text(*word), code.name);
      return;
    }
    if (llvm::all_of(digits, llvm::isDigit) && digits.size() != packedDigits) {
      // Without a leading zero the fields are still those that were meant.
      const bool leadingZero = digits.size() + 1 == packedDigits && digits.front() != '0';
      if (auto finding = ctx.report(*word, event.certain))
        finding
            .message("`{0}` of `{1}` has {2} digits: it packs finishing passes, run-out and "
                     "angle, two digits each",
                     ctx.text(*word), code.name, digits.size())
            .severity(leadingZero ? std::optional(Severity::Warning) : std::nullopt);
      return;
    }
    if (*value > 999999)
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
