// How often each of many names is in a text: in one pass over it.
#pragma once

#include "llvm/ADT/StringMap.h"

#include <set>

namespace ncvet {

/// Counts whatever is spelled like a name, as a part of a longer one too.
class NameCounts {
public:
  void add(llvm::StringRef name);
  /// Names overlap none of their own kind that was counted.
  void countIn(llvm::StringRef text);
  unsigned of(llvm::StringRef name) const {
    const auto count = counts_.find(name);
    return count == counts_.end() ? 0 : count->second.times;
  }

private:
  struct Count {
    unsigned times = 0;
    size_t end = 0; ///< of the last one
  };

  llvm::StringMap<Count> counts_;
  std::set<size_t> lengths_; ///< of the names
};

} // namespace ncvet
