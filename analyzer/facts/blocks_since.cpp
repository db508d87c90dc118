// The blocks between a cause and the current block, as far as the text tells the way.
#include "analyzer/facts/blocks_since.h"

#include "analyzer/program/block_reading.h"
#include "analyzer/program/project.h"
#include "analyzer/program/references.h"

namespace ncvet {

namespace {

/// Part of a program that was executed on the way.
struct Stretch {
  FileUnit *unit = nullptr;
  uint32_t begin = 0, end = 0;
  bool isCall = false; ///< its last block is the call of the next one
};

/// Whether `block`, one of the current program, calls the program that holds the origin: where it
/// is.
std::optional<ReferredPlace> calledWith(const Origin &origin, const Block &block,
                                        const RuleContext &ctx) {
  std::optional<ReferredPlace> found;
  FileUnit &unit = ctx.unit();
  unit.references().all(block, unit.source.text(), [&](const Reference &reference) {
    if (found || reference.kind != ReferenceKind::Call || !unit.project ||
        (reference.to != ReferredKind::Program && reference.to != ReferredKind::NamedProgram))
      return;
    const auto place = resolveProgram(*unit.project, unit, reference);
    if (place && place->unit->source.id() == origin.file && origin.begin >= place->begin &&
        origin.begin < place->program->end)
      found = place;
  });
  return found;
}

/// From a place in a program that the current one has called last.
llvm::SmallVector<Stretch, 4> wayFromReturned(const Origin &origin, const RuleContext &ctx) {
  constexpr unsigned furthest = 64; // blocks back to the call
  const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
  uint32_t at = ctx.block().begin;
  Block block;
  for (unsigned i = 0; i < furthest && at > program.body; ++i) {
    at = std::max(program.body, ctx.source().lines().lineBegin(at - 1));
    ctx.index().read(at, block);
    const auto place = calledWith(origin, block, ctx);
    if (!place)
      continue;
    return {{&ctx.unit(), block.next, ctx.block().begin, false},
            {place->unit, place->unit->source.lines().lineBegin(origin.begin), place->program->end,
             false}};
  }
  return {};
}

/// The innermost program first; empty: the origin is in none of them.
llvm::SmallVector<Stretch, 4> wayFrom(const Origin &origin, const RuleContext &ctx) {
  llvm::SmallVector<Stretch, 4> way;
  FileUnit *unit = &ctx.unit();
  const ProgramInfo *program = &ctx.index().programAt(ctx.block().begin);
  uint32_t end = ctx.block().begin;
  const CallSite *caller = ctx.caller();
  for (;;) {
    const bool isHere =
        origin.file == unit->source.id() && origin.begin >= program->begin && origin.begin < end;
    way.push_back({unit, isHere ? unit->source.lines().lineBegin(origin.begin) : program->body, end,
                   unit != &ctx.unit() || end != ctx.block().begin});
    if (isHere)
      return way;
    if (!caller || !caller->unit)
      return wayFromReturned(origin, ctx);
    unit = caller->unit;
    program = caller->program;
    end = caller->next;
    caller = caller->before;
  }
}

} // namespace

bool blocksSince(const Origin &origin, const RuleContext &ctx,
                 llvm::function_ref<bool(const FileUnit &, const Block &)> look) {
  const llvm::SmallVector<Stretch, 4> way = wayFrom(origin, ctx);
  bool isFirst = true;
  for (const Stretch &part : llvm::reverse(way))
    for (const Block &block : blocks(part.unit->index, part.begin, part.end)) {
      if (std::exchange(isFirst, false) || (part.isCall && block.next >= part.end))
        continue;
      if (!look(*part.unit, block))
        return false;
    }
  return !way.empty();
}

} // namespace ncvet
