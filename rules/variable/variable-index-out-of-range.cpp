// A variable or an element that the control does not have.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class VariableIndexOutOfRange final : public Rule {
public:
  void listen(Subscriptions &to) override {
    greatest_ = int64_t(to.option("greatest", 0));
    reservedFrom_ = int64_t(to.option("reservedFrom", 0));
    reservedTo_ = int64_t(to.option("reservedTo", -1));
    numbered_ = to.option("numbered", 0) != 0;
    to.on(EventKind::Statement);
  }

  void on(const Event &event, RuleContext &ctx) override {
    const Item &item = ctx.block().items[size_t(event.number)];
    if (item.kind != ItemKind::Assignment)
      return;
    if (numbered_)
      return numbered(item, ctx);
    llvm::StringRef name =
        ctx.text(SourceRange{ctx.source().id(), item.nameBegin, item.nameEnd}).rtrim();
    if (greatest_ && (name.startswith("R") || name.startswith("r"))) {
      int64_t index = 0;
      if (name.drop_front().getAsInteger(10, index))
        return;
      const bool reserved = reservedFrom_ <= index && index <= reservedTo_;
      if (index <= greatest_ && !reserved)
        return;
      auto finding = ctx.report(SourceRange{ctx.source().id(), item.nameBegin, item.nameEnd});
      if (finding && reserved)
        finding.message("`{0}`: the control keeps R{1} to R{2} for itself", name, reservedFrom_,
                        reservedTo_);
      else if (finding)
        finding.message("`{0}`: the control has the parameters R0 to R{1}", name, greatest_);
      return;
    }
    element(item, name, ctx);
  }

private:
  /// `#5603 = 1` of a control with fewer variables.
  void numbered(const Item &item, RuleContext &ctx) {
    const SourceRange range{ctx.source().id(), item.nameBegin, item.nameEnd};
    const llvm::StringRef name = ctx.text(range);
    int64_t index = 0;
    if (name.getAsInteger(10, index) || (index > 0 && index <= greatest_))
      return;
    if (auto finding = ctx.report(range))
      finding.message("`#{0}`: the control has the variables #1 to #{1}", name, greatest_);
  }

  /// `FIELD[5]` of an array with fewer elements.
  static void element(const Item &item, llvm::StringRef name, RuleContext &ctx) {
    const auto [array, rest] = name.split('[');
    int64_t index = 0;
    if (rest.empty() || rest.split(']').first.trim().getAsInteger(10, index))
      return;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    const Defined *defined = ctx.index().definition(program, array.trim());
    if (!defined || !defined->array)
      return;
    Block block;
    ctx.index().read(ctx.source().lines().lineBegin(defined->begin), block);
    for (const Item &definition : block.items) {
      if (definition.kind != ItemKind::Definition || definition.nameBegin != defined->begin ||
          definition.arguments != 1)
        continue;
      const uint16_t size = block.argumentsOf(definition)[0].expression;
      const Expression &e = block.expressions[size];
      if (e.bad || e.count != 1 || block.operations[e.first].op != Op::Number ||
          double(index) < block.operations[e.first].value)
        continue;
      const SourceRange range{ctx.source().id(), item.nameBegin, item.nameEnd};
      if (auto finding = ctx.report(range))
        finding
            .message("`{0}`: the elements of `{1}` are numbered 0 to {2}", ctx.text(range), array,
                     int64_t(block.operations[e.first].value) - 1)
            .note(SourceRange{ctx.source().id(), definition.begin, definition.end},
                  "it is defined here");
    }
  }

  int64_t greatest_ = 0;
  bool numbered_ = false;                      ///< variables have numbers behind `#`
  int64_t reservedFrom_ = 0, reservedTo_ = -1; ///< of the control itself
};

} // namespace
NCVET_RULE(VariableIndexOutOfRange, variable_index_out_of_range)
} // namespace ncvet
