// A call and what it calls do not agree in their arguments.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/callers.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "analyzer/rule/text_answers.h"
#include "formats/dialect/control_facts.h"
#include "interp/evaluate/condition.h"
#include "interp/value/macro_argument.h"

#include <array>
#include <map>

namespace ncvet {
namespace {

class FlowArgumentMismatch final : public Rule {
public:
  void listen(Subscriptions &to) override {
    words_ = to.dialect().facts->program.callsTakeNoWords;
    to.on({EventKind::FlowIssue, EventKind::Syntax, EventKind::Statement});
    to.onNotices("flow-argument-mismatch");
    to.onCode([](const CodeInfo &code) {
      return code.arguments || isMacro(code) ||
             llvm::any_of(code.words, [](const WordSpec &w) { return w.text; });
    });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    switch (event.kind) {
    case EventKind::Code:
      return atCode(event, ctx);
    case EventKind::Statement:
      sleepAtBlock();
      wordsBeside(ctx.block().items[event.item()], ctx);
      fewerThanOthers(ctx.block().items[event.item()], ctx);
      numberForVariable(ctx.block().items[event.item()], ctx);
      return atDefinition(ctx.block().items[event.item()], ctx);
    case EventKind::Syntax: {
      const SyntaxIssue &issue = ctx.block().issues[event.issue()];
      const SourceRange range = ctx.range(issue);
      if (issue.kind == SyntaxIssueKind::MissingArgument ||
          issue.kind == SyntaxIssueKind::TooManyArguments) {
        if (auto finding = ctx.report(range))
          finding.message(issue.kind == SyntaxIssueKind::MissingArgument
                              ? "`{0}` has fewer arguments than it needs"
                              : "`{0}` has more arguments than it takes",
                          ctx.text(range));
        return;
      }
      if (issue.kind == SyntaxIssueKind::NamedArgument)
        if (auto finding = ctx.report(range))
          finding.message("`{0}`: arguments are told by their places, and take no names",
                          ctx.text(range));
      return;
    }
    default:
      return atCall(event, ctx);
    }
  }

private:
  static bool isMacro(const CodeInfo &code) {
    return code.letter == 'G' &&
           (code.action == Action::MacroCall || code.action == Action::MacroModal);
  }

  /// The number of a macro and its repeats are no arguments: each is there once.
  static void repeated(RuleContext &ctx) {
    const Block &block = ctx.block();
    for (const char letter : {'P', 'L'}) {
      if (!(block.repeated & maskOf(letter)))
        continue;
      const Word *first = block.find(letter);
      const Word *again = llvm::find_if(
          block.words, [&](const Word &w) { return &w != first && w.address == first->address; });
      if (auto finding = ctx.report(*again))
        finding
            .message("`{0}` is a second {1}, which is no argument of a macro", ctx.text(*again),
                     letter)
            .note(ctx.range(*first), "the first one");
    }
  }

  /// Axis words in the block of a call that takes none.
  void wordsBeside(const Item &item, RuleContext &ctx) const {
    const Word *word = ctx.block().findAny(ctx.dialect().axisWords);
    if (!words_ || item.kind != ItemKind::Call || !word)
      return;
    const SourceRange range = ctx.range(item);
    if (auto finding = ctx.report(*word))
      finding.severity(Severity::Warning)
          .message("`{0}` beside `{1}` is a move of this block: the called program takes no words",
                   ctx.text(*word), ctx.text(range));
  }

  bool words_ = false; ///< a call takes no words of its block

  /// What a macro works with, and what the calls of its file give it: bits by letter.
  struct Sisters {
    uint32_t places = 0; ///< something is worked out with them
    uint32_t asked = 0;  ///< the macro looks whether it has them, or gives them a value itself
    unsigned calls = 0;  ///< 0: not all of them are known
    std::array<unsigned, 26> given{};
  };
  TextAnswers<std::pair<FileId, uint32_t>, Sisters> sisters_; ///< by macro

  /// `G65` without an argument that all other calls of the same macro give, and that the macro
  /// works something out with.
  void lostArgument(const Event &event, const CodeInfo &code, RuleContext &ctx) const {
    constexpr unsigned fewest = 2; // calls
    const Word *const number = wordOf(ctx.block(), code, Role::Program);
    if (code.action != Action::MacroCall || !number || !number->isNumber() || !event.certain)
      return;
    const ProgramInfo *const macro = ctx.index().find(int64_t(number->value()));
    if (!macro)
      return;
    const Sisters &sisters =
        sisters_.of({ctx.source().id(), macro->begin}, [&] { return sistersOf(*macro, ctx); });
    if (sisters.calls < fewest)
      return;
    for (char letter = 'A'; letter <= 'Z'; ++letter) {
      const uint32_t bit = 1u << (letter - 'A');
      if (!(sisters.places & ~sisters.asked & bit) ||
          sisters.given[size_t(letter - 'A')] + 1 != sisters.calls ||
          ctx.block().has(letterAddress(letter)))
        continue;
      if (auto finding = ctx.report(ctx.blockRange()))
        finding.severity(Severity::Warning)
            .message("this call gives no {0}, which all other calls of O{1} give: the macro "
                     "works with it, and it is empty",
                     std::string(1, letter), ctx.text(*number).drop_front());
      return;
    }
  }

  static Sisters sistersOf(const ProgramInfo &macro, const RuleContext &ctx) {
    Sisters sisters;
    const Callers callers = callersOf(ctx.unit(), macro);
    if (!callers.all)
      return sisters;
    for (const CallPlace &call : callers.places) {
      Block block;
      call.unit->index.read(call.block, block);
      if (!findCode(ctx.dialect(), block, {Action::MacroCall}) ||
          (block.repeated & lettersMask("IJK")))
        return {}; // called otherwise, or by a list of I, J and K
      for (char letter = 'A'; letter <= 'Z'; ++letter)
        sisters.given[size_t(letter - 'A')] += block.has(letterAddress(letter));
      ++sisters.calls;
    }
    for (const Block &block : blocks(ctx.index().reader(), macro.body, macro.end))
      look(block, sisters);
    return sisters;
  }

  static void look(const Block &block, Sisters &sisters) {
    const auto lettersOf = [&](uint16_t expression) {
      return uint32_t(
          setOf(block, expression, [](uint64_t variable) { return letterOf(variable); }));
    };
    for (const Item &item : block.items) {
      if (item.kind == ItemKind::Assignment) {
        sisters.asked |= letterOf(block.keyOf(item.target));
        // Half of an empty diameter is nothing: only what is worked out is a place.
        if (item.value < block.expressions.size() && block.expressions[item.value].count > 1)
          sisters.places |= lettersOf(item.value);
        else
          sisters.asked |= lettersOf(item.value); // it goes on under another name
      }
      sisters.asked |= lettersOf(item.condition);
    }
  }

  /// A subprogram whose arguments are told by their places, by the text of its file.
  struct Places {
    bool known = false;          ///< it begins in the file
    uint64_t reads = 0;          ///< `#1` and so on: it works with them
    uint64_t asked = 0;          ///< it looks whether it has them, or gives them a value itself
    std::vector<unsigned> calls; ///< how many arguments each gives
  };
  using PlacesByLabel = std::map<uint32_t, Places>;
  TextAnswers<FileId, PlacesByLabel> placed_;

  /// `o<slot> call [1] [2]` with fewer arguments than all other calls give: the control gives 0 for
  /// what is left out.
  void fewerThanOthers(const Item &item, RuleContext &ctx) const {
    if (item.kind != ItemKind::Call || !item.positional || !item.label)
      return;
    ctx.index().reader(); // the text is looked through, now or before
    const PlacesByLabel &all = placed_.of(ctx.source().id(), [&] { return placesOf(ctx); });
    const auto known = all.find(item.label);
    if (known == all.end() || !known->second.known || known->second.calls.size() < 2)
      return;
    const Places &places = known->second;
    const unsigned given = item.arguments;
    const unsigned most = *std::max_element(places.calls.begin(), places.calls.end());
    if (llvm::count(places.calls, most) + 1 != ptrdiff_t(places.calls.size()) || given >= most)
      return;
    for (unsigned place = given + 1; place <= most && place < 64; ++place) {
      if (!((places.reads & ~places.asked) >> place & 1))
        continue;
      const SourceRange range = ctx.range(item);
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Warning)
            .message("this call gives {0} arguments and all others {1}: the subprogram works with "
                     "#{2}, which is 0 in it",
                     given, most, place);
      return;
    }
  }

  /// `call [#3016] [3017] [#3018]`: the number of a variable in a row of variables.
  static void numberForVariable(const Item &item, RuleContext &ctx) {
    constexpr double firstShared = 31; // those before are the program's own, and small numbers
    if (item.kind != ItemKind::Call || !item.positional || item.arguments < 3)
      return;
    const Block &block = ctx.block();
    const auto arguments = block.argumentsOf(item);
    // The one operation of an argument: a number or a variable.
    const auto only = [&](size_t at) -> const ExpressionOp * {
      if (at >= arguments.size() || arguments[at].kind != ArgumentKind::Expression ||
          arguments[at].expression >= block.expressions.size())
        return nullptr;
      const Expression &e = block.expressions[arguments[at].expression];
      return e.count == 1 && !e.bad ? &block.operations[e.first] : nullptr;
    };
    const auto isVariable = [&](size_t at, double number) {
      const ExpressionOp *const op = only(at);
      return op && op->op == Op::Variable && double(uint64_t(op->value)) == number;
    };
    for (size_t i = 0; i < arguments.size(); ++i) {
      const ExpressionOp *const op = only(i);
      if (!op || op->op != Op::Number || op->value < firstShared ||
          !(isVariable(i + 1, op->value + 1) || (i > 0 && isVariable(i - 1, op->value - 1))))
        continue;
      const SourceRange range = ctx.range(arguments[i]);
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Warning)
            .message(
                "`{0}` is a number in a row of variables: `#` is missing, and the program gets "
                "the number itself",
                ctx.text(range));
      return;
    }
  }

  static PlacesByLabel placesOf(const RuleContext &ctx) {
    PlacesByLabel all;
    Places *inside = nullptr;
    for (const Block &block : blocks(ctx.index().reader())) {
      for (const Item &item : block.items) {
        if (item.kind == ItemKind::Call && item.positional)
          all[item.label].calls.push_back(item.arguments);
        else if (item.kind == ItemKind::Structure && item.structure == Structure::Sub)
          (inside = &all[item.label])->known = true;
        else if (item.kind == ItemKind::Structure && item.structure == Structure::EndSub)
          inside = nullptr;
        else if (inside && item.kind == ItemKind::Assignment)
          inside->asked |= placeOf(block.keyOf(item.target));
        if (inside)
          inside->asked |= placesIn(block, item.condition);
      }
      for (uint16_t i = 0; inside && i < block.expressions.size(); ++i)
        inside->reads |= placesIn(block, i);
    }
    return all;
  }

  static uint64_t placeOf(uint64_t variable) {
    constexpr uint64_t last = 30; // argument
    return variable >= 1 && variable <= last ? uint64_t(1) << variable : 0;
  }

  static uint64_t placesIn(const Block &block, uint16_t expression) {
    return setOf(block, expression, placeOf);
  }

  /// The bits that `bitOf` has for the variables of an expression.
  static uint64_t setOf(const Block &block, uint16_t expression,
                        llvm::function_ref<uint64_t(uint64_t variable)> bitOf) {
    uint64_t bits = 0;
    if (expression < block.expressions.size()) {
      const Expression &e = block.expressions[expression];
      for (const ExpressionOp &op : llvm::makeArrayRef(block.operations).slice(e.first, e.count))
        if (op.op == Op::Variable)
          bits |= bitOf(uint64_t(op.value));
    }
    return bits;
  }

  static uint32_t letterOf(uint64_t variable) {
    for (char letter = 'A'; letter <= 'Z'; ++letter)
      if (macroArgument(letter) && macroArgument(letter) == variable)
        return 1u << (letter - 'A');
    return 0;
  }

  void atCode(const Event &event, RuleContext &ctx) const {
    const CodeInfo &code = ctx.code(event);
    const Block &block = ctx.block();
    if (!asksNumbers(code, "flow-argument-mismatch"))
      sleepAtBlock();
    ctx.reportNotices("flow-argument-mismatch", event);
    if (isMacro(code)) {
      repeated(ctx);
      lostArgument(event, code, ctx);
    }
    if (code.arguments)
      if (const Word *further = block.argument(code.arguments + 1u))
        if (auto finding = ctx.report(*further))
          finding.message("`{0}` takes {1} arguments at most, and this is one more", code.name,
                          code.arguments);
    for (const WordSpec &spec : code.words) {
      const Word *word = spec.text ? wordFor(block, spec) : nullptr;
      if (!word)
        continue;
      for (const Item &item : block.items)
        if (item.kind == ItemKind::Instruction && item.begin == event.word->offset &&
            item.arguments >= spec.position &&
            isName(block.argumentsOf(item)[spec.position - 1], ctx))
          if (auto finding = ctx.report(*word))
            finding.message("`{0}` ({1}) of `{2}` is a string: write it in quotation marks",
                            ctx.text(*word), spec.note, code.name);
    }
  }

  /// A number, or a name that the program has not defined as a variable for texts.
  static bool isName(const Argument &argument, const RuleContext &ctx) {
    const Block &block = ctx.block();
    if (argument.kind != ArgumentKind::Expression || argument.expression == noExpression)
      return false;
    const Expression &e = block.expressions[argument.expression];
    if (isLabelPair(ctx.text(ctx.range(argument)), ctx))
      return true;
    if (e.bad || e.count != 1 || block.operations[e.first].op == Op::Opaque)
      return false;
    const Defined *defined =
        ctx.index().definition(ctx.index().programAt(block.begin), ctx.text(ctx.range(e)).trim());
    return !defined || defined->kind != ItemKind::Definition ||
           defined->type != VariableType::String;
  }

  /// `BEGIN1:END1`, two names of which neither is a variable.
  static bool isLabelPair(llvm::StringRef text, const RuleContext &ctx) {
    const auto [first, second] = text.split(':');
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    const auto isLabel = [&](llvm::StringRef name) {
      name = name.trim();
      return !name.empty() && !llvm::isDigit(name[0]) &&
             llvm::all_of(name, [](char c) { return llvm::isAlnum(c) || c == '_'; }) &&
             !ctx.index().definition(program, name);
    };
    return isLabel(first) && isLabel(second);
  }

  /// Definitions come before everything that runs, and the parameters of a program before them.
  void atDefinition(const Item &item, RuleContext &ctx) const {
    const bool head = item.kind == ItemKind::Parameters;
    if (!head && item.kind != ItemKind::Definition && item.kind != ItemKind::Declaration)
      return;
    // A list of names is one slip, and so are further heads after the first that is misplaced.
    if (&item != &ctx.block().items.front())
      return;
    const uint32_t here = ctx.block().begin;
    const HeadOf &of = headBefore(here, ctx);
    const SourceRange &first = head ? of.firstContent : of.firstThatRuns;
    if (first.empty() || first.begin >= here || (head && of.secondHead < here) ||
        (!head && of.runs >= here))
      return;
    const SourceRange range = ctx.range(item);
    auto finding = ctx.report(range);
    if (!finding)
      return;
    finding
        .message(head ? "`{0}` has to be the program's first block"
                      : "`{0}` has to come before the first block that runs",
                 ctx.text(range).trim())
        .note(first, "this block comes before");
    // Where only modes were set many controls take it.
    if (!head && of.moves >= here)
      finding.severity(Severity::Warning);
  }

  /// What is first of its kind in a program, as far as it was read.
  struct HeadOf {
    uint32_t end = 0; ///< after what was read; 0: nothing was
    uint32_t heads = 0;
    uint32_t secondHead = ~0u, moves = ~0u, runs = ~0u; ///< blocks
    SourceRange firstContent, firstThatRuns;            ///< what a head, and a definition, precedes
  };

  /// The same of all that comes before the block at `here`: each block is read once.
  const HeadOf &headBefore(uint32_t here, const RuleContext &ctx) const {
    const ProgramInfo &program = ctx.index().programAt(here);
    ctx.index().reader(); // the program is looked through, now or before
    HeadOf &of = heads_.growing({ctx.source().id(), program.begin});
    for (const Block &block : blocks(ctx.index(), std::max(of.end, program.body), here)) {
      of.end = block.next;
      const auto note = [&](uint32_t &place) { place = std::min(place, block.begin); };
      if (block.hasAny(ctx.dialect().axisWords))
        note(of.moves);
      if (!onlySets(block, ctx.dialect()))
        note(of.runs);
      if (llvm::any_of(block.items, isHead) && ++of.heads > 1)
        note(of.secondHead);
      if (of.firstContent.empty() && runsBefore(block, true))
        of.firstContent = ctx.range(block);
      if (of.firstThatRuns.empty() && runsBefore(block, false))
        of.firstThatRuns = ctx.range(block);
    }
    return of;
  }

  TextAnswers<std::pair<FileId, uint32_t>, HeadOf> heads_; ///< by file and program

  /// Modes and remarks for the operator, which controls take before definitions: neither a work
  /// offset nor anything that acts.
  static bool onlySets(const Block &block, const Dialect &dialect) {
    const GroupIndex offsets = dialect.group(StandardGroup::WorkOffset);
    return llvm::all_of(block.words,
                        [&](const Word &word) {
                          const CodeIndex code = codeOf(dialect, word);
                          if (code == noCode || dialect.codes[code].letter == 'M')
                            return word.address == argumentAddress;
                          const CodeInfo &info = dialect.codes[code];
                          return info.group != noGroup ? info.group != offsets
                                                       : info.action == Action::None;
                        }) &&
           llvm::all_of(block.items, [](const Item &item) {
             return item.kind == ItemKind::Instruction || item.kind == ItemKind::Definition ||
                    item.kind == ItemKind::Declaration || item.kind == ItemKind::Parameters ||
                    item.kind == ItemKind::Macro;
           });
  }

  static bool isHead(const Item &item) { return item.kind == ItemKind::Parameters; }

  /// Whether the block has to come after a definition, or after the head of the program.
  static bool runsBefore(const Block &block, bool head) {
    return !block.words.empty() || llvm::any_of(block.items, [&](const Item &i) {
      return head || (i.kind != ItemKind::Definition && i.kind != ItemKind::Declaration &&
                      i.kind != ItemKind::Parameters && i.kind != ItemKind::Macro);
    });
  }

  /// What is said of the program's head is told there.
  static bool isHeadOpen(const SourceRange &head, const RuleContext &ctx) {
    const llvm::StringRef text = ctx.text(head);
    return text.count('(') > text.count(')');
  }

  static void atCall(const Event &event, RuleContext &ctx) {
    if (ctx.flowRelated().end && isHeadOpen(ctx.flowRelated(), ctx))
      return;
    const char *what = nullptr;
    std::optional<Severity> severity;
    switch (event.flowIssue()) {
    case FlowIssue::TooManyArguments:
      what = ctx.flowRelated().end
                 ? "`{0}` has more arguments than the program takes"
                 : "`{0}` has arguments, and the program has no PROC to take them";
      break;
    case FlowIssue::ArgumentLeftOut:
      what = "`{0}` leaves an argument out that has no value of its own: it becomes 0";
      severity = Severity::Warning;
      break;
    case FlowIssue::ArgumentNotVariable:
      what = "`{0}`: the program gives a value back, and the argument is no variable to take it";
      break;
    case FlowIssue::NotDeclared: // newer controls look for the head themselves
      if (!ctx.asked())
        return;
      what = "`{0}` has arguments, and no EXTERN says before what the program takes";
      severity = Severity::Style;
      break;
    case FlowIssue::DeclarationMismatch:
      what = "`{0}` is declared with other types than the program takes";
      break;
    default:
      return;
    }
    if (auto finding = ctx.report(ctx.flowRange(), event.certain)) {
      finding.message(what, ctx.text(ctx.flowRange())).severity(severity);
      if (ctx.flowRelated().end)
        finding.note(ctx.flowRelated(), "what the program takes");
    }
  }
};

} // namespace
NCVET_RULE(FlowArgumentMismatch, flow_argument_mismatch)
} // namespace ncvet
