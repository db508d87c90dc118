// Programs that say nothing of tools and spindles.
#pragma once

#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"

namespace ncvet {

/// Whether the program of the current block names neither tool nor speed, and neither turns nor
/// stops a spindle: it may be for a machine without one, as a printer, a laser or a grinder whose
/// wheels the builder's programs start. Reads the whole program.
inline bool saysNothingOfTools(const RuleContext &ctx) {
  const Dialect &dialect = ctx.dialect();
  const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
  constexpr AddressMask words = maskOf(letterAddress('T')) | maskOf(letterAddress('S'));
  for (const Block &block : blocks(ctx.index().reader(), program.body, program.end))
    if (block.hasAny(words | dialect.orientWords) ||
        findCode(dialect, block,
                 {Action::ToolChange, Action::SpindleCw, Action::SpindleCcw, Action::SpindleStop,
                  Action::SpindleOrient, Action::LiveToolCw, Action::LiveToolCcw}))
      return false;
  return true;
}

/// Whether no block of the current program ends the job: it may be called by a program that is not
/// here. Reads the whole program.
inline bool onlyReturns(const RuleContext &ctx) {
  const Dialect &dialect = ctx.dialect();
  const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
  bool returns = false;
  if (program.kind == ProgramKind::Main)
    return false;
  for (const Block &block : blocks(ctx.index().reader(), program.body, program.end)) {
    if (findCode(dialect, block, {Action::ProgramEnd, Action::ProgramEndRewind}))
      return false;
    returns = returns || findCode(dialect, block, {Action::Return});
  }
  return returns;
}

/// Whether the current program starts no spindle: what turns it is the builder's.
inline bool startsNoSpindle(const RuleContext &ctx) {
  const Dialect &dialect = ctx.dialect();
  const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
  for (const Block &block : blocks(ctx.index().reader(), program.body, program.end))
    if (findCode(dialect, block,
                 {Action::SpindleCw, Action::SpindleCcw, Action::LiveToolCw, Action::LiveToolCcw}))
      return false;
  return true;
}

} // namespace ncvet
