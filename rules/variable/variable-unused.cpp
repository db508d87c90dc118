// A variable or an element of a contour that is defined and never read.
#include "analyzer/facts/called_blocks.h"
#include "analyzer/facts/defined_elements.h"
#include "analyzer/facts/name_counts.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <map>
#include <set>

namespace ncvet {
namespace {

struct VariableUnusedMemory {
  bool defines = false;
  bool assigns = false;
  DefinedElements elements;
};

class VariableUnused final : public StatefulRule<VariableUnusedMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::Statement);
    overwritten_ = to.flag("overwritten");
    if (to.dialect().elementWords) {
      to.onAction({Action::DefineElement});
      to.on(EventKind::WordIssue);
    }
  }

  void on(const Event &event, RuleContext &ctx) const override {
    // Also where an element leads nowhere, as in a profile that is read by itself.
    if (event.kind != EventKind::Statement)
      return element(ctx);
    const ItemKind kind = ctx.block().items[event.item()].kind;
    memory().defines |= kind == ItemKind::Definition;
    memory().assigns |= kind == ItemKind::Assignment;
    sleepAtBlock();
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (file.complete)
      for (const auto &[key, element] : memory().elements.all())
        if (!element.used)
          report(element.where, ctx);
    if (overwritten_ && memory().assigns)
      overwritten(file, ctx);
    if (!memory().defines)
      return;
    for (const ProgramInfo &program : file.index.programs())
      check(file, program, ctx);
  }

private:
  void element(RuleContext &ctx) const {
    if (!ctx.block().hasAny(ctx.dialect().elementWords))
      return;
    if (const Word *word = DefinedElements::definedBy(ctx)) {
      const SourceRange here = ctx.range(*word);
      const auto old = memory().elements.define(*word, ctx);
      // In a program that is called again the same definition comes round.
      if (old && !old->used && old->where.begin != here.begin)
        if (auto finding = ctx.report(here))
          finding.severity(Severity::Warning)
              .message("`{0}` is defined again before anything has used it", ctx.text(here))
              .note(old->where, "the definition before");
      return;
    }
    for (const Word &word : ctx.block().words)
      if (ctx.dialect().elementWords & maskOf(word.address))
        if (DefinedElements::Element *element = memory().elements.find(word))
          element->used = true;
  }

  static void report(SourceRange range, RuleContext &ctx) {
    if (auto finding = ctx.report(range))
      finding.text("this element is defined, and nothing uses it");
  }

  /// `R1=5` and further down `R1=6`, with nothing in between that reads R1 or may come from
  /// elsewhere.
  static void overwritten(const FileSummary &file, RuleContext &ctx) {
    std::map<uint64_t, SourceRange> written;
    for (const Block &block : blocks(file.reader)) {
      const bool flows =
          block.skip >= 0 || block.hasLabel() ||
          (block.number >= 0 &&
           std::binary_search(file.usedNumbers.begin(), file.usedNumbers.end(), block.number)) ||
          llvm::any_of(block.items, [](const Item &item) {
            return item.kind != ItemKind::Assignment && item.kind != ItemKind::Instruction &&
                   item.kind != ItemKind::Call;
          });
      const bool calls =
          llvm::any_of(block.items, [](const Item &item) { return item.kind == ItemKind::Call; });
      if (flows || (calls && !readByCalled(block, file, written, ctx)))
        written.clear();
      const auto read = [&](llvm::ArrayRef<ExpressionOp> operations) {
        for (const ExpressionOp &op : operations)
          if (op.op == Op::Variable)
            written.erase(uint64_t(op.value));
          else if (op.op == Op::VariableAt || op.op == Op::ElementAt || op.op == Op::Unknown)
            written.clear();
      };
      read(block.operations);
      for (const Item &item : block.items) {
        // Each assignment reads what those before it have written.
        if (item.kind == ItemKind::Assignment && item.value != noExpression) {
          const Expression &value = block.expressions[item.value];
          read(llvm::makeArrayRef(block.operations).slice(value.first, value.count));
        }
        const SourceRange name{file.source.id(), item.nameBegin, item.nameEnd};
        const llvm::StringRef text = ctx.text(name).trim();
        if (flows || item.kind != ItemKind::Assignment || text.size() < 2 ||
            (text[0] | 32) != 'r' || !llvm::all_of(text.drop_front(), llvm::isDigit))
          continue;
        const SourceRange range{file.source.id(), item.begin, item.end};
        const auto [entry, fresh] = written.try_emplace(block.keyOf(item.target), range);
        if (fresh)
          continue;
        if (auto finding = ctx.report(entry->second))
          finding
              .message("nothing reads `{0}` before `{1}` replaces it", ctx.text(entry->second),
                       ctx.text(range))
              .note(range, "replaced here");
        entry->second = range;
      }
    }
  }

  /// Takes out what the programs that the block calls read; false: that is not known.
  static bool readByCalled(const Block &block, const FileSummary &file,
                           std::map<uint64_t, SourceRange> &written, RuleContext &ctx) {
    return eachCalledBlock(ctx.unitOf(file.source.id()), block, [&](const Block &called) {
      for (const ExpressionOp &op : called.operations)
        if (op.op == Op::Variable)
          written.erase(uint64_t(op.value));
        else if (op.op == Op::VariableAt || op.op == Op::ElementAt || op.op == Op::Unknown)
          return false;
      return true;
    });
  }

  /// A name that a block defines.
  struct DefinedName {
    uint64_t key;
    SourceRange range;
    uint32_t block; ///< its begin
  };

  static void check(const FileSummary &file, const ProgramInfo &program, RuleContext &ctx) {
    std::set<uint64_t> read;
    std::vector<DefinedName> defined;
    for (const Block &block : blocks(file.reader, program.begin, program.end)) {
      for (const ExpressionOp &op : block.operations)
        if (op.op == Op::Variable || op.op == Op::ElementAt)
          read.insert(uint64_t(op.value));
      for (const Item &item : block.items) {
        const SourceRange name{file.source.id(), item.nameBegin, item.nameEnd};
        if (item.kind == ItemKind::Definition)
          defined.push_back({block.keyOf(item.target), name, block.begin});
        else if (item.kind == ItemKind::Call || item.kind == ItemKind::Jump ||
                 (item.kind == ItemKind::Structure && item.structure == Structure::For))
          read.insert(variableKey(ctx.text(name))); // a name that may be a variable's
      }
    }
    // Somewhere in a form that is not read closely: an index of a system variable, a message.
    NameCounts mentioned;
    for (const DefinedName &name : defined)
      if (!read.count(name.key))
        mentioned.add(ctx.text(name.range).upper());
    mentioned.countIn(file.source.text(program.begin, program.end).upper());
    std::vector<SourceRange> unread; // of one block: told together
    for (size_t i = 0; i < defined.size(); ++i) {
      const DefinedName &name = defined[i];
      if (!read.count(name.key) && mentioned.of(ctx.text(name.range).upper()) < 3)
        unread.push_back(name.range);
      if (i + 1 == defined.size() || defined[i + 1].block != name.block) {
        unusedOfBlock(unread, ctx);
        unread.clear();
      }
    }
  }

  static void unusedOfBlock(llvm::ArrayRef<SourceRange> names, RuleContext &ctx) {
    if (names.empty())
      return;
    auto finding = ctx.report(names.front());
    if (!finding)
      return;
    if (names.size() == 1)
      finding.message("nothing reads `{0}`", ctx.text(names.front()));
    else
      finding.message("nothing reads `{0}`, nor {1} other name{2} of this definition",
                      ctx.text(names.front()), names.size() - 1, names.size() > 2 ? "s" : "");
    constexpr size_t mostNotes = 8; // as many as a reader is shown of findings alike
    for (const SourceRange &further : names.drop_front().take_front(mostNotes))
      finding.note(further, "nothing reads this one either");
  }

  bool overwritten_ = false; ///< values that are replaced unread are reported
};

} // namespace
NCVET_RULE(VariableUnused, variable_unused)
} // namespace ncvet
