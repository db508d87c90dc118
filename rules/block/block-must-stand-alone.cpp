// A code that needs a block of its own shares it with words that are not its own.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class BlockMustStandAlone final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onCode([](const CodeInfo &code) {
      return code.alone || llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
  }

  void on(const Event &event, RuleContext &ctx) override {
    ctx.reportNotices(id, event);
    const CodeInfo &code = ctx.code(event);
    if (!code.alone)
      return;
    AddressMask own = code.takes;
    for (const WordSpec &spec : code.words)
      own |= spec.any;
    for (const Word &word : ctx.block().words) {
      if (&word == event.word || own & maskOf(word.address))
        continue;
      if (auto finding = ctx.report(word))
        finding
            .message("`{0}` stands in the block of `{1}`, which wants a block of its own",
                     ctx.text(word), ctx.text(*event.word))
            .fix(FixSafety::Unsafe, "put the code into a block of its own", ctx.remove(*event.word))
            .edit(ctx.insertBlockBefore(own_block(event, own, ctx)));
      return;
    }
  }

private:
  static constexpr llvm::StringLiteral id{"block-must-stand-alone"};

  static std::string own_block(const Event &event, AddressMask, const RuleContext &ctx) {
    return ctx.text(*event.word).str();
  }
};

} // namespace
NCVET_RULE(BlockMustStandAlone, block_must_stand_alone)
} // namespace ncvet
