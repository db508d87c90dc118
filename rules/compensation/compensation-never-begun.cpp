// The end of a compensation that nothing has begun.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/text_answers.h"

#include <array>

namespace ncvet {
namespace {

class CompensationNeverBegun final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().isLathe())
      to.onAction({Action::CompensationOff});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    constexpr AddressMask plane = maskOf(letterAddress('X')) | maskOf(letterAddress('Y'));
    const MachineState &before = ctx.before();
    if (!event.certain || !ctx.block().hasAny(plane) || before.compensation != phaseOff ||
        before.activeAction(ctx.dialect(), StandardGroup::Compensation) !=
            Action::CompensationOff ||
        !before.must(Fact::CutSinceTool) || before.may(Fact::UnknownCode) ||
        before.may(Fact::AwayFromPart) || ctx.callDepth() > 0 ||
        before.activeAction(ctx.dialect(), StandardGroup::Motion) == Action::Rapid ||
        ctx.after().activeAction(ctx.dialect(), StandardGroup::Motion) != Action::Linear ||
        !ctx.after().frames.empty() || !endsContour(ctx) || !isMeant(ctx))
      return;
    if (auto finding = ctx.report(event))
      finding.message(
          "`{0}` ends a compensation that nothing has begun: the contour before it is cut "
          "along the centre of the tool",
          ctx.text(*event.word));
  }

private:
  /// The block before cuts in the plane, and this one does nothing else than end the compensation:
  /// a row of safe modes may be in any block.
  static bool endsContour(const RuleContext &ctx) {
    constexpr AddressMask plane = maskOf(letterAddress('X')) | maskOf(letterAddress('Y'));
    Block before;
    return onlyMoves(ctx.block(), ctx) && readPrevious(ctx, before) && before.hasAny(plane) &&
           before.items.empty() && !findCode(ctx.dialect(), before, {Action::CompensationOff});
  }

  /// Whether the G codes of the block are those of moves, lengths and the compensation's end.
  static bool onlyMoves(const Block &block, const RuleContext &ctx) {
    constexpr std::array harmless{Action::Linear, Action::Rapid, Action::LengthPositive,
                                  Action::Absolute, Action::CompensationOff};
    return llvm::all_of(block.words, [&](const Word &word) {
      if (word.address != letterAddress('G'))
        return true;
      const CodeIndex code = codeOf(ctx.dialect(), word);
      return code != noCode && llvm::is_contained(harmless, ctx.dialect().codes[code].action);
    });
  }

  /// The tool has a D of its own, or other contours of the program are compensated.
  bool isMeant(const RuleContext &ctx) const {
    const MachineState &before = ctx.before();
    const Origin &given = before.origin.of(StatePart::RadiusOffset);
    const Origin &tool = before.origin.of(StatePart::Tool);
    if (before.radiusOffset > 0 && given.known() && tool.known() && given.file == tool.file &&
        given.begin > tool.begin && given.file == ctx.source().id()) {
      Block block;
      ctx.index().read(given.begin, block);
      if (onlyMoves(block, ctx)) // no other code may have taken its D
        return true;
    }
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    return compensates_.of({ctx.source().id(), program.begin},
                           [&] { return compensates(program, ctx); });
  }

  /// Every run of the program comes by the same blocks, and some of them compensate.
  static bool compensates(const ProgramInfo &program, const RuleContext &ctx) {
    bool compensates = false;
    for (const Block &block : blocks(ctx.index().reader(), program.body, program.end)) {
      if (block.skip >= 0 || !block.items.empty())
        return false; // not every run of it comes by the same blocks
      compensates |= findCode(ctx.dialect(), block,
                              {Action::CompensationLeft, Action::CompensationRight}) != nullptr;
    }
    return compensates;
  }

  TextAnswers<std::pair<FileId, uint32_t>, bool> compensates_; ///< by program
};

} // namespace
NCVET_RULE(CompensationNeverBegun, compensation_never_begun)
} // namespace ncvet
