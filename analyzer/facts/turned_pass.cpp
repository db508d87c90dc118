// Reads back from a rapid move: the retract, the cut and the approach.
#include "analyzer/facts/turned_pass.h"

#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/lookahead.h"

namespace ncvet {

namespace {

constexpr uint16_t alongX = 1u << unsigned(Axis::X), alongZ = 1u << unsigned(Axis::Z);

/// Words of motion and of the feed alone: nothing that makes the numbers mean something else.
bool isPlain(const Dialect &dialect, const Block &block) {
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
  if (!readPrevious(ctx, retract) || !isPlain(dialect, retract) ||
      axesOf(dialect, retract) != alongX || !findCode(dialect, retract, {Action::Rapid}))
    return std::nullopt;
  Block cut = retract;
  if (!readBack(ctx, cut) || !isPlain(dialect, cut) || axesOf(dialect, cut) != alongZ ||
      findCode(dialect, cut, {Action::Rapid}))
    return std::nullopt;
  Block before = cut;
  bool feeds = findCode(dialect, cut, {Action::Linear});
  std::optional<double> x, z;
  constexpr unsigned furthest = 4; // blocks
  for (unsigned i = 0; i < furthest && !(x && z) && readBack(ctx, before); ++i) {
    if (!isPlain(dialect, before))
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
  if (!x || !z || !(end < *z) || !(away > *x) || !(*x > 0))
    return std::nullopt;
  return TurnedPass{*x, *z, end, away, wordsRange(ctx, cut)};
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
  // Where the straight way comes to the diameter; with each axis at its own speed X is not later.
  const double part = (pass->away - pass->diameter) / (pass->away - x->value());
  const double at = pass->end + part * (z->value() - pass->end);
  constexpr double face = 0;
  if (part <= 0 || part >= 1 || at >= std::min(pass->begin, face))
    return std::nullopt;
  return CrossedPass{*pass, at};
}

bool isTurning(const RuleContext &ctx) {
  const MachineState &after = ctx.after();
  return turnsWork(ctx.dialect(), after) ||
         (after.activeAction(ctx.dialect(), StandardGroup::Plane) == Action::PlaneZX &&
          after.activeAction(ctx.dialect(), StandardGroup::FeedMode) != Action::FeedPerMinute);
}

} // namespace ncvet
