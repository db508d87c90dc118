// The paths that clients look at while they edit.
#pragma once

#include "lsp/server/checks.h"
#include "lsp/server/path_wish.h"

#include <list>

namespace ncvet::lsp {

class LivePath; // lsp/server/live_path.h

/// Those that are looked at. Belongs to the thread of paths.
class LivePaths {
public:
  LivePaths();
  ~LivePaths();

  llvm::Expected<std::string> answer(const CheckJob &job, const PathWish &wish,
                                     const std::atomic<bool> &cancelled);
  void forget(const std::string &path);
  /// After a crash: what it leaves can be neither used nor given back.
  void abandon(const std::string &path);

private:
  /// A path of a million moves takes 20 MB; more than two are not looked at in turn.
  static constexpr size_t mostPaths = 2;
  struct Kept {
    std::string path;
    std::unique_ptr<LivePath> live;
  };
  std::list<Kept> kept_; ///< the last one that was asked for first
};

} // namespace ncvet::lsp
