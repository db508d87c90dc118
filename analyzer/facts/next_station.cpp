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

bool doesNothingHere(const RuleContext &ctx) {
  constexpr unsigned furthest = 8; // blocks
  const Dialect &dialect = ctx.dialect();
  BlocksAhead ahead(ctx);
  Block next;
  for (unsigned i = 0; i < furthest && ahead.next(next); ++i) {
    if (!next.items.empty() || next.has(letterAddress('T')) ||
        findCode(dialect, next,
                 {Action::Linear, Action::ArcCw, Action::ArcCcw, Action::Cycle, Action::Thread,
                  Action::SkipMove, Action::MachineSpecific, Action::CallProgram, Action::CallLocal,
                  Action::MacroCall, Action::MacroModal}) ||
        llvm::any_of(next.words, [&](const Word &word) {
          return word.address == letterAddress('M') && codeOf(dialect, word) == noCode;
        }))
      return false;
    if (next.has(letterAddress('Z')) || findCode(dialect, next,
                                                 {Action::ReferenceReturn, Action::MachineMove,
                                                  Action::ProgramEnd, Action::ProgramEndRewind}))
      return true;
  }
  return false;
}

bool cutsOnAcross(const RuleContext &ctx) {
  constexpr uint16_t plane = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y);
  BlocksAhead ahead(ctx);
  Block next;
  return ahead.next(next) && findCode(ctx.dialect(), next, {Action::Linear}) &&
         axesOf(ctx.dialect(), next) && !(axesOf(ctx.dialect(), next) & ~plane);
}

bool cutsAcross(const RuleContext &ctx) {
  constexpr unsigned furthest = 8; // blocks
  BlocksAhead ahead(ctx);
  Block next;
  for (unsigned i = 0; i < furthest && ahead.next(next); ++i)
    if (namesAxes(ctx.dialect(), next))
      return !(axesOf(ctx.dialect(), next) & (1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y)));
  return false;
}

bool hasCutAcross(const RuleContext &ctx) {
  constexpr uint16_t plane = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y);
  Block before;
  return ctx.before().activeAction(ctx.dialect(), StandardGroup::Motion) == Action::Linear &&
         readPrevious(ctx, before) && before.items.empty() && axesOf(ctx.dialect(), before) &&
         !(axesOf(ctx.dialect(), before) & ~plane);
}

bool risesNext(const RuleContext &ctx) {
  constexpr unsigned furthest = 6; // blocks
  const Dialect &dialect = ctx.dialect();
  const Interval &here = ctx.after().at(Axis::Z);
  BlocksAhead ahead(ctx);
  Block next;
  for (unsigned i = 0; i < furthest && ahead.next(next); ++i) {
    const bool moves = next.items.empty() && llvm::all_of(next.words, [&](const Word &word) {
                         const CodeIndex code = codeOf(dialect, word);
                         return code == noCode ? word.address != letterAddress('M') &&
                                                     word.address != letterAddress('T')
                                               : dialect.codes[code].action == Action::Rapid ||
                                                     dialect.codes[code].action == Action::Absolute;
                       });
    if (!moves)
      return false;
    if (const Word *const z = next.find(letterAddress('Z'))) {
      const Interval to = wordValue(*z, next, ctx.after());
      const auto unit = millimetresPer(dialect, ctx.after());
      return to.isConstant() && here.isConstant() && unit && to.value() * *unit > here.value();
    }
  }
  return false;
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

bool isFedUpNext(const RuleContext &ctx) {
  constexpr uint16_t plane = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y);
  constexpr uint16_t alongZ = 1u << unsigned(Axis::Z);
  const Dialect &dialect = ctx.dialect();
  const Interval &here = ctx.after().at(Axis::Z);
  BlocksAhead ahead(ctx);
  Block next;
  if (!ahead.next(next) || !next.items.empty() || axesOf(dialect, next) != alongZ ||
      !findCode(dialect, next, {Action::Linear}) ||
      findCode(dialect, next, {Action::MachineMove, Action::Incremental}))
    return false;
  const Word *const up = next.find(letterAddress('Z'));
  const Interval to = up ? wordValue(*up, next, ctx.after()) : Interval();
  const auto unit = millimetresPer(dialect, ctx.after());
  if (!up || !unit || !to.isConstant() || !here.isConstant() ||
      to.value() * *unit <= here.value() || !ahead.next(next) || !next.items.empty())
    return false;
  const uint16_t axes = axesOf(dialect, next);
  return axes && !(axes & ~plane) && !findCode(dialect, next, {Action::Rapid, Action::Cycle});
}

} // namespace ncvet
