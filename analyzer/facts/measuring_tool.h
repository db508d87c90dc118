// Tools that measure: touch probes, by what the program does with them.
#pragma once

#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"

#include <map>

namespace ncvet {

/// Which tools of a text measure, by where they are changed in: each is looked for once.
class MeasuringTools {
public:
  /// Whether the tool in use measures: between the block that changed it in, or the begin of the
  /// program, and the next change a block of the text makes a skip move (G31, MEAS).
  static bool measures(const RuleContext &ctx, Aside<std::map<TextPlace, bool>> &known) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    const Origin &tool = ctx.after().origin.of(StatePart::Tool);
    const bool here = tool.known() && tool.file == ctx.source().id() &&
                      tool.begin >= program.begin && tool.begin < program.end;
    const uint32_t begin = here ? ctx.source().lines().lineBegin(tool.begin) : program.begin;
    const TextPlace from{ctx.source().id(), std::max(begin, program.begin)};
    const auto [entry, fresh] = known.look().try_emplace(from, false);
    if (fresh)
      entry->second = readsOn(ctx, from.offset, program.end);
    return entry->second;
  }

private:
  static bool readsOn(const RuleContext &ctx, uint32_t from, uint32_t end) {
    const Dialect &dialect = ctx.dialect();
    bool first = true;
    for (const Block &block : blocks(ctx.index(), from, end)) {
      if (findCode(dialect, block, {Action::SkipMove}))
        return true;
      const bool changes = findCode(dialect, block, {Action::ToolChange}) ||
                           (dialect.toolChangeByT && block.has(letterAddress('T')));
      if (changes && !first)
        return false;
      first = false;
    }
    return false;
  }
};

} // namespace ncvet
