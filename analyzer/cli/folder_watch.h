// Waiting until something may have changed in folders.
#pragma once

#include "formats/text/system/system.h"

#include <atomic>
#include <chrono>
#include <set>
#include <string>

namespace ncvet::cli {

/// Waits for changes: of local folders Linux tells at once. Elsewhere, and in folders on a network,
/// of which nobody tells, who waits has to look again after some time.
class FolderWatch {
public:
  /// The folders that are watched from now on, without those below them.
  void watch(const std::set<std::string> &folders) { events_.watch(folders); }
  /// Returns when something has happened in one of the folders and nothing more follows for a
  /// moment, when so much time is over, or soon after `ended` was set.
  void wait(std::chrono::milliseconds longest, const std::atomic<bool> &ended);

private:
  system::FolderEvents events_;
};

} // namespace ncvet::cli
