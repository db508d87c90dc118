// Places that are spelled alike because they belong together.
#include "lsp/features/writing/linked_editing.h"

#include "analyzer/program/flow_shape.h"
#include "lsp/features/names.h"
#include "lsp/features/writing/rename.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet::lsp {

namespace {

/// Of a name with more places nobody watches what is typed.
constexpr size_t mostPlaces = 1000;

bool isLoop(const Item &item) {
  return item.kind == ItemKind::While || item.kind == ItemKind::Do || item.kind == ItemKind::End;
}

/// The number that ends an item: of `DO1` and of `END1`.
SourceRange numberOf(const Snapshot &snapshot, const Item &item) {
  uint32_t begin = item.end;
  while (begin > item.begin && llvm::isDigit(snapshot.text()[begin - 1]))
    --begin;
  return {snapshot.source().id(), begin, item.end};
}

/// The number of a loop in the block that begins there; none: the block is no end of a loop.
std::optional<SourceRange> loopNumber(Snapshot &snapshot, uint32_t at) {
  Block block;
  snapshot.unit().reader->read(at, block);
  for (const Item &item : block.items)
    if (isLoop(item))
      if (const SourceRange number = numberOf(snapshot, item); !number.empty())
        return number;
  return std::nullopt;
}

std::vector<SourceRange> loopPlaces(Snapshot &snapshot, uint32_t offset) {
  Block block;
  snapshot.readAt(offset, block);
  const auto here = loopNumber(snapshot, block.begin);
  if (!here || offset < here->begin || offset > here->end)
    return {};
  const ProgramInfo &program = snapshot.unit().index.programAt(block.begin);
  const FlowShape shape = readShape(*snapshot.unit().reader, program.begin, program.end);
  for (const auto &[end, head] : shape.back)
    if (end == block.begin || head == block.begin) {
      const auto first = loopNumber(snapshot, head), last = loopNumber(snapshot, end);
      if (first && last)
        return {*first, *last};
    }
  return {};
}

} // namespace

std::vector<SourceRange> linkedPlaces(Snapshot &snapshot, uint32_t offset) {
  const Names &names = snapshot.names();
  const Occurrence *const one = names.at(offset);
  if (!one || (one->kind != NameKind::Bracket && one->kind != NameKind::Subprogram))
    return loopPlaces(snapshot, offset);
  const llvm::ArrayRef<uint32_t> same = names.same(*one);
  if (same.size() < 2 || same.size() > mostPlaces ||
      !prepareRename(snapshot, offset).refused.empty())
    return {};
  std::vector<SourceRange> places;
  for (const uint32_t i : same) {
    const Occurrence &place = names.all()[i];
    if (names.text(place) != names.text(*one)) // typed into both they would become two names
      return {};
    if (places.empty() || places.back().begin != place.begin)
      places.push_back(names.range(place));
  }
  return places;
}

} // namespace ncvet::lsp
