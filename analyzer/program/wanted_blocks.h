// The blocks of a text that may hold what somebody looks for.
#pragma once

#include "analyzer/program/program_index.h"

#include <algorithm>

namespace ncvet {

/// The blocks of those pieces of a text that are wanted, as `blocksWhere` gives them.
template <class Wants>
class WantedBlocks {
public:
  WantedBlocks(const FileIndex &index, const ProgramInfo &program, uint32_t from, Wants wants)
      : index_(index), at_(program.body), pieceEnd_(program.body), from_(std::max(from, at_)),
        to_(program.end), wants_(std::move(wants)) {}
  /// What was passed over counts as well, so that it is no matter which pieces were known.
  ~WantedBlocks() { workDone += (std::max(at_, from_) - from_) / usualBlock + 1; }
  WantedBlocks(const WantedBlocks &) = delete;
  WantedBlocks &operator=(const WantedBlocks &) = delete;

  struct End {};
  class Iterator {
  public:
    explicit Iterator(WantedBlocks &range) : range_(range) { range_.read(); }
    const Block &operator*() const { return range_.block_; }
    Iterator &operator++() {
      range_.goOn();
      range_.read();
      return *this;
    }
    bool operator!=(End) const { return range_.at_ < range_.to_; }

  private:
    WantedBlocks &range_;
  };
  Iterator begin() { return Iterator(*this); }
  End end() const { return {}; }

private:
  static constexpr uint32_t usualBlock = 16; // bytes

  /// Reads the block at which it is, or the first one after it that is wanted.
  void read() {
    for (passOver(); at_ < to_; passOver()) {
      index_.reader().read(at_, block_);
      if (at_ >= from_)
        return;
      goOn();
    }
  }
  /// Goes over pieces that are not wanted.
  void passOver() {
    while (at_ >= pieceEnd_ && at_ < to_) {
      const TextPiece &piece = index_.pieceAt(at_, to_);
      pieceEnd_ = piece.end;
      if (pieceEnd_ <= from_ || !wants_(piece))
        at_ = pieceEnd_;
    }
  }
  void goOn() { at_ = std::max(block_.next, at_ + 1); }

  const FileIndex &index_;
  uint32_t at_, pieceEnd_;
  const uint32_t from_, to_;
  Wants wants_;
  Block block_;
};

/// The blocks of a program from `from` on, in those pieces of which `wants` says true. A block is
/// read when the loop comes to it and holds until the next one.
template <class Wants>
WantedBlocks<Wants> blocksWhere(const FileIndex &index, const ProgramInfo &program, Wants wants,
                                uint32_t from = 0) {
  return {index, program, from, std::move(wants)};
}
/// The same for blocks that hold one of these addresses.
inline auto blocksWith(const FileIndex &index, const ProgramInfo &program, AddressMask addresses,
                       uint32_t from = 0) {
  return blocksWhere(
      index, program, [=](const TextPiece &piece) { return piece.hasAny(addresses); }, from);
}
/// The same for blocks that name one of these codes, see `findCode`.
inline auto blocksNaming(const FileIndex &index, const ProgramInfo &program, const Dialect &dialect,
                         llvm::ArrayRef<Action> actions) {
  return blocksWhere(
      index, program,
      [&dialect, wanted = llvm::SmallVector<Action, 4>(actions.begin(), actions.end())](
          const TextPiece &piece) { return piece.mayName(dialect, wanted); });
}

} // namespace ncvet
