// Source buffers: the immutable bytes of one input file, and positions in them.
#pragma once

#include "formats/text/encoding.h"
#include "formats/text/line_index.h"

#include "llvm/ADT/STLExtras.h"
#include "llvm/ADT/StringRef.h"
#include "llvm/Support/Error.h"
#include "llvm/Support/MemoryBuffer.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ncvet {

/// Number of a file within one run; the index into `SourceSet`.
using FileId = uint32_t;

/// Half-open byte range [begin, end) of one file.
struct SourceRange {
  FileId file = 0;
  uint32_t begin = 0;
  uint32_t end = 0;

  bool empty() const { return begin >= end; }
  friend bool operator==(const SourceRange &a, const SourceRange &b) {
    return a.file == b.file && a.begin == b.begin && a.end == b.end;
  }
};

/// Line and column, both from 1; the column counts Unicode code points.
struct LineColumn {
  uint32_t line = 1;
  uint32_t column = 1;
};

struct TextHistory; // formats/text/text_change.h

/// A version of a text that several look at.
struct SharedText {
  std::shared_ptr<const std::string> bytes;
  std::shared_ptr<const LineIndex> lines;     ///< all counted; null: not known
  std::shared_ptr<const TextHistory> history; ///< null: not known

  SharedText() = default;
  SharedText(std::shared_ptr<const std::string> text) : bytes(std::move(text)) {}
};

/// One input file, never changed after it was made. Offsets are 32 bit: a file of 4 GiB or more is
/// refused by `SourceFile::open`. Positions are cached: one thread at a time may ask for them.
class SourceFile {
public:
  /// Reads or maps `path`. `display` is the name that reports show. Fails with one line that
  /// names the file for what cannot be read, folders, devices and files of 4 GiB or more.
  static llvm::Expected<std::unique_ptr<SourceFile>> open(FileId id, llvm::StringRef path,
                                                          llvm::StringRef display);
  /// Wraps text that is already in memory (standard input, an editor's buffer, a test). `path`,
  /// when given, is its place on disk; it is not read.
  static std::unique_ptr<SourceFile> fromText(FileId id, llvm::StringRef display,
                                              llvm::StringRef text, llvm::StringRef path = {});

  /// The same over text that others hold as well; it is not copied.
  static std::unique_ptr<SourceFile> fromShared(FileId id, llvm::StringRef display, SharedText text,
                                                llvm::StringRef path = {});

  FileId id() const { return id_; }
  /// Name shown in reports: as given on the command line, `/` as separator.
  const std::string &display() const { return display_; }
  /// Path on disk, empty for text without a file.
  const std::string &path() const { return path_; }
  /// All bytes, a byte order mark included. No zero byte follows them.
  llvm::StringRef text() const { return text_; }
  llvm::StringRef text(uint32_t begin, uint32_t end) const { return text_.slice(begin, end); }
  /// Offset of the first byte that is program text: 3 after a byte order mark, else 0.
  uint32_t textBegin() const { return byteOrderMark(text_); }
  /// Found out when first asked for, by `guessEncoding`.
  Encoding encoding() const;
  const LineIndex &lines() const { return lines_; }
  /// Position of a byte offset (clamped to the file). A byte order mark takes no column.
  LineColumn position(uint32_t offset) const;
  /// Text of line `line` (from 1) without its end, decoded to UTF-8 for display.
  std::string displayLine(uint32_t line) const;
  /// `bytes` of this file decoded to valid UTF-8 for display.
  std::string displayText(llvm::StringRef bytes) const;
  /// Calls `visit` with the offset of every byte `c`, ascending, at the speed of memory; the pages
  /// that were passed are given back meanwhile.
  void eachPlaceOf(char c, llvm::function_ref<void(uint32_t)> visit) const;
  /// Tells the system that the pages before `offset` are not needed soon, so that a mapped
  /// file does not count as memory in use. Cheap; a hint only.
  void forget(uint32_t offset) const;

private:
  /// Code points in [begin, end).
  uint32_t codePointsIn(uint32_t begin, uint32_t end) const;
  /// UTF-8 bytes before `offset` that begin no code point.
  void countLines(uint32_t offset) const;
  uint32_t continuationsBefore(uint32_t offset) const;

  SourceFile(FileId id, std::string path, std::string display,
             std::unique_ptr<llvm::MemoryBuffer> buffer);

  FileId id_;
  std::string path_;
  std::string display_;
  std::shared_ptr<const std::string> shared_; ///< what the buffer is a view of; or null
  std::unique_ptr<llvm::MemoryBuffer> buffer_;
  llvm::StringRef text_;
  LineIndex lines_;
  mutable uint32_t forgotten_ = 0;
  mutable std::optional<Encoding> encoding_;
  /// Bytes before each 4 KiB step that begin no code point, as far as was ever asked: a line
  /// may be as long as the file.
  mutable std::vector<uint32_t> continuations_ = {0};
};

} // namespace ncvet
