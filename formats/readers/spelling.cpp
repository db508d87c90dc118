// How a block is spelled, its coordinates aside.
#include "formats/readers/spelling.h"

#include "formats/readers/alike_block.h"

namespace ncvet {

uint64_t spellingOf(const Block &block, AddressMask free) {
  if (!isAlikePattern(block))
    return 0;
  uint64_t number = uint64_t(block.number >= 0) | uint64_t(block.comments.size()) << 1;
  const auto add = [&](uint64_t part) {
    constexpr uint64_t odd = 0x9E3779B97F4A7C15; // the golden ratio: spreads small numbers
    number = (number ^ part) * odd;
    number ^= number >> 29;
  };
  // Of a zero it is no matter whether it has a point.
  add(block.pointed);
  add(block.pointless);
  for (const Word &word : block.words) {
    if (free & maskOf(word.address)) {
      add(uint64_t(word.address) << 8 | (word.flags & ~wordMinus));
    } else {
      add(uint64_t(word.address) << 8 | word.flags);
      add(uint64_t(word.mantissa) << 8 | word.decimals);
    }
  }
  return number ? number : 1;
}

} // namespace ncvet
