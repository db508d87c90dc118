// Names of all programs of the workspace, for the request `workspace/symbol`.
#pragma once

#include "lsp/server/context.h"
#include "lsp/server/file_stamp.h"
#include "lsp/server/progress.h"

namespace ncvet::lsp {

/// Keeps the symbols of each file as long as the file is what it was: a name is looked for at every
/// key. Belongs to the thread of the workspace.
class WorkspaceSymbols {
public:
  /// Symbols whose names contain `query`, in capitals or not, in the order of the files; those that
  /// were not sent as a part of the answer.
  Json search(const CheckJob &base, llvm::ArrayRef<std::string> folders, llvm::StringRef query,
              WorkDone &work, PartialAnswer &parts, const std::atomic<bool> &cancelled);

private:
  struct Entry {
    std::string name;
    Json symbol; ///< `WorkspaceSymbol`
  };
  struct Kept {
    FileStamp stamp;
    std::vector<Entry> entries;
  };
  const std::vector<Entry> &entriesOf(const CheckJob &base, const std::string &path);

  std::shared_ptr<Session> session_; ///< under which the files were read
  std::map<std::string, Kept> files_;
};

} // namespace ncvet::lsp
