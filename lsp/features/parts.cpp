// The parts of a program text that people speak of: tool sections, operations, profiles, loops.
#include "lsp/features/parts.h"

#include "analyzer/facts/generated_block.h"
#include "analyzer/program/flow_shape.h"
#include "formats/readers/table_words.h"

#include <algorithm>
#include <set>

namespace ncvet::lsp {

namespace {

/// Most targets of local calls and of profiles that are looked for.
constexpr unsigned mostAsked = 5000;

/// Reads the parts of a document, one block after the other.
class PartReader {
public:
  explicit PartReader(Snapshot &snapshot)
      : snapshot_(snapshot), unit_(snapshot.unit()), dialect_(snapshot.dialect()),
        text_(snapshot.text()) {}

  std::vector<Part> read();

private:
  void program(const ProgramInfo &program);
  void block();
  void comments();
  void endComments();
  void tool();
  bool isToolWord(const Word &word);
  void codes();
  void operation(const Word &word, CodeIndex code);
  void label();
  void generated();
  void endProgram();
  void endSection(std::vector<Part> &sections, uint32_t end);
  void endOperation(uint32_t end);
  void profiles();
  void localSubprograms();
  void bracketSubprograms();
  void note(Part &part) const;

  Part part(PartKind kind, uint32_t nameBegin, uint32_t nameEnd) const {
    Part part;
    part.kind = kind;
    part.begin = contentBegin_;
    part.end = contentEnd_;
    part.nameBegin = nameBegin;
    part.nameEnd = nameEnd;
    return part;
  }
  bool isFull() const { return parts_.size() >= mostParts; }
  /// After the last byte before `end` that is no blank, line end or mark of a tape's end.
  uint32_t trimmed(uint32_t begin, uint32_t end) const {
    constexpr llvm::StringLiteral nothing(" \t\r\n%\x1A");
    while (end > begin && (nothing.contains(text_[end - 1]) || text_[end - 1] == '\0'))
      --end;
    return end;
  }
  void takeContent() {
    contentBegin_ = block_.begin;
    while (contentBegin_ < block_.end &&
           (text_[contentBegin_] == ' ' || text_[contentBegin_] == '\t'))
      ++contentBegin_;
    contentEnd_ = trimmed(contentBegin_, std::max(contentBegin_, block_.end));
  }

  Snapshot &snapshot_;
  FileUnit &unit_;
  const Dialect &dialect_;
  const llvm::StringRef text_;
  std::vector<Part> parts_;
  Block block_;
  uint32_t contentBegin_ = 0, contentEnd_ = 0; ///< of the current block
  uint32_t lastEnd_ = 0;                       ///< after the last block with code
  std::vector<uint32_t> returns_;              ///< ends of the blocks that return
  // of the current program
  std::vector<Part> changes_, tools_;    ///< sections by changes, and by T words where none changes
  bool sectionOpen_[2] = {false, false}; ///< the last of `changes_`, of `tools_`
  bool operationOpen_ = false;
  size_t operation_ = 0;
  int64_t station_ = -1;                   ///< tool of the last T word, where it changes the tool
  uint32_t toolBegin_ = 0, toolEnd_ = 0;   ///< the last T word
  uint32_t aboveBegin_ = 0, aboveEnd_ = 0; ///< comment on a line of its own right above the block
  uint32_t runBegin_ = 0, runEnd_ = 0;     ///< lines of comments that are being read
  unsigned runLines_ = 0;
};

std::vector<Part> PartReader::read() {
  const auto programs = unit_.index.programs();
  size_t next = 0;
  for (uint32_t at = unit_.reader->first(); at < text_.size();) {
    if (next < programs.size() && programs[next].begin <= at) {
      endProgram();
      program(programs[next++]);
    }
    unit_.reader->read(at, block_);
    block();
    if (block_.next <= at)
      break;
    at = block_.next;
  }
  endProgram();
  bracketSubprograms();
  localSubprograms();
  profiles();
  std::stable_sort(parts_.begin(), parts_.end(), [](const Part &a, const Part &b) {
    return a.begin != b.begin ? a.begin < b.begin
           : a.end != b.end   ? a.end > b.end
                              : a.kind < b.kind;
  });
  return std::move(parts_);
}

void PartReader::program(const ProgramInfo &program) {
  Part part;
  part.kind = PartKind::Program;
  part.begin = program.begin;
  part.end = trimmed(program.begin, program.end);
  part.nameBegin = part.nameEnd = program.begin;
  if (program.hasHeader()) {
    part.nameBegin = program.headerBegin;
    part.nameEnd = program.headerEnd;
    part.end = std::max(part.end, part.nameEnd);
    Block head;
    unit_.reader->read(program.begin, head);
    if (!head.comments.empty()) {
      part.noteBegin = head.comments[0].begin;
      part.noteEnd = head.comments[0].end;
    }
  }
  parts_.push_back(part);
}

void PartReader::block() {
  if (block_.isEmpty() && block_.kind == BlockKind::Empty) {
    comments();
    return;
  }
  endComments();
  takeContent();
  if (dialect_.lexical.blocksSpanLines && block_.comments.size() > 1)
    generated();
  if (block_.hasLabel())
    label();
  if (!block_.words.empty()) {
    tool();
    codes();
  }
  lastEnd_ = contentEnd_;
  aboveBegin_ = aboveEnd_ = 0;
}

/// A line that holds nothing but comments, or nothing at all.
void PartReader::comments() {
  if (block_.comments.empty()) {
    endComments();
    aboveBegin_ = aboveEnd_ = 0;
    return;
  }
  if (runLines_++ == 0)
    runBegin_ = block_.comments.front().begin;
  runEnd_ = block_.comments.back().end;
  aboveBegin_ = block_.comments.front().begin;
  aboveEnd_ = block_.comments.front().end;
}

void PartReader::endComments() {
  if (runLines_ > 1 && !isFull()) {
    Part part;
    part.kind = PartKind::Comments;
    part.begin = part.nameBegin = part.nameEnd = runBegin_;
    part.end = runEnd_;
    parts_.push_back(part);
  }
  runLines_ = 0;
}

/// The comment in the block of a part, else the one right above it.
void PartReader::note(Part &part) const {
  part.noteBegin = block_.comments.empty() ? aboveBegin_ : block_.comments.front().begin;
  part.noteEnd = block_.comments.empty() ? aboveEnd_ : block_.comments.front().end;
}

/// Whether a T word brings another tool; on a lathe `T0100` after `T0101` only ends its offset.
bool PartReader::isToolWord(const Word &word) {
  if (!word.isNumber())
    return !word.has(wordNoValue);
  if (word.mantissa <= 0)
    return false;
  if (!dialect_.isLathe())
    return true;
  const bool pair = word.mantissa >= 100 || word.has(wordLeadingZero);
  const int64_t station = pair ? word.mantissa / 100 : word.mantissa;
  const bool ends = pair && word.mantissa % 100 == 0 && (station == station_ || station == 0);
  if (!ends)
    station_ = station;
  return !ends;
}

void PartReader::endSection(std::vector<Part> &sections, uint32_t end) {
  bool &open = sectionOpen_[&sections == &tools_];
  if (open && !sections.empty())
    sections.back().end = std::max(sections.back().end, end);
  open = false;
}

void PartReader::tool() {
  const Word *const word = block_.find('T');
  const bool wordChanges = word && isToolWord(*word);
  if (word) {
    toolBegin_ = word->offset;
    toolEnd_ = block_.endOf(*word);
  }
  const Word *change = wordChanges && dialect_.toolChangeByT ? word : nullptr;
  for (const Word &one : block_.words)
    if (const CodeIndex code = codeOf(dialect_, one);
        !change && code != noCode && dialect_.codes[code].action == Action::ToolChange)
      change = &one;
  for (std::vector<Part> *sections : {&changes_, &tools_}) {
    const bool byWord = sections == &tools_;
    if (byWord ? !wordChanges : !change)
      continue;
    endSection(*sections, lastEnd_);
    if (sections->size() >= mostParts)
      continue;
    const bool named = byWord || toolEnd_ > toolBegin_;
    Part section = part(PartKind::Tool, named ? toolBegin_ : change->offset,
                        named ? toolEnd_ : block_.endOf(*change));
    // Its T word may be in an earlier block: the range of the name must lie inside.
    if (section.nameBegin < section.begin)
      section.begin = std::min(section.begin, change->offset);
    note(section);
    sections->push_back(section);
    sectionOpen_[byWord] = true;
  }
  if (change)
    endOperation(lastEnd_);
}

void PartReader::codes() {
  for (const Word &word : block_.words) {
    const CodeIndex index = codeOf(dialect_, word);
    if (index == noCode)
      continue;
    const CodeInfo &code = dialect_.codes[index];
    switch (code.action) {
    case Action::CycleCancel:
      endOperation(contentEnd_);
      break;
    case Action::ProgramEnd:
    case Action::ProgramEndRewind:
    case Action::Return:
      endOperation(lastEnd_);
      endSection(changes_, contentEnd_);
      endSection(tools_, contentEnd_);
      if (code.action == Action::Return)
        returns_.push_back(contentEnd_);
      break;
    default:
      if (code.cycle != CycleKind::None)
        operation(word, index);
      else if (isMotion(code.action) && !dialect_.cycleSurvivesMotion)
        endOperation(lastEnd_);
    }
  }
}

void PartReader::operation(const Word &word, CodeIndex index) {
  const CodeInfo &code = dialect_.codes[index];
  if (operationOpen_ && parts_[operation_].begin == contentBegin_)
    return; // one of a block is enough
  endOperation(lastEnd_);
  if (isFull())
    return;
  Part operation = part(PartKind::Operation, word.offset, block_.endOf(word));
  operation.code = index;
  note(operation);
  operation_ = parts_.size();
  operationOpen_ = code.group != noGroup && !dialect_.groups[code.group].oneShot;
  parts_.push_back(operation);
}

void PartReader::endOperation(uint32_t end) {
  if (operationOpen_)
    parts_[operation_].end = std::max(parts_[operation_].end, end);
  operationOpen_ = false;
}

void PartReader::label() {
  const bool opens = !block_.items.empty() && block_.items[0].kind == ItemKind::Structure &&
                     block_.items[0].structure == Structure::Sub;
  if (opens || isFull())
    return;
  Part label = part(PartKind::Label, block_.labelBegin, block_.labelEnd);
  label.begin = std::min(label.begin, label.nameBegin);
  note(label);
  parts_.push_back(label);
}

void PartReader::generated() {
  if (isFull() || !readGenerated(block_, text_).isGenerated())
    return;
  Part generated = part(PartKind::Generated, contentBegin_, contentBegin_);
  generated.end = trimmed(contentBegin_, std::max(contentBegin_, block_.next));
  parts_.push_back(generated);
}

/// The sections of the program that ends are those between its tool changes; where it has none,
/// those between its T words.
void PartReader::endProgram() {
  endComments();
  endOperation(lastEnd_);
  endSection(changes_, lastEnd_);
  endSection(tools_, lastEnd_);
  const std::vector<Part> &sections = changes_.empty() ? tools_ : changes_;
  for (size_t i = 0; i < sections.size() && !isFull(); ++i)
    parts_.push_back(sections[i]);
  changes_.clear();
  tools_.clear();
  station_ = -1;
  toolBegin_ = toolEnd_ = aboveBegin_ = aboveEnd_ = 0;
}

/// `o100 sub` to `o100 endsub`.
void PartReader::bracketSubprograms() {
  const Names &names = snapshot_.names();
  for (const Scope &scope : names.scopes().drop_front(unit_.index.programs().size())) {
    if (isFull())
      return;
    unit_.reader->read(scope.begin, block_);
    takeContent();
    Part sub = part(PartKind::Subprogram, block_.labelBegin, block_.labelEnd);
    sub.end = trimmed(sub.end, std::max(sub.end, scope.end));
    note(sub);
    parts_.push_back(sub);
  }
}

/// From each block that a local call names to the next return.
void PartReader::localSubprograms() {
  const Names &names = snapshot_.names();
  unsigned asked = 0;
  std::set<uint32_t> seen;
  for (const Occurrence &one : names.all()) {
    if (one.kind != NameKind::Block || one.use != NameUse::Call || isFull() || returns_.empty() ||
        ++asked > mostAsked)
      continue;
    const Occurrence *const target = names.definition(one);
    if (!target || !seen.insert(target->begin).second)
      continue;
    const auto end = llvm::partition_point(returns_, [&](uint32_t r) { return r < target->begin; });
    if (end == returns_.end() || *end > names.scopes()[target->scope].end)
      continue;
    snapshot_.readAt(target->begin, block_);
    takeContent();
    Part sub = part(PartKind::Subprogram, block_.numberBegin, block_.numberEnd);
    sub.end = std::max(sub.end, *end);
    aboveBegin_ = aboveEnd_ = 0;
    note(sub);
    parts_.push_back(sub);
  }
}

/// From the first to the last block that a cycle names.
void PartReader::profiles() {
  const Names &names = snapshot_.names();
  std::set<std::pair<uint32_t, uint32_t>> seen;
  unsigned asked = 0;
  for (const Occurrence &last : names.all()) {
    if (last.use != NameUse::Last || isFull() || ++asked > mostAsked)
      continue;
    const Occurrence *const first = names.firstOf(last);
    const Occurrence *const begin = first ? names.definition(*first) : nullptr;
    const Occurrence *const end = begin ? names.definition(last) : nullptr;
    if (!end || end->begin < begin->begin || !seen.insert({begin->begin, end->begin}).second)
      continue;
    snapshot_.readAt(begin->begin, block_);
    takeContent();
    Part profile = part(PartKind::Profile, begin->begin, begin->end);
    snapshot_.readAt(end->begin, block_);
    takeContent();
    profile.end = std::max(profile.end, contentEnd_);
    parts_.push_back(profile);
  }
}

} // namespace

std::vector<Part> partsOf(Snapshot &snapshot) { return PartReader(snapshot).read(); }

std::vector<Part> structuresOf(Snapshot &snapshot) {
  const FileUnit &unit = snapshot.unit();
  const llvm::StringRef text = snapshot.text();
  std::vector<Part> parts;
  const auto add = [&](PartKind kind, uint32_t begin, uint32_t end, uint32_t closing) {
    Part part;
    part.kind = kind;
    part.begin = part.nameBegin = part.nameEnd = begin;
    part.end = begin + uint32_t(text.slice(begin, end).rtrim().size());
    part.closing = closing;
    parts.push_back(part);
  };
  for (const ProgramInfo &program : unit.index.programs()) {
    const FlowShape shape = readShape(*unit.reader, program.begin, program.end);
    // From each bracket to the next one of its kind: a branch, or what closes it.
    llvm::DenseMap<uint32_t, uint32_t> next;
    for (const auto &[at, head] : shape.back)
      next[head] = at;
    for (const auto &[head, past] : shape.past) {
      const auto closing = next.find(head);
      if (closing == next.end())
        continue;
      const bool isBranch = shape.back.count(head) != 0;
      const bool branches = shape.past.count(closing->second) != 0;
      if (isBranch || branches)
        add(PartKind::Branch, head, closing->second, closing->second);
      if (isBranch)
        continue;
      uint32_t last = closing->second, end = past;
      for (auto i = shape.past.find(last); i != shape.past.end(); i = shape.past.find(last)) {
        const auto further = next.find(last);
        if (further == next.end() || further->second <= last)
          break;
        end = i->second;
        last = further->second;
      }
      add(PartKind::Loop, head, end, last);
    }
  }
  std::sort(parts.begin(), parts.end(), [](const Part &a, const Part &b) {
    return a.begin != b.begin ? a.begin < b.begin
           : a.end != b.end   ? a.end > b.end
                              : a.kind < b.kind;
  });
  return parts;
}

std::string noteText(const SourceFile &source, uint32_t begin, uint32_t end) {
  constexpr size_t longest = 200; // bytes; a comment may be as long as the file
  llvm::StringRef note = source.text(begin, end).take_front(longest).trim();
  note = note.ltrim("(;{'\"").rtrim(")}\"").trim();
  return source.displayText(note);
}

} // namespace ncvet::lsp
