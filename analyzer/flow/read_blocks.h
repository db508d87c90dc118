// Blocks that are executed again and again, read once.
#pragma once

#include "analyzer/flow/known_blocks.h"
#include "analyzer/program/project.h"
#include "interp/execute/calculation.h"

namespace ncvet {

/// A block that only calculates, in the modes in which it was executed: what happens in it is the
/// same again, but for the numbers of its variables.
struct KnownCalculation {
  uint64_t situation = 0;       ///< modes and callers
  Truth condition = Truth::Yes; ///< see `Calculated`
  bool goesOn = false;          ///< with the next block
  std::unique_ptr<Outcome> outcome;
  StateUse use; ///< what executing it has looked at
};

/// A call or a return in the modes in which it was executed: it leaves the state as it is.
struct KnownFlow {
  uint64_t situation = 0;
  std::unique_ptr<Outcome> outcome;
  StateUse use;
};

/// What executing a block costs, in plain moves.
inline uint64_t workOf(const Block &block) {
  constexpr uint64_t statement = 4; // expressions
  constexpr uint64_t turn = 8;      // states that wait and meet
  const auto turns = [](const Item &item) {
    return item.kind == ItemKind::Structure || item.kind == ItemKind::Jump ||
           item.kind == ItemKind::End;
  };
  return block.items.empty() ? 1 : llvm::any_of(block.items, turns) ? turn : statement;
}

/// A block of the text as it was read, and what is known of it.
struct KeptBlock {
  explicit KeptBlock(const Block &read)
      : block(read), calculation(calculationOf(read)), work(workOf(read)) {}

  const Block block;
  const std::optional<Calculation> calculation;
  const uint64_t work; ///< see `workOf`
  llvm::SmallVector<KnownCalculation, 0> calculations;
  llvm::SmallVector<std::unique_ptr<KnownBlocks::Known>, 0> moves; ///< `before`: the situation
  llvm::SmallVector<KnownFlow, 0> flows;
  unsigned tries = 0; ///< times that it was found out, or was to be
};

/// Keeps blocks of loops and called programs as they were read. Belongs to one run: the texts stay
/// the same while it lasts.
class ReadBlocks {
public:
  /// The block at `offset`, kept or read into `own`. It is kept from its second time on.
  const Block &at(const FileUnit &unit, uint32_t offset, Block &own) {
    const uint64_t key = keyOf(unit, offset);
    const auto known = blocks_.find(key);
    if (known != blocks_.end() && known->second.kept)
      return known->second.kept->block;
    unit.reader->read(offset, own);
    if (known == blocks_.end()) {
      if (blocks_.size() < mostBlocks)
        blocks_.try_emplace(key);
      return own;
    }
    if (isShort(own))
      known->second.kept = std::make_unique<KeptBlock>(own);
    return own;
  }
  /// Whether a block of a called program has been executed so seldom that what others of its
  /// spelling do says more of it than what it did itself. It is executed once more now.
  bool isSeldom(const FileUnit &unit, uint32_t offset) {
    const uint64_t key = keyOf(unit, offset);
    auto known = blocks_.find(key);
    if (known == blocks_.end()) {
      if (blocks_.size() >= mostBlocks)
        return true;
      known = blocks_.try_emplace(key).first;
    }
    return !known->second.kept && ++known->second.times <= seldom;
  }
  /// The same, where it is kept; null: it is not.
  KeptBlock *find(const FileUnit &unit, uint32_t offset) const {
    const auto known = blocks_.find(keyOf(unit, offset));
    return known == blocks_.end() ? nullptr : known->second.kept.get();
  }
  /// Spellings of the blocks of called programs in a file, for the time of a run of one of them.
  /// Null: there are none yet that nobody else has.
  std::unique_ptr<KnownBlocks> borrow(const FileUnit &unit) {
    const auto spare = llvm::find_if(spare_, [&](const auto &one) { return one.first == &unit; });
    if (spare == spare_.end())
      return nullptr;
    std::unique_ptr<KnownBlocks> known = std::move(spare->second);
    spare_.erase(spare);
    known->start();
    return known;
  }
  void giveBack(const FileUnit &unit, std::unique_ptr<KnownBlocks> known) {
    if (spare_.size() < mostSpare)
      spare_.emplace_back(&unit, std::move(known));
  }
  /// Whether it is to be found out once more what the block does.
  bool mayLearn(KeptBlock &kept) {
    ++kept.tries;
    return kept.tries > inVain && kept.tries <= mostTries && ++learned_ <= mostLearned;
  }

private:
  struct Entry {
    std::unique_ptr<KeptBlock> kept;
    unsigned times = 0; ///< see `isSeldom`
  };

  /// Loops and subprograms of more blocks are seldom executed often.
  static constexpr size_t mostBlocks = 1u << 13;
  /// Executions of one block.
  static constexpr unsigned seldom = 3;
  /// Some hundred kilobytes each: programs call one another some deep.
  static constexpr size_t mostSpare = 8;
  /// Parts of a block that is kept: with the number of blocks it bounds the memory, some 16 MiB.
  static constexpr size_t mostParts = 64;
  /// What is called some times is seldom called often.
  static constexpr unsigned inVain = 2;
  /// Ways and modes in which one block is met again and again.
  static constexpr unsigned mostTries = 12;
  /// With an outcome each, some 8 MiB.
  static constexpr size_t mostLearned = 1u << 12;

  static uint64_t keyOf(const FileUnit &unit, uint32_t offset) {
    return uint64_t(unit.source.id()) << 32 | offset;
  }
  static bool isShort(const Block &block) {
    return block.words.size() + block.items.size() + block.arguments.size() +
               block.operations.size() <=
           mostParts;
  }

  llvm::DenseMap<uint64_t, Entry> blocks_; ///< by file and offset
  std::vector<std::pair<const FileUnit *, std::unique_ptr<KnownBlocks>>> spare_;
  size_t learned_ = 0; ///< times that something was found out, or was to be
};

} // namespace ncvet
