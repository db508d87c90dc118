// Where the name at a place of a document is defined, in this file or in another one.
#include "lsp/features/navigation/definition.h"

#include "analyzer/program/block_reading.h"
#include "analyzer/program/references.h"

namespace ncvet::lsp {

namespace {

/// The header's name of a program, empty at its begin when it has none.
SourceRange headerName(const Names &names, const ProgramInfo &program) {
  for (const Occurrence &one : names.within(program.headerBegin, program.headerEnd))
    if (one.kind == NameKind::Program && one.use == NameUse::Definition)
      return names.range(one);
  return {names.unit().source.id(), program.begin, program.begin};
}

std::optional<NameTarget> programTarget(Snapshot &snapshot, FileUnit &from, const Occurrence &one) {
  const Names &names = snapshot.names(from);
  // Those of the same file come first, and need no search through all of them.
  for (const uint32_t i : names.same(one))
    if (const Occurrence &other = names.all()[i];
        one.kind == NameKind::Program && other.use == NameUse::Definition)
      return NameTarget{&from, &from.index.programs()[names.programAt(other.begin)],
                        names.range(other)};
  const bool numbered = one.kind == NameKind::Program && one.key < firstNamedVariable;
  const auto [unit, program] = numbered ? snapshot.project().findProgram(from, int64_t(one.key))
                                        : snapshot.project().findProgram(from, names.text(one));
  if (!program)
    return std::nullopt;
  return NameTarget{unit, program, headerName(snapshot.names(*unit), *program)};
}

/// A definition in `unit` of what `probe` names.
std::optional<NameTarget> targetIn(Snapshot &snapshot, FileUnit &unit, const Occurrence &probe) {
  const Names &names = snapshot.names(unit);
  const Occurrence *const found = names.definition(probe);
  if (!found)
    return std::nullopt;
  return NameTarget{&unit, &unit.index.programAt(found->begin), names.range(*found)};
}

/// Offset of the block of `program` that `one` names, found as the engine finds it from the block
/// at `from`; `text`: its spelling.
std::optional<uint32_t> offsetIn(const FileIndex &index, const ProgramInfo &program,
                                 const Occurrence &one, llvm::StringRef text, uint32_t from) {
  Reference reference;
  reference.to = one.kind == NameKind::Label ? ReferredKind::Label : ReferredKind::Block;
  reference.search = one.search;
  reference.number = int64_t(one.key);
  reference.text = text;
  return resolveBlock(index, program, reference, from);
}

/// The name of that block.
std::optional<NameTarget> blockIn(Snapshot &snapshot, FileUnit &unit, const ProgramInfo &program,
                                  const Occurrence &one, llvm::StringRef text, uint32_t from) {
  const auto at = offsetIn(unit.index, program, one, text, from);
  if (!at)
    return std::nullopt;
  Block block;
  unit.reader->read(*at, block);
  const Names &names = snapshot.names(unit);
  for (const Occurrence &other : names.within(*at, block.next))
    if (other.kind == one.kind && other.key == one.key && other.use == NameUse::Definition)
      return NameTarget{&unit, &program, names.range(other)};
  return std::nullopt;
}

/// A block of a program of this file.
std::optional<NameTarget> blockHere(Snapshot &snapshot, FileUnit &unit, const Occurrence &one) {
  const Names &names = snapshot.names(unit);
  const auto programs = unit.index.programs();
  if (one.use == NameUse::Definition || one.scope >= programs.size())
    return targetIn(snapshot, unit, one);
  uint32_t from = one.begin;
  // The last block of a section is looked for from its first one on.
  if (const Occurrence *first = one.use == NameUse::Last ? names.firstOf(one) : nullptr)
    if (const auto begin =
            offsetIn(unit.index, programs[first->scope], *first, names.text(*first), first->begin))
      from = std::max(*begin, 1u) - 1;
  return blockIn(snapshot, unit, programs[one.scope], one, names.text(one), from);
}

/// A block of a program of another file, which the block of `one` names beside it.
std::optional<NameTarget> blockElsewhere(Snapshot &snapshot, FileUnit &from,
                                         const Occurrence &one) {
  const Names &names = snapshot.names(from);
  const Occurrence *const first = names.all().begin();
  constexpr ptrdiff_t near = 4; // they are in one block
  for (ptrdiff_t i = std::max<ptrdiff_t>(0, &one - first - near);
       i < std::min<ptrdiff_t>(ptrdiff_t(names.all().size()), &one - first + near); ++i) {
    if (first[i].kind != NameKind::Program)
      continue;
    const auto program = programTarget(snapshot, from, first[i]);
    if (!program)
      continue;
    return blockIn(snapshot, *program->unit, *program->program, one, names.text(one),
                   program->program->begin);
  }
  return std::nullopt;
}

} // namespace

bool isShared(const Occurrence &one) {
  return one.kind == NameKind::Program || one.kind == NameKind::Subprogram;
}

std::optional<NameTarget> targetOf(Snapshot &snapshot, FileUnit &from, const Occurrence &one) {
  if (one.scope == otherFile)
    return blockElsewhere(snapshot, from, one);
  if (one.kind == NameKind::Program)
    return programTarget(snapshot, from, one);
  if (one.kind == NameKind::Block || one.kind == NameKind::Label)
    return blockHere(snapshot, from, one);
  if (const auto here = targetIn(snapshot, from, one))
    return here;
  if (one.kind != NameKind::Subprogram)
    return std::nullopt;
  const auto program = programTarget(snapshot, from, one);
  if (!program)
    return std::nullopt;
  const auto inside = targetIn(snapshot, *program->unit, one);
  return inside ? inside : program;
}

std::optional<DefinedPlace> definition(Snapshot &snapshot, uint32_t offset) {
  const Names &names = snapshot.names();
  const Occurrence *const one = names.at(offset);
  if (!one)
    return std::nullopt;
  const auto target = targetOf(snapshot, snapshot.unit(), *one);
  if (!target)
    return std::nullopt;
  Block block;
  if (target->unit == &snapshot.unit())
    snapshot.readAt(target->name.begin, block);
  else
    readBlockAt(target->unit->source, *target->unit->reader, target->name.begin, block);
  return DefinedPlace{names.range(*one),
                      target->name,
                      {target->name.file, block.begin, std::max(block.end, target->name.end)}};
}

std::optional<SourceRange> declaration(Snapshot &snapshot, uint32_t offset) {
  const Names &names = snapshot.names();
  const Occurrence *const one = names.at(offset);
  if (!one)
    return std::nullopt;
  for (const uint32_t i : names.same(*one))
    if (names.all()[i].use == NameUse::Declaration)
      return names.range(names.all()[i]);
  const auto target = targetOf(snapshot, snapshot.unit(), *one);
  return target ? std::optional(target->name) : std::nullopt;
}

} // namespace ncvet::lsp
