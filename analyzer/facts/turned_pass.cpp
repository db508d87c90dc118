// Reads back from a rapid move: the retract, the cut and the approach.
#include "analyzer/facts/turned_pass.h"

#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"

namespace ncvet {

namespace {

constexpr uint16_t alongX = 1u << unsigned(Axis::X), alongZ = 1u << unsigned(Axis::Z);

/// Words of motion and of the feed alone: nothing that makes the numbers mean something else.
bool onlyMovesAndFeeds(const Dialect &dialect, const Block &block) {
  if (!block.items.empty() || block.skip >= 0)
    return false;
  return llvm::all_of(block.words, [&](const Word &word) {
    const CodeIndex code = codeOf(dialect, word);
    if (code == noCode)
      return word.isNumber() && word.address != letterAddress('U') &&
             word.address != letterAddress('W') && word.address != letterAddress('M') &&
             word.address != letterAddress('T');
    const Action action = dialect.codes[code].action;
    return action == Action::Rapid || action == Action::Linear || action == Action::CoolantOn ||
           action == Action::CompensationOff;
  });
}

} // namespace

std::optional<TurnedPass> turnedBefore(const RuleContext &ctx) {
  const Dialect &dialect = ctx.dialect();
  Block retract;
  if (!readPrevious(ctx, retract) || !onlyMovesAndFeeds(dialect, retract) ||
      axesOf(dialect, retract) != alongX)
    return std::nullopt;
  const bool rapid = findCode(dialect, retract, {Action::Rapid});
  Block cut = retract;
  if (!readBack(ctx, cut) || !onlyMovesAndFeeds(dialect, cut) || axesOf(dialect, cut) != alongZ ||
      findCode(dialect, cut, {Action::Rapid}))
    return std::nullopt;
  Block before = cut;
  bool feeds = findCode(dialect, cut, {Action::Linear});
  std::optional<double> x, z;
  constexpr unsigned furthest = 4; // blocks
  for (unsigned i = 0; i < furthest && !(x && z) && readBack(ctx, before); ++i) {
    if (!onlyMovesAndFeeds(dialect, before))
      return std::nullopt;
    feeds |= findCode(dialect, before, {Action::Linear}) != nullptr;
    if (const Word *word = before.find(letterAddress('X')); word && !x)
      x = word->value();
    if (const Word *word = before.find(letterAddress('Z')); word && !z)
      z = word->value();
    if (!feeds) // the cut is not fed by itself
      return std::nullopt;
  }
  const double end = cut.find(letterAddress('Z'))->value();
  const double away = retract.find(letterAddress('X'))->value();
  if (!x || !z || !(end < *z) || !(rapid ? away > *x : away < *x) || !(*x > 0))
    return std::nullopt;
  return TurnedPass{*x, *z, end, away, wordsRange(ctx, cut)};
}

/// The next block is a pass along Z: the passes become smaller, as they do on the outside.
static bool turnsNext(const RuleContext &ctx, double from) {
  BlocksAhead ahead(ctx);
  Block next;
  if (!ahead.next(next) || !onlyMovesAndFeeds(ctx.dialect(), next) ||
      axesOf(ctx.dialect(), next) != alongZ)
    return false;
  return findCode(ctx.dialect(), next, {Action::Linear}) &&
         next.find(letterAddress('Z'))->value() < from;
}

std::optional<CrossedPass> crossedPass(const Event &event, const RuleContext &ctx) {
  const MachineState &before = ctx.before(), &after = ctx.after();
  const Interval &fromX = before.at(Axis::X), &toX = after.at(Axis::X);
  const Interval &fromZ = before.at(Axis::Z), &toZ = after.at(Axis::Z);
  if (event.axes != (alongX | alongZ) || !fromX.isConstant() || !toX.isConstant() ||
      !fromZ.isConstant() || !toZ.isConstant() || toX.value() >= fromX.value() ||
      toZ.value() <= fromZ.value() || !event.certain || event.inMachineCoordinates() ||
      before.profile != ProfileMode::Off || before.may(Fact::UnknownCode) ||
      after.isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental}) == Truth::Yes)
    return std::nullopt;
  const Word *const x = ctx.block().find(letterAddress('X'));
  const Word *const z = ctx.block().find(letterAddress('Z'));
  if (!x || !z || !x->isNumber() || !z->isNumber())
    return std::nullopt;
  const auto pass = turnedBefore(ctx);
  if (!pass || x->value() >= pass->diameter || z->value() <= pass->end)
    return std::nullopt;
  if (pass->away < pass->diameter)
    return x->value() <= pass->away && turnsNext(ctx, z->value())
               ? std::optional(CrossedPass{
                     *pass, pass->end,
                     "this rapid move leads through what is left inside of the diameter {0}, from "
                     "Z{1} on: the tool was not taken out of the cut"})
               : std::nullopt;
  // Where the straight way comes to the diameter; with each axis at its own speed X is not later.
  const double part = (pass->away - pass->diameter) / (pass->away - x->value());
  const double at = pass->end + part * (z->value() - pass->end);
  constexpr double face = 0;
  if (part <= 0 || part >= 1 || at >= std::min(pass->begin, face))
    return std::nullopt;
  return CrossedPass{*pass, at,
                     "this rapid move leads through the diameter {0} that was just turned, at "
                     "Z{1}: first Z, then X"};
}

bool isTurning(const RuleContext &ctx) {
  const MachineState &after = ctx.after();
  return turnsWork(ctx.dialect(), after) ||
         (after.activeAction(ctx.dialect(), StandardGroup::Plane) == Action::PlaneZX &&
          after.activeAction(ctx.dialect(), StandardGroup::FeedMode) != Action::FeedPerMinute);
}

bool retractsNext(const RuleContext &ctx) {
  constexpr uint16_t x = 1u << unsigned(Axis::X);
  BlocksAhead ahead(ctx);
  Block next;
  if (!ahead.next(next) || !(axesOf(ctx.dialect(), next) & x) ||
      (hasMotionCode(ctx.dialect(), next) && !findCode(ctx.dialect(), next, {Action::Rapid})))
    return false;
  if (const Word *u = next.find(letterAddress('U')))
    return u->isNumber() && u->value() > 0;
  const Word *const word = next.find(letterAddress('X'));
  const Interval &at = ctx.after().at(Axis::X);
  return word && word->isNumber() && at.isConstant() && word->value() > at.value();
}

bool mirrorsOthers(const RuleContext &ctx, double x, double z) {
  constexpr unsigned habit = 2; // tools
  unsigned others = 0;
  const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
  for (const Block &block : blocks(ctx.index().reader(), program.body, program.end)) {
    const Word *const otherX = block.find(letterAddress('X'));
    const Word *const otherZ = block.find(letterAddress('Z'));
    if (block.begin == ctx.block().begin || !otherX || !otherZ || !otherX->isNumber() ||
        !otherZ->isNumber() || otherX->value() != x)
      continue;
    if (otherZ->value() == z)
      return false;
    others += otherZ->value() == -z;
  }
  return others >= habit;
}

} // namespace ncvet
