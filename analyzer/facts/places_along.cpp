// One pass over the blocks of a program.
#include "analyzer/facts/places_along.h"

#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"

namespace ncvet {

namespace {

constexpr size_t mostPlaces = 200; // of a surface: nothing is a habit

void noteWay(const Block &block, double z, const Dialect &dialect, PlacesAlong &places) {
  if (z >= 0 || places.below.size() > mostPlaces)
    return;
  const bool alone = axesOf(dialect, block) == 1u << unsigned(Axis::Z);
  if (findCode(dialect, block, {Action::Rapid}))
    ++places.below[z].rapid;
  else if (alone && findCode(dialect, block, {Action::Linear}))
    ++places.below[z].fed;
}

/// Whether the block has a code by which the tool may be fed, or one that is not known.
bool mayFeed(const Block &block, const Dialect &dialect) {
  return llvm::any_of(block.words, [&](const Word &word) {
    if (word.address != letterAddress('G'))
      return false;
    const CodeIndex code = codeOf(dialect, word);
    if (code == noCode)
      return true;
    const Action action = dialect.codes[code].action;
    return (isMotion(action) && action != Action::Rapid) || action == Action::Cycle ||
           action == Action::MachineSpecific;
  });
}

PlacesAlong placesOf(const ProgramInfo &program, const RuleContext &ctx) {
  const Dialect &dialect = ctx.dialect();
  PlacesAlong places;
  auto &[first, second] = places.lowest;
  bool told = true, feeds = false;
  unsigned withFeed = 0;
  for (const Block &block : blocks(ctx.index().reader(), program.body, program.end)) {
    const Word *const z = block.find(letterAddress('Z'));
    places.fedRapids +=
        block.has(letterAddress('F')) && findCode(dialect, block, {Action::Rapid}) != nullptr;
    feeds |= mayFeed(block, dialect);
    withFeed += block.has(letterAddress('F')) && axesOf(dialect, block);
    told &=
        block.items.empty() && (!z || z->isNumber()) &&
        !findCode(dialect, block,
                  {Action::CallProgram, Action::CallLocal, Action::MacroCall, Action::MacroModal});
    if (!z || !z->isNumber() ||
        findCode(dialect, block,
                 {Action::MachineMove, Action::ReferenceReturn, Action::WorkOffset}))
      continue;
    noteWay(block, z->value(), dialect, places);
    if (z->value() < first)
      second = std::exchange(first, z->value());
    else
      second = std::min(second, z->value());
  }
  if (!told)
    places.lowest = {};
  else if (!feeds)
    places.neverFed = withFeed;
  return places;
}

} // namespace

const PlacesAlong &PlacesOfPrograms::of(const RuleContext &ctx) const {
  const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
  ctx.index().reader(); // the program is looked through, now or before
  return known_.of({ctx.source().id(), program.begin}, [&] { return placesOf(program, ctx); });
}

} // namespace ncvet
