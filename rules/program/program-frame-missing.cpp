// The program number, or the closing mark, that the control wants around a program is missing.
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"

namespace ncvet {
namespace {

struct ProgramFrameMissingMemory {
  std::vector<SourceRange> ends;
};

class ProgramFrameMissing final : public StatefulRule<ProgramFrameMissingMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::ProgramEnd);
    wantsHeader_ = to.flag("header", true);
    wantsReset_ = to.flag("reset");
    wantsMarks_ = to.flag("tapeMarks");
    wantsEndMark_ = to.flag("endMark", to.dialect().lexical.percentHeader);
    percent_ = to.dialect().lexical.percentHeader;
  }

  void on(const Event &, RuleContext &ctx) const override {
    // What ends a program is a whole program; anything else is a fragment or a part of one.
    if (ctx.callDepth() == 0)
      memory().ends.push_back({ctx.source().id(), ctx.block().begin, ctx.block().end});
    if (!ctx.block().tapeInside || !wantsEndMark_ || ctx.callDepth() > 0)
      return;
    const llvm::StringRef text = ctx.source().text(ctx.block().begin, ctx.block().end);
    const auto mark = uint32_t(ctx.block().begin + text.rfind('%'));
    if (auto finding = ctx.report(SourceRange{ctx.source().id(), mark, mark + 1}))
      finding.text("the tape mark `%` comes after other words: it needs its own line")
          .severity(Severity::Style);
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    const SourceRange *end = nullptr;
    for (const SourceRange &range : memory().ends)
      if (range.file == file.source.id() && (!end || range.begin > end->begin))
        end = &range;
    if (!end)
      return;
    const ProgramInfo &first = file.index.programs().front();
    if (wantsReset_)
      reset(first, file, ctx);
    if (wantsHeader_ && !first.hasHeader())
      header(first, file, ctx);
    if (wantsEndMark_)
      endMark(*end, file, ctx);
    if (wantsMarks_ && file.index.tapeMarks().empty())
      tapeMarks(first, file, ctx);
  }

private:
  /// The first block that says anything resets the control.
  void reset(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) const {
    for (const Block &block : blocks(file.reader, program.begin, program.end)) {
      if (block.isEmpty())
        continue;
      if (!findCode(ctx.dialect(), block, {Action::Reset}))
        if (auto finding = ctx.report(SourceRange{file.source.id(), block.begin, block.end}))
          finding.message(
              "the program begins without `%`: it runs in whatever modes the one before "
              "has left");
      return;
    }
  }

  bool wantsReset_ = false;

  /// No `%` at either end.
  static void tapeMarks(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) {
    for (const Block &block : blocks(file.reader, program.begin, program.end)) {
      if (block.kind == BlockKind::Empty)
        continue;
      const uint32_t end = block.headerEnd ? block.headerEnd : block.end;
      if (auto finding = ctx.report(SourceRange{file.source.id(), block.begin, end}))
        finding.severity(Severity::Style)
            .text("the file has no line `%` at either end: a transfer does not know where the "
                  "programs begin and end");
      return;
    }
  }

  bool wantsMarks_ = false;

  void header(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) const {
    for (const Block &block : blocks(file.reader, program.begin, program.end)) {
      if (block.isEmpty() && block.number < 0)
        continue;
      if (const CodeInfo *head = firstCodeWith(ctx.dialect(), Action::ProgramHead)) {
        if (!findCode(ctx.dialect(), block, {Action::ProgramHead}))
          if (auto finding = ctx.report(SourceRange{file.source.id(), block.begin, block.end}))
            finding.message("the program begins without `{0}`", head->name);
        return;
      }
      if (auto finding = ctx.report(SourceRange{file.source.id(), block.begin, block.end}))
        finding.message(
            "the program begins without {0}: the control cannot store it under a number",
            percent_ ? "its line `%O` and number" : "its `O` number");
      return;
    }
  }

  void endMark(const SourceRange &end, const FileSummary &file, RuleContext &ctx) const {
    // A mark inside the last block has been spoken of.
    const auto marks = file.index.tapeMarks();
    const llvm::StringRef block = ctx.text(end);
    if ((!marks.empty() && marks.back() >= end.begin) || block.contains('%'))
      return;
    if (auto finding = ctx.report(end))
      finding.text("the file does not close with a line `%`")
          .severity(Severity::Style)
          .fix(FixSafety::Unsafe, "add a line `%`",
               ctx.insertBefore(uint32_t(file.source.text().size()),
                                file.source.text().endswith("\n") ? "%\n" : "\n%\n"));
  }

  bool wantsHeader_ = true;
  bool wantsEndMark_ = false;
  bool percent_ = false;
};

} // namespace
NCVET_RULE(ProgramFrameMissing, program_frame_missing)
} // namespace ncvet
