// An actual value is read before the moves before it are done.
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/preprocessor_reads.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct VariableReadAheadMemory {
  bool limited = false; ///< the program limits how far the control reads ahead
};

class VariableReadAhead final : public StatefulRule<VariableReadAheadMemory> {
public:
  void listen(Subscriptions &to) override {
    shown_ = to.dialect().facts->variables.shownAhead;
    if (!shown_.empty()) {
      to.onChange({EventKind::Block});
      to.onAction({Action::LookAheadLimit});
    }
    if (to.dialect().readAhead.empty())
      return;
    to.on(EventKind::Statement);
    to.onChange({EventKind::Block});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code) {
      memory().limited = true;
      return;
    }
    if (event.kind == EventKind::Block && !shown_.empty())
      places(ctx);
    // A value that is kept is wanted for what it is worth; others may be signals to wait for.
    const bool kept = event.kind == EventKind::Statement &&
                      ctx.block().items[event.item()].kind == ItemKind::Assignment;
    eachPrepared(event, ctx, [&](const Expression &value) { look(value, !kept, ctx); });
  }

private:
  std::vector<int> shown_; ///< first and last number of each range that shows places

  /// `#1=#5021` right after a move.
  void places(RuleContext &ctx) const {
    const Block &block = ctx.block();
    if (memory().limited || block.operations.empty())
      return;
    for (const ExpressionOp &op : block.operations) {
      if (op.op != Op::Variable)
        continue;
      for (size_t i = 0; i + 1 < shown_.size(); i += 2) {
        if (op.value < shown_[i] || op.value > shown_[i + 1] || !movedJustBefore(ctx))
          continue;
        const llvm::StringRef text = ctx.source().text(op.offset, block.end);
        const auto length = uint32_t(text.drop_front().take_while(llvm::isDigit).size() + 1);
        const SourceRange range{ctx.source().id(), op.offset, op.offset + length};
        if (auto finding = ctx.report(range))
          finding.severity(Severity::Warning)
              .message("`{0}` is read while the move before it still runs: `G103 P1` and empty "
                       "blocks, or a stop, make the control wait",
                       ctx.text(range));
        return;
      }
    }
  }

  /// The block before it moves the axes, and no empty line is between.
  static bool movedJustBefore(const RuleContext &ctx) {
    Block previous;
    return readPrevious(ctx, previous) && previous.next == ctx.block().begin &&
           previous.hasAny(ctx.dialect().axisWords) && previous.items.empty() &&
           !findCode(ctx.dialect(), previous,
                     {Action::MacroCall, Action::MacroModal, Action::DataInput,
                      Action::PresetPosition, Action::LocalShift, Action::ProgramStop});
  }

  static void look(const Expression &value, bool ofAxis, RuleContext &ctx) {
    if (!readsAhead(value, ctx, ofAxis) || !movesBefore(ctx))
      return;
    // Under compensation the wait itself is the fault, and another rule's.
    if (ctx.before().compensationActive(ctx.dialect()) == Truth::Yes)
      return;
    const SourceRange range = ctx.range(value);
    if (auto finding = ctx.report(range))
      finding.message("`{0}` is read while the moves before it still run: `STOPRE` makes the "
                      "control wait for them",
                      ctx.text(range));
  }

  /// Whether the control waits for its moves at the block.
  static bool waits(const Block &block, const Dialect &dialect) {
    return llvm::any_of(block.words, [&](const Word &word) {
      const CodeIndex code = codeOf(dialect, word);
      return code != noCode && dialect.codes[code].stopsPreparation;
    });
  }

  /// A move comes before, in plain order, and nothing that waits for it.
  static bool movesBefore(RuleContext &ctx) {
    constexpr unsigned lookBack = 20;
    Block block;
    uint32_t at = ctx.block().begin;
    const ProgramInfo &program = ctx.index().programAt(at);
    for (unsigned i = 0; i < lookBack && at > program.body; ++i) {
      at = ctx.source().lines().lineBegin(at - 1);
      ctx.index().read(at, block);
      if (block.hasLabel() || waits(block, ctx.dialect()))
        return false;
      if (block.hasAny(ctx.dialect().axisWords))
        return llvm::none_of(block.items,
                             [](const Item &one) { return one.kind == ItemKind::Structure; });
      for (const Item &item : block.items)
        if (item.kind != ItemKind::Assignment && item.kind != ItemKind::Output)
          return false;
    }
    return false;
  }
};

} // namespace
NCVET_RULE(VariableReadAhead, variable_read_ahead)
} // namespace ncvet
