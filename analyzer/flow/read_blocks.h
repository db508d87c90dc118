// Blocks that are executed again and again, read once.
#pragma once

#include "analyzer/program/project.h"

namespace ncvet {

/// Keeps blocks of loops and called programs as they were read. Belongs to one run: the texts stay
/// the same while it lasts.
class ReadBlocks {
public:
  /// The block at `offset`, kept or read into `own`. It is kept from its second time on.
  const Block &at(const FileUnit &unit, uint32_t offset, Block &own) {
    const uint64_t key = uint64_t(unit.source.id()) << 32 | offset;
    const auto known = blocks_.find(key);
    if (known != blocks_.end() && known->second)
      return *known->second;
    unit.reader->read(offset, own);
    if (known == blocks_.end()) {
      if (blocks_.size() < mostBlocks)
        blocks_.try_emplace(key);
      return own;
    }
    if (isShort(own))
      known->second = std::make_unique<const Block>(own);
    return own;
  }

private:
  /// Loops and subprograms of more blocks are seldom executed often.
  static constexpr size_t mostBlocks = 1u << 13;
  /// Parts of a block that is kept: with the number of blocks it bounds the memory, some 16 MiB.
  static constexpr size_t mostParts = 64;

  static bool isShort(const Block &block) {
    return block.words.size() + block.items.size() + block.arguments.size() +
               block.operations.size() <=
           mostParts;
  }

  llvm::DenseMap<uint64_t, std::unique_ptr<const Block>> blocks_; ///< by file and offset
};

} // namespace ncvet
