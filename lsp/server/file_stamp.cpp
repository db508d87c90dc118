// What a file was when something was found out about it.
#include "lsp/server/file_stamp.h"

#include "llvm/Support/FileSystem.h"

namespace ncvet::lsp {

FileStamp stampOf(const std::string &path, const SourceSet::Overlay &open) {
  if (const auto text = open.find(path); text != open.end())
    return {text->second, {}, 0};
  llvm::sys::fs::file_status status;
  if (llvm::sys::fs::status(path, status))
    return {};
  return {nullptr, status.getLastModificationTime(), status.getSize()};
}

} // namespace ncvet::lsp
