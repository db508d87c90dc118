// Ctrl-C as a flag: the signal of the C standard, which every platform has.
#include "analyzer/cli/interrupt.h"

#include <csignal>

namespace ncvet::cli {

namespace {

/// Written by the handler, which can be given nothing.
std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a handler must not wait");

void onInterrupt(int signal) {
  interrupted = true;
  std::signal(signal, SIG_DFL);
}

} // namespace

const std::atomic<bool> &noteInterrupt() {
  if (std::signal(SIGINT, onInterrupt) == SIG_IGN)
    std::signal(SIGINT, SIG_IGN);
  return interrupted;
}

} // namespace ncvet::cli
