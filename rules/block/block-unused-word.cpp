// A word that no code of the block and no code in force takes.
#include "analyzer/facts/foreign_block.h"
#include "analyzer/facts/word_checks.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <set>

namespace ncvet {
namespace {

struct BlockUnusedWordMemory {
  bool foreign = false; ///< the program holds codes of another control
};

class BlockUnusedWord final : public StatefulRule<BlockUnusedWordMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::WordIssue);
    to.onNotices(id);
    for (const CodeInfo &code : to.dialect().codes)
      if (readsParameters(code))
        for (const WordSpec &spec : code.words)
          if (spec.variable)
            parameters_.insert(spec.variable);
    if (!parameters_.empty())
      to.on({EventKind::Assignment, EventKind::CycleRun});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code)
      return ctx.reportNotices(id, event);
    if (event.kind == EventKind::CycleRun) {
      // A later hole of the cycle whose block gives a parameter anew.
      if (event.code != noCode && !ctx.codeWord(event) &&
          givesNoticedValue(ctx.block(), ctx.code(event), id))
        ctx.reportNotices(id, event);
      return;
    }
    if (event.kind == EventKind::Assignment)
      return ctx.codes().empty() ? sleepAtBlock() : parameter(uint64_t(event.variable()), ctx);
    if (event.wordIssue() != WordIssue::Special)
      return;
    // What an unknown code or another control's takes is not known either; the letters of a macro
    // call are arguments.
    if ((ctx.outcome().kinds & bitOf(EventKind::UnknownCode)) ||
        ctx.before().may(Fact::UnknownCode) || ctx.after().may(Fact::UnknownCode) ||
        ctx.before().modalCalls || ctx.before().switches.mayBeOn(ctx.dialect().dataSwitches))
      return;
    // After another control's cycle its words go on (`X20 Y5`, `R-3.`): the code is the mistake.
    memory().foreign |= holdsForeignCode(ctx);
    if (memory().foreign)
      return;
    const std::optional<AddressMask> taken = takenBy(ctx);
    if (!taken)
      return;
    const Dialect &dialect = ctx.dialect();
    // Of words that are in the block twice another rule names the second one.
    const AddressMask repeated = ctx.block().repeated & ~dialect.repeatable;
    AddressMask seen = 0;
    for (const Word &word : ctx.block().words) {
      const AddressMask mask = maskOf(word.address);
      const bool isAgain = seen & mask & repeated;
      seen |= mask;
      // Words that limit or position the spindle, and switches, act by themselves.
      const AddressMask alone = dialect.plain | dialect.speedLimitWords | dialect.orientWords |
                                dialect.switchWords | dialect.elementWords;
      if (isAgain || (mask & alone) || !(mask & dialect.known) || (mask & *taken) ||
          word.address == letterAddress('N') || word.address == letterAddress('O') ||
          isOffsetOfOther(word, ctx) || isVariable(word, ctx) || namesSpindle(word, ctx))
        continue;
      auto finding = ctx.report(word);
      if (!finding)
        continue;
      finding.message("`{0}` is used by no code of the block{1}: the control ignores it or stops",
                      ctx.text(word), ctx.codes().empty() ? " or in force" : "");
      if (!(mask & repeated)) // without it the second one would be unused
        finding.fix(FixSafety::Unsafe, "delete the word", ctx.remove(word));
    }
    sleepInShape(); // addresses and codes alone decide it
  }

private:
  static constexpr llvm::StringLiteral id{"block-unused-word"};

  /// Cycles, and codes that only keep values for what comes later.
  static bool readsParameters(const CodeInfo &code) {
    return code.action == Action::Cycle || code.action == Action::ProfileBegin ||
           (code.action == Action::None && code.exclusive);
  }

  /// `D1` away from a straight line: another rule says whose word it is.
  static bool isOffsetOfOther(const Word &word, const RuleContext &ctx) {
    return ctx.dialect().addresses[word.address].lineLength &&
           llvm::none_of(ctx.codes(),
                         [&](const CodeUse &use) { return isMotion(ctx.code(use).action); });
  }

  /// `S500 $1`: the speed of that spindle.
  static bool namesSpindle(const Word &word, const RuleContext &ctx) {
    return ctx.block().has(letterAddress('S')) &&
           llvm::StringRef(ctx.dialect().addressName(word.address)).startswith("$");
  }

  /// `I=I+1` after `DEF INT I`: a name that a variable cannot have is told where it is defined.
  static bool isVariable(const Word &word, const RuleContext &ctx) {
    const uint64_t key = variableKey(ctx.dialect().addressName(word.address));
    return word.has(wordExpression) && ctx.before().locals.given(key) != Truth::No;
  }

  std::set<uint64_t> parameters_; ///< keys of the variables that cycles read

  /// A cycle's parameter beside a cycle that does not read it.
  void parameter(uint64_t key, RuleContext &ctx) const {
    if (!parameters_.count(key))
      return;
    const CodeInfo *cycle = nullptr;
    for (const CodeUse &use : ctx.codes()) {
      bool reads = false;
      for (const WordSpec &spec : ctx.code(use).words) {
        if (spec.variable == key || spec.orVariable == key)
          return;
        reads |= spec.variable != 0;
      }
      if (reads && readsParameters(ctx.code(use)))
        cycle = &ctx.code(use);
    }
    if (!cycle)
      return;
    for (const Item &item : ctx.block().items) {
      if (item.kind != ItemKind::Assignment || ctx.block().keyOf(item.target) != key)
        continue;
      const SourceRange range = ctx.range(item);
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Style)
            .message("`{0}` is beside `{1}`, which does not read it", ctx.text(range), cycle->name);
      return;
    }
  }

  static AddressMask wordsOf(const CodeInfo &code) {
    AddressMask mask = code.takes;
    for (const WordSpec &spec : code.words)
      mask |= spec.any;
    return mask;
  }

  /// Words that some code of the block, or one that may be in force, reads; none: anything may be.
  static std::optional<AddressMask> takenBy(const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    AddressMask taken = 0;
    for (const CodeUse &use : ctx.codes()) {
      const CodeInfo &code = ctx.code(use);
      if (code.action == Action::MacroCall || code.action == Action::MacroModal ||
          code.action == Action::MachineSpecific)
        return std::nullopt;
      taken |= wordsOf(code);
    }
    for (const StandardGroup which : {StandardGroup::Motion, StandardGroup::Cycle}) {
      const GroupIndex group = dialect.group(which);
      if (group == noGroup)
        continue;
      // After the block: a code of the block itself has replaced the one before.
      const uint64_t active = ctx.before().group(group) | ctx.after().group(group);
      for (size_t i = 0; i < dialect.groups[group].members.size(); ++i) {
        if (!(active >> i & 1))
          continue;
        const CodeInfo &code = dialect.codes[dialect.groups[group].members[i]];
        const bool replaced = llvm::any_of(ctx.codes(), [&](const CodeUse &use) {
          return ctx.code(use).group == group ||
                 (which == StandardGroup::Cycle && ctx.code(use).cancelsCycle);
        });
        if (!replaced)
          taken |= wordsOf(code);
      }
    }
    return taken;
  }
};

} // namespace
NCVET_RULE(BlockUnusedWord, block_unused_word)
} // namespace ncvet
