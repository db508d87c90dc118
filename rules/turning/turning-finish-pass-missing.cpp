// Roughing leaves an allowance that no finishing pass removes.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "analyzer/rule/text_answers.h"

#include <set>

namespace ncvet {
namespace {

class TurningFinishPassMissing final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on({EventKind::ProgramEnd, EventKind::CycleRun}); }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::CycleRun)
      return ctx.outcome().flow.kind == FlowKind::Profile ? replaced(event, ctx) : sleepInShape();
    const MachineState &before = ctx.before();
    const Origin &origin = before.origin.of(StatePart::Roughing);
    if (before.roughFirst < 0 || ctx.callDepth() != 0 || ctx.dialect().profileRunsThrough ||
        before.may(Fact::UnknownCode) || !origin.known())
      return;
    report(origin, before.roughFirst, before.roughLast, "the program ends here", ctx);
  }

private:
  /// Another contour is roughed while the one before is not finished: it is to be finished later.
  void replaced(const Event &event, RuleContext &ctx) const {
    const MachineState &before = ctx.before();
    const Flow &flow = ctx.outcome().flow;
    const Origin &origin = before.origin.of(StatePart::Roughing);
    if (event.code == noCode || before.roughFirst < 0 ||
        ctx.code(event).cycle == CycleKind::Finish || flow.first == before.roughFirst ||
        ctx.dialect().profileRunsThrough || before.may(Fact::UnknownCode) || !origin.known() ||
        isFinished(origin, before.roughFirst, ctx))
      return;
    report(origin, before.roughFirst, before.roughLast, "the next contour is roughed here", ctx);
  }

  /// Whether a finishing cycle of the program names the contour, or one that cannot be read does.
  bool isFinished(const Origin &roughing, int64_t first, const RuleContext &ctx) const {
    const FileIndex &index = ctx.indexOf(roughing.file);
    const ProgramInfo &program = index.programAt(roughing.begin);
    const ProgramInfo &here = ctx.index().programAt(ctx.block().begin);
    return finishes(roughing.file, index, program, first, ctx) ||
           (&here != &program && finishes(ctx.source().id(), ctx.index(), here, first, ctx));
  }

  bool finishes(FileId file, const FileIndex &index, const ProgramInfo &program, int64_t first,
                const RuleContext &ctx) const {
    index.reader(); // it is looked through, now or before
    const Finished &finished = finished_.of(
        {file, program.begin}, [&] { return finishedIn(index, program, ctx.dialect()); });
    return finished.any || finished.contours.count(double(first));
  }

  /// What the finishing cycles of a program work along.
  struct Finished {
    bool any = false;          ///< it cannot be told
    std::set<double> contours; ///< numbers of their first blocks
  };

  static Finished finishedIn(const FileIndex &index, const ProgramInfo &program,
                             const Dialect &dialect) {
    Finished finished;
    finished.any = program.end - program.body > longest;
    if (finished.any)
      return finished;
    for (const Block &block : blocks(index, program.body, program.end)) {
      const Word *word = block.find('P');
      finished.any |=
          !block.items.empty() ||
          findCode(dialect, block, {Action::CallProgram, Action::CallLocal, Action::MacroCall}) ||
          (word && !word->isNumber() && isFinishing(block, dialect));
      if (finished.any)
        break;
      if (word && isFinishing(block, dialect))
        finished.contours.insert(word->value());
    }
    return finished;
  }

  static bool isFinishing(const Block &block, const Dialect &dialect) {
    // A code that roughs by itself finishes where its block says nothing of roughing.
    const bool roughs = block.hasAny(lettersMask("UWFD"));
    return llvm::any_of(codesOf(dialect, block), [&](const CodeIndex each) {
      const CodeInfo &code = dialect.codes[each];
      const bool finishes = code.cycle == CycleKind::Finish ||
                            llvm::any_of(code.variants, [&](const Variant &variant) {
                              return dialect.codes[variant.code].cycle == CycleKind::Finish;
                            });
      const bool mayRough = code.cycle != CycleKind::None && code.cycle != CycleKind::Finish;
      return finishes && !(mayRough && roughs);
    });
  }

  TextAnswers<std::pair<FileId, uint32_t>, Finished> finished_; ///< by file and program

  static constexpr uint32_t longest = 200000; ///< bytes: no longer program is looked through

  static void report(const Origin &cause, int64_t first, int64_t last, const char *end,
                     RuleContext &ctx) {
    // The cycle's own words tell whether it left anything.
    Block block;
    readBlockOf(ctx, cause, block);
    bool leaves = false;
    std::string name = ctx.text(cause.range()).str();
    for (const CodeIndex index : codesOf(ctx.dialect(), block))
      name = ctx.dialect().codes[index].name;
    for (const Word &word : block.words)
      if (word.address == letterAddress('U') || word.address == letterAddress('W'))
        leaves |= !word.isNumber() || word.mantissa != 0;
    if (!leaves)
      return;
    const CausePlace place = causePlace(ctx, cause);
    if (auto finding = ctx.report(place.at))
      finding
          .message(
              "`{0}` leaves an allowance along N{1} to N{2}, and no finishing cycle removes it",
              name, first, last)
          .note(place.other, place.note(end, "it is called here"));
  }
};

} // namespace
NCVET_RULE(TurningFinishPassMissing, turning_finish_pass_missing)
} // namespace ncvet
