// A variable that is defined and never read.
#include "analyzer/rule.h"

#include <set>

namespace ncvet {
namespace {

class VariableUnused final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Statement); }

  void on(const Event &event, RuleContext &ctx) override {
    defines_ |= ctx.block().items[size_t(event.number)].kind == ItemKind::Definition;
  }

  void finish(const FileSummary &file, RuleContext &ctx) override {
    if (!defines_)
      return;
    for (const ProgramInfo &program : file.index.programs())
      check(file, program, ctx);
  }

private:
  static void check(const FileSummary &file, const ProgramInfo &program, RuleContext &ctx) {
    std::set<uint64_t> read;
    std::vector<std::pair<uint64_t, SourceRange>> defined;
    Block block;
    for (uint32_t at = program.begin; at < program.end; at = block.next) {
      file.reader.read(at, block);
      for (const ExpressionOp &op : block.operations)
        if (op.op == Op::Variable || op.op == Op::ElementAt)
          read.insert(uint64_t(op.value));
      for (const Item &item : block.items) {
        const SourceRange name{file.source.id(), item.nameBegin, item.nameEnd};
        if (item.kind == ItemKind::Definition)
          defined.emplace_back(block.keyOf(item.target), name);
        else if (item.kind == ItemKind::Call || item.kind == ItemKind::Jump ||
                 (item.kind == ItemKind::Structure && item.structure == Structure::For))
          read.insert(variableKey(ctx.text(name))); // a name that may be a variable's
      }
    }
    const std::string text = file.source.text(program.begin, program.end).upper();
    for (const auto &[key, range] : defined)
      // Somewhere in a form that is not read closely: an index of a system variable, a message.
      if (!read.count(key) && llvm::StringRef(text).count(ctx.text(range).upper()) < 3)
        if (auto finding = ctx.report(range))
          finding.message("nothing reads `{0}`", ctx.text(range));
  }

  bool defines_ = false;
};

} // namespace
NCVET_RULE(VariableUnused, variable_unused)
} // namespace ncvet
