// Waiting until something may have changed in folders.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <set>
#include <string>

namespace ncvet::cli {

/// Waits for changes. The only question of the platform in `ncvet check --watch`: Linux tells of
/// changes in local folders at once. Elsewhere, and in folders on a network, which nobody tells of,
/// who waits has to look again after some time.
class FolderWatch {
public:
  FolderWatch();
  ~FolderWatch();
  FolderWatch(const FolderWatch &) = delete;

  /// The folders that are watched from now on, without those below them.
  void watch(const std::set<std::string> &folders);
  /// Returns when something has happened in one of the folders and nothing more follows for a
  /// moment, when so much time is over, or soon after `ended` was set.
  void wait(std::chrono::milliseconds longest, const std::atomic<bool> &ended);

private:
  struct Told;
  std::unique_ptr<Told> told_; ///< null: nobody tells of changes
};

} // namespace ncvet::cli
