// Waiting for changes in folders until no more of them follow.
#include "analyzer/cli/folder_watch.h"

namespace ncvet::cli {

namespace {

using Milliseconds = std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

/// How long Ctrl-C may have to wait when its signal comes between two looks at the flag.
constexpr Milliseconds lookAtFlag(200);
/// A file is written in several steps, and a folder is copied file by file: all that comes in such
/// short intervals is one change.
constexpr Milliseconds quiet(50);
/// … unless it never ends.
constexpr Milliseconds longestBurst(1000);

} // namespace

void FolderWatch::wait(Milliseconds longest, const std::atomic<bool> &ended) {
  const Clock::time_point end = Clock::now() + longest;
  while (!ended && Clock::now() < end) {
    if (!events_.wait(lookAtFlag))
      continue;
    const Clock::time_point endOfBurst = Clock::now() + longestBurst;
    while (!ended && Clock::now() < endOfBurst && events_.wait(quiet))
      ;
    return;
  }
}

} // namespace ncvet::cli
