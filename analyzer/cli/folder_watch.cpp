// Waiting for changes in folders: inotify on Linux, time elsewhere.
#include "analyzer/cli/folder_watch.h"

#include <map>
#include <thread>

#ifdef __linux__
#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>
#endif

namespace ncvet::cli {

namespace {

using Milliseconds = std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

/// How long Ctrl-C may have to wait when its signal comes between two looks at the flag.
constexpr Milliseconds lookAtFlag(200);

} // namespace

#ifdef __linux__

namespace {

/// A file is written in several steps, and a folder is copied file by file: all that comes in such
/// short intervals is one change.
constexpr Milliseconds quiet(50);
/// … unless it never ends.
constexpr Milliseconds longestBurst(1000);
constexpr uint32_t changes =
    IN_CLOSE_WRITE | IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO | IN_ONLYDIR;

} // namespace

struct FolderWatch::Told {
  int queue;
  std::map<std::string, int> watched; ///< the system's number of each folder

  /// Whether something has happened; waits for it as long as that.
  bool comes(Milliseconds longest) const {
    pollfd of = {queue, POLLIN, 0};
    if (::poll(&of, 1, int(longest.count())) <= 0)
      return false; // a signal ends it as well
    alignas(inotify_event) char events[16 * 1024];
    return ::read(queue, events, sizeof events) > 0;
  }
};

FolderWatch::FolderWatch() {
  const int queue = ::inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
  if (queue >= 0)
    told_ = std::make_unique<Told>(Told{queue, {}});
}

FolderWatch::~FolderWatch() {
  if (told_)
    ::close(told_->queue);
}

void FolderWatch::watch(const std::set<std::string> &folders) {
  if (!told_)
    return;
  std::map<std::string, int> now;
  // Asking again is harmless, and finds folders that were removed and made again. What cannot be
  // watched, as the system's number of watches is limited, is still looked at from time to time.
  for (const std::string &folder : folders)
    now[folder] = ::inotify_add_watch(told_->queue, folder.c_str(), changes);
  std::set<int> kept;
  for (const auto &[folder, number] : now)
    kept.insert(number);
  for (const auto &[folder, number] : told_->watched)
    if (number >= 0 && !kept.count(number))
      ::inotify_rm_watch(told_->queue, number);
  told_->watched = std::move(now);
}

void FolderWatch::wait(Milliseconds longest, const std::atomic<bool> &ended) {
  const Clock::time_point end = Clock::now() + longest;
  while (!ended && Clock::now() < end) {
    if (!told_) {
      std::this_thread::sleep_for(lookAtFlag);
    } else if (told_->comes(lookAtFlag)) {
      const Clock::time_point endOfBurst = Clock::now() + longestBurst;
      while (!ended && Clock::now() < endOfBurst && told_->comes(quiet))
        ;
      return;
    }
  }
}

#else

struct FolderWatch::Told {};

FolderWatch::FolderWatch() = default;
FolderWatch::~FolderWatch() = default;
void FolderWatch::watch(const std::set<std::string> &) {}

void FolderWatch::wait(Milliseconds longest, const std::atomic<bool> &ended) {
  const Clock::time_point end = Clock::now() + longest;
  while (!ended && Clock::now() < end)
    std::this_thread::sleep_for(lookAtFlag);
}

#endif

} // namespace ncvet::cli
