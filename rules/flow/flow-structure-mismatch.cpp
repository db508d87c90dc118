// WHILE, DO and END do not belong together.
#include "analyzer/program/block_reading.h"
#include "analyzer/program/repeated_sections.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

#include <set>

namespace ncvet {
namespace {

struct FlowStructureMismatchMemory {
  bool repeats = false;
  bool loops = false;         ///< a loop with a number was executed
  std::set<CodeIndex> opened; ///< words that others have to end
};

class FlowStructureMismatch final : public StatefulRule<FlowStructureMismatchMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::FlowIssue, EventKind::Statement});
    to.onAction({Action::ModesRestored});
    loopNumbers_ = to.dialect().facts->limits.loopNumbers;
    nest_ = to.dialect().facts->program.repeatsNest;
    // Words without a letter that another ends, with arguments or none.
    to.onCode([&](const CodeInfo &code) { return isPair(to.dialect(), code); });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code && isPair(ctx.dialect(), ctx.code(event))) {
      memory().opened.insert(event.code);
      return;
    }
    if (event.kind == EventKind::Code)
      return restores(event, ctx);
    if (event.kind == EventKind::Statement) {
      const ItemKind kind = ctx.block().items[event.item()].kind;
      memory().repeats |= kind == ItemKind::Repeat;
      memory().loops |= kind == ItemKind::While || kind == ItemKind::Do;
      return sleepAtBlock();
    }
    if (event.flowIssue() == FlowIssue::RepeatOverlap) {
      if (auto finding = ctx.report(ctx.flowRange(), event.certain))
        finding
            .message("`{0}` repeats a part of a bracket of structured flow",
                     ctx.text(ctx.flowRange()))
            .note(ctx.flowRelated(), "the bracket begins here");
      return;
    }
    if (event.flowIssue() == FlowIssue::StructureOpen) {
      if (auto finding = ctx.report(ctx.flowRange(), event.certain))
        finding.severity(Severity::Warning)
            .message(loops(ctx) ? "`{0}` has no end: nothing repeats what follows"
                                : "`{0}` has no end: its body runs here, and where it is to be "
                                  "left out the control stops with an alarm",
                     ctx.text(ctx.flowRange()));
      return;
    }
    if (event.flowIssue() == FlowIssue::IntoStructure) {
      // Machines that are delivered so jump into an IF: its end does nothing.
      if (auto finding = ctx.report(ctx.flowRange(), event.certain))
        finding.severity(isInIf(ctx) ? std::optional(Severity::Warning) : std::nullopt)
            .message("`{0}` leads into a bracket of structured flow from outside: its head never "
                     "ran",
                     ctx.text(ctx.flowRange()))
            .note(ctx.flowRelated(), "it leads here");
      return;
    }
    if (event.flowIssue() != FlowIssue::StructureMismatch ||
        (ctx.outcome().flow.kind != FlowKind::Structure && ctx.outcome().flow.loop == 0))
      return; // an END without a number is no statement of this control
    auto finding = ctx.report(ctx.flowRange(), event.certain);
    if (!finding)
      return;
    finding.message(beginsSubprogram(ctx)
                        ? "`{0}` has no end of its own, or begins inside another subprogram: the "
                          "control stops with an alarm"
                        : "`{0}` has no partner: the control stops with an alarm",
                    ctx.text(ctx.flowRange()));
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    for (const CodeIndex code : memory().opened)
      neverEnded(ctx.dialect().codes[code], file, ctx);
    if (loopNumbers_ && memory().loops)
      for (const ProgramInfo &program : file.index.programs())
        numbers(program, file, ctx);
    if (!memory().repeats)
      return;
    const std::vector<RepeatedSection> sections = repeatedSections(file.index);
    for (const RepeatedSection &section : sections) {
      for (const RepeatedSection &inner : sections)
        if (crosses(section, inner))
          crossed(section, inner, file, ctx);
      left(section, file, ctx);
    }
  }

private:
  /// Whether the innermost bracket round the target is an IF.
  static bool isInIf(const RuleContext &ctx) {
    const SourceRange target = ctx.flowRelated();
    const FileIndex &index = ctx.indexOf(target.file);
    llvm::SmallVector<Structure, 4> open;
    for (const Block &block : blocks(index, index.programAt(target.begin).body, target.begin))
      for (const Item &item : block.items) {
        if (item.kind != ItemKind::Structure)
          continue;
        if (opensBracket(item.structure))
          open.push_back(item.structure);
        else if (closesBracket(item.structure) && !open.empty())
          open.pop_back();
      }
    return !open.empty() && open.back() == Structure::If;
  }

  /// A word of the language that opens something which another one ends: `GROUP_BEGIN`.
  static bool isPair(const Dialect &dialect, const CodeInfo &code) {
    return !code.letter && code.action == Action::None && code.group == noGroup &&
           code.opposite != noCode && code.words.empty() &&
           dialect.codes[code.opposite].opposite == noCode;
  }

  /// Each of them that the text does not end.
  static void neverEnded(const CodeInfo &opens, const FileSummary &file, RuleContext &ctx) {
    std::vector<SourceRange> open;
    for (const Block &block : blocks(file.reader))
      for (const Word &word : block.words) {
        const CodeIndex code =
            word.address == keywordAddress ? codeOf(ctx.dialect(), word) : noCode;
        if (code == noCode)
          continue;
        if (&ctx.dialect().codes[code] == &opens)
          open.push_back({file.source.id(), word.offset, block.endOf(word)});
        else if (code == opens.opposite && !open.empty())
          open.pop_back();
      }
    for (const SourceRange &range : open)
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Style)
            .message("`{0}` has no `{1}`", opens.name, ctx.dialect().codes[opens.opposite].name);
  }

  static bool beginsSubprogram(const RuleContext &ctx) {
    return llvm::any_of(ctx.block().items,
                        [](const Item &item) { return item.structure == Structure::Sub; });
  }

  unsigned loopNumbers_ = 0; ///< greatest number of a loop; 0: any

  /// Numbers of loops: the control has some, and each may be in use once.
  void numbers(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) const {
    std::vector<unsigned> open;
    for (const Block &block : blocks(file.reader, program.body, program.end)) {
      for (const Item &item : block.items) {
        if (item.kind == ItemKind::End) {
          const auto last = std::find(open.rbegin(), open.rend(), item.loop);
          if (last != open.rend())
            open.erase(std::next(last).base(), open.end());
          continue;
        }
        if ((item.kind != ItemKind::While && item.kind != ItemKind::Do) || item.loop == 0)
          continue;
        const bool used = llvm::is_contained(open, item.loop);
        open.push_back(item.loop);
        if (!used && item.loop <= loopNumbers_)
          continue;
        const SourceRange range{file.source.id(), item.begin, item.end};
        if (auto finding = ctx.report(range))
          finding.message(used ? "the loop of `{0}` is inside another with the same number: the "
                                 "control stops with an alarm"
                               : "`{0}`: the control has loops 1 to {1} and stops with an alarm",
                          ctx.text(range), loopNumbers_);
      }
    }
  }

  /// Whether the bracket is one whose body always runs.
  static bool loops(const RuleContext &ctx) {
    return ctx.block().items[size_t(ctx.outcome().flow.item)].structure == Structure::Repeat;
  }

  /// What no code of this program has kept cannot come back.
  static void restores(const Event &event, RuleContext &ctx) {
    const SavedModes &saved = ctx.before().saved;
    const bool keeps = llvm::any_of(ctx.codes(), [&](const CodeUse &use) {
      const Action action = ctx.code(use).action;
      return action == Action::ModesKept || action == Action::ModesRestoredAtReturn;
    });
    if (!saved.known || saved.modes || keeps || ctx.before().may(Fact::UnknownCode))
      return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}` brings modes back that this program has not kept: the control stops "
                      "with an alarm",
                      ctx.code(event).name);
  }

  /// Whether the section holds the other repeat, but not the begin of that one's section; or the
  /// two, both before their repeats, overlap in part. `other` comes first in the text.
  bool crosses(const RepeatedSection &section, const RepeatedSection &other) const {
    if (section.holds(other.at))
      return other.first < section.first;
    return nest_ && other.at < section.at && other.first < section.first &&
           section.first < other.after && other.after < section.after;
  }

  /// The section and that of another repeat hold only a part of each other.
  static void crossed(const RepeatedSection &section, const RepeatedSection &inner,
                      const FileSummary &file, RuleContext &ctx) {
    const SourceRange where{file.source.id(), section.begin, section.end};
    const SourceRange other{file.source.id(), inner.begin, inner.end};
    if (auto finding = ctx.report(where))
      finding
          .message("the section of `{0}` holds a part of the one that `{1}` repeats, which begins "
                   "before it",
                   ctx.text(where), ctx.text(other))
          .note(other, "the other repeat");
  }

  bool nest_ = false; ///< repeated sections lie inside each other or apart

  /// A jump out of the section: the control goes on to count the pass.
  static void left(const RepeatedSection &section, const FileSummary &file, RuleContext &ctx) {
    for (const Block &block : blocks(file.reader, section.first, section.after)) {
      for (const Item &item : block.items) {
        if (item.kind != ItemKind::Jump && item.kind != ItemKind::Input)
          continue;
        for (const Argument &target : block.argumentsOf(item)) {
          const auto to = blockNamed(file.index, block, item, target);
          if (!to || section.holds(*to) || *to == section.after || *to == section.at)
            continue;
          const SourceRange where{file.source.id(), target.begin, target.end};
          if (auto finding = ctx.report(where))
            finding.severity(Severity::Warning)
                .message("`{0}` leads out of a section that is repeated: the repeat stays open",
                         ctx.text(where))
                .note(SourceRange{file.source.id(), section.begin, section.end}, "repeated here");
          break;
        }
      }
    }
  }
};

} // namespace
NCVET_RULE(FlowStructureMismatch, flow_structure_mismatch)
} // namespace ncvet
