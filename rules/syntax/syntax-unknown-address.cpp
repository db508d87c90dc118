// An address letter that this control does not have.
#include "analyzer/facts/foreign_block.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct SyntaxUnknownAddressMemory {
  uint16_t axes = 0; ///< that the machine profile has; 0: it does not say
};

class SyntaxUnknownAddress final : public StatefulRule<SyntaxUnknownAddressMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::Syntax, EventKind::WordIssue});
    isoSigns_ = to.dialect().facts->text.isoSignsForeign;
    if (!to.dialect().facts->text.axesOfMachine)
      return;
    for (unsigned i = 0; i < axisCount; ++i)
      if (to.machine().axes[i].min || to.machine().axes[i].max)
        memory().axes |= uint16_t(1u << i);
    // A list without the axes that every machine has says something of single ones only.
    constexpr uint16_t always = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Z);
    if ((memory().axes & always) == always)
      to.on({EventKind::Motion, EventKind::Statement});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Motion) {
      for (const Word &word : ctx.block().words) {
        const AddressInfo &address = ctx.dialect().addresses[word.address];
        if (address.kind == AddressKind::Axis && !(memory().axes >> unsigned(address.axis) & 1))
          if (auto finding = ctx.report(word))
            finding.message("`{0}`: the machine profile has no axis {1}", ctx.text(word),
                            ctx.dialect().addressName(word.address));
      }
      return;
    }
    if (event.kind == EventKind::Statement)
      return inBrackets(ctx.block().items[event.item()], ctx);
    if (event.kind == EventKind::Syntax) {
      const SyntaxIssue &issue = ctx.block().issues[event.issue()];
      if (issue.kind != SyntaxIssueKind::SymbolAsAddress)
        return;
      const SourceRange range = ctx.range(issue);
      if (ctx.text(range).contains('/')) // `G83/R`: block-foreign-dialect-code speaks
        return;
      if (isoSigns_ && isIsoSign(ctx.text(range)))
        return; // another rule says whose it is
      if (auto finding = ctx.report(range))
        finding.message("`{0}`: no address of this control is written so", ctx.text(range));
      return;
    }
    if (event.wordIssue() != WordIssue::Unknown)
      return sleepInShape();
    // The letters of a macro call are arguments, whatever they mean elsewhere.
    if (ctx.find({Action::MacroCall, Action::MacroModal}) || holdsForeignCode(ctx))
      return;
    for (const Word &word : ctx.block().words)
      if (!(ctx.dialect().known & maskOf(word.address)) && !explained(word, ctx) &&
          !(isoSigns_ && isIsoSign(ctx.text(word))))
        if (auto finding = ctx.report(word)) {
          const std::string instead = isRadius(word, ctx)
                                          ? "; the radius of an arc is " +
                                                ctx.dialect().addressName(ctx.dialect().arcRadius)
                                          : "";
          finding.message("`{0}`: this control has no address {1}, the block is refused{2}",
                          ctx.text(word), ctx.dialect().addressName(word.address), instead);
        }
  }

private:
  /// `G3 X5 R2` where the radius has an address of several letters.
  static bool isRadius(const Word &word, const RuleContext &ctx) {
    return word.address == letterAddress('R') && ctx.dialect().arcRadius >= firstNamed &&
           ctx.find({Action::ArcCw, Action::ArcCcw});
  }

  /// `POS[V]=10`: the letter of an axis that a positioning or feed word names.
  void inBrackets(const Item &item, RuleContext &ctx) const {
    const llvm::StringRef name =
        ctx.text(SourceRange{ctx.source().id(), item.nameBegin, item.nameEnd});
    const auto [word, rest] = name.split('[');
    const llvm::StringRef index = rest.take_until([](char c) { return c == ']'; }).trim();
    const std::string known = word.trim().upper();
    if (item.kind != ItemKind::Assignment || index.size() != 1 || !llvm::isAlpha(index[0]) ||
        (known != "POS" && known != "POSA" && known != "POSP" && known != "FA" && known != "FL" &&
         known != "OVRA" && known != "ACC"))
      return;
    const AddressInfo &address = ctx.dialect().addresses[letterAddress(llvm::toUpper(index[0]))];
    if (address.kind != AddressKind::Axis || (memory().axes >> unsigned(address.axis) & 1))
      return;
    if (auto finding = ctx.report(SourceRange{ctx.source().id(), item.nameBegin, item.nameEnd}))
      finding.message("`{0}`: the machine profile has no axis {1}", name, index.upper());
  }

  /// A code of the block has something to say of just this address.
  static bool explained(const Word &word, const RuleContext &ctx) {
    return llvm::any_of(ctx.codes(), [&](const CodeUse &use) {
      return llvm::any_of(ctx.code(use).notices,
                          [&](const Notice &notice) { return notice.at == word.address; });
    });
  }

  bool isoSigns_ = false; ///< `O1000` and `#1` are known as another control's
};

} // namespace
NCVET_RULE(SyntaxUnknownAddress, syntax_unknown_address)
} // namespace ncvet
