// The blocks of the programs that a block calls.
#include "analyzer/facts/called_blocks.h"

#include "analyzer/program/block_reading.h"
#include "analyzer/program/references.h"

#include <set>

namespace ncvet {

namespace {

/// A program of a shop is shorter by far.
constexpr uint32_t longestProgram = 1u << 20; // bytes

/// Walks through called programs, each of them once.
class CalledBlocks {
public:
  explicit CalledBlocks(llvm::function_ref<bool(const Block &)> visit) : visit_(visit) {}

  bool follow(FileUnit &unit, const Block &block) {
    llvm::SmallVector<Reference, 2> calls;
    unit.references().all(block, unit.source.text(), [&](const Reference &reference) {
      if (reference.kind == ReferenceKind::Call)
        calls.push_back(reference);
    });
    if (calls.empty())
      return false;
    return llvm::all_of(calls, [&](const Reference &call) { return run(unit, call); });
  }

private:
  bool run(FileUnit &from, const Reference &call) {
    const bool named = call.to == ReferredKind::Program || call.to == ReferredKind::NamedProgram;
    const auto place =
        named && from.project ? resolveProgram(*from.project, from, call) : std::nullopt;
    if (!place || place->program->end - place->begin > longestProgram)
      return false;
    if (!seen_.insert({place->unit, place->begin}).second)
      return true;
    for (const Block &block : blocks(place->unit->index, place->begin, place->program->end))
      if (!visit_(block) || (entersProgram(block) && !follow(*place->unit, Block(block))))
        return false;
    return true;
  }

  llvm::function_ref<bool(const Block &)> visit_;
  std::set<std::pair<const FileUnit *, uint32_t>> seen_;
};

} // namespace

bool entersProgram(const Block &block) {
  return llvm::any_of(block.items, [](const Item &item) {
    return item.kind == ItemKind::Call ||
           (item.kind == ItemKind::Jump && item.nameEnd > item.nameBegin);
  });
}

bool eachCalledBlock(FileUnit &unit, const Block &block,
                     llvm::function_ref<bool(const Block &)> visit) {
  unit.index.reader(); // another file is looked at: nothing of this one may be taken over for it
  return CalledBlocks(visit).follow(unit, block);
}

} // namespace ncvet
