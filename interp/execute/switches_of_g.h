// Modes of the control, which no function of the machine changes.
#pragma once

#include "formats/dialect/dialect.h"

namespace ncvet {

/// Bit per switch that only G codes turn on and off.
inline uint32_t switchesOfG(const Dialect &dialect) {
  uint32_t modes = 0, others = 0;
  for (const CodeInfo &code : dialect.codes)
    if (code.effect.index < 32)
      (code.letter == 'G' ? modes : others) |= uint32_t(1) << code.effect.index;
  return modes & ~others;
}

} // namespace ncvet
