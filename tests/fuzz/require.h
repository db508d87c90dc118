// What a fuzz target holds true of every input.
#pragma once

#include <cstdlib>

namespace ncvet::fuzz {

/// Ends the run, with its input kept, when it does not hold.
inline void require(bool holds) {
  if (!holds)
    std::abort();
}

} // namespace ncvet::fuzz
