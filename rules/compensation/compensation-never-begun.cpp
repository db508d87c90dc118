// The end of a compensation that nothing has begun.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/turning_profile.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "analyzer/rule/text_answers.h"

#include <array>

namespace ncvet {
namespace {

class CompensationNeverBegun final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().isLathe())
      to.on({EventKind::CycleRun});
    to.onAction({Action::CompensationOff});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::CycleRun)
      return inProfile(event, ctx);
    if (!onlyMoves(ctx.block(), ctx))
      return sleepInShape();
    const MachineState &before = ctx.before();
    const bool turns = ctx.dialect().isLathe() || turnsWork(ctx.dialect(), before);
    const AddressMask plane = turns ? lettersMask("XZ") : lettersMask("XY");
    if (!event.certain || !isOff(before, ctx) || !before.must(Fact::CutSinceTool) ||
        before.may(Fact::UnknownCode) || before.may(Fact::AwayFromPart) || ctx.callDepth() > 0 ||
        before.profile != ProfileMode::Off ||
        before.activeAction(ctx.dialect(), StandardGroup::Motion) == Action::Rapid ||
        !leavesBy(ctx.after().activeAction(ctx.dialect(), StandardGroup::Motion), turns) ||
        !isShiftedOrTurned(ctx.after().frames) || !endsContour(plane, ctx))
      return;
    const bool alone = !ctx.block().hasAny(plane);
    if ((alone && !goesOn(plane, turns, ctx)) ||
        (turns && (!isContour(ctx) || !before.must(Fact::ToolCalled))) ||
        !isMeant(turns || alone, ctx))
      return;
    if (auto finding = ctx.report(event))
      finding.message(
          "`{0}` ends a compensation that nothing has begun: the contour before it is cut "
          "along the centre of the tool",
          ctx.text(*event.word));
  }

private:
  /// In a mirror image the sides are others.
  static bool isShiftedOrTurned(const FrameStack &frames) {
    const auto total = frames.empty() ? std::optional(Frame()) : frames.total();
    return total && total->keepsLengths() && !total->mirrors(0, 1) && !total->mirrors(2, 0);
  }

  static bool isOff(const MachineState &state, const RuleContext &ctx) {
    return state.compensation == phaseOff &&
           state.activeAction(ctx.dialect(), StandardGroup::Compensation) ==
               Action::CompensationOff;
  }

  /// A lathe's tool may leave its contour at rapid.
  static bool leavesBy(Action motion, bool turns) {
    return motion == Action::Linear || (turns && motion == Action::Rapid);
  }

  /// The profile of a turning cycle has arcs or slants, and compensation ends in it.
  void inProfile(const Event &event, RuleContext &ctx) const {
    if (event.code == noCode || ctx.outcome().flow.kind != FlowKind::Profile || !event.certain ||
        !isOff(ctx.before(), ctx) || ctx.before().may(Fact::UnknownCode))
      return;
    const Profile profile = readProfile(ctx);
    if (!profile.known)
      return;
    const ProfileBlock *end = nullptr;
    const CodeUse *off = nullptr;
    bool shaped = false;
    for (const ProfileBlock &entry : profile.blocks) {
      for (const CodeUse &use : entry.codes) {
        const Action action = ctx.code(use).action;
        if (action == Action::CompensationLeft || action == Action::CompensationRight)
          return;
        if (action == Action::CompensationOff)
          end = &entry, off = &use;
      }
      shaped |= entry.moves && entry.motion != MotionKind::Rapid && !isStraightAlong(entry);
    }
    if (!off || end != &profile.blocks.back() || !shaped || !lostOne(ctx))
      return;
    if (auto finding = ctx.report(
            SourceRange{ctx.source().id(), off->word->offset, end->block.endOf(*off->word)}))
      finding.message("`{0}` ends a compensation that nothing has begun: the profile is cut "
                      "without that of the tool's nose",
                      ctx.code(*off).name);
  }

  /// A line along one axis.
  static bool isStraightAlong(const ProfileBlock &entry) {
    return entry.motion == MotionKind::Feed &&
           (entry.fromX == entry.toX || entry.fromZ == entry.toZ);
  }

  /// The block before cuts in the plane, and this one does nothing else than end the compensation:
  /// a row of safe modes may be in any block.
  static bool endsContour(AddressMask plane, const RuleContext &ctx) {
    Block before;
    return onlyMoves(ctx.block(), ctx) && readPrevious(ctx, before) && before.hasAny(plane) &&
           before.items.empty() && !findCode(ctx.dialect(), before, {Action::CompensationOff});
  }

  /// The code is alone in its block, and the tool leaves the contour in the next one.
  static bool goesOn(AddressMask plane, bool turns, const RuleContext &ctx) {
    Block next;
    if (ctx.block().words.size() != 1 || !BlocksAhead(ctx).next(next) || !next.items.empty() ||
        !next.hasAny(plane) || (!turns && next.has(letterAddress('Z'))) || !onlyMoves(next, ctx))
      return false;
    return !hasMotionCode(ctx.dialect(), next) || findCode(ctx.dialect(), next, {Action::Linear}) ||
           (turns && findCode(ctx.dialect(), next, {Action::Rapid}));
  }

  /// What was cut since the last rapid move has an arc or a slant: a lathe's straight cuts need no
  /// compensation.
  static bool isContour(const RuleContext &ctx) {
    constexpr unsigned furthest = 40; // blocks
    Block block;
    bool more = readPrevious(ctx, block);
    for (unsigned i = 0; more && i < furthest; ++i, more = readBack(ctx, block)) {
      if (!block.items.empty() || block.skip >= 0 ||
          findCode(ctx.dialect(), block, {Action::Rapid}))
        return false;
      if ((block.has(letterAddress('X')) && block.has(letterAddress('Z'))) ||
          findCode(ctx.dialect(), block, {Action::ArcCw, Action::ArcCcw}))
        return true;
    }
    return false;
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

  /// The tool has a D of its own, or other contours of the program are compensated. `byCount`: it
  /// ends one compensation more than it begins.
  bool isMeant(bool byCount, const RuleContext &ctx) const {
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
    return byCount ? lostOne(ctx) : countsOf(ctx).begins > 0;
  }

  /// How often the program begins a compensation, and ends one with no safe modes beside it.
  struct Counts {
    unsigned begins = 0, ends = 0;
  };

  /// It ends one more than it begins.
  bool lostOne(const RuleContext &ctx) const {
    const Counts &counts = countsOf(ctx);
    return counts.ends == counts.begins + 1;
  }

  const Counts &countsOf(const RuleContext &ctx) const {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    return counts_.of({ctx.source().id(), program.begin}, [&] { return count(program, ctx); });
  }

  /// Nothing is counted where not every run of the program comes by the same blocks.
  static Counts count(const ProgramInfo &program, const RuleContext &ctx) {
    Counts counts;
    for (const Block &block : blocks(ctx.index().reader(), program.body, program.end)) {
      const bool decides = llvm::any_of(
          block.items, [](const Item &item) { return item.kind != ItemKind::Instruction; });
      if (block.skip >= 0 || decides)
        return {};
      counts.begins += findCode(ctx.dialect(), block,
                                {Action::CompensationLeft, Action::CompensationRight}) != nullptr;
      counts.ends +=
          findCode(ctx.dialect(), block, {Action::CompensationOff}) && onlyMoves(block, ctx);
    }
    return counts;
  }

  TextAnswers<std::pair<FileId, uint32_t>, Counts> counts_; ///< by program
};

} // namespace
NCVET_RULE(CompensationNeverBegun, compensation_never_begun)
} // namespace ncvet
