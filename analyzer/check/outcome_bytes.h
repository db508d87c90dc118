// What the check of a file found, as bytes that a later run reads.
#pragma once

#include "analyzer/check/checker.h"

namespace ncvet {

/// The outcome of the check of `file`; findings may lie in other files of `sources`.
std::string outcomeBytes(const FileOutcome &outcome, const SourceFile &file,
                         const SourceSet &sources);

/// The outcome that the bytes are; `open` gives files that findings lie in by their paths, or null.
/// None when the bytes are none, or do not go with the texts of the files.
std::optional<FileOutcome> outcomeOf(llvm::StringRef bytes, const SourceFile &file,
                                     llvm::function_ref<const SourceFile *(llvm::StringRef)> open);

/// A reader and a writer of numbers and texts, for what else is kept beside outcomes.
class ByteWriter {
public:
  void number(uint64_t value);
  void text(llvm::StringRef value);
  std::string take() { return std::move(bytes_); }

private:
  std::string bytes_;
};

/// After something that cannot be read everything is 0 and empty, and `failed` says so.
class ByteReader {
public:
  explicit ByteReader(llvm::StringRef bytes) : rest_(bytes) {}

  uint64_t number();
  /// A number below `end`.
  uint64_t number(uint64_t end);
  llvm::StringRef text();
  llvm::StringRef rest() const { return rest_; }
  bool failed() const { return failed_; }
  void fail() {
    failed_ = true;
    rest_ = {};
  }

private:
  llvm::StringRef rest_;
  bool failed_ = false;
};

} // namespace ncvet
