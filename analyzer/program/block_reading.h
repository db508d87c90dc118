// Reading of blocks that are not the current one: the block at a place, and one block after
// another.
#pragma once

#include "formats/readers/reader.h"
#include "formats/text/source.h"
#include "interp/value/work_meter.h"

namespace ncvet {

/// Reads the block that holds the byte `offset` into `block`. After the last block it is empty.
void readBlockAt(const SourceFile &source, const Reader &reader, uint32_t offset, Block &block);

/// The blocks of a text one after another, as `blocks` gives them. A block is read when the loop
/// comes to it and holds until the next one.
template <class Text>
class BlockRange {
public:
  BlockRange(const Text &text, uint32_t from, uint32_t to, unsigned most)
      : text_(text), at_(from), to_(to), left_(most) {}

  struct End {};
  class Iterator {
  public:
    explicit Iterator(BlockRange &range) : range_(range) { range_.read(); }
    const Block &operator*() const { return range_.block_; }
    Iterator &operator++() {
      range_.goOn();
      return *this;
    }
    bool operator!=(End) const { return !range_.ended_; }

  private:
    BlockRange &range_;
  };
  Iterator begin() { return Iterator(*this); }
  End end() const { return {}; }

private:
  void read() {
    ended_ = at_ >= to_ || left_ == 0;
    if (ended_)
      return;
    --left_;
    ++workDone;
    text_.read(at_, block_);
  }
  void goOn() {
    const uint32_t next = block_.next;
    ended_ = next <= at_; // no reader does so; the loop ends whatever one does
    at_ = next;
    if (!ended_)
      read();
  }

  const Text &text_;
  uint32_t at_, to_;
  unsigned left_;
  bool ended_ = false;
  Block block_;
};

/// The blocks that begin in [from, to), at most `most`; `from` is the offset of a block. `text` is
/// a `Reader`, or a `FileIndex`, which notes what a rule has looked at.
template <class Text>
BlockRange<Text> blocks(const Text &text, uint32_t from, uint32_t to, unsigned most = ~0u) {
  return {text, from, to, most};
}

/// All blocks of a text.
inline BlockRange<Reader> blocks(const Reader &reader) {
  return {reader, reader.first(), uint32_t(reader.text().size()), ~0u};
}

} // namespace ncvet
