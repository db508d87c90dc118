// Where that is what the blocks of a program refer to.
#pragma once

#include "analyzer/program/project.h"
#include "analyzer/program/reference_reader.h"

namespace ncvet {

/// Where a reference leads.
struct ReferredPlace {
  FileUnit *unit = nullptr;
  const ProgramInfo *program = nullptr;
  uint32_t begin = 0; ///< first block to execute
  int64_t runs = 0;   ///< the count that the number has before that of the program; 0: none
};

/// The program or subprogram that `reference`, one of the file `from`, names.
std::optional<ReferredPlace> resolveProgram(Project &project, FileUnit &from,
                                            const Reference &reference);

/// Offset of the block of `program` that `reference` names, looked for from the block at `from`.
std::optional<uint32_t> resolveBlock(const FileIndex &index, const ProgramInfo &program,
                                     const Reference &reference, uint32_t from);

/// First and last block of a profile or a section.
struct ReferredBlocks {
  std::optional<uint32_t> first, last;

  /// Both are there, one after the other.
  bool areInOrder() const { return first && last && *first < *last; }
};

/// The blocks of `program` between which a profile lies. The first one is looked for from the block
/// at `from`, the last one from the first.
ReferredBlocks resolveProfile(const FileIndex &index, const ProgramInfo &program,
                              const Reference &first, const Reference &last, uint32_t from);

/// Whether blocks of `program` name a jump in another control's language, which the reader does not
/// read. Comments do not count.
bool namesForeignJump(const FileUnit &unit, const ProgramInfo &program);

} // namespace ncvet
