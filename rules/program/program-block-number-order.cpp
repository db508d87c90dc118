// Block numbers that do not ascend, are not first in their block, or are none of the control's.
#include "analyzer/facts/data_sections.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

/// From here on a fall to a tenth or less is numbering that begins anew, as long programs do.
constexpr int64_t wrapsFrom = 9000;

class ProgramBlockNumberOrder final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::WordIssue);
    if (to.dialect().lexical.blocksSpanLines)
      to.on(EventKind::Block);
    digits_ = to.dialect().facts->limits.blockDigits;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Block)
      return beginsInside(ctx);
    if (event.wordIssue() != WordIssue::NumberInside)
      return sleepInShape();
    if (event.word->has(wordNoValue)) // syntax-incomplete-word speaks
      return;
    // A local call may name its target so.
    if (ctx.find({Action::CallLocal, Action::MacroCall, Action::MacroModal}))
      return;
    // The number of an origin or a target is a word of its code.
    for (const CodeUse &use : ctx.codes()) {
      const CodeInfo &code = ctx.code(use);
      AddressMask taken = code.takes;
      for (const WordSpec &spec : code.words)
        taken |= spec.any;
      if (taken & maskOf(event.word->address))
        return;
    }
    if (auto finding = ctx.report(*event.word))
      finding.message("`{0}` is not first in its block: searching for the number does not find it",
                      ctx.text(*event.word));
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    for (const ProgramInfo &program : file.index.programs()) {
      ascending(program, file, ctx);
      if (digits_)
        range(program, file, ctx);
    }
  }

private:
  unsigned digits_ = 0; ///< most digits of a block number; 0: any

  /// The first number that the control does not take.
  void range(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) const {
    int64_t greatest = 9;
    for (unsigned i = 1; i < digits_; ++i)
      greatest = greatest * 10 + 9;
    // Sorted by number: what is out of range is at one of the ends.
    const llvm::ArrayRef<NumberedBlock> numbers = file.index.numbers(program);
    if (numbers.empty() || (numbers.front().number > 0 && numbers.back().number <= greatest))
      return;
    DataSections data(program, file.reader, ctx.dialect());
    for (const NumberedBlock &block : numbers) {
      if ((block.number > 0 && block.number <= greatest) || data.holds(block.offset))
        continue;
      const SourceRange where = file.numberAt(block.offset);
      if (auto finding = ctx.report(where))
        finding.severity(block.number > 0 ? std::optional(Severity::Warning) : std::nullopt)
            .message(block.number > 0 ? "`{0}` has more than {1} digits: the control does not take "
                                        "it as a block number"
                                      : "`{0}`: the control has no block number 0",
                     ctx.text(where), digits_);
      return;
    }
  }

  /// Where a number begins a block wherever it is, one after other words hides it.
  static void beginsInside(RuleContext &ctx) {
    const llvm::StringRef text = ctx.source().text();
    const Block &block = ctx.block();
    const uint32_t line = ctx.source().lines().lineBegin(block.begin);
    const llvm::StringRef before =
        text.slice(std::max(line, ctx.source().textBegin()), block.begin);
    if (before.trim(" \t").empty())
      return;
    const uint32_t end = std::max(block.numberEnd, block.begin + 1);
    if (auto finding = ctx.report(SourceRange{ctx.source().id(), block.begin, end}))
      finding.severity(Severity::Style)
          .message("`{0}` begins a block inside a line: a line of its own shows it",
                   text.slice(block.begin, end));
  }

  /// The first descent of a program. Numbers that something refers to are labels, not an order. A
  /// label may begin a row of its own, as in a profile, after which the row before it goes on.
  static void ascending(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) {
    const NumberedBlock *last = nullptr, *outer = nullptr, *label = nullptr;
    const bool phases = ctx.dialect().keyword(":N") != noCode;
    DataSections data(program, file.reader, ctx.dialect());
    for (const NumberedBlock &block : file.index.numbersAsWritten(program)) {
      if (phases && isPhase(block, file))
        continue;
      const bool descends = last && block.number < last->number;
      const bool begins = descends && last->number >= wrapsFrom && block.number < wrapsFrom / 10;
      if (descends && !begins) {
        if (isLabel(block, file) || data.holds(block.offset))
          continue;
        const bool goesOn =
            label && block.number < label->number && (!outer || block.number > outer->number);
        if (!data.holds(last->offset) && !goesOn)
          return report(*last, block, file, ctx);
        label = nullptr;
      }
      if (!file.usedNumbers.empty() && isLabel(block, file)) {
        if (!label) {
          outer = last;
          label = &block;
        }
        continue;
      }
      last = &block;
    }
  }

  static bool isLabel(const NumberedBlock &block, const FileSummary &file) {
    return std::binary_search(file.usedNumbers.begin(), file.usedNumbers.end(), block.number);
  }

  /// `:20` begins a phase of the program: phases are counted by themselves.
  static bool isPhase(const NumberedBlock &where, const FileSummary &file) {
    const llvm::StringRef line = file.source.text().substr(where.offset).take_until([](char c) {
      return c == 'N' || c == 'n' || c == '\n';
    });
    if (!line.contains(':'))
      return false;
    Block block;
    file.reader.read(where.offset, block);
    return block.mainBlock;
  }

  static void report(const NumberedBlock &before, const NumberedBlock &block,
                     const FileSummary &file, RuleContext &ctx) {
    if (auto finding = ctx.report(file.numberAt(block.offset)))
      finding
          .message("N{0} comes after N{1}: blocks run in the order of the text, "
                   "not of their numbers",
                   block.number, before.number)
          .note(file.numberAt(before.offset), "the higher number");
  }
};

} // namespace
NCVET_RULE(ProgramBlockNumberOrder, program_block_number_order)
} // namespace ncvet
