// Which files of a folder call which programs.
#pragma once

#include "formats/dialect/dialect.h"

#include "llvm/ADT/STLExtras.h"

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace ncvet {

/// What a file says of programs.
struct FileCalls {
  std::string path;
  std::set<std::string> calls; ///< numbers, and names in capitals
  bool untold = false;         ///< only the run decides what one of its calls names
  bool returns = false;        ///< a block of it returns to a caller
  bool ends = false;           ///< a block of it ends the program
};

struct FolderCalls {
  std::vector<FileCalls> files; ///< in the order of their paths
  bool all = true;              ///< false: the folder is too large to be read
};

/// Calls of each folder, read once for each control and ending. Safe for several threads.
class CallsOfFolders {
public:
  using Key = std::tuple<std::string, std::string, std::shared_ptr<const Dialect>>;

  /// Those of the folder, the ending and the control of `key`; `read` reads them.
  const FolderCalls &of(const Key &key, llvm::function_ref<FolderCalls()> read) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto [at, fresh] = folders_.try_emplace(key);
    if (fresh)
      at->second = read();
    return at->second;
  }

private:
  std::mutex mutex_;
  std::map<Key, FolderCalls> folders_;
};

} // namespace ncvet
