// Block numbers that do not ascend, or do not stand first in their block.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

/// From here on a fall to a tenth or less is numbering that begins anew, as long programs do.
constexpr int64_t wrapsFrom = 9000;

class ProgramBlockNumberOrder final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::WordIssue); }

  void on(const Event &event, RuleContext &ctx) override {
    if (WordIssue(event.number) != WordIssue::NumberInside)
      return;
    // A local call may name its target so.
    if (ctx.find({Action::CallLocal, Action::MacroCall, Action::MacroModal}))
      return;
    if (auto finding = ctx.report(*event.word))
      finding.message("`{0}` does not stand first in its block: searching for the number does not find it",
                      ctx.text(*event.word));
  }

  void finish(const FileSummary &file, RuleContext &ctx) override {
    for (const ProgramInfo &program : file.index.programs())
      ascending(program, file, ctx);
  }

private:
  /// The first descent of a program. Numbers that something refers to are labels, not an order.
  static void ascending(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) {
    const llvm::ArrayRef<NumberedBlock> numbers = file.index.numbers(program);
    const auto byOffset = [](const NumberedBlock &a, const NumberedBlock &b) {
      return a.offset < b.offset;
    };
    // Sorted by number already: when the places ascend too, so do the numbers.
    if (std::is_sorted(numbers.begin(), numbers.end(), byOffset))
      return;
    std::vector<NumberedBlock> blocks;
    for (const NumberedBlock &block : numbers)
      if (!std::binary_search(file.usedNumbers.begin(), file.usedNumbers.end(), block.number))
        blocks.push_back(block);
    llvm::sort(blocks, byOffset);
    for (size_t i = 1; i < blocks.size(); ++i) {
      if (blocks[i].number >= blocks[i - 1].number)
        continue;
      if (blocks[i - 1].number >= wrapsFrom && blocks[i].number < wrapsFrom / 10)
        continue;
      const auto numberAt = [&](const NumberedBlock &where) {
        Block block;
        file.reader.read(where.offset, block);
        return SourceRange{file.source.id(), block.numberBegin, block.numberEnd};
      };
      if (auto finding = ctx.report(numberAt(blocks[i])))
        finding
            .message("N{0} stands behind N{1}: blocks run in the order in which they are written, "
                     "never by their numbers",
                     blocks[i].number, blocks[i - 1].number)
            .note(numberAt(blocks[i - 1]), "the higher number");
      return;
    }
  }
};

} // namespace
NCVET_RULE(ProgramBlockNumberOrder, program_block_number_order)
} // namespace ncvet
