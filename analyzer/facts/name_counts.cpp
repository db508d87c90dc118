// Counts names by looking up, at each place, the texts of the lengths that names have.
#include "analyzer/facts/name_counts.h"

#include <bitset>

namespace ncvet {

namespace {

/// Of the first two letters.
size_t beginOf(llvm::StringRef text) {
  return size_t(uint8_t(text[0])) << 8 | (text.size() > 1 ? uint8_t(text[1]) : 0);
}

} // namespace

void NameCounts::add(llvm::StringRef name) {
  if (!name.empty() && counts_.try_emplace(name).second)
    lengths_.insert(name.size());
}

void NameCounts::countIn(llvm::StringRef text) {
  std::bitset<256 * 256> begins; // at most places no name begins
  std::bitset<256> letters;      // names of one letter
  for (const auto &entry : counts_) {
    begins.set(beginOf(entry.getKey()));
    if (entry.getKey().size() == 1)
      letters.set(uint8_t(entry.getKey()[0]));
  }
  for (size_t at = 0; at < text.size(); ++at) {
    const llvm::StringRef left = text.drop_front(at);
    if (!begins.test(beginOf(left)) && !letters.test(uint8_t(left[0])))
      continue;
    for (const size_t length : lengths_) {
      if (length > left.size())
        break;
      const auto count = counts_.find(left.take_front(length));
      if (count == counts_.end() || count->second.end > at)
        continue;
      ++count->second.times;
      count->second.end = at + length;
    }
  }
}

} // namespace ncvet
