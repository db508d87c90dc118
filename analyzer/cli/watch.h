// `ncvet check --watch`: checks again after each change, until Ctrl-C.
#pragma once

#include "analyzer/cli/check_round.h"
#include "analyzer/cli/command.h"
#include "analyzer/cli/file_stamps.h"
#include "analyzer/cli/folder_watch.h"

#include <functional>

namespace ncvet::cli {

class Watch {
public:
  using MakeRequest = std::function<llvm::Expected<CheckRequest>()>;
  using RunCheck = std::function<int(CheckRequest, CheckRound &)>;

  /// `request` makes what is to be checked, each time anew: it reads files that options name.
  /// `check` checks it, writes the reports and gives the exit code.
  Watch(MakeRequest request, RunCheck check)
      : makeRequest_(std::move(request)), runCheck_(std::move(check)) {}

  /// Checks and waits in turn until Ctrl-C; the exit code of the last check.
  int run();

private:
  void check();
  llvm::Expected<CheckRequest> requestFrom(llvm::StringRef folder) const;
  bool waitForChange();
  void say(const llvm::Twine &what) const;

  MakeRequest makeRequest_;
  RunCheck runCheck_;
  std::optional<CheckRequest> request_; ///< the last one that could be made
  std::optional<FileStamps> stamps_;    ///< of what the last check has seen
  std::vector<std::string> read_;       ///< by the last check
  FolderWatch folders_;
  std::string startFolder_;
  const std::atomic<bool> *ended_ = nullptr;
  int code_ = 0;
};

} // namespace ncvet::cli
