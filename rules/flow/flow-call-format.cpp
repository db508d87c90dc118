// A local call gives its target as a block number word.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/foreign_block.h"
#include "analyzer/facts/lookahead.h"
#include "interp/evaluate/expression.h"
#include "interp/value/macro_argument.h"

namespace ncvet {
namespace {

class FlowCallFormat final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onAction({Action::CallLocal, Action::CallProgram});
    to.onNotices("flow-call-format");
    if (to.dialect().limits.packedCallDigits)
      to.on(EventKind::FlowIssue);
    if (to.flag("statements"))
      to.on({EventKind::Statement, EventKind::WordIssue});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Statement)
      return atStatement(ctx.block().items[event.item()], ctx);
    if (event.kind == EventKind::FlowIssue)
      return neither(event, ctx);
    if (event.kind == EventKind::WordIssue) {
      if (event.wordIssue() == WordIssue::Special)
        number(ctx);
      return;
    }
    if (!isSignal(ctx.code(event), ctx))
      ctx.reportNotices("flow-call-format", event);
    if (ctx.code(event).action == Action::CallProgram) {
      if (ctx.dialect().lexical.macro && !ctx.code(event).foreign)
        arguments(event, ctx);
      return packed(event, ctx);
    }
    if (ctx.code(event).action != Action::CallLocal)
      return;
    const Block &block = ctx.block();
    const Word *number = block.find('N');
    if (block.has(letterAddress('P')) || !number || !number->isNumber())
      return;
    const std::string cure = formatted("P{0}", number->mantissa);
    if (auto finding = ctx.report(*number))
      finding
          .message("`{0}` after `{1}` reads as a block number: write the target as `{2}`",
                   ctx.text(*number), ctx.text(*event.word), cure)
          .fix(FixSafety::Unsafe, formatted("write `{0}`", cure),
               ctx.replace(ctx.range(*number), cure));
  }

private:
  /// `M98 P2 A5.`: a subprogram gets no arguments, and the called program reads one.
  static void arguments(const Event &event, RuleContext &ctx) {
    AddressMask own = lettersMask("GMNOPLQ");
    for (const WordSpec &spec : ctx.code(event).words)
      own |= spec.any;
    std::map<double, const Word *> given; // by the variable that a macro call would set
    for (const Word &word : ctx.block().words)
      if (word.address < 26 && !(own & maskOf(word.address)))
        if (const uint32_t number = macroArgument(char('A' + word.address));
            number && !readVariable(ctx.before(), number).isConstant())
          given.emplace(number, &word);
    if (given.empty())
      return;
    const auto place = [](FileUnit &unit, const Block &block) {
      return std::pair(&unit, unit.index.programAt(block.begin).begin);
    };
    const auto here = place(ctx.unit(), ctx.block());
    constexpr unsigned furthest = 60; // blocks of the called program
    BlocksAhead ahead(ctx);
    Block block;
    for (unsigned i = 0; i < furthest && ahead.next(block) && !given.empty(); ++i) {
      if (place(ahead.unit(), block) == here)
        return;
      for (const ExpressionOp &op : block.operations)
        if (const auto read = op.op == Op::Variable ? given.find(op.value) : given.end();
            read != given.end()) {
          if (auto finding = ctx.report(*read->second))
            finding.severity(Severity::Warning)
                .message("`{0}` hands no arguments over: `{1}` does not become #{2}, which the "
                         "called program reads; a macro call does",
                         ctx.text(*event.word), ctx.text(*read->second), unsigned(op.value))
                .note(ahead.range(block), "it is read here");
          return;
        }
      for (const Item &item : block.items)
        if (item.kind == ItemKind::Assignment)
          given.erase(double(block.keyOf(item.target)));
    }
  }

  /// `M98 P051000`, the count of runs before the number, on a control that reads a number alone.
  static void packed(const Event &event, RuleContext &ctx) {
    const Limits &limits = ctx.dialect().limits;
    const Word *const program = ctx.block().find('P');
    if (limits.packedCallDigits || !limits.programDigitsMax || ctx.code(event).foreign ||
        !program || !program->isNumber() || !program->isWhole())
      return;
    const llvm::StringRef digits = ctx.text(*program).drop_until(llvm::isDigit);
    // A number that is too great is no program's at all: another rule says so.
    if (digits.size() <= limits.programDigitsMax ||
        std::to_string(program->mantissa).size() > limits.programDigitsMax)
      return;
    if (auto finding = ctx.report(*program))
      finding.severity(Severity::Warning)
          .message("`{0}` has more digits than a program's number: the count of runs is a word of "
                   "its own here",
                   ctx.text(*program));
  }

  /// `M98 P31201`: there is neither a program of that number, nor one of its last digits to run as
  /// often as the first ones say.
  static void neither(const Event &event, RuleContext &ctx) {
    const Flow &flow = ctx.outcome().flow;
    if (event.flowIssue() != FlowIssue::UnknownProgram || flow.macro || !flow.word ||
        !flow.word->isNumber() || ctx.index().programs().size() < 2)
      return;
    const llvm::StringRef digits = ctx.text(*flow.word).drop_until(llvm::isDigit);
    const unsigned own = ctx.dialect().limits.packedCallDigits;
    if (digits.size() <= own)
      return tooShort(digits, own, ctx);
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding.severity(Severity::Warning)
          .message("`{0}` is neither the number of a program nor `{1}` runs of program {2}: the "
                   "file has none of both",
                   ctx.text(*flow.word), digits.drop_back(own), digits.take_back(own));
  }

  /// `M98 P510` for five runs of O0010: the number has four digits then.
  static void tooShort(llvm::StringRef digits, unsigned own, RuleContext &ctx) {
    for (size_t count = 1; count < digits.size(); ++count) {
      int64_t number = 0;
      if (digits.drop_front(count).getAsInteger(10, number) || !ctx.index().find(number))
        continue;
      const std::string whole =
          (digits.take_front(count) + std::string(own - (digits.size() - count), '0') +
           digits.drop_front(count))
              .str();
      if (auto finding = ctx.report(ctx.flowRange()))
        finding.severity(Severity::Warning)
            .message("`P{0}` calls program {0}, which the file does not have: {1} runs of program "
                     "{2} are `P{3}`",
                     digits, digits.take_front(count), number, whole);
      return;
    }
  }

  /// `L100` where L names an element of a contour, and a call has its name in brackets.
  static void number(RuleContext &ctx) {
    const Word *word = undefinedElement(ctx);
    const llvm::StringRef mark = ctx.dialect().lexical.callMark;
    if (!word || mark.empty() || word->address != letterAddress(mark.front()))
      return;
    const std::string call = (mark + ctx.text(*word).drop_front() + ">").str();
    if (auto finding = ctx.report(*word))
      finding
          .message("`{0}` is a {1} here, and none of this name is defined: a call is `{2}`",
                   ctx.text(*word), ctx.dialect().addresses[word->address].title, call)
          .fix(FixSafety::Unsafe, "write `" + call + "`", ctx.replace(ctx.range(*word), call));
  }

  /// How calls and choices name their targets.
  static void atStatement(const Item &item, RuleContext &ctx) {
    const SourceRange whole = ctx.range(item);
    if (item.kind == ItemKind::Call && item.nameEnd > item.nameBegin) {
      const SourceRange range{ctx.source().id(), item.nameBegin, item.nameEnd};
      const llvm::StringRef name = ctx.text(range);
      if (name.size() > 1 && name[0] == 'R' &&
          llvm::all_of(name.drop_front(), [](char c) { return c >= '0' && c <= '9'; })) {
        if (auto finding = ctx.report(range))
          finding.message("`{0}` is taken as a name: the program that a variable names is `&{0}`",
                          name);
      } else if (ctx.text(whole).contains('\\')) {
        if (auto finding = ctx.report(whole))
          finding.severity(Severity::Style)
              .message("`{0}` names a folder of this control: on another one it is not found",
                       ctx.text(whole));
      }
      return;
    }
    if (item.kind != ItemKind::Jump && item.kind != ItemKind::Input)
      return;
    for (const Argument &target : ctx.block().argumentsOf(item)) {
      const SourceRange range = ctx.range(target);
      if (target.kind == ArgumentKind::Name && item.nameEnd == item.nameBegin)
        if (auto finding = ctx.report(range))
          finding.message("`{0}` is no block of this program: a jump into another program names "
                          "the program and a block",
                          ctx.text(range));
      if (target.kind != ArgumentKind::Label)
        continue;
      const llvm::StringRef name = ctx.text(range);
      const bool number =
          name.size() > 1 && name[0] == 'N' &&
          llvm::all_of(name.drop_front(), [](char c) { return c >= '0' && c <= '9'; });
      if (item.jump != JumpKind::BySign && !number)
        continue;
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Warning)
            .message(number
                         ? "the label `{0}` reads like a block number: `{0}` without brackets is "
                           "another place"
                         : "`{0}`: a choice by sign takes block numbers, not labels",
                     name);
    }
  }
};

} // namespace
NCVET_RULE(FlowCallFormat, flow_call_format)
} // namespace ncvet
