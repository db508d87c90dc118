// The two blocks of a two-block cycle can be skipped separately.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/repeated_sections.h"
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class FlowBlockSkipChangesFlow final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.handleNotices();
    statements_ = to.flag("statements");
    to.onCode([&](const CodeInfo &code) {
      return to.dialect().codes[code.base].twoBlock || code.twoBlock ||
             (statements_ && ends(code.action)) ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
    if (statements_)
      to.on(EventKind::Statement);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Statement)
      return statement(ctx.block().items[event.item()], ctx);
    if (!takenBack(event, ctx))
      ctx.reportNotices(id, event);
    if (statements_ && ends(ctx.code(event).action)) {
      if (ctx.block().skip >= 0)
        optional(ctx.range(*event.word), ctx);
      return;
    }
    if (!ctx.dialect().codes[ctx.code(event).base].twoBlock && !ctx.code(event).twoBlock)
      return;
    Block next;
    ctx.index().read(ctx.block().begin, next);
    do {
      if (next.next >= ctx.source().text().size() || next.next <= next.begin)
        return;
      ctx.index().read(next.next, next);
    } while (next.isEmpty() && next.kind != BlockKind::ProgramHeader);
    if (next.skip == ctx.block().skip)
      return;
    for (const Word &word : next.words) {
      if (word.address != event.word->address || !word.isNumber() ||
          word.codeNumber() != event.word->codeNumber())
        continue;
      const SourceRange range{ctx.source().id(), next.words.front().offset,
                              next.endOf(next.words.back())};
      if (auto finding = ctx.report(range))
        finding
            .message(
                "only one of the two blocks of `{0}` can be skipped: the other runs without it",
                ctx.text(*event.word))
            .note(ctx.blockRange(), "the first block of the pair");
      return;
    }
  }

  /// With one key for all optional blocks those after an optional jump run on no path.
  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (!statements_)
      return;
    for (const Block &block : blocks(file.reader))
      for (const Item &item : block.items)
        if (block.skip >= 0 && (item.kind == ItemKind::Jump || item.kind == ItemKind::Repeat))
          optional({file.source.id(), item.begin, item.end}, ctx);
  }

private:
  static constexpr llvm::StringLiteral id{"flow-block-skip-changes-flow"};

  static bool ends(Action action) {
    return action == Action::Return || action == Action::ProgramEnd ||
           action == Action::ProgramEndRewind;
  }

  /// Whether the program gives the operator back later what the code takes away.
  static bool takenBack(const Event &event, RuleContext &ctx) {
    const CodeIndex opposite = ctx.code(event).opposite;
    if (opposite == noCode)
      return false;
    const uint32_t end = ctx.index().programAt(ctx.block().begin).end;
    for (const Block &later : blocks(ctx.index(), ctx.block().next, end))
      if (llvm::is_contained(codesOf(ctx.dialect(), later), opposite))
        return true;
    return false;
  }

  static void optional(SourceRange range, RuleContext &ctx) {
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Warning)
          .message("`{0}` is in an optional block: a key of the panel decides where the program "
                   "goes on",
                   ctx.text(range));
  }

  /// A jump, call or repeat that may be left out, or whose target may be.
  static void statement(const Item &item, RuleContext &ctx) {
    const Block &block = ctx.block();
    const bool asks = item.kind == ItemKind::Input;
    if (item.kind != ItemKind::Jump && item.kind != ItemKind::Repeat &&
        item.kind != ItemKind::Call && !asks)
      return;
    if (block.skip >= 0 && !asks)
      return optional(ctx.range(item), ctx);
    if (item.kind == ItemKind::Call)
      return;
    Block named;
    for (const Argument &target : block.argumentsOf(item)) {
      const auto at = blockNamed(ctx.index(), block, item, target);
      if (!at)
        continue;
      ctx.index().read(*at, named);
      if (named.skip < 0)
        continue;
      const SourceRange where = ctx.range(target);
      if (auto finding = ctx.report(where))
        finding.severity(Severity::Warning)
            .message("`{0}` leads to an optional block: a key of the panel takes it away",
                     ctx.text(where));
    }
  }

  bool statements_ = false; ///< statements of an optional block are reported
};

} // namespace
NCVET_RULE(FlowBlockSkipChangesFlow, flow_block_skip_changes_flow)
} // namespace ncvet
