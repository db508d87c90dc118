// The two blocks of a two-block cycle can be skipped separately.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FlowBlockSkipChangesFlow final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onCode([&](const CodeInfo &code) {
      return to.dialect().codes[code.base].twoBlock || code.twoBlock;
    });
  }

  void on(const Event &event, RuleContext &ctx) override {
    Block next;
    ctx.index().reader().read(ctx.block().begin, next);
    do {
      if (next.next >= ctx.source().text().size() || next.next <= next.begin)
        return;
      ctx.index().reader().read(next.next, next);
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
};

} // namespace
NCVET_RULE(FlowBlockSkipChangesFlow, flow_block_skip_changes_flow)
} // namespace ncvet
