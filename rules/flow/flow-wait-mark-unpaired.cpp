// A wait mark of one channel that the program of the other channel never comes to.
#include "analyzer/facts/called_blocks.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/rule.h"

#include "llvm/Support/Path.h"

#include <set>

namespace ncvet {
namespace {

class FlowWaitMarkUnpaired final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onNotices(id); }

  void on(const Event &event, RuleContext &ctx) const override {
    const Item *const wait = instructionOf(event.word, ctx.block());
    Project *const project = ctx.unit().project;
    if (!wait || !project || ctx.callDepth() > 0)
      return;
    const std::optional<int64_t> mark = markOf(*wait, ctx.block());
    const auto [stem, own] = channelOf(ctx.source().path());
    if (!mark || own == 0)
      return;
    for (unsigned channel = 1; channel <= mostChannels; ++channel) {
      if (channel == own || !names(*wait, ctx.block(), channel))
        continue;
      const auto [other, program] =
          project->findProgram(ctx.unit(), stem + "_" + std::to_string(channel));
      if (!other || !program || other == &ctx.unit() || mayCome(*other, *program, *mark))
        continue;
      if (auto finding = ctx.report(ctx.range(*wait)))
        finding.message("mark {0} is never set in {1}, the program of channel {2}: this channel "
                        "waits for ever",
                        *mark, llvm::sys::path::filename(other->source.path()), channel);
      return;
    }
  }

private:
  static constexpr llvm::StringLiteral id{"flow-wait-mark-unpaired"};
  static constexpr llvm::StringLiteral family{"wait-mark"};
  static constexpr unsigned mostChannels = 10; // of the largest control

  /// `PART_2.MPF` is the program of channel 2: what its channels have in common, and the number.
  static std::pair<std::string, unsigned> channelOf(llvm::StringRef path) {
    const auto [stem, digits] = llvm::sys::path::stem(path).rsplit('_');
    unsigned channel = 0;
    if (digits.getAsInteger(10, channel) || channel > mostChannels)
      return {"", 0};
    return {stem.str(), channel};
  }

  /// The statement to which a keyword of the block belongs.
  static const Item *instructionOf(const Word *word, const Block &block) {
    const auto *const item = llvm::find_if(block.items, [&](const Item &one) {
      return word && one.kind == ItemKind::Instruction && one.begin == word->offset;
    });
    return item == block.items.end() ? nullptr : item;
  }

  static std::optional<int64_t> numberOf(const Argument &argument, const Block &block) {
    const auto number = block.numberIn(argument.expression);
    if (argument.kind != ArgumentKind::Expression || !number)
      return std::nullopt;
    return int64_t(*number);
  }
  static std::optional<int64_t> markOf(const Item &wait, const Block &block) {
    const llvm::ArrayRef<Argument> arguments = block.argumentsOf(wait);
    return arguments.empty() ? std::nullopt : numberOf(arguments[0], block);
  }
  /// Whether the channel is one of those that are waited for.
  static bool names(const Item &wait, const Block &block, unsigned channel) {
    return llvm::any_of(block.argumentsOf(wait).drop_front(), [&](const Argument &one) {
      return numberOf(one, block) == int64_t(channel);
    });
  }

  static bool waits(const CodeInfo &code) {
    return llvm::any_of(code.notices, [](const Notice &notice) { return id == notice.rule; });
  }

  /// Whether the block sets the mark, or one that its text does not tell.
  static bool sets(const Dialect &dialect, const Block &block, int64_t mark) {
    return llvm::any_of(block.words, [&](const Word &word) {
      const CodeIndex code = codeOf(dialect, word);
      if (code == noCode || dialect.codes[code].family != family)
        return false;
      const Item *const item = instructionOf(&word, block);
      if (!item)
        return false;
      // The further arguments of a wait are its channels.
      llvm::ArrayRef<Argument> marks = block.argumentsOf(*item);
      if (waits(dialect.codes[code]))
        marks = marks.take_front(1);
      return llvm::any_of(
          marks, [&](const Argument &one) { return numberOf(one, block).value_or(mark) == mark; });
    });
  }

  /// Whether the program, or one that it calls, may set the mark.
  static bool mayCome(FileUnit &unit, const ProgramInfo &program, int64_t mark) {
    const auto setsNone = [&](const Block &block) { return !sets(*unit.dialect, block, mark); };
    for (const Block &block : blocks(unit.index.reader(), program.body, program.end))
      if (!setsNone(block) || (entersProgram(block) && !eachCalledBlock(unit, block, setsNone)))
        return true;
    return false;
  }
};

} // namespace
NCVET_RULE(FlowWaitMarkUnpaired, flow_wait_mark_unpaired)
} // namespace ncvet
