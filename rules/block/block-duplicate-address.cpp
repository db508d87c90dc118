// An address that is allowed once in a block is there twice.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/variable_key.h"

#include <array>
#include <set>

namespace ncvet {
namespace {

class BlockDuplicateAddress final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::WordIssue);
    if (to.dialect().lexical.commaSeparates)
      to.on(EventKind::Statement);
    for (const CodeInfo &code : to.dialect().codes)
      for (const WordSpec &spec : code.words)
        if (spec.variable)
          parameters_.insert(spec.variable);
    if (!parameters_.empty())
      to.on(EventKind::Assignment);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind != EventKind::WordIssue)
      sleepAtBlock();
    if (event.kind == EventKind::Statement)
      return numberedAgain(event.item(), ctx);
    if (event.kind == EventKind::Assignment)
      return parameterAgain(uint64_t(event.variable()), ctx);
    if (event.wordIssue() != WordIssue::Repeated)
      return sleepInShape();
    // Arguments of a macro call may be given in several sets of I, J and K.
    if (ctx.find({Action::MacroCall, Action::MacroModal}))
      return sets(ctx);
    const Block &block = ctx.block();
    const AddressMask repeated = block.repeated & ~ctx.dialect().repeatable;
    AddressMask seen = 0, told = 0;
    for (const Word &word : block.words) {
      const AddressMask mask = maskOf(word.address);
      if (!(repeated & mask) || word.has(wordNoValue)) // syntax-incomplete-word speaks of these
        continue;
      if (seen & mask && !(told & mask)) {
        told |= mask;
        report(*block.find(word.address), word, ctx);
      }
      seen |= mask;
    }
  }

private:
  /// More sets of I, J and K than a call passes on.
  static void sets(RuleContext &ctx) {
    constexpr unsigned most = 10;
    std::array<unsigned, 3> count{};
    for (const Word &word : ctx.block().words) {
      const unsigned which = word.address - letterAddress('I');
      if (word.address < letterAddress('I') || which >= count.size() || ++count[which] <= most)
        continue;
      if (auto finding = ctx.report(word))
        finding.message("`{0}` begins set {1} of I, J and K: a call passes {2} on", ctx.text(word),
                        count[which], most);
      return;
    }
  }

  /// `S2=500 S2=600`: the number belongs to the address.
  static void numberedAgain(size_t index, RuleContext &ctx) {
    const Block &block = ctx.block();
    const auto addressOf = [&](const Item &item) {
      const llvm::StringRef text = ctx.text(ctx.range(item));
      const llvm::StringRef name = text.take_until([](char c) { return c == '='; }).rtrim();
      const bool numbered = item.kind == ItemKind::Output && name.size() > 1 &&
                            name.size() < text.size() &&
                            llvm::StringRef("STst").contains(name[0]) &&
                            llvm::all_of(name.drop_front(), llvm::isDigit);
      return numbered ? name : llvm::StringRef();
    };
    const llvm::StringRef address = addressOf(block.items[index]);
    for (size_t i = 0; i < index && !address.empty(); ++i)
      if (address.equals_insensitive(addressOf(block.items[i]))) {
        const SourceRange range = ctx.range(block.items[index]);
        const SourceRange first = ctx.range(block.items[i]);
        if (auto finding = ctx.report(range))
          finding
              .message("`{0}` is in the block beside `{1}`: only one of them can count",
                       ctx.text(range), ctx.text(first))
              .note(first, "the first of the two");
        return;
      }
  }

  /// A cycle's parameter that the block sets twice.
  void parameterAgain(uint64_t key, RuleContext &ctx) const {
    if (!parameters_.count(key))
      return;
    const Item *first = nullptr;
    for (const Item &item : ctx.block().items) {
      if (!sets(item, key, ctx))
        continue;
      if (!first) {
        first = &item;
        continue;
      }
      const SourceRange again = ctx.range(item), before = ctx.range(*first);
      if (auto finding = ctx.report(again))
        finding.severity(Severity::Warning)
            .message("`{0}` sets again what `{1}` of the same block has set", ctx.text(again),
                     ctx.text(before))
            .note(before, "the first of the two");
    }
  }

  /// `<DRA=0>` gives the variable a value, and so does the instruction of the same name, `<DRA:0>`.
  static bool sets(const Item &item, uint64_t key, const RuleContext &ctx) {
    const Block &block = ctx.block();
    if (item.kind == ItemKind::Instruction)
      return variableKey(ctx.text(SourceRange{ctx.source().id(), item.nameBegin, item.nameEnd})) ==
             key;
    return item.kind == ItemKind::Assignment && block.keyOf(item.target) == key &&
           llvm::any_of(block.words, [&](const Word &word) {
             return word.address == variableAddress && word.offset == item.begin;
           });
  }

  std::set<uint64_t> parameters_; ///< keys of the variables that codes read

  /// `again` and what comes after it with the same address.
  static void report(const Word &first, const Word &again, RuleContext &ctx) {
    auto finding = ctx.report(again);
    if (!finding)
      return;
    llvm::SmallVector<const Word *, 4> further;
    for (const Word &word : ctx.block().words)
      if (word.address == again.address && word.offset > again.offset)
        further.push_back(&word);
    const llvm::StringRef text = ctx.text(first);
    const bool same = text == ctx.text(again) && llvm::all_of(further, [&](const Word *word) {
                        return ctx.text(*word) == text;
                      });
    const std::string count = further.empty() ? "" : formatted(", and {0} more", further.size());
    finding.message(same ? "`{0}` is in the block twice{2}"
                         : "`{1}` is in the block beside `{0}`{2}: only one of them can count",
                    text, ctx.text(again), count);
    finding.note(ctx.range(first), "the first of them");
    // Of two values only the programmer knows which one is meant.
    if (!same)
      return;
    finding.fix(FixSafety::Safe, "delete the second word", ctx.remove(again));
    for (const Word *word : further)
      finding.edit(ctx.remove(*word));
  }
};

} // namespace
NCVET_RULE(BlockDuplicateAddress, block_duplicate_address)
} // namespace ncvet
