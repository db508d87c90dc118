// Where that is what the blocks of a program refer to.
#include "analyzer/program/references.h"

#include "analyzer/program/block_reading.h"
#include "formats/dialect/control_facts.h"
#include "formats/dialect/packed_call.h"

namespace ncvet {

namespace {

/// First block after the bracket that opens the subprogram `label` of a file.
std::optional<ReferredPlace> subprogramIn(FileUnit &unit, llvm::StringRef label) {
  for (const ProgramInfo &one : unit.index.programs())
    if (const auto at = unit.index.label(one, label, one.begin)) {
      const llvm::ArrayRef<uint32_t> marks = unit.index.tapeMarks();
      if (unit.dialect->facts->program.tapeMarkEnds && marks.size() > 1 && *at > marks[1])
        return std::nullopt; // the text ends before it
      Block block;
      unit.reader->read(*at, block);
      return ReferredPlace{&unit, &one, block.next, 0};
    }
  return std::nullopt;
}

} // namespace

std::optional<ReferredPlace> resolveProgram(Project &project, FileUnit &from,
                                            const Reference &reference) {
  if (reference.to == ReferredKind::Subprogram)
    if (const auto here = subprogramIn(from, reference.text))
      return here;
  auto [unit, program] = reference.to == ReferredKind::Program
                             ? project.findProgram(from, reference.number)
                             : project.findProgram(from, reference.text);
  if (!program && reference.packed) {
    const PackedCall call = unpackCall(*from.dialect, reference.number);
    if (call.digits)
      std::tie(unit, program) = project.findProgram(from, call.program);
    if (program)
      return ReferredPlace{unit, program, program->body, call.runs};
  }
  if (!program)
    return std::nullopt;
  // A file of the subprogram's name holds it.
  if (reference.to == ReferredKind::Subprogram)
    return subprogramIn(*unit, reference.text);
  return ReferredPlace{unit, program, program->body, 0};
}

std::optional<uint32_t> resolveBlock(const FileIndex &index, const ProgramInfo &program,
                                     const Reference &reference, uint32_t from) {
  return reference.to == ReferredKind::Label
             ? index.label(program, reference.text, from, reference.search)
             : index.block(program, reference.number, from, reference.search);
}

ReferredBlocks resolveProfile(const FileIndex &index, const ProgramInfo &program,
                              const Reference &first, const Reference &last, uint32_t from) {
  ReferredBlocks blocks;
  blocks.first = resolveBlock(index, program, first, from);
  // A number is looked for after the place, and may be that of the first block again.
  const uint32_t back = last.to == ReferredKind::Block && blocks.first.value_or(0) ? 1 : 0;
  blocks.last = resolveBlock(index, program, last, blocks.first ? *blocks.first - back : from);
  return blocks;
}

bool namesForeignJump(const FileUnit &unit, const ProgramInfo &program) {
  const llvm::StringRef jump = unit.dialect->lexical.foreignJump;
  if (jump.empty())
    return false;
  const llvm::StringRef text = unit.source.text(program.begin, program.end);
  Block block;
  for (size_t at = text.find_insensitive(jump); at != llvm::StringRef::npos;
       at = text.find_insensitive(jump, at + 1)) {
    const auto offset = uint32_t(program.begin + at);
    readBlockAt(unit.source, *unit.reader, offset, block);
    if (llvm::none_of(block.comments, [&](const Comment &comment) {
          return comment.begin <= offset && offset < comment.end;
        }))
      return true;
  }
  return false;
}

} // namespace ncvet
