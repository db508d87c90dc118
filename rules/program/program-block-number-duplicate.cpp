// A block number that occurs twice in a program.
#include "analyzer/facts/data_sections.h"

#include <map>

namespace ncvet {
namespace {

/// Whether the code, or a variant of it, works along blocks that two of its words name.
bool readsProfile(const CodeInfo &code, const Dialect &dialect) {
  return addressesOf(code, Role::ProfileFirst) ||
         llvm::any_of(code.variants, [&](const auto &variant) {
           return addressesOf(dialect.codes[variant.code], Role::ProfileFirst) != 0;
         });
}

/// The words P and Q of a program, which name blocks; read when they are first asked for.
class Namers {
public:
  Namers(const ProgramInfo &program, const Reader &reader, const Dialect &dialect)
      : program_(program), reader_(reader), dialect_(dialect) {}

  /// Only cycles before the block name its number: they have found this one of several.
  bool areBefore(const NumberedBlock &where) {
    if (!isRead_)
      read();
    isRead_ = true;
    const auto own = last_.find(where.number);
    return untold_ <= where.offset && (own == last_.end() || own->second <= where.offset);
  }

private:
  void read() {
    for (const Block &block : blocks(reader_, program_.body, program_.end)) {
      if (llvm::any_of(block.items, [](const Item &item) { return item.kind == ItemKind::Jump; }))
        untold_ = anywhere;
      for (const char letter : {'P', 'Q'})
        if (const Word *word = block.find(letter))
          note(*word, block);
    }
  }
  void note(const Word &word, const Block &block) {
    const bool cycle = llvm::any_of(codesOf(dialect_, block), [&](CodeIndex code) {
      return readsProfile(dialect_.codes[code], dialect_);
    });
    uint32_t &last = word.isNumber() ? last_[int64_t(word.value())] : untold_;
    last = std::max(last, cycle ? block.begin : anywhere);
  }

  static constexpr uint32_t anywhere = ~0u;
  const ProgramInfo &program_;
  const Reader &reader_;
  const Dialect &dialect_;
  bool isRead_ = false;
  std::map<int64_t, uint32_t> last_; ///< by number: the last block that names it
  uint32_t untold_ = 0;              ///< the last block of which it is not known what it names
};

class ProgramBlockNumberDuplicate final : public Rule {
public:
  void listen(Subscriptions &to) override {
    unreferenced_ = to.flag("unreferencedIsWarning", true) ? Severity::Warning : Severity::Style;
    nextProfile_ = to.flag("nextProfile");
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    for (const ProgramInfo &program : file.index.programs())
      check(program, file, ctx);
  }

private:
  void check(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) const {
    const llvm::ArrayRef<NumberedBlock> numbers = file.index.numbers(program);
    const NumberedBlock *plain = nullptr, *plainFirst = nullptr;
    size_t others = 0;
    DataSections data(program, file.reader, ctx.dialect());
    Namers namers(program, file.reader, ctx.dialect());
    for (size_t i = 1; i < numbers.size(); ++i) {
      if (numbers[i].number != numbers[i - 1].number)
        continue;
      const NumberedBlock &first = numbers[i - 1], &again = numbers[i];
      if (isPhase(first, file, ctx) || isPhase(again, file, ctx) || data.holds(first.offset) ||
          data.holds(again.offset))
        continue;
      if (std::binary_search(file.usedNumbers.begin(), file.usedNumbers.end(), again.number)) {
        if (i > 1 && numbers[i - 2].number == again.number) // once for each number
          continue;
        if (nextProfile_ && namers.areBefore(first)) {
          ++others;
          continue;
        }
        if (otherProgramBetween(first, again, file, ctx.dialect()) ||
            (nextProfile_ && profileBetween(first, again, file, ctx.dialect())))
          continue;
        report(
            first, again,
            "N{0} is used twice, and a jump, call or profile names it: it may go to the wrong one",
            Severity::Error, file, ctx);
        continue;
      }
      ++others;
      if (!plain || again.offset < plain->offset) {
        plain = &again;
        plainFirst = &first;
      }
    }
    // One report for all those that nothing refers to: numbers of long programs begin anew.
    if (plain)
      report(*plainFirst, *plain,
             others == 1 ? "N{0} is used twice in the program"
                         : "N{0} is used twice in the program, and so are {1} further numbers",
             others == 1 ? unreferenced_ : Severity::Style, file, ctx, others - 1);
  }

  /// Whether there is a program header between the two, after other words of its line, as in
  /// `M99 O0810`: dumps of a control's memory lack line ends.
  static bool otherProgramBetween(const NumberedBlock &first, const NumberedBlock &again,
                                  const FileSummary &file, const Dialect &dialect) {
    for (const Block &block : blocks(file.reader, first.offset, again.offset)) {
      if (block.kind != BlockKind::ProgramHeader && block.has(letterAddress('O')) &&
          findCode(dialect, block, {Action::Return, Action::ProgramEnd, Action::ProgramEndRewind}))
        return true;
    }
    return false;
  }

  /// Whether a cycle between the two names the number: it finds the profile that follows it, and
  /// one before the first has found the first.
  static bool profileBetween(const NumberedBlock &first, const NumberedBlock &again,
                             const FileSummary &file, const Dialect &dialect) {
    for (const Block &block : blocks(file.reader, first.offset, again.offset)) {
      const auto names = [&](char letter) {
        const Word *word = block.find(letter);
        return word && word->isNumber() && int64_t(word->value()) == again.number;
      };
      if ((names('P') || names('Q')) && llvm::any_of(codesOf(dialect, block), [&](CodeIndex code) {
            return readsProfile(dialect.codes[code], dialect);
          }))
        return true;
    }
    return false;
  }

  /// `:20` where that begins a phase of the program, which is found by a number of its own.
  static bool isPhase(const NumberedBlock &where, const FileSummary &file, const RuleContext &ctx) {
    if (ctx.dialect().keyword(":N") == noCode)
      return false;
    Block block;
    file.reader.read(where.offset, block);
    return block.mainBlock;
  }

  static void report(const NumberedBlock &first, const NumberedBlock &again, const char *message,
                     Severity severity, const FileSummary &file, RuleContext &ctx,
                     size_t further = 0) {
    if (auto finding = ctx.report(file.numberAt(again.offset)))
      finding.message(message, again.number, further)
          .severity(severity)
          .note(file.numberAt(first.offset), "the first one");
  }

  Severity unreferenced_ = Severity::Warning;
  bool nextProfile_ = false; ///< a cycle takes the profile that follows it
};

} // namespace
NCVET_RULE(ProgramBlockNumberDuplicate, program_block_number_duplicate)
} // namespace ncvet
