// How much of an earlier analysis was taken over.
#pragma once

#include <cstdint>

namespace ncvet {

struct TakenRuns {
  uint64_t blocks = 0;
  uint64_t runs = 0; ///< in so many steps
};

} // namespace ncvet
