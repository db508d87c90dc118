// A line that looks like a block of its own, but goes on with the block above, or belongs to none.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class MefiMissingBlockStart final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().lexical.blocksSpanLines)
      to.on({EventKind::Block, EventKind::Syntax});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const Block &block = ctx.block();
    if (event.kind == EventKind::Block)
      return merged(ctx);
    const SyntaxIssue &issue = block.issues[event.issue()];
    if (issue.kind != SyntaxIssueKind::OutsideBlock || block.words.empty())
      return;
    if (auto finding = ctx.report(ctx.range(block.words.front())))
      finding.severity(Severity::Warning)
          .message("this comes before the first `N`: it belongs to no block");
  }

private:
  /// A word after a line end that repeats a word of a line above.
  static void merged(RuleContext &ctx) {
    const Block &block = ctx.block();
    const Dialect &dialect = ctx.dialect();
    const llvm::StringRef text = ctx.source().text(block.begin, block.end);
    if (!text.contains('\n'))
      return;
    AddressMask seen = 0;
    uint64_t groups = 0;
    for (const Word &word : block.words) {
      const CodeIndex code = codeOf(dialect, word);
      const GroupIndex group = code == noCode ? noGroup : dialect.codes[code].group;
      const AddressMask mask = maskOf(word.address) & ~dialect.repeatable;
      const bool again = (seen & mask) || (group != noGroup && (groups >> group & 1));
      seen |= mask;
      if (group != noGroup)
        groups |= uint64_t(1) << group;
      const size_t line = text.rfind('\n', word.offset - block.begin);
      if (!again || line == llvm::StringRef::npos ||
          block.words.front().offset > block.begin + line)
        continue;
      if (auto finding = ctx.report(word))
        finding
            .message("the line of `{0}` does not begin with `N`: it goes on with the block above, "
                     "which says the like already",
                     ctx.text(word))
            .note(SourceRange{ctx.source().id(), block.begin, block.numberEnd},
                  "the block begins here");
      return;
    }
  }
};

} // namespace
NCVET_RULE(MefiMissingBlockStart, mefi_missing_block_start)
} // namespace ncvet
