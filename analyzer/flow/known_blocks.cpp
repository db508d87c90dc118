// Blocks that are spelled as one before them: how they are read, and what they do.
#include "analyzer/flow/known_blocks.h"

#include "formats/readers/spelling.h"

#include <algorithm>

namespace ncvet {

namespace {

/// Makes `to` the block that `from` is, which is spelled alike.
void takeNumbers(const Block &from, Block &to) {
  to.begin = from.begin;
  to.end = from.end;
  to.next = from.next;
  to.plain = from.plain;
  to.number = from.number;
  to.numberBegin = from.numberBegin;
  to.numberEnd = from.numberEnd;
  std::copy(from.words.begin(), from.words.end(), to.words.begin());
  std::copy(from.comments.begin(), from.comments.end(), to.comments.begin());
}

} // namespace

/// Notes which spelling comes after that of the block before.
void KnownBlocks::follow(Spelling *spelling) {
  if (last_ && spelling && after_[row_] != spelling) {
    after_[row_] = followed_[pair_] = spelling;
    auto &followers = last_->followers;
    if (followers[0] != spelling) {
      auto *const known = std::find(followers.begin(), followers.end() - 1, spelling);
      std::copy_backward(followers.begin(), known, known + 1);
      followers[0] = spelling;
    }
  }
  constexpr uint64_t spread = 31, odd = 0x9E3779B97F4A7C15; // the golden ratio
  if (spelling) {
    history_ = history_ << 8 | (spelling->serial & 0xFF);
    row_ = size_t(history_ * odd >> 54) % after_.size();
    pair_ = (spelling->serial * spread + (last_ ? last_->serial : 0)) % followed_.size();
  }
  last_ = spelling;
}

/// Reads the block at `offset`, where it is one that is expected: first by the forms of their
/// lines, of which most are others by their first bytes.
KnownBlocks::Spelling *KnownBlocks::readExpected(uint32_t offset, Block Spelling::*into) const {
  const llvm::StringRef text = reader_.text();
  const auto blockOf = [&](Spelling &spelling) -> Block & {
    if (into == &Spelling::ahead && !std::exchange(spelling.hasAhead, true))
      spelling.ahead = spelling.block;
    return spelling.*into;
  };
  if (Spelling *const next = expect(
          [&](Spelling &spelling) { return spelling.line.read(text, offset, blockOf(spelling)); }))
    return next;
  return expect([&](Spelling &spelling) {
    return spelling.line.readOther(reader_, offset, free_, blockOf(spelling));
  });
}

KnownBlocks::Spelling *KnownBlocks::read(uint32_t offset) {
  if (offset == peekedAt_) {
    if (peeked_) {
      takeNumbers(peeked_->ahead, peeked_->block);
      follow(peeked_);
    }
    return peeked_;
  }
  Spelling *const next = readExpected(offset, &Spelling::block);
  if (next)
    follow(next);
  return next;
}

const Block *KnownBlocks::peek(uint32_t offset) {
  if (offset != peekedAt_) {
    peekedAt_ = offset;
    peeked_ = readExpected(offset, &Spelling::ahead);
  }
  return peeked_ ? &peeked_->ahead : nullptr;
}

/// Room for a further spelling, perhaps that of an older one.
KnownBlocks::Spelling &KnownBlocks::makeRoom(uint64_t number) {
  if (spellings_.size() < mostSpellings)
    spellings_.push_back(std::make_unique<Spelling>());
  Spelling &room = *spellings_[serial_ % spellings_.size()];
  room.number = number;
  room.serial = ++serial_;
  room.followers = {};
  room.refused = 0;
  room.hasAhead = false;
  room.line.forget();
  return room;
}

KnownBlocks::Spelling *KnownBlocks::find(const Block &block) {
  peekedAt_ = ~0u; // what was read may be given up
  const uint64_t number = spellingOf(block, free_);
  const size_t place = number % mostMet;
  Spelling *spelling = nullptr;
  if (number && std::exchange(met_[place], number) == number) {
    spelling = at_[place];
    if (!spelling || spelling->number != number)
      at_[place] = spelling = &makeRoom(number);
    spelling->block = block;
    spelling->isPattern = reader_.isPattern(block);
  }
  follow(spelling);
  return spelling;
}

KnownBlocks::Known *KnownBlocks::find(const Spelling &spelling, uint64_t before) const {
  for (const std::unique_ptr<Known> &known : known_[placeOf(spelling, before) % rows].known)
    if (known && known->spelling == spelling.serial && known->before == before)
      return known.get();
  return nullptr;
}

bool KnownBlocks::meetsAgain(const Spelling &spelling, uint64_t before) {
  const size_t place = placeOf(spelling, before) % mostMet;
  const uint64_t both = spelling.number ^ before;
  return std::exchange(metModes_[place], both) == both;
}

KnownBlocks::Known &KnownBlocks::add(const Spelling &spelling, uint64_t before) {
  Row &row = known_[placeOf(spelling, before) % rows];
  std::unique_ptr<Known> &known = row.known[row.next];
  row.next = (row.next + 1) % places;
  if (!known)
    known = std::make_unique<Known>();
  known->spelling = spelling.serial;
  known->before = before;
  return *known;
}

} // namespace ncvet
