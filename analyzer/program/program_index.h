// What is where in one file: its programs, and on demand the block numbers in them.
#pragma once

#include "analyzer/program/file_scan.h"
#include "analyzer/program/suppress.h"
#include "formats/readers/reader.h"
#include "formats/text/source.h"
#include "interp/value/work_meter.h"

#include "llvm/ADT/DenseMap.h"
#include "llvm/ADT/StringMap.h"

#include <string>
#include <vector>

namespace ncvet {

/// What the text or the file's name says a program is.
enum class ProgramKind : uint8_t { Unknown, Main, Subprogram };

/// What the control files under names with such an ending, `MPF` or `SPF`, in either case.
ProgramKind kindOfEnding(llvm::StringRef ending, const Dialect &dialect);

/// One program of a file.
struct ProgramInfo {
  int64_t number = -1; ///< -1: no readable number
  std::string name;    ///< in capitals; empty when the header gives none
  uint32_t begin = 0;  ///< first byte: of the header, or of the text when there is none
  uint32_t body = 0;   ///< first block to execute
  uint32_t end = 0;    ///< after the last byte
  uint32_t headerBegin = 0, headerEnd = 0; ///< equal: no header
  ProgramKind kind = ProgramKind::Unknown;
  bool hasHeader() const { return headerEnd > headerBegin; }
};

/// Where a jump looks for its target.
enum class Search : uint8_t {
  Anywhere, ///< after the jump, then from the program's begin
  Forward,
  Backward ///< the nearest before the jump
};

/// Index of one file, from one light scan of its lines; block numbers are collected when the first
/// jump, local call or profile asks for them.
class FileIndex {
public:
  /// `kept`, when given, is what earlier versions of the text have left.
  FileIndex(const SourceFile &source, const Reader &reader, const Dialect &dialect,
            FileScan *kept = nullptr);

  llvm::ArrayRef<ProgramInfo> programs() const { return programs_; }
  /// The program that holds `offset`.
  const ProgramInfo &programAt(uint32_t offset) const;
  /// First program with this number, or null.
  const ProgramInfo *find(int64_t number) const;
  /// First program with this name, in capitals or not; null.
  const ProgramInfo *find(llvm::StringRef name) const;
  /// Offset of the block numbered `number` in the program, looked for from the block at `from`.
  /// None: no such block.
  std::optional<uint32_t> block(const ProgramInfo &program, int64_t number, uint32_t from,
                                Search search = Search::Anywhere) const;
  /// Offset of the block with this label (as the text spells it), in the same way.
  std::optional<uint32_t> label(const ProgramInfo &program, llvm::StringRef label, uint32_t from,
                                Search search = Search::Anywhere) const;
  /// All labels of the program by key, each with its blocks in text order.
  using Labels = llvm::StringMap<std::vector<uint32_t>>;
  const Labels &labels(const ProgramInfo &program) const;
  /// All numbered blocks of the program, sorted by number, then offset.
  llvm::ArrayRef<NumberedBlock> numbers(const ProgramInfo &program) const;
  /// The same in the order in which they are written.
  llvm::ArrayRef<NumberedBlock> numbersAsWritten(const ProgramInfo &program) const;
  /// Variables, parameters, declared programs and macros of the program by name, in capitals.
  using Definitions = llvm::StringMap<Defined>;
  const Definitions &definitions(const ProgramInfo &program) const;
  /// Calls `read` for the blocks of [begin, end) until it says false. Pieces whose blocks are all
  /// plain, and of which `pass` says true, are left out. `begin` is that of a block.
  void eachBlock(uint32_t begin, uint32_t end,
                 llvm::function_ref<bool(uint32_t at, const Block &)> read,
                 llvm::function_ref<bool(const TextPiece &)> pass) const;
  /// Calls `visit` for the pieces of the whole text.
  void eachPiece(llvm::function_ref<void(const TextPiece &)> visit) const;
  /// The piece of [begin, end) that begins with the block at `begin`, and what it holds; until the
  /// next call.
  const TextPiece &pieceAt(uint32_t begin, uint32_t end) const {
    looks_.anywhere = true;
    return scan_.pieceAt(pieces_, begin, end);
  }
  /// One of the definitions, or null.
  const Defined *definition(const ProgramInfo &program, llvm::StringRef name) const;
  /// Offsets of the lines that hold a tape mark `%` first, ascending.
  llvm::ArrayRef<uint32_t> tapeMarks() const { return tapeMarks_; }
  /// The suppression comments of the file; looked for when first asked.
  llvm::ArrayRef<Suppression> suppressions(RulesOfName rulesOf) const;
  /// Calls `visit` with the offset of every byte `c`, ascending.
  void eachPlaceOf(char c, llvm::function_ref<void(uint32_t)> visit) const;
  /// Offsets of the lines that open a subprogram between brackets (`o100 sub`), ascending.
  llvm::ArrayRef<uint32_t> subprograms() const { return subprograms_; }
  const SourceFile &source() const { return source_; }
  /// Reads a block of the text that is not the current one.
  void read(uint32_t offset, Block &block) const {
    reader_.read(offset, block);
    noteRead(offset, block.next);
  }
  /// The block at `begin` was looked at, whoever has read it.
  void noteRead(uint32_t begin, uint32_t next) const {
    ++workDone;
    looks_.from = std::min(looks_.from, begin);
    looks_.to = std::max(looks_.to, next);
    if (places_)
      noteIn(*places_, begin, next);
  }
  /// For any reading of the text; who looks at one block says so by `read`.
  const Reader &reader() const {
    looks_.anywhere = true;
    return reader_;
  }
  /// What was looked at beside the current blocks.
  struct Looks {
    uint32_t from = ~0u, to = 0;
    bool anywhere = false; ///< it cannot be said where

    Looks &operator|=(const Looks &other) {
      from = std::min(from, other.from);
      to = std::max(to, other.to);
      anywhere |= other.anywhere;
      return *this;
    }
  };
  Looks looks() const { return looks_; }
  /// What has been looked at since the last call.
  Looks takeLooks() const { return std::exchange(looks_, Looks()); }
  /// From now on each place that is looked at is noted there as well; null: no more.
  using Places = std::vector<std::pair<uint32_t, uint32_t>>;
  void notePlaces(Places *places) const { places_ = places; }

private:
  /// What follows the last place, or is a part of it, makes it longer.
  static void noteIn(Places &places, uint32_t begin, uint32_t next) {
    if (!places.empty() && begin >= places.back().first && begin <= places.back().second)
      places.back().second = std::max(places.back().second, next);
    else
      places.emplace_back(begin, next);
  }

  mutable Looks looks_;
  mutable Places *places_ = nullptr;
  const SourceFile &source_;
  const Reader &reader_;
  const PieceReader pieces_;
  std::unique_ptr<FileScan> own_; ///< when nothing is kept
  FileScan &scan_;
  const bool keeps_;
  std::vector<ProgramInfo> programs_;
  llvm::DenseMap<int64_t, uint32_t> byNumber_; ///< index of the first program with the number
  llvm::StringMap<uint32_t> byName_;           ///< the same for names, in capitals
  std::vector<uint32_t> tapeMarks_;
  std::vector<uint32_t> subprograms_;
  struct Numbers {
    std::vector<NumberedBlock> sorted; ///< empty when sorted as written
    bool ascending = false;
  };
  mutable llvm::DenseMap<uint32_t, Numbers> numbers_;         ///< by program's begin
  mutable llvm::DenseMap<uint32_t, Labels> labels_;           ///< by program's begin
  mutable llvm::DenseMap<uint32_t, Definitions> definitions_; ///< by program's begin
  mutable std::optional<std::vector<Suppression>> suppressions_;
};

/// Reads the first block of the program that holds more than a comment: the one that says what the
/// program takes, where it does. An empty block: there is none.
Block headOf(const FileIndex &index, const ProgramInfo &program);

} // namespace ncvet
