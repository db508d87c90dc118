// Ctrl-C, for a command that ends in its own way then.
#pragma once

#include <atomic>

namespace ncvet::cli {

/// From now on the first Ctrl-C sets the flag, and the second one ends the process as ever. Where
/// the process was started so that Ctrl-C does nothing, it still does nothing.
const std::atomic<bool> &noteInterrupt();

} // namespace ncvet::cli
