// What stands where in one file: its programs, and on demand the block numbers in them.
#include "analyzer/program_index.h"

#include "llvm/ADT/StringExtras.h"

#include <algorithm>
#include <cstring>

namespace ncvet {

namespace {

/// Calls `visit(lineBegin, firstContent)` for every line of [begin, end). The pages that lie behind
/// are given back on the way.
template <typename Visit>
void eachLine(const SourceFile &source, size_t begin, size_t end, Visit visit) {
  const llvm::StringRef text = source.text();
  constexpr ptrdiff_t forgetStep = 4 << 20;
  const char *const base = text.data();
  const char *at = base + begin;
  const char *const stop = base + end;
  // Files with lone CR as line end are rare: look once.
  const bool lineFeeds = memchr(at, '\n', size_t(stop - at)) != nullptr;
  const char *forgotten = at;
  source.forget(0);
  while (at < stop) {
    if (at - forgotten >= forgetStep) {
      source.forget(uint32_t(at - base));
      forgotten = at;
    }
    const auto *next =
        static_cast<const char *>(memchr(at, lineFeeds ? '\n' : '\r', size_t(stop - at)));
    const char *content = at;
    while (content < stop && (*content == ' ' || *content == '\t' || *content == '\0'))
      ++content;
    if (content < stop)
      visit(uint32_t(at - base), uint32_t(content - base));
    if (!next)
      break;
    at = next + 1;
  }
}

} // namespace

namespace {

/// By the header (`%_N_SHAFT_MPF`) or, without one, by the ending of the file's name.
ProgramKind kindOf(const SourceFile &source, const ProgramInfo &program, const Dialect &dialect) {
  llvm::StringRef sign = source.text(program.headerBegin, program.headerEnd).rsplit('_').second;
  if (!program.hasHeader()) {
    const llvm::StringRef path = source.display();
    sign = path.contains('.') ? path.rsplit('.').second : llvm::StringRef();
  }
  const auto isOneOf = [&](const std::vector<std::string> &endings) {
    return llvm::any_of(endings,
                        [&](const std::string &one) { return sign.equals_insensitive(one); });
  };
  return isOneOf(dialect.mainExtensions)         ? ProgramKind::Main
         : isOneOf(dialect.subprogramExtensions) ? ProgramKind::Subprogram
                                                 : ProgramKind::Unknown;
}

} // namespace

FileIndex::FileIndex(const SourceFile &source, const Reader &reader, const Dialect &dialect)
    : source_(source), reader_(reader) {
  const llvm::StringRef text = source.text();
  const llvm::StringRef marks = dialect.lexical.headerMarks;
  Block block;
  ProgramInfo first;
  first.begin = first.body = reader.first();
  programs_.push_back(first);
  eachLine(source, reader.first(), text.size(), [&](uint32_t line, uint32_t content) {
    const char c = text[content];
    if (c == '%')
      tapeMarks_.push_back(line);
    if (marks.find(c) == llvm::StringRef::npos &&
        marks.find(llvm::toUpper(c)) == llvm::StringRef::npos)
      return;
    reader.read(line, block);
    if (!block.items.empty() && block.items[0].kind == ItemKind::Structure &&
        block.items[0].structure == Structure::Sub)
      subprograms_.push_back(line);
    if (block.kind != BlockKind::ProgramHeader)
      return;
    ProgramInfo program;
    program.number = block.program;
    program.name = text.slice(block.nameBegin, block.nameEnd).upper();
    program.begin = line;
    // Words behind the number stand in the header's block and are executed with it.
    program.body = line;
    program.headerBegin = block.headerBegin;
    program.headerEnd = block.headerEnd;
    if (programs_.size() == 1 && !programs_[0].hasHeader()) {
      // What stands in front of the first header is a leader (tape mark, comments) or a fragment.
      bool content_ = false;
      for (uint32_t at = programs_[0].begin; at < line;) {
        Block other;
        reader.read(at, other);
        content_ |= !other.isEmpty();
        at = other.next;
        if (at > programs_[0].begin + 65536)
          break;
      }
      if (!content_)
        programs_.clear();
    }
    programs_.push_back(program);
  });
  for (ProgramInfo &program : programs_)
    program.kind = kindOf(source, program, dialect);
  for (size_t i = 0; i < programs_.size(); ++i)
    programs_[i].end = i + 1 < programs_.size() ? programs_[i + 1].begin : uint32_t(text.size());
}

const ProgramInfo &FileIndex::programAt(uint32_t offset) const {
  auto at = std::upper_bound(programs_.begin(), programs_.end(), offset,
                             [](uint32_t o, const ProgramInfo &p) { return o < p.begin; });
  return at == programs_.begin() ? programs_.front() : *std::prev(at);
}

const ProgramInfo *FileIndex::find(int64_t number) const {
  for (const ProgramInfo &program : programs_)
    if (program.hasHeader() && program.number == number)
      return &program;
  return nullptr;
}

const ProgramInfo *FileIndex::find(llvm::StringRef name) const {
  for (const ProgramInfo &program : programs_)
    if (!program.name.empty() && name.equals_insensitive(program.name))
      return &program;
  return nullptr;
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
  looks_.anywhere = true;
  const llvm::ArrayRef<NumberedBlock> written = numbersAsWritten(program);
  Numbers &numbers = numbers_[program.begin];
  if (numbers.ascending)
    return written;
  if (numbers.sorted.empty()) {
    numbers.sorted = numbers.asWritten;
    std::stable_sort(numbers.sorted.begin(), numbers.sorted.end(), byNumber);
  }
  return numbers.sorted;
}

llvm::ArrayRef<NumberedBlock> FileIndex::numbersAsWritten(const ProgramInfo &program) const {
  looks_.anywhere = true;
  const auto found = numbers_.find(program.begin);
  if (found != numbers_.end())
    return found->second.asWritten;
  Numbers &numbers = numbers_[program.begin];
  std::vector<NumberedBlock> &list = numbers.asWritten;
  const llvm::StringRef text = source_.text();
  eachLine(source_, program.begin, program.end, [&](uint32_t line, uint32_t content) {
    uint32_t at = content;
    // Block skip may stand in front of the number.
    while (at < program.end &&
           (text[at] == '/' || (text[at] >= '0' && text[at] <= '9') || text[at] == ' '))
      ++at;
    if (at >= program.end || (text[at] != 'N' && text[at] != 'n'))
      return;
    ++at;
    while (at < program.end && text[at] == ' ')
      ++at;
    int64_t number = 0;
    unsigned digits = 0;
    while (at < program.end && text[at] >= '0' && text[at] <= '9' && digits < 12) {
      number = number * 10 + (text[at++] - '0');
      ++digits;
    }
    if (digits)
      list.push_back({number, line});
  });
  numbers.ascending = std::is_sorted(list.begin(), list.end(), byNumber);
  return list;
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
  if (!fresh)
    return labels;
  Block block;
  for (uint32_t at = program.begin; at < program.end; at = block.next) {
    reader_.read(at, block);
    if (block.hasLabel())
      labels[reader_.labelKey(source_.text(block.labelBegin, block.labelEnd))].push_back(at);
  }
  return labels;
}

const FileIndex::Definitions &FileIndex::definitions(const ProgramInfo &program) const {
  looks_.anywhere = true;
  const auto [known, fresh] = definitions_.try_emplace(program.begin);
  Definitions &definitions = known->second;
  if (!fresh)
    return definitions;
  Block block;
  for (uint32_t at = program.begin; at < program.end; at = block.next) {
    reader_.read(at, block);
    for (const Item &item : block.items) {
      if (item.kind != ItemKind::Definition && item.kind != ItemKind::Declaration &&
          item.kind != ItemKind::Parameters && item.kind != ItemKind::Macro)
        continue;
      definitions.try_emplace(
          source_.text(item.nameBegin, item.nameEnd).upper(),
          Defined{item.kind, item.type, item.arguments != 0, item.nameBegin, item.nameEnd});
      if (item.kind == ItemKind::Parameters)
        for (const Argument &parameter : block.argumentsOf(item))
          definitions.try_emplace(
              source_.text(parameter.begin, parameter.end).upper(),
              Defined{ItemKind::Definition, parameter.type, false, parameter.begin, parameter.end});
    }
  }
  return definitions;
}

const Defined *FileIndex::definition(const ProgramInfo &program, llvm::StringRef name) const {
  const Definitions &all = definitions(program);
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

llvm::ArrayRef<Suppression> FileIndex::suppressions() const {
  if (!suppressions_)
    suppressions_ = findSuppressions(source_, reader_);
  return *suppressions_;
}

} // namespace ncvet
