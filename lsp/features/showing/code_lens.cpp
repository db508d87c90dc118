// Code lenses: one look at all blocks for calls and tools, one run for the contours.
#include "lsp/features/showing/code_lens.h"

#include "analyzer/check/contour_report.h"
#include "analyzer/program/callers.h"
#include "analyzer/program/references.h"
#include "formats/dialect/packed_call.h"
#include "formats/text/formatted.h"
#include "interp/evaluate/condition.h"

#include <cmath>
#include <map>

namespace ncvet::lsp {

namespace {

/// Lenses of one kind; a text with more is none that a person reads.
constexpr size_t mostLenses = 2000;
/// Calls of one program that are listed.
constexpr size_t mostCallers = 1000;

std::string counted(size_t count, llvm::StringRef one, llvm::StringRef many) {
  return std::to_string(count) + " " + (count == 1 ? one : many).str();
}

/// Looks at all blocks of the text once.
class BlockScan {
public:
  explicit BlockScan(Snapshot &snapshot)
      : snapshot_(snapshot), dialect_(snapshot.dialect()), file_(snapshot.source().id()) {}

  void run() {
    Block block;
    const FileIndex &index = snapshot_.unit().index;
    const bool callees = index.programs().size() > 1 || !index.subprograms().empty();
    for (const uint32_t at : snapshot_.blocks()) {
      snapshot_.unit().reader->read(at, block);
      ++blocks_;
      tool(block);
      codes(block, callees);
    }
    endTool(blocks_ + 1);
  }

  std::vector<CodeLens> callers() {
    std::vector<CodeLens> lenses;
    const FileIndex &index = snapshot_.unit().index;
    const ProgramInfo &main = index.programs().front();
    for (const ProgramInfo &program : index.programs()) {
      std::vector<SourceRange> places = placesOf(program);
      addPlacesElsewhere(program, places);
      if (&program == &main && places.empty() && program.kind != ProgramKind::Subprogram)
        continue;
      if (program.hasHeader())
        add(lenses, {file_, program.headerBegin, program.headerEnd}, std::move(places));
      else if (!places.empty())
        add(lenses, {file_, program.body, snapshot_.source().lines().lineEnd(program.body)},
            std::move(places));
    }
    for (auto &[target, places] : local_)
      add(lenses, {file_, target, snapshot_.source().lines().lineEnd(target)}, std::move(places));
    for (const uint32_t head : index.subprograms()) {
      Block block;
      snapshot_.unit().reader->read(head, block);
      add(lenses, {file_, block.begin, block.end}, named_[subprogramName(block)]);
    }
    return lenses;
  }
  std::vector<CodeLens> takeTools() { return std::move(tools_); }
  /// Over blocks that switch compensation on, without titles.
  std::vector<CodeLens> takeContours() { return std::move(contours_); }

private:
  llvm::StringRef text(uint32_t begin, uint32_t end) const {
    return snapshot_.text().slice(begin, end);
  }

  static void add(std::vector<CodeLens> &lenses, SourceRange range,
                  std::vector<SourceRange> places) {
    if (lenses.size() < mostLenses)
      lenses.push_back(
          {range, LensKind::Callers,
           places.empty() ? "no callers found" : counted(places.size(), "caller", "callers"),
           std::move(places)});
  }

  std::vector<SourceRange> placesOf(const ProgramInfo &program) {
    std::vector<SourceRange> places;
    if (program.number >= 0)
      places = numbered_[program.number];
    if (!program.name.empty()) {
      const auto &byName = named_[program.name];
      places.insert(places.end(), byName.begin(), byName.end());
    }
    return places;
  }

  /// Calls of the program in the files round this one.
  void addPlacesElsewhere(const ProgramInfo &program, std::vector<SourceRange> &places) {
    Block block;
    for (const CallPlace &call : callersInOtherFiles(snapshot_.unit(), program).places) {
      call.unit->reader->read(call.block, block);
      note(places, {call.unit->source.id(), block.begin, block.end});
    }
  }

  /// `o100 sub`, `o<name> sub`: what a call of it names.
  std::string subprogramName(const Block &block) const {
    for (const Item &item : block.items)
      if (item.kind == ItemKind::Structure && item.structure == Structure::Sub) {
        llvm::StringRef head = text(item.begin, item.end).drop_front();
        head = head.take_until([](char c) { return c == ' ' || c == '\t'; });
        head.consume_front("<");
        head.consume_back(">");
        return head.upper();
      }
    return {};
  }

  static void note(std::vector<SourceRange> &places, SourceRange range) {
    if (places.size() < mostCallers)
      places.push_back(range);
  }

  /// Calls, and what else codes of the block begin.
  void codes(const Block &block, bool callees) {
    for (const Item &item : block.items)
      if (callees && item.kind == ItemKind::Call && item.nameEnd > item.nameBegin)
        note(named_[text(item.nameBegin, item.nameEnd).upper()], {file_, item.begin, item.end});
    if (!block.hasAny(maskOf('M') | maskOf('G')))
      return;
    for (const Word &word : block.words) {
      const CodeIndex index = codeOf(dialect_, word);
      if (index == noCode)
        continue;
      switch (dialect_.codes[index].action) {
      case Action::CompensationLeft:
      case Action::CompensationRight:
        if (contours_.size() < mostLenses)
          contours_.push_back({{file_, block.begin, block.end}, LensKind::Contour, {}, {}});
        break;
      case Action::CallProgram:
      case Action::MacroCall:
      case Action::MacroModal:
        if (const Word *p = callees ? target(block, dialect_.codes[index]) : nullptr)
          note(numbered_[calledNumber(block, *p, dialect_.codes[index].action)],
               {file_, word.offset, block.endOf(*p)});
        break;
      case Action::CallLocal:
        localCall(block, word, dialect_.codes[index]);
        break;
      default:
        break;
      }
    }
  }

  /// The word that names what a code calls, when its text says it.
  static const Word *target(const Block &block, const CodeInfo &code) {
    for (const WordSpec &spec : code.words)
      if (spec.role == Role::Program || spec.role == Role::Sequence)
        if (const Word *word = wordFor(block, spec); word && word->isNumber() && word->isWhole())
          return word;
    return nullptr;
  }

  int64_t calledNumber(const Block &block, const Word &word, Action action) const {
    const bool counted = action != Action::CallProgram || block.has(letterAddress('L'));
    return unpackCall(dialect_, word.mantissa, counted).program;
  }

  void localCall(const Block &block, const Word &word, const CodeInfo &code) {
    const Word *target = this->target(block, code);
    if (!target || local_.size() >= mostLenses)
      return;
    const FileIndex &index = snapshot_.unit().index;
    if (const auto at = resolveBlock(index, index.programAt(block.begin),
                                     Reference::toBlock(target->mantissa), block.begin))
      note(local_[*at], {file_, word.offset, block.endOf(*target)});
  }

  void tool(const Block &block) {
    const Word *word = block.find('T');
    if (!word && !block.has(letterAddress('M')))
      return;
    bool changes = dialect_.toolChangeByT && word;
    for (const Word &other : block.words)
      if (const CodeIndex index = codeOf(dialect_, other);
          index != noCode && dialect_.codes[index].action == Action::ToolChange)
        changes = true;
    if (word)
      preselected_ = snapshot_.source().displayText(text(word->offset, block.endOf(*word)));
    if (!changes || preselected_.empty())
      return;
    endTool(blocks_);
    if (tools_.size() < mostLenses)
      tools_.push_back({{file_, block.begin, block.end}, LensKind::Tool, preselected_, {}});
    open_ = true;
    toolBegins_ = blocks_;
  }

  /// `next`: the block after the tool's last one, counted from 1.
  void endTool(size_t next) {
    if (!std::exchange(open_, false) || tools_.empty())
      return;
    const size_t count = next - toolBegins_;
    tools_.back().title += ": " + counted(count, "block", "blocks");
  }

  Snapshot &snapshot_;
  const Dialect &dialect_;
  const FileId file_;
  size_t blocks_ = 0, toolBegins_ = 0;
  bool open_ = false; ///< the last of `tools_` still waits for its number of blocks
  std::string preselected_;
  std::vector<CodeLens> tools_, contours_;
  std::map<int64_t, std::vector<SourceRange>> numbered_;
  std::map<std::string, std::vector<SourceRange>> named_; ///< in capitals
  std::map<uint32_t, std::vector<SourceRange>> local_;    ///< by the block that is called
};

/// Empty: nothing is known of it.
std::string titleOf(const CompensatedContour &contour) {
  if (!contour.largest && !contour.whole)
    return {};
  // What is rounded up would not fit.
  std::string title =
      contour.largest ? formatted("safe up to R{0:f2}", std::floor(*contour.largest * 100) / 100)
                      : "safe with any radius";
  return contour.whole ? title : title + ", as far as the contour is known";
}

void contours(Snapshot &snapshot, std::vector<CodeLens> &lenses) {
  size_t count = 0;
  for (const CompensatedContour &contour : snapshot.contours()) {
    if (contour.unit != &snapshot.unit() || ++count > mostLenses)
      continue;
    Block block;
    snapshot.readAt(contour.begin, block);
    if (std::string title = titleOf(contour); !title.empty())
      lenses.push_back({{snapshot.source().id(), block.begin, block.end},
                        LensKind::Contour,
                        std::move(title),
                        {}});
  }
}

void sortByPlace(std::vector<CodeLens> &lenses) {
  llvm::stable_sort(
      lenses, [](const CodeLens &a, const CodeLens &b) { return a.range.begin < b.range.begin; });
}

void append(std::vector<CodeLens> &lenses, std::vector<CodeLens> more) {
  lenses.insert(lenses.end(), std::make_move_iterator(more.begin()),
                std::make_move_iterator(more.end()));
}

} // namespace

std::vector<CodeLens> codeLenses(Snapshot &snapshot,
                                 const std::array<bool, size_t(LensKind::Count)> &on) {
  std::vector<CodeLens> lenses;
  const bool callers = on[size_t(LensKind::Callers)], tools = on[size_t(LensKind::Tool)];
  if (callers || tools) {
    BlockScan scan(snapshot);
    scan.run();
    if (callers)
      append(lenses, scan.callers());
    if (tools)
      append(lenses, scan.takeTools());
  }
  if (on[size_t(LensKind::Contour)])
    contours(snapshot, lenses);
  sortByPlace(lenses);
  return lenses;
}

std::vector<CodeLens> lensesToResolve(Snapshot &snapshot) {
  BlockScan scan(snapshot);
  scan.run();
  std::vector<CodeLens> lenses = scan.callers();
  append(lenses, scan.takeTools());
  append(lenses, scan.takeContours());
  sortByPlace(lenses);
  return lenses;
}

std::string titleOfContour(Snapshot &snapshot, uint32_t offset) {
  Block block;
  snapshot.readAt(offset, block);
  for (const CompensatedContour &contour : snapshot.contours())
    if (contour.unit == &snapshot.unit() && contour.begin >= block.begin &&
        contour.begin <= block.end)
      if (std::string title = titleOf(contour); !title.empty())
        return title;
  return {};
}

} // namespace ncvet::lsp
