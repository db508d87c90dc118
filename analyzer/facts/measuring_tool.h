// Tools that measure: touch probes, by what the program does with them.
#pragma once

#include "analyzer/facts/lookahead.h"
#include "analyzer/program/wanted_blocks.h"
#include "analyzer/rule/text_answers.h"

namespace ncvet {

/// Whether tools measure, by where they are changed in.
using MeasuringTools = TextAnswers<std::pair<FileId, uint32_t>, bool>;

/// Whether a skip move (G31, MEAS) follows in the text of the program, from the block at `from` to
/// the next change of the tool.
inline bool measuresBeforeNextTool(const RuleContext &ctx, const ProgramInfo &program,
                                   uint32_t from) {
  const Dialect &dialect = ctx.dialect();
  const AddressMask tool = dialect.toolChangeByT ? maskOf(letterAddress('T')) : 0;
  const auto wants = [&](const TextPiece &piece) {
    return piece.hasAny(tool) || piece.mayName(dialect, {Action::SkipMove, Action::ToolChange});
  };
  for (const Block &block : blocksWhere(ctx.index(), program, wants, from)) {
    if (findCode(dialect, block, {Action::SkipMove}))
      return true;
    const bool changes = findCode(dialect, block, {Action::ToolChange}) ||
                         (dialect.toolChangeByT && block.has(letterAddress('T')));
    if (changes && block.begin > from)
      return false;
  }
  return false;
}

/// Whether the line of a tool calls it by a name that probes have: `T="3D_TASTER"`.
inline bool namesProbe(llvm::StringRef line) {
  const llvm::StringRef name = line.split('"').second.split('"').first;
  for (const char *const probe : {"TASTER", "FUEHLER", "PROBE", "RENISHAW"})
    if (name.contains_insensitive(probe))
      return true;
  return false;
}

/// Whether the tool in use measures: between the block that changed it in, or the begin of the
/// program, and the next change a block of the text makes a skip move, or it has the name of a
/// probe.
inline bool toolMeasures(const RuleContext &ctx, const MeasuringTools &known) {
  const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
  const Origin &tool = ctx.after().origin.of(StatePart::Tool);
  const bool here = tool.known() && tool.file == ctx.source().id() && tool.begin >= program.begin &&
                    tool.begin < program.end;
  const uint32_t from = here ? ctx.source().lines().lineBegin(tool.begin) : program.begin;
  if (here && namesProbe(ctx.source().text(from, ctx.source().lines().lineEnd(tool.begin))))
    return true;
  ctx.index().reader(); // the text is looked through, now or before
  return known.of({ctx.source().id(), std::max(from, program.begin)}, [&] {
    return measuresBeforeNextTool(ctx, program, std::max(from, program.begin));
  });
}

} // namespace ncvet
