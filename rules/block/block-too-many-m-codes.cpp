// More M codes in a block than the control takes.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class BlockTooManyMCodes final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::UnknownCode);
    to.onCode([](const CodeInfo &code) { return code.letter == 'M'; });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const Block &block = ctx.block();
    if (functions(event, ctx))
      return;
    if (event.word->address != letterAddress('M') || !(block.repeated & maskOf('M')))
      return;
    const double limit =
        ctx.machine().number("mCodesPerBlock").value_or(ctx.dialect().limits.mCodesPerBlock);
    if (limit < 1 || ctx.find({Action::MacroCall, Action::MacroModal}))
      return;
    double count = 0;
    for (const Word &word : block.words) {
      if (word.address != letterAddress('M'))
        continue;
      if (++count > limit && &word == event.word)
        return report(word, limit, ctx);
    }
  }

private:
  /// M words and the other words that go to the machine, all together.
  static bool functions(const Event &event, RuleContext &ctx) {
    const Block &block = ctx.block();
    const unsigned most = ctx.dialect().limits.functionsPerBlock;
    if (!most || block.words.size() + block.items.size() <= most || event.word != block.find('M'))
      return false;
    constexpr AddressMask counted = lettersMask("MSTDH");
    unsigned count = 0;
    const Word *further = nullptr;
    for (const Word &word : block.words)
      if (counted & maskOf(word.address) && ++count > most && !further)
        further = &word;
    for (const Item &item : block.items)
      count += item.kind == ItemKind::Output && ctx.text(ctx.range(item)).contains('=') &&
               llvm::StringRef("MSTH").contains(llvm::toUpper(ctx.text(ctx.range(item))[0]));
    if (count <= most)
      return false;
    if (auto finding = further ? ctx.report(*further) : ctx.report(*event.word))
      finding.message("{0} auxiliary functions are in the block, and the control takes {1}", count,
                      most);
    return true;
  }

  static void report(const Word &word, double limit, RuleContext &ctx) {
    auto finding = ctx.report(word);
    if (!finding)
      return;
    const char *message = limit == 1
                              ? "`{0}` is the second M code of its block: the control executes one"
                              : "`{0}` is one M code too many: the control takes {1} in a block";
    finding.message(message, ctx.text(word), int(limit))
        .fix(FixSafety::Unsafe, "move it to its own block after this one", ctx.remove(word))
        .edit(ctx.insertBlockAfter(ctx.text(word)));
  }
};

} // namespace
NCVET_RULE(BlockTooManyMCodes, block_too_many_m_codes)
} // namespace ncvet
