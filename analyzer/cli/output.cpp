// Files that the commands write.
#include "analyzer/cli/output.h"

#include "formats/text/failure.h"

namespace ncvet::cli {

llvm::Error writeFile(const std::string &file,
                      llvm::function_ref<void(llvm::raw_ostream &)> write) {
  if (file == "-") {
    write(llvm::outs());
    return llvm::Error::success();
  }
  std::error_code error;
  llvm::raw_fd_ostream out(file, error);
  if (!error) {
    write(out);
    out.close();
    error = out.error();
    out.clear_error();
  }
  return error ? failure("cannot write " + file + ": " + error.message()) : llvm::Error::success();
}

} // namespace ncvet::cli
