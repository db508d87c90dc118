// A code that needs a block of its own shares it with words that are not its own.
#include "analyzer/facts/called_blocks.h"
#include "analyzer/facts/foreign_condition.h"
#include "analyzer/facts/word_checks.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class BlockMustStandAlone final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.handleNotices();
    to.on(EventKind::Syntax);
    assignments_ = to.flag("assignments");
    if (to.flag("statements"))
      to.on(EventKind::Statement);
    flowAlone_ = to.dialect().facts->program.flowCodesAlone;
    to.onCode([&](const CodeInfo &code) {
      return code.alone || (flowAlone_ && decidesFlow(code)) ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Statement)
      return atStatement(ctx.block().items[event.item()], event.item(), ctx);
    if (event.kind == EventKind::Syntax)
      return noAction(ctx.block().issues[event.issue()], ctx);
    ctx.reportNotices(id, event);
    const CodeInfo &code = ctx.code(event);
    if (flowAlone_ && decidesFlow(code))
      besideOthers(*event.word, ctx);
    if (!code.alone)
      return;
    // Of two such codes the first speaks.
    for (const CodeUse &other : ctx.codes())
      if (ctx.code(other).alone && other.word && other.word->offset < event.word->offset)
        return;
    AddressMask own = code.takes;
    for (const WordSpec &spec : code.words)
      own |= spec.any;
    if (ctx.block().has(argumentAddress))
      own |= maskOf(argumentAddress);
    for (const Item &item : ctx.block().items)
      if (item.kind == ItemKind::Call && item.begin != event.word->offset && !isMacro(item, ctx)) {
        const SourceRange call = ctx.range(item);
        if (auto finding = ctx.report(call))
          finding.message("`{0}` is in the block of `{1}`, which needs its own block",
                          ctx.text(call), ctx.text(*event.word));
        return;
      }
    if (assignments_ && assignment(code, event, ctx))
      return;
    // `G4 X2`: what is missing is there under another letter, and another rule says so.
    if (!missingWords(ctx, event).empty())
      return;
    for (const Word &word : ctx.block().words) {
      if (&word == event.word || own & maskOf(word.address) || isCalled(code, word, ctx) ||
          isHowItMoves(code, word, ctx))
        continue;
      auto finding = ctx.report(word);
      if (!finding)
        return;
      finding.message("`{0}` is in the block of `{1}`, which needs its own block", ctx.text(word),
                      ctx.text(*event.word));
      moveOut(finding, *event.word, own, ctx);
      return;
    }
  }

private:
  /// An M code at which the program stops, ends, or goes elsewhere.
  static bool decidesFlow(const CodeInfo &code) {
    switch (code.action) {
    case Action::ProgramStop:
    case Action::OptionalStop:
    case Action::ProgramEnd:
    case Action::ProgramEndRewind:
    case Action::CallProgram:
    case Action::CallLocal:
    case Action::Return:
      return code.letter == 'M';
    default:
      return false;
    }
  }

  /// Another M code in the block of one that decides where the program goes.
  static void besideOthers(const Word &code, RuleContext &ctx) {
    const Block &block = ctx.block();
    if (!(block.repeated & maskOf('M')))
      return;
    for (const Word &word : block.words) {
      if (&word == &code || word.address != letterAddress('M'))
        continue;
      // Two such codes: the first speaks.
      const CodeIndex other = ctx.dialect().find('M', word.codeNumber());
      if (word.offset < code.offset && other != noCode && decidesFlow(ctx.dialect().codes[other]))
        return;
      if (auto finding = ctx.report(word))
        finding.message("`{0}` is in the block of `{1}`, which takes no other M code",
                        ctx.text(word), ctx.text(code));
      return;
    }
  }

  /// `R1=3` beside a code that reads no variables: its own words may be computed from it.
  static bool assignment(const CodeInfo &code, const Event &event, RuleContext &ctx) {
    if (llvm::any_of(code.words, [](const WordSpec &spec) { return spec.variable != 0; }))
      return false;
    for (const Item &item : ctx.block().items) {
      if (item.kind != ItemKind::Assignment)
        continue;
      const SourceRange range = ctx.range(item);
      // `AX[1]=5` is a word of the axis that the index names.
      if (ctx.text(range).split('=').first.contains('['))
        continue;
      if (auto finding = ctx.report(range))
        finding.message("`{0}` is in the block of `{1}`, which needs its own block",
                        ctx.text(range), ctx.text(*event.word));
      return true;
    }
    return false;
  }

  /// What belongs to the path of the program is no action beside it.
  static void noAction(const SyntaxIssue &issue, RuleContext &ctx) {
    if (issue.kind != SyntaxIssueKind::NoAction)
      return;
    // The words of one action: the first speaks for the others.
    for (const SyntaxIssue &other : ctx.block().issues)
      if (other.kind == issue.kind && other.begin < issue.begin)
        return;
    const SourceRange range = ctx.range(issue);
    if (auto finding = ctx.report(range))
      finding.message("`{0}` belongs to the path and wants a block of the program: no synchronised "
                      "action takes it",
                      ctx.text(range));
  }

  /// `G0 G75 X0`: the way to a reference or fixed point is a rapid move in any case.
  static bool isHowItMoves(const CodeInfo &code, const Word &word, const RuleContext &ctx) {
    const CodeIndex other =
        code.action == Action::ReferenceReturn && ctx.dialect().lexical.commaSeparates
            ? codeOf(ctx.dialect(), word)
            : noCode;
    return other != noCode && ctx.dialect().codes[other].action == Action::Rapid;
  }

  /// The cycle that a modal call calls.
  static bool isCalled(const CodeInfo &code, const Word &word, const RuleContext &ctx) {
    if (word.address != keywordAddress || !ctx.dialect().codes[code.base].cancelsCalls)
      return false;
    const CodeIndex called = codeOf(ctx.dialect(), word);
    return called != noCode && ctx.dialect().codes[called].action == Action::Cycle;
  }

  /// Calls by name, brackets of structured flow and jumps without a condition share their block
  /// with nothing.
  static void atStatement(const Item &item, size_t index, RuleContext &ctx) {
    const Block &block = ctx.block();
    if (!wantsOwnBlock(index, ctx))
      return;
    // The first of several speaks for the others.
    for (size_t before = 0; before < index; ++before)
      if (wantsOwnBlock(before, ctx))
        return;
    const bool bracket = item.kind == ItemKind::Structure;
    const SourceRange range = ctx.range(item);
    if (ctx.dialect().facts->text.isoSignsForeign && // block-foreign-dialect-code speaks
        foreignSignIn(item, ctx.source().text(item.begin, block.end)))
      return;
    const bool marked = bracket && (block.hasLabel() || block.skip >= 0);
    if (block.words.empty() && block.items.size() == 1 && !marked)
      return;
    if (item.kind == ItemKind::Call && looksLikeWord(item, ctx) && mayBeMacro(item, ctx))
      return mistypedWord(range, ctx);
    if (auto finding = ctx.report(range))
      // A name that no program in sight has may be a macro of the machine's builder.
      finding.severity(severityOf(item, ctx))
          .message(marked ? "`{0}` carries a label or a skip mark, which a bracket of structured "
                            "flow may not have"
                          : "`{0}` shares its block with other words: it wants a block of its "
                            "own",
                   ctx.text(range));
  }

  /// What no program in sight is may be a cycle or a macro of the machine's builder.
  static std::optional<Severity> severityOf(const Item &item, const RuleContext &ctx) {
    if (item.kind != ItemKind::Call || isNumbered(item, ctx) || isKnownProgram(ctx))
      return std::nullopt;
    return mayBeMacro(item, ctx) ? Severity::Style : Severity::Warning;
  }

  /// `L100`
  static bool isNumbered(const Item &call, const RuleContext &ctx) {
    const llvm::StringRef name =
        ctx.text(SourceRange{ctx.source().id(), call.nameBegin, call.nameEnd});
    return name.size() > 1 &&
           llvm::all_of(name.drop_front(), [](char c) { return llvm::isDigit(c); });
  }

  static bool isKnownProgram(const RuleContext &ctx) {
    bool known = false;
    eachCalledBlock(ctx.unitOf(ctx.source().id()), ctx.block(), [&](const Block &) {
      known = true;
      return false;
    });
    return known;
  }

  static bool wantsOwnBlock(size_t index, const RuleContext &ctx) {
    const Block &block = ctx.block();
    const Item &item = block.items[index];
    if (item.kind == ItemKind::Jump)
      return item.jump != JumpKind::ByValue && item.jump != JumpKind::BySign && item.arguments &&
             (index == 0 || block.items[index - 1].kind != ItemKind::If);
    return item.kind == ItemKind::Structure ||
           (item.kind == ItemKind::Call && !item.modal && !isMacro(item, ctx));
  }

  /// `Zl00`, `XX20` beside words: the letter of an axis, and a number that a letter spoils.
  static bool looksLikeWord(const Item &call, const RuleContext &ctx) {
    const std::string name =
        ctx.text(SourceRange{ctx.source().id(), call.nameBegin, call.nameEnd}).upper();
    if (name.size() < 3 || !llvm::StringRef("XYZABCIJK").contains(name[0]) ||
        !llvm::isDigit(name.back()) || !ctx.block().hasAny(ctx.dialect().known))
      return false;
    return llvm::all_of(llvm::StringRef(name).drop_front(), [&](char c) {
      return llvm::isDigit(c) || c == name[0] || c == 'L' || c == 'I' || c == 'O';
    });
  }

  static void mistypedWord(SourceRange range, RuleContext &ctx) {
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Warning)
          .message("`{0}` is a name, where a word of an axis is due: the control stops unless the "
                   "machine has a macro of that name",
                   ctx.text(range));
  }

  /// A bare name, and no program of it is known: definitions of the machine may have it as words.
  static bool mayBeMacro(const Item &call, const RuleContext &ctx) {
    return !call.arguments && !isNumbered(call, ctx) && !ctx.text(ctx.range(call)).contains('(') &&
           !isKnownProgram(ctx);
  }

  /// A name that the program defines as words: they take its place.
  static bool isMacro(const Item &call, const RuleContext &ctx) {
    const Defined *known = ctx.index().definition(
        ctx.index().programAt(ctx.block().begin),
        ctx.text(SourceRange{ctx.source().id(), call.nameBegin, call.nameEnd}));
    return known && known->kind == ItemKind::Macro;
  }

  /// The code goes into a block before this one, with the words that belong to it.
  static void moveOut(FindingBuilder &finding, const Word &code, AddressMask own,
                      const RuleContext &ctx) {
    const auto goes = [&](const Word &w) { return &w == &code || own & maskOf(w.address); };
    std::string text;
    for (const Word &word : ctx.block().words)
      if (goes(word)) {
        if (!text.empty())
          text += ' ';
        text += ctx.text(word);
      }
    finding.fix(FixSafety::Unsafe, "put the code into a block of its own",
                ctx.insertBlockBefore(text));
    for (const Word &word : ctx.block().words)
      if (goes(word))
        finding.edit(ctx.remove(word));
  }

  bool assignments_ = false; ///< an assignment is something beside the code too
  static constexpr llvm::StringLiteral id{"block-must-stand-alone"};

  bool flowAlone_ = false; ///< codes that decide the flow share their block with no other M code
};

} // namespace
NCVET_RULE(BlockMustStandAlone, block_must_stand_alone)
} // namespace ncvet
