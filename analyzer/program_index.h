// What stands where in one file: its programs, and on demand the block numbers in them.
#pragma once

#include "analyzer/suppress.h"
#include "formats/readers/reader.h"
#include "formats/text/source.h"

#include "llvm/ADT/DenseMap.h"

#include <vector>

namespace ncvet {

/// One program of a file.
struct ProgramInfo {
  int64_t number = -1; ///< -1: no readable number
  uint32_t begin = 0;  ///< first byte: of the header, or of the text when there is none
  uint32_t body = 0;   ///< first block to execute
  uint32_t end = 0;    ///< behind the last byte
  uint32_t headerBegin = 0, headerEnd = 0; ///< equal: no header
  bool hasHeader() const { return headerEnd > headerBegin; }
};

/// A block with a number.
struct NumberedBlock {
  int64_t number = 0;
  uint32_t offset = 0;
};

/// Index of one file, from one light scan of its lines; block numbers are collected when the first
/// jump, local call or profile asks for them.
class FileIndex {
public:
  FileIndex(const SourceFile &source, const Reader &reader, const Dialect &dialect);

  llvm::ArrayRef<ProgramInfo> programs() const { return programs_; }
  /// The program that holds `offset`.
  const ProgramInfo &programAt(uint32_t offset) const;
  /// First program with this number, or null.
  const ProgramInfo *find(int64_t number) const;
  /// Offset of the block numbered `number` in the program: the first one behind `from`, else the
  /// first in the program. None: no such block.
  std::optional<uint32_t> block(const ProgramInfo &program, int64_t number, uint32_t from) const;
  /// All numbered blocks of the program, sorted by number, then offset.
  llvm::ArrayRef<NumberedBlock> numbers(const ProgramInfo &program) const;
  /// The same in the order in which they are written.
  llvm::ArrayRef<NumberedBlock> numbersAsWritten(const ProgramInfo &program) const;
  /// Offsets of the lines that hold a tape mark `%` first, ascending.
  llvm::ArrayRef<uint32_t> tapeMarks() const { return tapeMarks_; }
  /// The suppression comments of the file; looked for when first asked.
  llvm::ArrayRef<Suppression> suppressions() const;
  const SourceFile &source() const { return source_; }
  const Reader &reader() const { return reader_; }

private:
  const SourceFile &source_;
  const Reader &reader_;
  std::vector<ProgramInfo> programs_;
  std::vector<uint32_t> tapeMarks_;
  struct Numbers {
    std::vector<NumberedBlock> asWritten;
    std::vector<NumberedBlock> sorted; ///< empty while not asked for, or when sorted as written
    bool ascending = false;
  };
  mutable llvm::DenseMap<uint32_t, Numbers> numbers_; ///< by program's begin
  mutable std::optional<std::vector<Suppression>> suppressions_;
};

} // namespace ncvet
