// Small files read whole, and never without end.
#include "formats/text/read_file.h"

#include "formats/text/failure.h"
#include "formats/text/program_file.h"

#include "llvm/ADT/SmallVector.h"
#include "llvm/Support/FileSystem.h"

namespace ncvet {

llvm::Expected<std::unique_ptr<llvm::MemoryBuffer>> readFile(llvm::StringRef path, uint64_t limit) {
  namespace fs = llvm::sys::fs;
  const auto cannotRead = [&](const llvm::Twine &why) {
    return failure("cannot read " + path + ": " + why);
  };
  fs::file_status status;
  if (const std::error_code error = fs::status(path, status))
    return cannotRead(error.message());
  if (status.type() == fs::file_type::directory_file)
    return cannotRead("it is a folder");
  if (status.type() != fs::file_type::regular_file && status.type() != fs::file_type::fifo_file)
    return cannotRead("it is not a regular file");
  if (status.type() == fs::file_type::fifo_file) {
    auto piped = readWholeFile(path, limit);
    if (!piped)
      return cannotRead(llvm::toString(piped.takeError()));
    return std::move(*piped);
  }
  auto file = fs::openNativeFileForRead(path);
  if (!file)
    return cannotRead(llvm::toString(file.takeError()));
  llvm::SmallVector<char, 0> bytes;
  constexpr size_t step = 1u << 14;
  std::string wrong;
  while (wrong.empty()) {
    const size_t begin = bytes.size();
    bytes.resize_for_overwrite(begin + step);
    auto read = fs::readNativeFile(*file, llvm::makeMutableArrayRef(bytes.data() + begin, step));
    if (!read) {
      wrong = llvm::toString(read.takeError());
      break;
    }
    bytes.truncate(begin + *read);
    if (*read == 0)
      break;
    if (bytes.size() > limit)
      wrong = "it is larger than " + std::to_string(limit >> 20) + " MiB";
  }
  fs::closeFile(*file);
  if (!wrong.empty())
    return cannotRead(wrong);
  return llvm::MemoryBuffer::getMemBufferCopy(llvm::StringRef(bytes.data(), bytes.size()), path);
}

} // namespace ncvet
