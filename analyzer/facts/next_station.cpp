// Reads the blocks after a move.
#include "analyzer/facts/next_station.h"

#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"

namespace ncvet {

Station nextStation(const RuleContext &ctx) {
  constexpr unsigned furthest = 8; // blocks
  const Dialect &dialect = ctx.dialect();
  BlocksAhead ahead(ctx);
  Block next;
  for (unsigned i = 0; i < furthest && ahead.next(next); ++i) {
    if (!next.items.empty() || llvm::any_of(next.words, [&](const Word &word) {
          const CodeIndex code = codeOf(dialect, word);
          return word.address == letterAddress('M') &&
                 (code == noCode || dialect.codes[code].action == Action::MachineSpecific);
        }))
      return Station::None;
    if (findCode(dialect, next,
                 {Action::ReferenceReturn, Action::MachineMove, Action::ToolChange,
                  Action::ProgramEnd, Action::ProgramEndRewind}) ||
        (dialect.toolChangeByT && next.has(letterAddress('T'))))
      return Station::Home;
    if (namesAxes(dialect, next))
      return Station::Move;
  }
  return Station::None;
}

bool comesUpNext(const RuleContext &ctx) {
  constexpr uint16_t alongZ = 1u << unsigned(Axis::Z);
  BlocksAhead ahead(ctx);
  Block next;
  if (!ahead.next(next) || !next.items.empty() || next.has(letterAddress('M')) ||
      axesOf(ctx.dialect(), next) != alongZ ||
      (next.has(letterAddress('G')) && !findCode(ctx.dialect(), next, {Action::Rapid})) ||
      findCode(ctx.dialect(), next,
               {Action::MachineMove, Action::ReferenceReturn, Action::Incremental,
                Action::LengthPositive, Action::LengthOff}))
    return false;
  const Word *const up = next.find(letterAddress('Z'));
  const Interval to = up ? wordValue(*up, next, ctx.after()) : Interval();
  return up && to.isConstant() && to.value() > 0;
}

} // namespace ncvet
