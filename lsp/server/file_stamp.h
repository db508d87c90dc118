// What a file was when something was found out about it, so that it need not be found out again.
#pragma once

#include "formats/text/source_set.h"

#include "llvm/Support/Chrono.h"

namespace ncvet::lsp {

/// The text that the editor has of a file, or else when the one on disk was written.
struct FileStamp {
  std::shared_ptr<const std::string> open; ///< null: the file is not open
  llvm::sys::TimePoint<> written;          ///< the epoch: there is no such file
  uint64_t size = 0;

  bool operator==(const FileStamp &) const = default;
};

/// What the file is now.
FileStamp stampOf(const std::string &path, const SourceSet::Overlay &open);

} // namespace ncvet::lsp
