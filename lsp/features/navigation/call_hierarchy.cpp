// Which program calls which, by the text: every call that is written, whether it is reached or not.
#include "lsp/features/navigation/call_hierarchy.h"

#include "analyzer/program/block_reading.h"
#include "formats/readers/table_words.h"
#include "lsp/features/navigation/definition.h"

#include "llvm/ADT/SmallPtrSet.h"
#include "llvm/Support/Path.h"

#include <algorithm>
#include <map>

namespace ncvet::lsp {

namespace {

/// Most callers or callees of one item, and most names that are looked for on its behalf.
constexpr size_t mostEdges = 1000;

bool isCall(const Occurrence &one) {
  return one.use == NameUse::Call || (one.use == NameUse::Jump && one.kind == NameKind::Program);
}

/// What can be called.
struct Callable {
  FileUnit *unit = nullptr;
  uint32_t begin = 0, end = 0;    ///< its blocks
  std::optional<Occurrence> name; ///< none for a program without a header
  bool isProgram = false;

  bool operator==(const Callable &other) const {
    return unit == other.unit && begin == other.begin;
  }
};

class Hierarchy {
public:
  explicit Hierarchy(Snapshot &snapshot) : snapshot_(snapshot) {}

  Callable at(FileUnit &unit, uint32_t offset);
  std::optional<Callable> target(FileUnit &from, const Occurrence &one);
  CallItem item(const Callable &callable);
  std::vector<CallEdge> outgoing(const Callable &caller);
  std::vector<CallEdge> incoming(const Callable &callee, llvm::ArrayRef<std::string> paths);

private:
  Callable program(FileUnit &unit, const ProgramInfo &program);
  Callable scope(FileUnit &unit, uint32_t scope);
  Callable local(FileUnit &unit, const Occurrence &definition);
  Callable around(FileUnit &unit, uint32_t offset);
  uint32_t endOfLocal(FileUnit &unit, uint32_t begin);
  const std::vector<uint32_t> &returns(FileUnit &unit);
  void callers(FileUnit &unit, const Callable &callee, std::vector<CallEdge> &edges);

  Snapshot &snapshot_;
  std::map<const FileUnit *, std::vector<uint32_t>> returns_;
};

Callable Hierarchy::program(FileUnit &unit, const ProgramInfo &program) {
  Callable callable{&unit, program.begin, program.end, std::nullopt, true};
  for (const Occurrence &one : snapshot_.names(unit).within(program.headerBegin, program.headerEnd))
    if (one.kind == NameKind::Program && one.use == NameUse::Definition)
      callable.name = one;
  return callable;
}

/// A program, or a subprogram between brackets, by its scope.
Callable Hierarchy::scope(FileUnit &unit, uint32_t index) {
  const Names &names = snapshot_.names(unit);
  if (index < unit.index.programs().size())
    return program(unit, unit.index.programs()[index]);
  const Scope &scope = names.scopes()[index];
  Callable callable{&unit, scope.begin, scope.end, std::nullopt, false};
  for (const Occurrence &one : names.within(scope.begin, scope.end))
    if (one.kind == NameKind::Subprogram && one.use == NameUse::Definition) {
      callable.name = one;
      break;
    }
  return callable;
}

/// Ends of the blocks of a file that return, ascending.
const std::vector<uint32_t> &Hierarchy::returns(FileUnit &unit) {
  const auto [known, fresh] = returns_.try_emplace(&unit);
  if (!fresh)
    return known->second;
  for (const Block &block : blocks(*unit.reader)) {
    for (const Word &word : block.words)
      if (const CodeIndex code = codeOf(*unit.dialect, word);
          code != noCode && unit.dialect->codes[code].action == Action::Return)
        known->second.push_back(block.next);
  }
  return known->second;
}

/// After the first block that returns, looked for from `begin` on.
uint32_t Hierarchy::endOfLocal(FileUnit &unit, uint32_t begin) {
  const std::vector<uint32_t> &ends = returns(unit);
  const auto end = llvm::partition_point(ends, [&](uint32_t e) { return e <= begin; });
  const uint32_t programEnd = unit.index.programAt(begin).end;
  return end == ends.end() ? programEnd : std::min(programEnd, *end);
}

Callable Hierarchy::local(FileUnit &unit, const Occurrence &definition) {
  Block block;
  readBlockAt(unit.source, *unit.reader, definition.begin, block);
  return {&unit, block.begin, endOfLocal(unit, definition.begin), definition, false};
}

/// The program that holds a place, or the subprogram between brackets.
Callable Hierarchy::around(FileUnit &unit, uint32_t offset) {
  const Names &names = snapshot_.names(unit);
  const auto programs = unit.index.programs().size();
  const llvm::ArrayRef<Scope> subprograms = names.scopes().drop_front(programs);
  const auto next =
      llvm::partition_point(subprograms, [&](const Scope &s) { return s.begin <= offset; });
  if (next != subprograms.begin() && offset < (next - 1)->end)
    return scope(unit, uint32_t(programs + size_t(next - 1 - subprograms.begin())));
  return program(unit, unit.index.programAt(offset));
}

/// What a name that is called, or defined, means.
std::optional<Callable> Hierarchy::target(FileUnit &from, const Occurrence &one) {
  const auto found = targetOf(snapshot_, from, one);
  if (!found)
    return std::nullopt;
  if (one.kind == NameKind::Program)
    return program(*found->unit, *found->program);
  const Occurrence *const name = snapshot_.names(*found->unit).at(found->name.begin);
  if (one.kind == NameKind::Subprogram && name && name->kind == NameKind::Subprogram)
    return around(*found->unit, name->begin);
  if (one.kind == NameKind::Block && name)
    return local(*found->unit, *name);
  return program(*found->unit, *found->program);
}

Callable Hierarchy::at(FileUnit &unit, uint32_t offset) {
  const Names &names = snapshot_.names(unit);
  const Occurrence *const one = names.at(offset);
  if (!one || one->scope == otherFile)
    return around(unit, offset);
  const bool called = llvm::any_of(names.same(*one),
                                   [&](uint32_t i) { return names.all()[i].use == NameUse::Call; });
  if (isShared(*one) || (one->kind == NameKind::Block && called))
    if (const auto meant = target(unit, *one))
      return *meant;
  return around(unit, offset);
}

CallItem Hierarchy::item(const Callable &callable) {
  const SourceFile &source = callable.unit->source;
  CallItem item;
  item.kind = callable.isProgram ? PartKind::Program : PartKind::Subprogram;
  const uint32_t begin = callable.begin;
  item.full = {source.id(), begin, std::max(begin, callable.end)};
  item.selection = {source.id(), begin, begin};
  if (callable.name) {
    // With its O or N: the address belongs to what people call it.
    Block block;
    readBlockAt(source, *callable.unit->reader, callable.name->begin, block);
    item.selection = {source.id(), callable.name->begin, callable.name->end};
    item.name = callable.isProgram ? noteText(source, block.headerBegin, block.headerEnd)
                : callable.name->kind == NameKind::Block
                    ? noteText(source, block.numberBegin, block.numberEnd)
                    : noteText(source, callable.name->begin, callable.name->end);
    if (!block.comments.empty())
      item.detail = noteText(source, block.comments[0].begin, block.comments[0].end);
  }
  if (item.name.empty())
    item.name = llvm::sys::path::stem(source.path().empty() ? source.display() : source.path());
  return item;
}

/// Adds a call of `other` to those that are known.
void addEdge(std::vector<CallEdge> &edges, std::vector<Callable> &known, const Callable &other,
             SourceRange place, llvm::function_ref<CallItem(const Callable &)> item) {
  const auto found = llvm::find(known, other);
  const auto index = size_t(found - known.begin());
  if (found == known.end()) {
    known.push_back(other);
    edges.push_back({item(other), {}});
  }
  edges[index].places.push_back(place);
}

std::vector<CallEdge> Hierarchy::outgoing(const Callable &caller) {
  const Names &names = snapshot_.names(*caller.unit);
  std::vector<CallEdge> edges;
  std::vector<Callable> known;
  std::map<std::tuple<NameKind, uint32_t, uint64_t>, std::optional<Callable>> targets;
  for (const Occurrence &one : names.within(caller.begin, caller.end)) {
    if (!isCall(one) || (caller.isProgram && !(around(*caller.unit, one.begin) == caller)))
      continue;
    if (targets.size() >= mostEdges)
      break;
    const auto [entry, fresh] = targets.try_emplace({one.kind, one.scope, one.key});
    if (fresh)
      entry->second = target(*caller.unit, one);
    if (entry->second)
      addEdge(edges, known, *entry->second, names.range(one),
              [&](const Callable &other) { return item(other); });
  }
  return edges;
}

void Hierarchy::callers(FileUnit &unit, const Callable &callee, std::vector<CallEdge> &edges) {
  const Names &names = snapshot_.names(unit);
  std::vector<Callable> known;
  std::vector<CallEdge> found;
  std::map<std::tuple<NameKind, uint32_t, uint64_t>, bool> leads;
  for (const Occurrence &one : names.all()) {
    if (!isCall(one) || found.size() >= mostEdges || leads.size() >= mostEdges)
      continue;
    const auto [entry, fresh] = leads.try_emplace({one.kind, one.scope, one.key}, false);
    if (fresh) {
      const auto meant = target(unit, one);
      entry->second = meant && *meant == callee;
    }
    if (entry->second)
      addEdge(found, known, around(unit, one.begin), names.range(one),
              [&](const Callable &other) { return item(other); });
  }
  std::move(found.begin(), found.end(), std::back_inserter(edges));
}

std::vector<CallEdge> Hierarchy::incoming(const Callable &callee,
                                          llvm::ArrayRef<std::string> paths) {
  std::vector<CallEdge> edges;
  llvm::SmallPtrSet<const FileUnit *, 8> seen;
  const auto look = [&](FileUnit *unit) {
    if (unit && seen.insert(unit).second)
      callers(*unit, callee, edges);
  };
  look(callee.unit);
  look(&snapshot_.unit());
  for (const std::string &path : paths)
    look(snapshot_.unitOf(path));
  return edges;
}

} // namespace

std::optional<CallItem> callItem(Snapshot &snapshot, uint32_t offset) {
  if (snapshot.text().empty())
    return std::nullopt;
  Hierarchy hierarchy(snapshot);
  return hierarchy.item(hierarchy.at(snapshot.unit(), offset));
}

std::vector<CallEdge> outgoingCalls(Snapshot &snapshot, llvm::StringRef path, uint32_t offset) {
  FileUnit *const unit = snapshot.unitOf(path);
  if (!unit)
    return {};
  Hierarchy hierarchy(snapshot);
  return hierarchy.outgoing(hierarchy.at(*unit, offset));
}

std::vector<CallEdge> incomingCalls(Snapshot &snapshot, llvm::StringRef path, uint32_t offset,
                                    llvm::ArrayRef<std::string> paths) {
  FileUnit *const unit = snapshot.unitOf(path);
  if (!unit)
    return {};
  Hierarchy hierarchy(snapshot);
  return hierarchy.incoming(hierarchy.at(*unit, offset), paths);
}

} // namespace ncvet::lsp
