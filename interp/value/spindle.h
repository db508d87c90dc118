// What a spindle may be doing.
#pragma once

#include <cstdint>

namespace ncvet {

/// Set of what the main spindle may be doing.
enum SpindleBits : uint8_t {
  spindleOff = 1,
  spindleCw = 2,
  spindleCcw = 4,
  spindleOriented = 8,
  spindleAny = 15
};

} // namespace ncvet
