// Blocks that are spelled as one before them: how they are read, and what they do.
#pragma once

#include "analyzer/rule/text_ahead.h"
#include "formats/readers/spelled_line.h"
#include "interp/execute/known_move.h"

#include <memory>
#include <vector>

namespace ncvet {

/// Remembers the spellings of blocks of one text that were met more than once, and what such blocks
/// do in the modes in which they were executed. Belongs to one run of a region at a time.
class KnownBlocks final : public TextAhead {
public:
  /// A spelling, and the block that was read in it last.
  struct Spelling {
    uint64_t number = 0; ///< see `spellingOf`
    uint64_t serial = 0; ///< another one when a further spelling takes the place of this one
    Block block;
    Block ahead;                           ///< another of them, read before it is its turn
    SpelledLine line;                      ///< of such blocks
    bool isPattern = false;                ///< blocks can be read over `block`
    bool hasAhead = false;                 ///< `ahead` may be read over
    std::array<Spelling *, 8> followers{}; ///< of the blocks that came after such a one, the last
                                           ///< one first; null: none
    unsigned refused = 0;                  ///< how often such a block did more than is known
  };
  /// What a block of a spelling does in some modes.
  struct Known {
    uint64_t spelling = 0; ///< its serial number
    uint64_t before = 0;   ///< the modes before it, see `modesNumber`
    /// The modes after it, and its `Outcome::known`, by `KnownMove::variantOf`; 0: not made out.
    std::array<uint64_t, KnownMove::variants> after{}, number{};
    StateUse use; ///< what executing it looks at
    KnownMove move;
    Outcome outcome; ///< whose words are those of the spelling's block
  };

  /// `free`: the words whose numbers may be any.
  KnownBlocks(const QuickReader &reader, AddressMask free) : reader_(reader), free_(free) {}

  /// What comes next is not what came after the block before.
  void start() {
    last_ = nullptr;
    peekedAt_ = ~0u;
  }
  /// Reads the block at `offset` where it is spelled as one that came after such a block as the one
  /// before; null: it is not.
  Spelling *read(uint32_t offset);
  const Block *peek(uint32_t offset) override;
  /// The block at `offset`, before its turn, where its line has the form of those of the spelling;
  /// null: it has another. What was looked at before is of no meaning then.
  const Block *readAhead(uint32_t offset, Spelling &spelling) {
    peekedAt_ = ~0u;
    if (!std::exchange(spelling.hasAhead, true))
      spelling.ahead = spelling.block;
    return spelling.line.read(reader_.text(), offset, spelling.ahead) ? &spelling.ahead : nullptr;
  }
  /// The spelling of a block that was read, which then holds the block; null: it is met for the
  /// first time, or has none.
  Spelling *find(const Block &block);
  /// What such a block does in these modes; null: it is not known.
  Known *find(const Spelling &spelling, uint64_t before) const;
  /// Whether a block of the spelling is met in these modes again: then it is worth while to find
  /// out what it does.
  bool meetsAgain(const Spelling &spelling, uint64_t before);
  /// Where to put what is found out.
  Known &add(const Spelling &spelling, uint64_t before);

private:
  void follow(Spelling *spelling);
  /// Calls `read` for the spellings that may be the next one, the likeliest first, until it is true
  /// for one of them; null: for none.
  template <typename Read>
  Spelling *expect(Read read) const {
    if (!last_)
      return nullptr;
    Spelling *const after = after_[row_], *const often = followed_[pair_];
    if (after && after->isPattern && read(*after))
      return after;
    if (often && often != after && often->isPattern && read(*often))
      return often;
    for (Spelling *const follower : last_->followers)
      if (follower && follower != after && follower != often && follower->isPattern &&
          read(*follower))
        return follower;
    return nullptr;
  }
  Spelling *readExpected(uint32_t offset, Block Spelling::*into) const;
  Spelling &makeRoom(uint64_t number);
  static size_t placeOf(const Spelling &spelling, uint64_t modes) {
    return size_t((spelling.number ^ modes) >> 32);
  }

  /// A program has some dozens of spellings, and perhaps many more that come once.
  static constexpr size_t mostSpellings = 96, mostMet = 2048;
  /// What is known is looked for in one of so many rows, each of so many places.
  static constexpr size_t rows = 64, places = 4;
  struct Row {
    std::array<std::unique_ptr<Known>, places> known;
    size_t next = 0; ///< which of them is given up next
  };

  const QuickReader &reader_;
  const AddressMask free_;
  Spelling *last_ = nullptr;                         ///< of the block before; null: it has none
  uint64_t history_ = 0;                             ///< of the last eight blocks, a byte for each
  size_t row_ = 0;                                   ///< a number for all of them
  size_t pair_ = 0;                                  ///< of the last one and the one before it
  std::array<Spelling *, 1024> after_{};             ///< by row: what came after it last
  std::array<Spelling *, 256> followed_{};           ///< the same by pair
  uint32_t peekedAt_ = ~0u;                          ///< which block was read before its turn
  Spelling *peeked_ = nullptr;                       ///< its spelling; null: it could not be read
  std::vector<std::unique_ptr<Spelling>> spellings_; ///< one of them is given up for a further one
  uint64_t serial_ = 0;                              ///< of the spelling met last
  std::array<uint64_t, mostMet> met_{};      ///< by place: the spelling that was met there last
  std::array<uint64_t, mostMet> metModes_{}; ///< the same of spellings and modes
  std::array<Spelling *, mostMet> at_{};     ///< by place: the spelling that may be there
  std::array<Row, rows> known_;
};

} // namespace ncvet
