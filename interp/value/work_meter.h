// What an analysis has cost besides its blocks.
#pragma once

#include <cstdint>

namespace ncvet {

/// Work that this thread has done, in plain moves, a third of a microsecond each: what may take
/// long without a block being read adds to it where it is done. It counts, and no clock is asked:
/// the same text has the same budget on every machine.
inline constinit thread_local uint64_t workDone = 0;

} // namespace ncvet
