// An axis word whose variable was never set.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/callers.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "analyzer/rule/text_answers.h"
#include "interp/evaluate/expression.h"
#include "interp/value/macro_argument.h"

namespace ncvet {
namespace {

class VariableNullAsCoordinate final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onChange({EventKind::Motion, EventKind::CycleRun}); }

  void on(const Event &event, RuleContext &ctx) const override {
    if (ctx.block().expressions.empty())
      return sleepInShape();
    if (ctx.outcome().known) // all its coordinates are numbers
      return;
    for (const Word &word : ctx.block().words) {
      if (!(ctx.dialect().axisWords & maskOf(word.address)) || !word.has(wordExpression) ||
          !isVacant(word, ctx))
        continue;
      if (ctx.callDepth() == 0) {
        // Whoever calls a subprogram without a macro call hands its own variables on.
        const uint32_t begin = ctx.index().programAt(ctx.block().begin).begin;
        if (returning_.of({ctx.source().id(), begin}, [&] { return endsByReturn(ctx); }))
          return;
        if (auto finding = ctx.report(word))
          finding.message("the variable of `{0}` was never set: the control leaves the word out "
                          "and the axis stays",
                          ctx.text(word));
      } else if (neverGiven(word, ctx)) {
        if (auto finding = ctx.report(word))
          finding.severity(Severity::Warning)
              .message("no call of this macro gives the argument of `{0}`: the control leaves "
                       "the word out and the axis stays",
                       ctx.text(word));
      } else if (cutsNothing(event, word, ctx)) {
        if (auto finding = ctx.report(word))
          finding.severity(Severity::Warning)
              .message("a call of this macro does not give the argument of `{0}`, and nothing else "
                       "moves in this block: the cut is left out",
                       ctx.text(word));
      }
    }
  }

private:
  /// Whether the first block of the current program that ends it for good returns to a caller.
  static bool endsByReturn(const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &block : blocks(ctx.index().reader(), program.body, program.end)) {
      if (findCode(ctx.dialect(), block, {Action::ProgramEnd, Action::ProgramEndRewind}))
        return false;
      if (block.items.empty() && findCode(ctx.dialect(), block, {Action::Return}))
        return true;
    }
    return false;
  }

  /// The operation that reads the variable of `X#1` or `X-#1`; null for another expression.
  static const ExpressionOp *variableOf(const Word &word, const Block &block) {
    const Expression &e = block.expressions[size_t(word.mantissa)];
    const bool sign = e.count == 2 && block.operations[e.first + 1].op == Op::Negate;
    return (e.count == 1 || sign) && block.operations[e.first].op == Op::Variable
               ? &block.operations[e.first]
               : nullptr;
  }

  static bool isVacant(const Word &word, const RuleContext &ctx) {
    if (evaluate(ctx.block(), uint16_t(word.mantissa), ctx.before(), nullptr).isVacant())
      return true;
    const ExpressionOp *const variable = variableOf(word, ctx.block());
    return variable && readVariable(ctx.before(), int64_t(variable->value)).isVacant();
  }

  /// Whether the word is an argument of the macro that no call gives. A macro whose argument some
  /// of them leave out, or that asks for it, leaves the word out on purpose.
  bool neverGiven(const Word &word, const RuleContext &ctx) const {
    const ExpressionOp *const variable = variableOf(word, ctx.block());
    if (!variable || !ctx.caller() || !ctx.caller()->macro)
      return false;
    const auto number = uint32_t(variable->value);
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    return answers_.of({{ctx.source().id(), program.begin}, number},
                       [&] { return noCallGives(number, program, ctx); });
  }

  /// A feed move of this word alone, by an argument that the macro does not ask for and that this
  /// call leaves out.
  bool cutsNothing(const Event &event, const Word &word, const RuleContext &ctx) const {
    const ExpressionOp *const variable = variableOf(word, ctx.block());
    if (event.kind != EventKind::Motion || !isFeed(event.motion) || !variable || !ctx.caller() ||
        !ctx.caller()->macro || ctx.before().may(Fact::UnknownCode) ||
        (ctx.block().addresses & ctx.dialect().axisWords) != maskOf(word.address))
      return false;
    const auto number = uint32_t(variable->value);
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    return asked_.of({{ctx.source().id(), program.begin}, number}, [&] {
      char letter = 'A';
      while (letter <= 'Z' && macroArgument(letter) != number)
        ++letter;
      for (const Block &block : blocks(ctx.index().reader(), program.body, program.end))
        if (looksAt(block, number))
          return false;
      return letter <= 'Z';
    });
  }

  static bool noCallGives(uint32_t number, const ProgramInfo &program, const RuleContext &ctx) {
    char letter = 'A';
    while (letter <= 'Z' && macroArgument(letter) != number)
      ++letter;
    if (letter > 'Z')
      return false;
    for (const Block &block : blocks(ctx.index().reader(), program.body, program.end))
      if (looksAt(block, number))
        return false;
    const Callers callers = callersOf(ctx.unit(), program);
    return callers.all && !callers.places.empty() &&
           llvm::all_of(callers.places, [&](const CallPlace &call) {
             Block block;
             call.unit->index.read(call.block, block);
             // With I, J and K more than once the letters are those of a list.
             return call.unit == &ctx.unit() && !block.has(letterAddress(letter)) &&
                    !(block.repeated & lettersMask("IJK")) &&
                    findCode(ctx.dialect(), block, {Action::MacroCall});
           });
  }

  /// Whether the block gives the variable a value or decides by it.
  static bool looksAt(const Block &block, uint32_t number) {
    return llvm::any_of(block.items, [&](const Item &item) {
      if (item.kind == ItemKind::Assignment && block.keyOf(item.target) == number)
        return true;
      if (item.condition == noExpression)
        return false;
      const Expression &e = block.expressions[item.condition];
      for (uint32_t i = 0; i < e.count; ++i) {
        const ExpressionOp &op = block.operations[e.first + i];
        if (op.op == Op::Variable && uint32_t(op.value) == number)
          return true;
      }
      return false;
    });
  }

  /// By program and variable: no call gives it.
  TextAnswers<std::pair<std::pair<FileId, uint32_t>, uint32_t>, bool> answers_;
  /// By program and variable: it is an argument that the macro neither asks for nor gives.
  TextAnswers<std::pair<std::pair<FileId, uint32_t>, uint32_t>, bool> asked_;
  /// By program: it returns.
  TextAnswers<std::pair<FileId, uint32_t>, bool> returning_;
};

} // namespace
NCVET_RULE(VariableNullAsCoordinate, variable_null_as_coordinate)
} // namespace ncvet
