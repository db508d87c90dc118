// Blocks that no path reaches.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "formats/dialect/control_facts.h"

#include <algorithm>

namespace ncvet {
namespace {

/// The last word or statement that ends what the block does.
SourceRange contentOf(const Block &block, const SourceFile &source) {
  uint32_t begin = block.end, end = block.begin;
  for (const Word &word : block.words) {
    begin = std::min(begin, word.offset);
    end = std::max(end, block.endOf(word));
  }
  for (const Item &item : block.items) {
    begin = std::min(begin, item.begin);
    end = std::max(end, item.end);
  }
  return {source.id(), begin, std::max(begin, end)};
}

class FlowUnreachableBlock final : public Rule {
public:
  void listen(Subscriptions &to) override {
    afterEnd_ = to.flag("afterEnd");
    if (to.flag("actions"))
      to.on(EventKind::Statement);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    actsNever(ctx.block().items[event.item()], ctx);
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (!file.complete)
      return;
    for (const SourceRange &range : file.reached)
      check(file, range, ctx);
  }

private:
  /// `WHEN .. DO ..` without a number acts with the next move, and the program ends before one.
  static void actsNever(const Item &item, RuleContext &ctx) {
    const Block &here = ctx.block();
    if (item.kind != ItemKind::Output || item.condition == noExpression ||
        llvm::any_of(here.items, [&](const Item &other) {
          return other.kind == ItemKind::Instruction && other.begin == item.begin;
        }))
      return;
    BlocksAhead ahead(ctx);
    Block next;
    if (!ahead.next(next) || next.hasAny(ctx.dialect().axisWords) ||
        !findCode(ctx.dialect(), next, {Action::ProgramEnd, Action::ProgramEndRewind}))
      return;
    const SourceRange range = ctx.blockRange();
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Warning)
          .message("this action lasts as long as the next move, and the program ends before one");
  }

  bool afterEnd_ = false; ///< … of the program too, which is another rule's business elsewhere

  /// Reports what follows the end of a section that is executed, when it ends with a return
  /// or a jump. What follows a program end is another rule's business, and a section that
  /// nothing before it leads around was not analysed at all.
  void check(const FileSummary &file, const SourceRange &reached, RuleContext &ctx) const {
    const ProgramInfo &program = file.index.programAt(reached.end - 1);
    if (reached.end >= program.end)
      return;
    Block block;
    readBlockAt(file.source, file.reader, reached.end - 1, block);
    const bool ends =
        afterEnd_ && findCode(ctx.dialect(), block, {Action::ProgramEnd, Action::ProgramEndRewind});
    const bool alarm = raisesAlarm(block, ctx.dialect());
    if (block.skip >= 0 || !(ends || alarm || leadsAway(block, ctx.dialect())))
      return;
    for (uint32_t at = reached.end; at < program.end; at = std::max(block.next, at + 1)) {
      file.reader.read(at, block);
      if (block.kind == BlockKind::Normal && ends && block.hasLabel())
        return; // a section that cycles and other programs name by its label
      if (block.isEmpty() || block.kind != BlockKind::Normal || isMark(block, ctx.dialect()))
        continue;
      // What a jump names is for other arguments than those of the calls in this file.
      if (block.number >= 0 && llvm::is_contained(file.usedNumbers, block.number))
        return;
      if (alarm && onlyWaits(block, ctx.dialect()))
        return;
      // Of a block that cannot be read that is said.
      if (block.issues.empty() && !file.isReached(block.begin) && !onlyEndsLoop(block) &&
          !(endsAfterLoop(block, ctx) && !ends))
        if (auto finding = ctx.report(contentOf(block, file.source))) {
          if (headsProgram(block))
            finding.severity(Severity::Warning)
                .message("this begins a program in the middle of another one: the control finds "
                         "a program in a file of its own, and never comes here");
          else
            finding.message("no path leads to this block: it is never executed");
        }
      return;
    }
  }

  /// `GROUP_END(0,0)`: an editor's mark, of which the control executes nothing.
  static bool isMark(const Block &block, const Dialect &dialect) {
    const auto isWord = [](const CodeInfo &one) {
      return !one.letter && one.action == Action::None && one.group == noGroup;
    };
    const CodeInfo *const code = findReading(dialect, block, isWord);
    return code && block.items.size() == 1 &&
           llvm::any_of(dialect.codes, [&](const CodeInfo &other) {
             return isWord(other) && other.opposite != noCode &&
                    &dialect.codes[other.opposite] == code;
           });
  }

  /// `PROC NAME`: most likely it is called by its name.
  static bool headsProgram(const Block &block) {
    return !block.items.empty() && block.items.front().kind == ItemKind::Parameters;
  }

  /// `END1` after a jump out of the loop: nothing is lost.
  static bool onlyEndsLoop(const Block &block) {
    return block.words.empty() && llvm::all_of(block.items, [](const Item &item) {
             return item.kind == ItemKind::End || item.kind == ItemKind::Structure;
           });
  }

  /// The `M30` that a program has by habit after a loop without end, or after `M99`; a subprogram
  /// its return.
  static bool endsAfterLoop(const Block &block, const RuleContext &ctx) {
    return findCode(ctx.dialect(), block,
                    {Action::ProgramEnd, Action::ProgramEndRewind, Action::Return});
  }

  /// After an alarm programs wait, go on elsewhere or return by habit: nothing is lost.
  static bool onlyWaits(const Block &block, const Dialect &dialect) {
    return llvm::any_of(block.items,
                        [](const Item &item) { return item.kind == ItemKind::Jump; }) ||
           findCode(dialect, block,
                    {Action::Return, Action::Dwell, Action::ProgramEnd, Action::ProgramEndRewind});
  }

  /// `#3000=1(..)` without a condition: the control stops there for good.
  static bool raisesAlarm(const Block &block, const Dialect &dialect) {
    const auto &messages = dialect.facts->messages;
    return block.items.size() == 1 && block.items.front().kind == ItemKind::Assignment &&
           llvm::any_of(messages.variables, [&](const auto variable) {
             return block.keyOf(block.items.front().target) == uint64_t(variable) &&
                    !llvm::is_contained(messages.stops, variable);
           });
  }

  static bool leadsAway(const Block &block, const Dialect &dialect) {
    if (findCode(dialect, block, {Action::Return}))
      return true;
    for (size_t i = 0; i < block.items.size(); ++i)
      if (block.items[i].kind == ItemKind::Repeat && block.items[i].count == noExpression)
        return true; // a repeat without a count that was never left
      else if (block.items[i].kind == ItemKind::Jump)
        return i == 0 || block.items[i - 1].kind != ItemKind::If;
    return false;
  }
};

} // namespace
NCVET_RULE(FlowUnreachableBlock, flow_unreachable_block)
} // namespace ncvet
