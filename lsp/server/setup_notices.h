// What is wrong with the files that setups come from, where the user sees it.
#pragma once

#include "lsp/transport/rpc.h"

#include <set>

namespace ncvet::lsp {

/// Shows errors of configurations, tables and machine profiles: each as a message, once, and as a
/// diagnostic at the line that it names. Safe for several threads.
class SetupNotices {
public:
  explicit SetupNotices(Rpc &rpc) : rpc_(rpc) {}

  /// `error`: "FILE:LINE: what is wrong", or a text without a place. True when it is new.
  bool add(llvm::StringRef error);
  /// The error as a message: what is wrong comes before the folder, as an editor cuts what is long.
  static std::string message(llvm::StringRef error);
  /// The files are read anew: what is told from here on takes the place of what was told.
  void renew();
  /// Whether something is wrong at present.
  bool any() const;

private:
  void publish(const std::string &file, const Json &diagnostics);

  Rpc &rpc_;
  mutable std::mutex mutex_;
  std::set<std::string> told_;        ///< errors that hold at present
  std::map<std::string, Json> files_; ///< diagnostics by file
};

} // namespace ncvet::lsp
