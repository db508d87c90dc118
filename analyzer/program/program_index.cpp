// What is where in one file: its programs, and on demand the block numbers in them.
#include "analyzer/program/program_index.h"

#include "analyzer/program/block_reading.h"
#include "formats/dialect/control_facts.h"
#include "formats/readers/quick_reader.h"

#include "llvm/ADT/StringExtras.h"

#include <algorithm>
#include <cstring>

namespace ncvet {

namespace {

/// By the header (`%_N_SHAFT_MPF`) or, without one, by the ending of the file's name.
ProgramKind kindOf(const SourceFile &source, const ProgramInfo &program, const Dialect &dialect) {
  llvm::StringRef sign = source.text(program.headerBegin, program.headerEnd).rsplit('_').second;
  if (!program.hasHeader()) {
    const llvm::StringRef path = source.display();
    sign = path.contains('.') ? path.rsplit('.').second : llvm::StringRef();
  }
  return kindOfEnding(sign, dialect);
}

/// `PROC NAME(..)` is its first block: a caller hands them over, whatever its file is called.
bool takesParameters(const SourceFile &source, const Reader &reader, const ProgramInfo &program) {
  constexpr unsigned furthest = 20; // blocks: comments, and the header
  Block block;
  uint32_t at = program.body;
  for (unsigned i = 0; i < furthest && at < source.text().size(); ++i, at = block.next) {
    reader.read(at, block);
    if (block.isEmpty() || block.kind != BlockKind::Normal)
      continue;
    return !block.items.empty() && block.items.front().kind == ItemKind::Parameters &&
           block.items.front().arguments > 0;
  }
  return false;
}

/// The whole file is data of the control, by the ending of its name.
bool isDataFile(const SourceFile &source, const Dialect &dialect) {
  const llvm::StringRef ending = llvm::StringRef(source.display()).rsplit('.').second;
  return llvm::any_of(dialect.facts->program.dataKinds,
                      [&](llvm::StringRef one) { return ending.equals_insensitive(one); }) &&
         kindOfEnding(ending, dialect) == ProgramKind::Unknown;
}

/// What comes before the first header is looked at so far, in bytes: a fragment shows soon.
constexpr uint32_t longestLeader = 65536;

/// The text before the first mark of the tape is for people: comments, and lines without any digit,
/// of which none can be a block.
bool isLeaderText(llvm::StringRef text) {
  llvm::SmallVector<llvm::StringRef, 8> lines;
  text.take_front(longestLeader).split(lines, '\n', /*MaxSplit=*/-1, /*KeepEmpty=*/false);
  bool says = false;
  for (llvm::StringRef line : lines) {
    line = line.trim();
    if (!line.empty() && !line.startswith("(") && llvm::any_of(line, llvm::isDigit))
      return false;
    says |= !line.empty();
  }
  return says;
}

bool isHeaderMark(char c, const Dialect &dialect) {
  const llvm::StringRef marks = dialect.lexical.headerMarks;
  return marks.contains(c) || marks.contains(llvm::toUpper(c));
}

/// Whether blocks from `at` on have nothing to execute, up to the line `end` or about `limit`.
bool isEmpty(const Reader &reader, uint32_t at, uint32_t end, uint32_t limit) {
  Block block;
  for (; at < end && at <= limit; at = block.next) {
    reader.read(at, block);
    if (!block.isEmpty())
      return false;
  }
  return true;
}

ProgramInfo programOf(const Block &header, llvm::StringRef text) {
  ProgramInfo program;
  program.number = header.program;
  program.name = text.slice(header.nameBegin, header.nameEnd).upper();
  // Words after the number are in the header's block and are executed with it.
  program.begin = program.body = header.begin;
  program.headerBegin = header.headerBegin;
  program.headerEnd = header.headerEnd;
  return program;
}

bool isBracket(const Block &block, Structure structure) {
  return !block.items.empty() && block.items[0].kind == ItemKind::Structure &&
         block.items[0].structure == structure;
}

} // namespace

ProgramKind kindOfEnding(llvm::StringRef ending, const Dialect &dialect) {
  const auto isOneOf = [&](const std::vector<std::string> &endings) {
    return llvm::any_of(endings,
                        [&](const std::string &one) { return ending.equals_insensitive(one); });
  };
  return isOneOf(dialect.mainExtensions)         ? ProgramKind::Main
         : isOneOf(dialect.subprogramExtensions) ? ProgramKind::Subprogram
                                                 : ProgramKind::Unknown;
}

FileIndex::FileIndex(const SourceFile &source, const Reader &reader, const Dialect &dialect,
                     FileScan *kept)
    : source_(source), reader_(reader), pieces_(source, reader, dialect),
      own_(kept ? nullptr : std::make_unique<FileScan>()), scan_(kept ? *kept : *own_),
      keeps_(kept) {
  const llvm::StringRef text = source.text();
  const std::string marks = dialect.lexical.headerMarks + '%';
  Block block;
  bool insideSub = false;
  ProgramInfo first;
  first.begin = first.body = reader.first();
  programs_.push_back(first);
  for (const uint32_t line : scan_.heads(source, marks)) {
    const char c = text[text.find_first_not_of(llvm::StringRef(" \t\0", 3), line)];
    if (c == '%')
      tapeMarks_.push_back(line);
    if (!isHeaderMark(c, dialect))
      continue;
    reader.read(line, block);
    const bool opens = isBracket(block, Structure::Sub);
    if (opens)
      subprograms_.push_back(line);
    insideSub = opens || (insideSub && !isBracket(block, Structure::EndSub));
    // `O103` alone inside `o<name> sub` begins nothing: its keyword is missing.
    if (block.kind != BlockKind::ProgramHeader || insideSub)
      continue;
    if (programs_.size() == 1 && !programs_[0].hasHeader()) {
      // What comes before the first header is a leader (tape mark, comments) or a fragment.
      const bool leader = dialect.lexical.tapeLeader && !tapeMarks_.empty();
      if (isEmpty(reader, leader ? tapeMarks_.back() : programs_[0].begin, line,
                  programs_[0].begin + longestLeader))
        programs_.clear();
    }
    programs_.push_back(programOf(block, text));
  }
  if (programs_.size() == 1 && !programs_[0].hasHeader()) {
    if (isDataFile(source, dialect))
      programs_[0].begin = programs_[0].body = uint32_t(text.size());
    else if (dialect.lexical.tapeLeader && !tapeMarks_.empty() &&
             isLeaderText(text.take_front(tapeMarks_.front())))
      programs_[0].begin = programs_[0].body = tapeMarks_.front();
  }
  for (ProgramInfo &program : programs_) {
    program.kind = kindOf(source, program, dialect);
    if (program.kind == ProgramKind::Main && takesParameters(source, reader, program))
      program.kind = ProgramKind::Subprogram;
  }
  for (uint32_t i = 0; i < programs_.size(); ++i) {
    if (programs_[i].hasHeader())
      byNumber_.try_emplace(programs_[i].number, i);
    if (!programs_[i].name.empty())
      byName_.try_emplace(programs_[i].name, i);
  }
  for (size_t i = 0; i < programs_.size(); ++i)
    programs_[i].end = i + 1 < programs_.size() ? programs_[i + 1].begin : uint32_t(text.size());
}

const ProgramInfo &FileIndex::programAt(uint32_t offset) const {
  auto at = std::upper_bound(programs_.begin(), programs_.end(), offset,
                             [](uint32_t o, const ProgramInfo &p) { return o < p.begin; });
  return at == programs_.begin() ? programs_.front() : *std::prev(at);
}

const ProgramInfo *FileIndex::find(int64_t number) const {
  const auto known = byNumber_.find(number);
  return known == byNumber_.end() ? nullptr : &programs_[known->second];
}

const ProgramInfo *FileIndex::find(llvm::StringRef name) const {
  const auto known = byName_.find(name.upper());
  return known == byName_.end() ? nullptr : &programs_[known->second];
}

namespace {

/// Of offsets in text order the one that a search from `from` finds.
template <typename Range, typename Offset>
std::optional<uint32_t> found(const Range &range, uint32_t from, Search search, Offset offsetOf) {
  std::optional<uint32_t> before;
  for (const auto &entry : range) {
    const uint32_t offset = offsetOf(entry);
    if (offset > from) {
      if (search != Search::Backward)
        return offset;
      break;
    }
    if (!before || search == Search::Backward)
      before = offset;
  }
  return search == Search::Forward ? std::nullopt : before;
}

bool byNumber(const NumberedBlock &a, const NumberedBlock &b) { return a.number < b.number; }
} // namespace

llvm::ArrayRef<NumberedBlock> FileIndex::numbers(const ProgramInfo &program) const {
  const llvm::ArrayRef<NumberedBlock> written = numbersAsWritten(program);
  const auto [known, fresh] = numbers_.try_emplace(program.begin);
  Numbers &numbers = known->second;
  if (fresh) {
    numbers.ascending = llvm::is_sorted(written, byNumber);
    if (!numbers.ascending) {
      numbers.sorted = written.vec();
      std::stable_sort(numbers.sorted.begin(), numbers.sorted.end(), byNumber);
    }
  }
  return numbers.ascending ? written : llvm::makeArrayRef(numbers.sorted);
}

llvm::ArrayRef<NumberedBlock> FileIndex::numbersAsWritten(const ProgramInfo &program) const {
  looks_.anywhere = true;
  const auto before = [](const NumberedBlock &block, uint32_t offset) {
    return block.offset < offset;
  };
  const std::vector<NumberedBlock> &all = scan_.numbers(source_);
  const auto first = std::lower_bound(all.begin(), all.end(), program.begin, before);
  const auto last = std::lower_bound(first, all.end(), program.end, before);
  return llvm::makeArrayRef(all).slice(size_t(first - all.begin()), size_t(last - first));
}

std::optional<uint32_t> FileIndex::block(const ProgramInfo &program, int64_t number, uint32_t from,
                                         Search search) const {
  const llvm::ArrayRef<NumberedBlock> list = numbers(program);
  const auto [first, last] =
      std::equal_range(list.begin(), list.end(), NumberedBlock{number, 0}, byNumber);
  return found(llvm::makeArrayRef(first, last), from, search,
               [](const NumberedBlock &block) { return block.offset; });
}

const FileIndex::Labels &FileIndex::labels(const ProgramInfo &program) const {
  looks_.anywhere = true;
  const auto [known, fresh] = labels_.try_emplace(program.begin);
  Labels &labels = known->second;
  const auto *const quick = dynamic_cast<const QuickReader *>(&reader_);
  if (fresh && (!quick || quick->mayHoldLabels(program.begin, program.end)))
    scan_.eachPiece(pieces_, program.begin, program.end, [&](const auto &piece) {
      for (const auto &[key, block] : piece.labels)
        labels[key].push_back(block);
      return true;
    });
  return labels;
}

const FileIndex::Definitions &FileIndex::definitions(const ProgramInfo &program) const {
  looks_.anywhere = true;
  const auto [known, fresh] = definitions_.try_emplace(program.begin);
  Definitions &definitions = known->second;
  if (fresh)
    scan_.eachPiece(pieces_, program.begin, program.end, [&](const auto &piece) {
      for (const auto &[name, defined] : piece.definitions)
        definitions.try_emplace(name, defined);
      return true;
    });
  return definitions;
}

void FileIndex::eachBlock(uint32_t begin, uint32_t end,
                          llvm::function_ref<bool(uint32_t, const Block &)> read,
                          llvm::function_ref<bool(const TextPiece &)> pass) const {
  looks_.anywhere = true;
  scan_.eachPiece(pieces_, begin, end, [&](const TextPiece &piece) {
    if (piece.isPlain && pass(piece))
      return true;
    for (const Block &block : blocks(reader_, piece.begin, piece.end)) {
      if (!read(block.begin, block))
        return false;
    }
    return true;
  });
}

void FileIndex::eachPiece(llvm::function_ref<void(const TextPiece &)> visit) const {
  const auto end = uint32_t(source_.text().size());
  looks_.anywhere = true;
  scan_.eachPiece(pieces_, reader_.first(), end, [&](const TextPiece &piece) {
    visit(piece);
    return true;
  });
}

const Defined *FileIndex::definition(const ProgramInfo &program, llvm::StringRef name) const {
  const Definitions &all = definitions(program);
  if (all.empty()) // as on controls whose variables have numbers, and they ask with every block
    return nullptr;
  const auto known = all.find(name.upper());
  return known == all.end() ? nullptr : &known->second;
}

std::optional<uint32_t> FileIndex::label(const ProgramInfo &program, llvm::StringRef label,
                                         uint32_t from, Search search) const {
  const Labels &all = labels(program);
  const auto known = all.find(reader_.labelKey(label));
  if (known == all.end())
    return std::nullopt;
  return found(known->second, from, search, [](uint32_t offset) { return offset; });
}

llvm::ArrayRef<Suppression> FileIndex::suppressions(RulesOfName rulesOf) const {
  // A colon is rare in programs, and one byte is found at the speed of memory.
  if (!suppressions_)
    suppressions_ = findSuppressions(
        source_, reader_, [this](auto visit) { eachPlaceOf(':', visit); }, rulesOf);
  return *suppressions_;
}

void FileIndex::eachPlaceOf(char c, llvm::function_ref<void(uint32_t)> visit) const {
  looks_.anywhere = true;
  const std::vector<uint32_t> *known = keeps_ ? scan_.places(source_, c) : nullptr;
  if (known)
    std::for_each(known->begin(), known->end(), visit);
  else
    source_.eachPlaceOf(c, visit);
}

Block headOf(const FileIndex &index, const ProgramInfo &program) {
  Block head;
  for (const Block &block : blocks(index, program.body, program.end))
    if (!block.isEmpty()) {
      head = block;
      break;
    }
  return head;
}

} // namespace ncvet
