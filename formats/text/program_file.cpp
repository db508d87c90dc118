// Reads whole files: what is no file, or never ends, is told and not waited for.
#include "formats/text/program_file.h"

#include "llvm/Support/FileSystem.h"
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>

namespace ncvet {

namespace {

namespace fs = llvm::sys::fs;

constexpr size_t readStep = 1u << 16;

llvm::Error refuse(std::errc code, const llvm::Twine &why) {
  return llvm::createStringError(std::make_error_code(code), why);
}

llvm::Error fromSystem() {
  const std::error_code code(errno, std::generic_category());
  return llvm::createStringError(code, llvm::Twine(code.message()));
}

/// Closes the descriptor when it is left.
struct Descriptor {
  int number;
  ~Descriptor() { ::close(number); }
};

/// Whether the pipe holds something, or another program has it open to write into it.
bool isWrittenTo(int descriptor) {
  pollfd ready{descriptor, POLLIN, 0};
  if (::poll(&ready, 1, 0) > 0 && (ready.revents & POLLIN))
    return true;
  char byte = 0; // nothing is lost: it is empty
  return ::read(descriptor, &byte, 1) < 0 && errno == EAGAIN;
}

llvm::Expected<std::unique_ptr<llvm::MemoryBuffer>> readPipe(llvm::StringRef path, uint64_t most) {
  const Descriptor pipe{::open(path.str().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
  if (pipe.number < 0)
    return fromSystem();
  if (!isWrittenTo(pipe.number))
    return refuse(std::errc::invalid_argument, "it is a pipe into which nothing writes");
  // From here on its writer is waited for.
  if (::fcntl(pipe.number, F_SETFL, 0) != 0)
    return fromSystem();
  std::string bytes;
  for (;;) {
    const size_t before = bytes.size();
    bytes.resize(before + readStep);
    const ssize_t read = ::read(pipe.number, bytes.data() + before, readStep);
    if (read < 0 && errno != EINTR)
      return fromSystem();
    bytes.resize(before + size_t(std::max<ssize_t>(read, 0)));
    if (bytes.size() > most)
      return refuse(std::errc::file_too_large, "it is too large");
    if (read == 0)
      return llvm::MemoryBuffer::getMemBufferCopy(bytes, path);
  }
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
    return readPipe(path, most);
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
