// A change of a text, found from both ends.
#include "formats/text/text_change.h"

#include <algorithm>
#include <cstring>

namespace ncvet {

namespace {

/// So many bytes are compared at once.
constexpr size_t compared = 4096;

} // namespace

void TextChanges::add(const TextChange &change) {
  // The pieces that touch the change become one with it.
  auto first = std::lower_bound(pieces_.begin(), pieces_.end(), change.begin,
                                [](const Piece &piece, uint32_t o) { return piece.end < o; });
  auto last = std::upper_bound(first, pieces_.end(), change.end,
                               [](uint32_t o, const Piece &piece) { return o < piece.begin; });
  // How far untouched text before a piece has moved.
  const auto movedBefore = [&](auto piece) {
    return piece == pieces_.begin() ? 0 : int64_t((piece - 1)->end) - (piece - 1)->beforeEnd;
  };
  Piece joined{};
  joined.begin = change.begin;
  uint32_t end = change.end;
  if (first != last) {
    joined.begin = std::min(joined.begin, first->begin);
    end = std::max(end, (last - 1)->end);
  }
  joined.before = uint32_t(joined.begin - movedBefore(first));
  joined.beforeEnd = uint32_t(end - movedBefore(last));
  joined.end = change.moved(end);
  for (auto later = last; later != pieces_.end(); ++later) {
    later->begin = change.moved(later->begin);
    later->end = change.moved(later->end);
  }
  pieces_.insert(pieces_.erase(first, last), joined);
}

void TextChanges::joinInLines(llvm::StringRef after) {
  std::vector<Piece> apart;
  for (const Piece &piece : pieces_) {
    if (!apart.empty() && !after.slice(apart.back().end, piece.begin).contains('\n')) {
      apart.back().beforeEnd = piece.beforeEnd;
      apart.back().end = piece.end;
    } else {
      apart.push_back(piece);
    }
  }
  pieces_ = std::move(apart);
}

std::vector<TextChange> TextChanges::fromFront() const {
  std::vector<TextChange> changes;
  for (const Piece &piece : pieces_)
    changes.push_back(
        {piece.begin, piece.begin + (piece.beforeEnd - piece.before), piece.end - piece.begin});
  return changes;
}

std::shared_ptr<const TextHistory> TextHistory::with(const SharedText &before,
                                                     const TextChange &change) {
  constexpr size_t most = 64; // whoever looks more seldom compares the texts
  auto history = std::make_shared<TextHistory>();
  if (before.history) {
    const auto &steps = before.history->steps;
    const size_t kept = std::min(steps.size(), most - 1);
    history->steps.assign(steps.end() - ptrdiff_t(kept), steps.end());
  }
  history->steps.push_back({before.bytes, change});
  return history;
}

TextChanges changesBetween(const std::shared_ptr<const std::string> &before,
                           const SharedText &after) {
  TextChanges changes;
  if (before == after.bytes)
    return changes;
  if (after.history) {
    const auto &steps = after.history->steps;
    const auto from = std::find_if(steps.rbegin(), steps.rend(),
                                   [&](const auto &step) { return step.before.lock() == before; });
    if (from != steps.rend()) {
      for (auto step = from.base() - 1; step != steps.end(); ++step)
        changes.add(step->change);
      changes.joinInLines(*after.bytes);
      return changes;
    }
  }
  changes.add(changeBetween(*before, *after.bytes));
  return changes;
}

TextChange changeBetween(llvm::StringRef before, llvm::StringRef after) {
  const size_t shorter = std::min(before.size(), after.size());
  size_t front = 0;
  while (shorter - front >= compared &&
         std::memcmp(before.data() + front, after.data() + front, compared) == 0)
    front += compared;
  while (front < shorter && before[front] == after[front])
    ++front;
  const char *const a = before.end(), *const b = after.end();
  const size_t most = shorter - front;
  size_t back = 0;
  while (most - back >= compared &&
         std::memcmp(a - back - compared, b - back - compared, compared) == 0)
    back += compared;
  while (back < most && a[-1 - ptrdiff_t(back)] == b[-1 - ptrdiff_t(back)])
    ++back;
  return {uint32_t(front), uint32_t(before.size() - back), uint32_t(after.size() - back - front)};
}

} // namespace ncvet
