// A called program writes a variable that the caller has set and still needs.
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

#include "llvm/ADT/StringExtras.h"

#include <set>

namespace ncvet {
namespace {

class VariableClobberedBySubprogram final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().facts->variables.sharedByPrograms)
      to.on(EventKind::CallReturned);
    ofMacros_ = to.dialect().facts->variables.ofMacros;
    if (!ofMacros_.empty())
      to.on(EventKind::Assignment);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Assignment)
      return written(event, ctx);
    const MachineState &before = ctx.before(), &after = ctx.after();
    if (ctx.outcome().flow.kind != FlowKind::CallNamed || after.may(Fact::UnknownCode))
      return;
    constexpr unsigned readable = 60;
    std::set<uint64_t> seen;
    const auto size = uint32_t(ctx.source().text().size());
    for (const Block &next : blocks(ctx.index(), ctx.block().next, size, readable)) {
      for (const ExpressionOp &op : next.operations) {
        if (op.op != Op::Variable) // only a variable's value is a key
          continue;
        const auto key = uint64_t(op.value);
        if (!seen.insert(key).second || !isNumbered(op, ctx) ||
            before.commons.given(key) != Truth::Yes ||
            before.commons.get(key) == after.commons.get(key))
          continue;
        if (auto finding = ctx.report(ctx.blockRange()))
          finding
              .message("the called program writes a variable that this program has set and reads "
                       "again: all programs share them")
              .note(ctx.range(next), "it is read here");
        return;
      }
      for (const Item &item : next.items) {
        if (item.kind != ItemKind::Assignment)
          return; // what runs next the text does not tell
        seen.insert(next.keyOf(item.target));
      }
    }
  }

private:
  std::vector<int> ofMacros_; ///< first and last number of each range that macros write

  /// A variable in which the machine's own macros keep their values.
  void written(const Event &event, RuleContext &ctx) const {
    constexpr int64_t firstOfMachine = 9000;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    if (program.hasHeader() && program.number >= firstOfMachine)
      return;
    for (size_t i = 0; i + 1 < ofMacros_.size(); i += 2) {
      if (event.variable() < ofMacros_[i] || event.variable() > ofMacros_[i + 1])
        continue;
      for (const Item &item : ctx.block().items) {
        if (item.kind != ItemKind::Assignment ||
            int64_t(ctx.block().keyOf(item.target)) != event.variable())
          continue;
        const SourceRange range{ctx.source().id(), item.begin, item.nameEnd};
        if (auto finding = ctx.report(range))
          finding.severity(Severity::Style)
              .message("`{0}`: macros of the machine, as those of its probe, write #{1} to #{2}",
                       ctx.text(range).rtrim(), ofMacros_[i], ofMacros_[i + 1]);
        return;
      }
    }
  }

  /// A variable without a meaning of its own: a letter and a number.
  static bool isNumbered(const ExpressionOp &op, const RuleContext &ctx) {
    const llvm::StringRef text = ctx.source().text(op.offset, op.offset + 2);
    return text.size() == 2 && (text[0] == 'R' || text[0] == 'r') && llvm::isDigit(text[1]);
  }
};

} // namespace
NCVET_RULE(VariableClobberedBySubprogram, variable_clobbered_by_subprogram)
} // namespace ncvet
