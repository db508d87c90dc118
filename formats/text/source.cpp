// Source buffers: opening files, positions, text for display.
#include "formats/text/source.h"

#include "formats/text/program_file.h"
#include "formats/text/system/system.h"

#include "llvm/Support/Path.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace ncvet {

namespace {

/// How far reading goes on before pages are given back: often enough that a big file costs little
/// memory, seldom enough that the system calls cost no time.
constexpr uint32_t forgetStep = 4u << 20;

/// Distance of the counters of code points, in bytes.
constexpr uint32_t countStep = 1u << 12;

void dropPages(llvm::StringRef bytes) { system::dropPages(bytes.begin(), bytes.end()); }

/// One name for one file: what `./a.nc` calls lies in the same folder as where `a.nc` is named.
std::string withoutDot(std::string name) {
  llvm::StringRef rest = name;
  while (rest.consume_front("./"))
    rest = rest.ltrim('/');
  return rest.empty() ? name : rest.str();
}

} // namespace

SourceFile::SourceFile(FileId id, std::string path, std::string display,
                       std::unique_ptr<llvm::MemoryBuffer> buffer)
    : id_(id), path_(withoutDot(std::move(path))), display_(withoutDot(std::move(display))),
      buffer_(std::move(buffer)), text_(buffer_->getBuffer()), lines_(text_) {}

llvm::Expected<std::unique_ptr<SourceFile>> SourceFile::open(FileId id, llvm::StringRef path,
                                                             llvm::StringRef display) {
  constexpr uint64_t limit = std::numeric_limits<uint32_t>::max(); // offsets have 32 bits
  auto buffer = readWholeFile(path, limit);
  if (!buffer) {
    std::error_code code;
    std::string why;
    llvm::handleAllErrors(buffer.takeError(), [&](const llvm::ErrorInfoBase &wrong) {
      code = wrong.convertToErrorCode();
      why = code == std::errc::file_too_large ? "it is 4 GiB or larger" : wrong.message();
    });
    return llvm::createStringError(code, "cannot read " + display + ": " + why);
  }
  return std::unique_ptr<SourceFile>(new SourceFile(
      id, path.str(), llvm::sys::path::convert_to_slash(display), std::move(*buffer)));
}

std::unique_ptr<SourceFile> SourceFile::fromText(FileId id, llvm::StringRef display,
                                                 llvm::StringRef text, llvm::StringRef path) {
  assert(text.size() <= std::numeric_limits<uint32_t>::max() && "offsets are 32 bit");
  return std::unique_ptr<SourceFile>(
      new SourceFile(id, path.str(), llvm::sys::path::convert_to_slash(display),
                     llvm::MemoryBuffer::getMemBufferCopy(text, display)));
}

std::unique_ptr<SourceFile> SourceFile::fromShared(FileId id, llvm::StringRef display,
                                                   SharedText text, llvm::StringRef path) {
  assert(text.bytes->size() <= std::numeric_limits<uint32_t>::max() && "offsets are 32 bit");
  auto file = std::unique_ptr<SourceFile>(new SourceFile(
      id, path.str(), llvm::sys::path::convert_to_slash(display),
      llvm::MemoryBuffer::getMemBuffer(*text.bytes, display, /*RequiresNullTerminator=*/false)));
  file->shared_ = std::move(text.bytes);
  if (text.lines)
    file->lines_ = *text.lines;
  return file;
}

Encoding SourceFile::encoding() const {
  if (!encoding_) {
    encoding_ = guessEncoding(text_);
    if (buffer_->getBufferKind() == llvm::MemoryBuffer::MemoryBuffer_MMap)
      dropPages(text_); // the whole file was read just for this
  }
  return *encoding_;
}

uint32_t SourceFile::continuationsBefore(uint32_t offset) const {
  const auto count = [this](uint32_t begin, uint32_t end) {
    return end - begin - countCodePoints(text(begin, end), Encoding::Utf8);
  };
  const uint32_t step = offset / countStep;
  while (continuations_.size() <= step) {
    const auto begin = static_cast<uint32_t>(continuations_.size() - 1) * countStep;
    continuations_.push_back(continuations_.back() + count(begin, begin + countStep));
  }
  return continuations_[step] + count(step * countStep, offset);
}

uint32_t SourceFile::codePointsIn(uint32_t begin, uint32_t end) const {
  const uint32_t bytes = end - begin;
  if (bytes <= countStep && isAscii(text(begin, end)))
    return bytes;
  if (encoding() != Encoding::Utf8)
    return bytes;
  if (bytes <= countStep)
    return countCodePoints(text(begin, end), Encoding::Utf8);
  return bytes - (continuationsBefore(end) - continuationsBefore(begin));
}

/// Counts lines up to `offset`, giving back what was counted: a report at the end of a large file
/// must not bring all of it into memory.
void SourceFile::countLines(uint32_t offset) const {
  const bool mapped = buffer_->getBufferKind() == llvm::MemoryBuffer::MemoryBuffer_MMap;
  for (uint32_t at = lines_.counted(); mapped && offset - std::min(at, offset) >= forgetStep;
       at += forgetStep) {
    lines_.lineOf(at + forgetStep);
    dropPages(text(at, at + forgetStep));
  }
}

LineColumn SourceFile::position(uint32_t offset) const {
  offset = std::min(offset, static_cast<uint32_t>(text_.size()));
  countLines(offset);
  const uint32_t begin = std::max(lines_.lineBegin(offset), std::min(textBegin(), offset));
  return {lines_.lineOf(offset), 1 + codePointsIn(begin, offset)};
}

std::string SourceFile::displayLine(uint32_t line) const {
  uint32_t begin = lines_.beginOfLine(line);
  const uint32_t end = lines_.lineEnd(begin);
  begin = std::max(begin, std::min(textBegin(), end));
  return displayText(text(begin, end));
}

std::string SourceFile::displayText(llvm::StringRef bytes) const {
  std::string out;
  out.reserve(bytes.size());
  appendDecoded(out, bytes, isAscii(bytes) ? Encoding::Utf8 : encoding());
  return out;
}

void SourceFile::eachPlaceOf(char c, llvm::function_ref<void(uint32_t)> visit) const {
  const char *const base = text_.data();
  for (size_t begin = 0; begin < text_.size(); begin += forgetStep) {
    const char *at = base + begin;
    const char *const end = base + std::min<size_t>(begin + forgetStep, text_.size());
    while (const void *found = std::memchr(at, c, size_t(end - at))) {
      at = static_cast<const char *>(found) + 1;
      visit(uint32_t(at - 1 - base));
    }
    forget(uint32_t(end - base));
  }
}

void SourceFile::forget(uint32_t offset) const {
  offset = std::min(offset, static_cast<uint32_t>(text_.size()));
  if (offset < forgotten_)
    forgotten_ = 0; // reading began anew, so the pages before are in memory again
  if (offset - forgotten_ < forgetStep)
    return;
  if (buffer_->getBufferKind() == llvm::MemoryBuffer::MemoryBuffer_MMap)
    dropPages(text(forgotten_, offset));
  forgotten_ = offset;
}

} // namespace ncvet
