// Programs that say nothing of tools and spindles.
#pragma once

#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/project.h"

namespace ncvet {

/// Whether no block of the current program, nor of those that have called it, is as `is` says.
/// Reads them whole.
inline bool noRunningProgramHas(const RuleContext &ctx,
                                llvm::function_ref<bool(const Block &)> is) {
  const FileUnit *unit = &ctx.unit();
  const ProgramInfo *program = &ctx.index().programAt(ctx.block().begin);
  for (const CallSite *caller = ctx.caller();; caller = caller->before) {
    for (const Block &block : blocks(unit->index.reader(), program->body, program->end))
      if (is(block))
        return false;
    if (!caller || !caller->unit)
      return true;
    unit = caller->unit;
    program = caller->program;
  }
}

/// Whether the program of the current block, and those that have called it, name neither tool nor
/// speed, and neither turn nor stop a spindle: it may be for a machine without one, as a printer, a
/// laser or a grinder whose wheels the builder's programs start.
inline bool saysNothingOfTools(const RuleContext &ctx) {
  const Dialect &dialect = ctx.dialect();
  constexpr AddressMask words = maskOf(letterAddress('T')) | maskOf(letterAddress('S'));
  return noRunningProgramHas(ctx, [&](const Block &block) {
    return block.hasAny(words | dialect.orientWords) ||
           findCode(dialect, block,
                    {Action::ToolChange, Action::SpindleCw, Action::SpindleCcw, Action::SpindleStop,
                     Action::SpindleOrient, Action::LiveToolCw, Action::LiveToolCcw});
  });
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

/// Whether the current program, and those that have called it, start no spindle: what turns it is
/// the builder's.
inline bool startsNoSpindle(const RuleContext &ctx) {
  return noRunningProgramHas(ctx, [&](const Block &block) {
    return findCode(
        ctx.dialect(), block,
        {Action::SpindleCw, Action::SpindleCcw, Action::LiveToolCw, Action::LiveToolCcw});
  });
}

/// Whether the current program, and those that have called it, neither name a speed nor start a
/// spindle: what stops it, or changes its tool, asks for none.
inline bool namesNoSpindle(const RuleContext &ctx) {
  const AddressMask words = maskOf(letterAddress('S')) | ctx.dialect().orientWords;
  return startsNoSpindle(ctx) &&
         noRunningProgramHas(ctx, [&](const Block &block) { return block.hasAny(words); });
}

/// Whether the current program, or one that has called it, has M codes that only the machine's
/// builder knows.
inline bool hasBuilderCodes(const RuleContext &ctx) {
  const Dialect &dialect = ctx.dialect();
  return !noRunningProgramHas(ctx, [&](const Block &block) {
    return llvm::any_of(block.words, [&](const Word &word) {
      return word.address == letterAddress('M') && codeOf(dialect, word) == noCode;
    });
  });
}

/// Whether the current program, and those that have called it, give no feed.
inline bool namesNoFeed(const RuleContext &ctx) {
  const AddressMask words = maskOf(letterAddress('F')) | ctx.dialect().feedWords;
  return noRunningProgramHas(ctx, [&](const Block &block) { return block.hasAny(words); });
}

/// Whether all that turns a spindle in the current programs is the builder's.
inline bool builderTurnsAll(const RuleContext &ctx) {
  return startsNoSpindle(ctx) && hasBuilderCodes(ctx);
}

/// Whether the current program, or one that has called it, changes tools more than once: it is for
/// a machine that cuts.
inline bool changesTools(const RuleContext &ctx) {
  unsigned changes = 0;
  return !noRunningProgramHas(ctx, [&](const Block &block) {
    changes += findCode(ctx.dialect(), block, {Action::ToolChange}) != nullptr;
    return changes > 1;
  });
}

/// Whether the spindle of such a program may be turned by a code of the builder: it holds one that
/// the table lacks, or names no speed that a spindle would be missing for, and no tools to change.
inline bool builderMayTurnSpindle(const RuleContext &ctx) {
  if (!startsNoSpindle(ctx))
    return false;
  const auto namesSpeed = [](const Block &block) { return block.has(letterAddress('S')); };
  return (noRunningProgramHas(ctx, namesSpeed) && !changesTools(ctx)) || hasBuilderCodes(ctx);
}

} // namespace ncvet
