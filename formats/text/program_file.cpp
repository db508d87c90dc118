// Reads whole files: what is no file, or never ends, is told and not waited for.
#include "formats/text/program_file.h"

#include "formats/text/system/system.h"

#include "llvm/Support/FileSystem.h"

namespace ncvet {

namespace {

namespace fs = llvm::sys::fs;

llvm::Error refuse(std::errc code, const llvm::Twine &why) {
  return llvm::createStringError(std::make_error_code(code), why);
}

} // namespace

llvm::Expected<std::unique_ptr<llvm::MemoryBuffer>> readWholeFile(llvm::StringRef path,
                                                                  uint64_t most) {
  fs::file_status status;
  if (std::error_code error = fs::status(path, status))
    return llvm::createStringError(error, llvm::Twine(error.message()));
  if (status.type() == fs::file_type::directory_file)
    return refuse(std::errc::is_a_directory, "it is a folder");
  if (status.type() == fs::file_type::fifo_file)
    return system::readPipe(path, most);
  if (status.type() != fs::file_type::regular_file)
    return refuse(std::errc::invalid_argument, "it is not a regular file");
  if (status.getSize() > most)
    return refuse(std::errc::file_too_large, "it is too large");
  auto buffer = llvm::MemoryBuffer::getFile(path, /*IsText=*/false,
                                            /*RequiresNullTerminator=*/false,
                                            /*IsVolatile=*/false);
  if (!buffer)
    return llvm::createStringError(buffer.getError(), llvm::Twine(buffer.getError().message()));
  if ((*buffer)->getBufferSize() > most)
    return refuse(std::errc::file_too_large, "it is too large");
  return std::move(*buffer);
}

bool isRegularFile(llvm::StringRef path) {
  fs::file_status status;
  return !fs::status(path, status) && status.type() == fs::file_type::regular_file;
}

} // namespace ncvet
