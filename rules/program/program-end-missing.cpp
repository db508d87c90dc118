// A path of the main program reaches the end of the text without an end code.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/wanted_blocks.h"
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct ProgramEndMissingMemory {
  bool headSeen = false;
};

class ProgramEndMissing final : public StatefulRule<ProgramEndMissingMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::FlowIssue);
    to.onAction({Action::ProgramHead, Action::Reset});
    fileIsProgram_ = to.dialect().facts->program.fileIsProgram;
    tapeMarkEnds_ = to.dialect().facts->program.tapeMarkEnds;
    fragments_ = to.flag("fragments");
    bool rewinds = false;
    for (const CodeInfo &code : to.dialect().codes) {
      // Of several the first one is the usual one: others end part of a job.
      if (code.action == Action::ProgramEndRewind && !rewinds) {
        end_ = code.name;
        rewinds = true;
      } else if (code.action == Action::ProgramEnd && end_.empty()) {
        end_ = code.name;
      }
      hasHead_ |= code.action == Action::ProgramHead || code.action == Action::Reset;
    }
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code) {
      memory().headSeen = true;
      return;
    }
    // Where a program has a head, a text without one is a fragment.
    if (event.flowIssue() != FlowIssue::MainRunsOut || (hasHead_ && !memory().headSeen))
      return;
    const llvm::ArrayRef<uint32_t> marks = ctx.index().tapeMarks();
    if (tapeMarkEnds_ && marks.size() > 1)
      return;
    const SourceRange where = ctx.flowRange();
    // In a file that is one program control runs on past the number of a further one.
    if (fileIsProgram_ && &ctx.index().programAt(where.begin) != &ctx.index().programs().back())
      return;
    if (ctx.index().programAt(where.begin).kind == ProgramKind::Subprogram)
      return; // flow-return-missing speaks
    if (tapeMarkEnds_ && marks.size() == 1 && marks.front() >= where.end)
      return strayMark(event, marks.front(), where, ctx);
    const ProgramInfo &program = ctx.index().programAt(where.begin);
    if (fileIsProgram_ && isNamedAsItsFile(program, ctx))
      return;
    // Before the first number are blocks of no program: another rule says so.
    if (!program.hasHeader() && !fileIsProgram_ && &program != &ctx.index().programs().back())
      return;
    auto finding = ctx.report(where, event.certain);
    if (!finding)
      return;
    finding.severity(severityOf(program, where, ctx));
    finding.message("the program runs out after this block: no `{0}` ends it", end_);
    endAfter(where, finding, ctx);
  }

private:
  /// None: that of the control.
  std::optional<Severity> severityOf(const ProgramInfo &program, const SourceRange &last,
                                     const RuleContext &ctx) const {
    // Without a number it may be a part of a program that somebody joins. One that has only
    // positioned leaves nothing half done. After a stop somebody may reset instead of going on.
    const bool isPart = !fileIsProgram_ && !program.hasHeader();
    if (isPart &&
        (!ctx.after().may(Fact::Cut) || (fragments_ && hasNone(lettersMask("MST"), program, ctx))))
      return Severity::Style;
    if (isPart || stopsAt(last, ctx))
      return Severity::Warning;
    if (fileIsProgram_ && hasNone(ctx.dialect().axisWords, program, ctx))
      return Severity::Style;
    return std::nullopt;
  }

  /// A file with a subprogram of its own name is called, and what is beside that never runs.
  static bool isNamedAsItsFile(const ProgramInfo &program, const RuleContext &ctx) {
    const std::string shown = ctx.source().display();
    const llvm::StringRef path = shown;
    const llvm::StringRef stem = path.drop_front(path.rfind('/') + 1).rsplit('.').first;
    return ctx.index().label(program, stem, program.body).has_value();
  }

  /// Whether a stop is in the block, or in the one before it.
  static bool stopsAt(const SourceRange &last, const RuleContext &ctx) {
    Block block;
    readBlockAt(ctx.source(), ctx.index().reader(), last.begin, block);
    return findCode(ctx.dialect(), block, {Action::ProgramStop}) != nullptr;
  }

  /// No block that always runs has one of these words. Without those of axes a text gives values,
  /// or is the head that others are pasted to.
  static bool hasNone(AddressMask words, const ProgramInfo &program, const RuleContext &ctx) {
    for (const Block &block : blocksWith(ctx.index(), program, words))
      if (block.skip < 0 && block.hasAny(words))
        return false;
    return true;
  }

  /// A `%` ends what another `%` has opened; alone it is a character that is no word.
  void strayMark(const Event &event, uint32_t line, const SourceRange &last,
                 RuleContext &ctx) const {
    const auto mark = uint32_t(ctx.source().text().find('%', line));
    if (auto finding = ctx.report(SourceRange{ctx.source().id(), mark, mark + 1}, event.certain)) {
      finding.message("no `%` has opened the program that this one is to end: the control stops "
                      "here with an error, and no `{0}` ends the program",
                      end_);
      endAfter(last, finding, ctx);
    }
  }

  void endAfter(const SourceRange &last, FindingBuilder &finding, RuleContext &ctx) const {
    const llvm::StringRef rest = ctx.source().text().substr(last.end, 2);
    const llvm::StringRef lineEnd = rest.startswith("\r\n") ? "\r\n" : "\n";
    // Where a block goes on over its line's end, a new one has to be opened.
    const llvm::StringRef opened = ctx.dialect().lexical.blocksSpanLines ? "N " : "";
    finding.fix(FixSafety::Unsafe, "end the program here",
                ctx.insertBefore(last.end, (lineEnd + opened + end_).str()));
  }

  std::string end_;
  bool hasHead_ = false;       ///< the control has a word that opens a program
  bool fileIsProgram_ = false; ///< a text without a number is one all the same
  bool tapeMarkEnds_ = false;  ///< a second `%` ends a program too
  bool fragments_ = false;     ///< see the page
};

} // namespace
NCVET_RULE(ProgramEndMissing, program_end_missing)
} // namespace ncvet
