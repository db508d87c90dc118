// The first block of a tool section has no number.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class ProgramBlockNumberMissing final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::ToolChange);
    every_ = to.dialect().facts->program.everyBlockNumbered;
    if (every_ || to.flag("everyBlock"))
      to.on(EventKind::Block);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const Block &block = ctx.block();
    if (event.kind == EventKind::Block)
      return every_ ? anyBlock(ctx) : bareNumber(ctx);
    if (block.number >= 0 || !event.word || ctx.callDepth() > 0)
      return;
    auto finding = ctx.report(event, event.certain);
    if (!finding)
      return;
    finding.message("the block of `{0}` has no number: a restart at this tool cannot find it",
                    ctx.text(*event.word));
    // A number that nothing else has, after the tool's own.
    const int64_t tool = event.tool() > 0 ? event.tool() : 1;
    const ProgramInfo &program = ctx.index().programAt(block.begin);
    int64_t number = tool * 100;
    while (ctx.index().block(program, number, 0))
      ++number;
    const SourceRange words = ctx.blockRange();
    // A bare `N` that opens the block lacks its digits only.
    const llvm::StringRef text = ctx.source().text().substr(words.begin, 2);
    const bool bare = text.size() == 2 && (text[0] | 32) == 'n' && !llvm::isAlnum(text[1]);
    finding.fix(FixSafety::Unsafe, "number the block",
                bare ? ctx.insertBefore(words.begin + 1, std::to_string(number))
                     : ctx.insertBefore(words.begin, formatted("N{0} ", number)));
  }

private:
  /// An `N` that opens a block and says no number.
  static void bareNumber(RuleContext &ctx) {
    const Block &block = ctx.block();
    if (block.number >= 0 || block.isEmpty() || ctx.find({Action::ProgramHead}) ||
        ctx.outcome().kinds & bitOf(EventKind::ToolChange))
      return;
    const llvm::StringRef text = ctx.source().text().substr(block.begin, 2);
    if (text.empty() || (text[0] | 32) != 'n' || (text.size() > 1 && llvm::isAlnum(text[1])))
      return;
    if (auto finding = ctx.report(SourceRange{ctx.source().id(), block.begin, block.begin + 1}))
      finding.severity(Severity::Style).message("the block has no number: a search cannot find it");
  }

  /// Where every block has a number. What only resets, and data for the control's files, has none.
  static void anyBlock(RuleContext &ctx) {
    const Block &block = ctx.block();
    if (block.number >= 0 || block.isEmpty() || !block.hasAny(~maskOf(variableAddress)) ||
        ctx.outcome().kinds & bitOf(EventKind::ToolChange))
      return;
    for (const CodeUse &use : ctx.codes())
      if (const Action action = ctx.code(use).action;
          action == Action::Reset || action == Action::DataInput)
        return;
    if (llvm::any_of(ctx.codes(), [&](const CodeUse &use) { return isOfToolFile(use, ctx); }))
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding.message("this block has no number, and every block of this control has one");
  }

  /// The code that opens the file of tools, and those that write it.
  static bool isOfToolFile(const CodeUse &use, const RuleContext &ctx) {
    constexpr llvm::StringLiteral name{"tool-file"};
    const auto &switches = ctx.dialect().switches;
    const auto is = [&](unsigned i) { return i < switches.size() && switches[i].id == name; };
    const CodeInfo &code = ctx.code(use);
    if (is(code.effect.index))
      return true;
    return llvm::any_of(code.notices, [&](const Notice &notice) {
      for (unsigned i = 0; i < switches.size(); ++i)
        if (is(i) && (notice.when.off >> i & 1))
          return true;
      return false;
    });
  }

  bool every_ = false; ///< every block has a number, not only those of tools
};

} // namespace
NCVET_RULE(ProgramBlockNumberMissing, program_block_number_missing)
} // namespace ncvet
