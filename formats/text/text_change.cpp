// A change of a text, found from both ends.
#include "formats/text/text_change.h"

#include <algorithm>
#include <cstring>

namespace ncvet {

namespace {

/// Bytes that are compared at once.
constexpr size_t piece = 4096;

} // namespace

TextChange changeBetween(llvm::StringRef before, llvm::StringRef after) {
  const size_t shorter = std::min(before.size(), after.size());
  size_t front = 0;
  while (shorter - front >= piece &&
         std::memcmp(before.data() + front, after.data() + front, piece) == 0)
    front += piece;
  while (front < shorter && before[front] == after[front])
    ++front;
  const char *const a = before.end(), *const b = after.end();
  const size_t most = shorter - front;
  size_t back = 0;
  while (most - back >= piece && std::memcmp(a - back - piece, b - back - piece, piece) == 0)
    back += piece;
  while (back < most && a[-1 - ptrdiff_t(back)] == b[-1 - ptrdiff_t(back)])
    ++back;
  return {uint32_t(front), uint32_t(before.size() - back), uint32_t(after.size() - back - front)};
}

} // namespace ncvet
