// A program's head or end is in the wrong place, or more than once.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class ProgramFrameMisplaced final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (llvm::any_of(to.dialect().codes,
                     [](const CodeInfo &c) { return c.action == Action::Reset; }))
      to.onAction({Action::Reset});
    marksOpen_ = to.dialect().facts->program.tapeMarkEnds;
    if (to.flag("numberFirst"))
      to.onChange({EventKind::Block});
    hasHead_ = llvm::any_of(to.dialect().codes,
                            [](const CodeInfo &c) { return c.action == Action::ProgramHead; });
  }

  /// A reset opens the program; a numbered one begins a new phase of it.
  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Block)
      return numberInside(ctx);
    if (ctx.block().mainBlock)
      return;
    if (ctx.callDepth() > 0) {
      if (auto finding = ctx.report(event))
        finding.message("`{0}` in a called program resets the modes of its caller",
                        ctx.text(*event.word));
      return;
    }
    for (const Block &block :
         blocks(ctx.index(), ctx.index().programAt(ctx.block().begin).body, ctx.block().begin)) {
      if (block.isEmpty())
        continue;
      if (auto finding = ctx.report(event))
        finding.message("`{0}` comes after other blocks: it opens a program",
                        ctx.text(*event.word));
      return;
    }
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (ctx.dialect().limits.nameLength)
      for (const ProgramInfo &program : file.index.programs())
        if (program.hasHeader())
          path(program, file, ctx);
    if (marksOpen_)
      markAfterComments(file, ctx);
    if (!hasHead_)
      return;
    for (const ProgramInfo &program : file.index.programs())
      check(program, file, ctx);
  }

private:
  /// A `%` opens a text only where nothing but blank lines comes before it: after comments it is a
  /// character that is no word.
  static void markAfterComments(const FileSummary &file, RuleContext &ctx) {
    const llvm::ArrayRef<uint32_t> marks = file.index.tapeMarks();
    if (marks.empty())
      return;
    const llvm::StringRef text = file.source.text();
    llvm::SmallVector<llvm::StringRef, 8> lines;
    constexpr size_t most = 200; // lines of a head
    text.take_front(marks.front()).split(lines, '\n', most);
    bool comments = false;
    for (const llvm::StringRef line : lines) {
      const llvm::StringRef content = line.trim();
      if (!content.empty() && !content.startswith("(") && !content.startswith(";"))
        return;
      comments |= !content.empty();
    }
    const size_t mark = text.find('%', marks.front());
    if (!comments || mark == llvm::StringRef::npos)
      return;
    if (auto finding =
            ctx.report(SourceRange{file.source.id(), uint32_t(mark), uint32_t(mark + 1)}))
      finding.severity(Severity::Error)
          .message("`%` comes after comments: only as the first line it opens a program, here "
                   "the interpreter stops with an error");
  }

  /// `G21 O1001`: the number opens no program.
  static void numberInside(RuleContext &ctx) {
    const Word *number = ctx.block().find('O');
    if (!number || !number->isNumber() || !ctx.block().issues.empty() ||
        ctx.block().kind == BlockKind::ProgramHeader ||
        ctx.find({Action::CallProgram, Action::MacroCall, Action::MacroModal, Action::Return,
                  Action::ProgramEnd, Action::ProgramEndRewind}))
      return;
    if (auto finding = ctx.report(*number))
      finding.severity(Severity::Warning)
          .message("`{0}` comes after other words of its block: it opens no program there",
                   ctx.text(*number));
  }

  /// The line after the header says where the unit is filed, when it is written exactly so.
  static void path(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) {
    const llvm::StringRef rest = file.source.text().slice(program.headerEnd, program.end);
    const size_t begin = rest.find('\n');
    if (begin == llvm::StringRef::npos)
      return;
    const llvm::StringRef line =
        rest.drop_front(begin + 1).take_until([](char c) { return c == '\r' || c == '\n'; });
    std::string close;
    for (const char c : line)
      if (c != ' ' && c != '\t')
        close += llvm::toUpper(c);
    if (!llvm::StringRef(close).startswith(";$PATH=") || line.startswith(";$PATH="))
      return;
    const auto at = uint32_t(program.headerEnd + begin + 1);
    if (auto finding =
            ctx.report(SourceRange{file.source.id(), at, at + uint32_t(line.rtrim().size())}))
      finding.severity(Severity::Warning)
          .message("`{0}` is a comment: only `;$PATH=` in capitals, at the begin of the line and "
                   "without blanks, says where the unit is filed",
                   line.trim());
  }

  static void check(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) {
    Block block;
    SourceRange head, end;
    bool content = false;
    for (uint32_t at = program.body; at < program.end; at = std::max(block.next, at + 1)) {
      file.reader.read(at, block);
      bool frame = false;
      for (const Word &word : block.words) {
        const CodeIndex code = codeOf(ctx.dialect(), word);
        const Action action = code == noCode ? Action::None : ctx.dialect().codes[code].action;
        const SourceRange here{file.source.id(), word.offset, block.endOf(word)};
        if (action == Action::ProgramHead) {
          frame = true;
          if (head.end)
            report(here, "`{0}` is repeated: two programs are in one file", head, ctx);
          else if (content)
            report(here, "`{0}` comes after other blocks: it opens a program", {}, ctx);
          head = here;
        } else if (action == Action::ProgramEnd || action == Action::ProgramEndRewind) {
          frame = true;
          if (end.end)
            report(here, "`{0}` ends the program once more: it has ended already", end, ctx);
          end = here;
        }
      }
      if (!frame && end.end && !block.isEmpty())
        report(end, "`{0}` is not at the end of the program", {}, ctx);
      // Where a number opens a block, one that holds nothing is a block too.
      const bool opened = ctx.dialect().lexical.blocksSpanLines && block.kind != BlockKind::Empty;
      content |= !frame && (opened || !block.isEmpty());
    }
  }

  static void report(SourceRange range, const char *message, SourceRange first, RuleContext &ctx) {
    auto finding = ctx.report(range);
    if (!finding)
      return;
    finding.message(message, ctx.text(range));
    if (first.end)
      finding.note(first, "the first one");
  }

  bool marksOpen_ = false; ///< a `%` opens a text, and another one ends it
  bool hasHead_ = false;
};

} // namespace
NCVET_RULE(ProgramFrameMisplaced, program_frame_misplaced)
} // namespace ncvet
