// The sections of a program that statements of it repeat, as the text says it.
#pragma once

#include "analyzer/program/program_index.h"

namespace ncvet {

/// A repeat whose bounds the text names. Offsets of blocks in the file.
struct RepeatedSection {
  uint32_t at = 0;             ///< the block with the repeat
  uint32_t first = 0;          ///< first block of the section
  uint32_t last = 0;           ///< last block of it
  uint32_t after = 0;          ///< the block after the last one
  uint32_t begin = 0, end = 0; ///< the repeat's own text
  bool holds(uint32_t offset) const { return first <= offset && offset < after; }
};

/// The block that an argument of `item`, a jump, a repeat or an input of `block`, names, looked for
/// as the control does; none: it is not there, or it is computed.
std::optional<uint32_t> blockNamed(const FileIndex &index, const Block &block, const Item &item,
                                   const Argument &argument);

/// All repeats with two bounds before which their section ends, in text order. Reads the file.
std::vector<RepeatedSection> repeatedSections(const FileIndex &index);

/// A code of the section that lays its frame by a variable which counts the passes, as the notices
/// of `flow-loop-counter` in the tables say, and the key of that variable.
struct CountedFrame {
  const CodeInfo *code = nullptr; ///< null: the section has none
  uint64_t counter = 0;
};
CountedFrame countedFrame(const FileIndex &index, const Dialect &dialect,
                          const RepeatedSection &section);

} // namespace ncvet
