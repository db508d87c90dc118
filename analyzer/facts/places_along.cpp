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

PlacesAlong placesOf(const ProgramInfo &program, const RuleContext &ctx) {
  const Dialect &dialect = ctx.dialect();
  PlacesAlong places;
  auto &[first, second] = places.lowest;
  bool told = true;
  for (const Block &block : blocks(ctx.index().reader(), program.body, program.end)) {
    const Word *const z = block.find(letterAddress('Z'));
    places.fedRapids +=
        block.has(letterAddress('F')) && findCode(dialect, block, {Action::Rapid}) != nullptr;
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
  return places;
}

} // namespace

const PlacesAlong &PlacesOfPrograms::of(const RuleContext &ctx) const {
  const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
  ctx.index().reader(); // the program is looked through, now or before
  return known_.of({ctx.source().id(), program.begin}, [&] { return placesOf(program, ctx); });
}

} // namespace ncvet
