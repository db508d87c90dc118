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

} // namespace ncvet
