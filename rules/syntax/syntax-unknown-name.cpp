// A name that the control does not know and the program does not define.
#include "analyzer/facts/defined_elements.h"
#include "analyzer/facts/instruction_name.h"
#include "analyzer/facts/near_names.h"
#include "analyzer/facts/word_checks.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "analyzer/rule/text_answers.h"
#include "formats/dialect/control_facts.h"

#include "llvm/ADT/StringExtras.h"

#include <set>

namespace ncvet {
namespace {

struct SyntaxUnknownNameMemory {
  std::set<uint64_t> spoken; ///< names that were looked at
  DefinedElements elements;
};

class SyntaxUnknownName final : public StatefulRule<SyntaxUnknownNameMemory> {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().elementWords) {
      to.onAction({Action::DefineElement});
      to.onChange({EventKind::Block});
    }
    lacks_ = to.dialect().facts->variables.lacksFunctions;
    if (!lacks_.empty()) {
      to.onChange({EventKind::Block});
      to.on(EventKind::Syntax);
    }
    if (to.dialect().keywords.empty())
      return;
    for (const CodeInfo &code : to.dialect().codes)
      for (const WordSpec &spec : code.words)
        if (spec.variable) {
          known_.insert(spec.variable);
          known_.insert(spec.orVariable);
          names_.push_back(llvm::StringRef(spec.name).upper());
        }
    for (const std::string &name : to.dialect().variableNames)
      known_.insert(variableKey(name));
    to.on({EventKind::Syntax, EventKind::Assignment});
    defined_ = to.flag("definedNames");
    if (defined_)
      to.on(EventKind::Statement);
    if (defined_ || !to.dialect().variableNames.empty()) // a list that the table gives is complete
      to.on(EventKind::UnsetRead);
    instructions_ = instructionNames(to.dialect());
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Assignment || event.kind == EventKind::Statement)
      sleepAtBlock();
    if (event.kind == EventKind::Assignment)
      return defined_ ? undefined(event, ctx) : parameter(event, ctx);
    if (event.kind == EventKind::UnsetRead)
      return !event.certain ? void()
             : defined_     ? undefinedRead(event, ctx)
                            : unknownRead(event, ctx);
    if (event.kind == EventKind::Block && !lacks_.empty())
      functions(ctx);
    if (event.kind == EventKind::Block || event.kind == EventKind::Code)
      return element(ctx);
    if (event.kind == EventKind::Statement)
      return again(ctx.block().items[event.item()], ctx);
    const SyntaxIssue &issue = ctx.block().issues[event.issue()];
    const SourceRange range = ctx.range(issue);
    if (namesLackedFunction(ctx, issue))
      return lacked({range.file, range.begin,
                     range.begin + uint32_t(ctx.text(range).take_while(llvm::isAlpha).size())},
                    ctx);
    if (ctx.dialect().keywords.empty()) // syntax-error speaks of other words
      return;
    if (issue.kind == SyntaxIssueKind::UnknownAttribute && !ctx.block().repeatsIssue(event.issue()))
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Warning)
            .message("`{0}` is no attribute of a program that the control knows", ctx.text(range));
    if (issue.kind == SyntaxIssueKind::BadName)
      return taken(range, ctx);
    if (issue.kind != SyntaxIssueKind::UnknownWord)
      return;
    auto finding = ctx.report(range);
    if (!finding)
      return;
    const std::string name = ctx.text(range).upper();
    const std::string *near = nullptr;
    unsigned least = unsigned(name.size()) / 3 + 1;
    for (const CodeInfo &code : ctx.dialect().codes)
      if (!code.letter) {
        const unsigned distance = llvm::StringRef(name).edit_distance(code.name, true, least);
        if (distance < least) {
          least = distance;
          near = &code.name;
        }
      }
    if (near)
      finding
          .message("`{0}` is no name that the control knows: did you mean `{1}`?", ctx.text(range),
                   *near)
          .fix(FixSafety::Unsafe, "write `" + *near + "`", ctx.replace(range, *near));
    else
      finding.message("`{0}` is no name that the control knows", ctx.text(range));
  }

private:
  std::vector<std::string> lacks_; ///< functions that the control lacks

  /// `FUP[#1]` where the control has no such function.
  void functions(RuleContext &ctx) const {
    const Block &block = ctx.block();
    for (const ExpressionOp &op : block.operations) {
      const llvm::StringRef name =
          ctx.source().text(op.offset, block.end).take_while(llvm::isAlpha);
      if (name.size() < 2 || llvm::none_of(lacks_, [&](const std::string &one) {
            return name.equals_insensitive(one);
          }))
        continue;
      lacked({ctx.source().id(), op.offset, op.offset + uint32_t(name.size())}, ctx);
    }
  }

  static void lacked(SourceRange name, RuleContext &ctx) {
    if (auto finding = ctx.report(name))
      finding.severity(Severity::Warning)
          .message("`{0}` is no function of this control", ctx.text(name));
  }

  /// A variable with the name of a word of the language.
  static void taken(const SourceRange &name, RuleContext &ctx) {
    const bool defined = llvm::any_of(ctx.block().items, [&](const Item &item) {
      return item.kind == ItemKind::Definition && item.nameBegin == name.begin;
    });
    if (!defined || !isLetter(ctx.text(name)[0]))
      return;
    if (auto finding = ctx.report(name))
      finding.message(
          "`{0}` is a word of the language and names no variable: the control stops here",
          ctx.text(name));
  }

  /// A name that the program has defined before.
  static void again(const Item &item, RuleContext &ctx) {
    if (item.kind != ItemKind::Definition)
      return;
    const SourceRange range{ctx.source().id(), item.nameBegin, item.nameEnd};
    const CodeIndex word = ctx.dialect().keyword(ctx.text(range));
    if (word != noCode && ctx.dialect().codes[word].group != noGroup)
      return taken(range, ctx);
    const Defined *first =
        ctx.index().definition(ctx.index().programAt(ctx.block().begin), ctx.text(range));
    if (!first || first->kind != ItemKind::Definition || first->begin >= item.nameBegin)
      return;
    if (auto finding = ctx.report(range))
      finding.message("`{0}` is defined already: the control stops here", ctx.text(range))
          .note(ctx.range(*first), "the first definition");
  }

  /// A value for a name that a main program does not define. What it is called by may have defined
  /// it, and so may the machine's own definitions.
  void undefined(const Event &event, RuleContext &ctx) const {
    const auto key = uint64_t(event.variable());
    if (event.variable() < int64_t(firstNamedVariable))
      return;
    const bool called = ctx.callDepth() > 0 || isSubprogram(ctx);
    // Among the words of a move it is an axis that the builder has named.
    if (ctx.block().hasAny(ctx.dialect().axisWords))
      return;
    const FileId file = ctx.source().id();
    if (!memory().spoken.insert(key).second)
      return;
    for (const Item &item : ctx.block().items) {
      if (item.kind != ItemKind::Assignment || ctx.block().keyOf(item.target) != key)
        continue;
      const SourceRange range{file, item.nameBegin, item.nameEnd};
      const llvm::StringRef name = ctx.text(range);
      const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
      const bool parameter =
          name.startswith_insensitive("R") && llvm::all_of(name.drop_front(), llvm::isDigit);
      if (name.empty() || parameter || !isLetter(name[0]) || name.contains('[') ||
          ctx.index().definition(program, name) || ctx.dialect().keyword(name) != noCode)
        return;
      // Names as builders write them may be definitions of the machine, if none is like them, and
      // those of a subprogram the caller's.
      const std::optional<Defined> near = nearlyDefined(name, program, ctx);
      if (called ? !near || isMentionedAgain(ctx.range(*near), program, ctx)
                 : mayBeOfMachine(name) && !near)
        return;
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Warning)
            .message("the program defines no `{0}`: unless the machine's own definitions have it, "
                     "the control stops here",
                     name);
      return;
    }
  }

  /// A name is read that the program does not define. Where it defines one that is almost the same
  /// that one was meant; names as builders write them may be definitions of the machine.
  void undefinedRead(const Event &event, RuleContext &ctx) const {
    const bool called = ctx.callDepth() > 0 || isSubprogram(ctx);
    const auto begin = event.place();
    const llvm::StringRef name = ctx.source().text(begin, ctx.block().end).take_while([](char c) {
      return llvm::isAlnum(c) || c == '_';
    });
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    // (`R8F100.`: a parameter and the word after it, for no name has a digit second)
    if (name.size() < shortest || !isLetter(name[0]) || llvm::isDigit(name[1]) ||
        ctx.index().definition(program, name) || known_.count(variableKey(name)) ||
        !memory().spoken.insert(variableKey(name)).second)
      return;
    const SourceRange range{ctx.source().id(), begin, uint32_t(begin + name.size())};
    if (const auto near = nearlyDefined(name, program, ctx)) {
      const SourceRange defined = ctx.range(*near);
      // In a subprogram the caller may have defined the name, save where the other is for nothing.
      if (called && isMentionedAgain(defined, program, ctx))
        return;
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Warning)
            .message("the program defines no `{0}`, but `{1}`: unless the machine's own "
                     "definitions have both, the control stops here",
                     name, ctx.text(defined))
            .note(defined, "this name is defined");
      return;
    }
    if (called || isArgument(range, ctx.block()) || mayBeOfMachine(name))
      return;
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Warning)
          .message("nothing has defined `{0}`: unless the machine's own definitions have it, the "
                   "control stops here",
                   name);
  }

  /// `<%CON=%CXN+1>`: the control has variables with names of its own only, and none of this name.
  void unknownRead(const Event &event, RuleContext &ctx) const {
    const uint32_t begin = event.place();
    const llvm::StringRef text = ctx.source().text(begin, ctx.block().end);
    const llvm::StringRef name = text.take_front(
        text.find_if_not([](char c) { return llvm::isAlnum(c) || c == '%' || c == '_'; }));
    const llvm::StringRef bare = name.ltrim('%');
    const bool numbered =
        bare.size() > 1 && llvm::all_of(bare.drop_front(), [](char c) { return llvm::isDigit(c); });
    if (bare.empty() || !llvm::isAlpha(bare[0]) || numbered || known_.count(variableKey(name)) ||
        knownWithout(name) || instructions_.count(bare.upper()))
      return;
    if (auto finding =
            ctx.report(SourceRange{ctx.source().id(), begin, uint32_t(begin + name.size())}))
      finding.severity(Severity::Warning)
          .message("`{0}` is no variable of the control: it has no value", name);
  }

  /// The first definition whose name differs by one letter, not by its digits.
  std::optional<Defined> nearlyDefined(llvm::StringRef name, const ProgramInfo &program,
                                       const RuleContext &ctx) const {
    return near_
        .of({ctx.source().id(), program.begin},
            [&] { return NearNames(ctx.index().definitions(program), shortest); })
        .near(name);
  }

  static bool isLetter(char c) { return llvm::isAlpha(c) || c == '_'; }

  /// Whether the text of the program has the name of a definition in a second place.
  bool isMentionedAgain(const SourceRange &defined, const ProgramInfo &program,
                        const RuleContext &ctx) const {
    constexpr uint32_t readable = 1u << 18;
    if (program.end - program.begin > readable)
      return true;
    const Mentions &mentions = mentions_.of({ctx.source().id(), program.begin}, [&] {
      return mentionsIn(ctx.source().text(program.begin, program.end));
    });
    return mentions.lookup(ctx.text(defined).upper()) != 1;
  }

  using Mentions = llvm::StringMap<unsigned>;

  /// How often a text has each name, in capitals.
  static Mentions mentionsIn(llvm::StringRef text) {
    Mentions mentions;
    while (!text.empty()) {
      const llvm::StringRef name =
          text.take_while([](char c) { return llvm::isAlnum(c) || c == '_'; });
      if (!name.empty())
        ++mentions[name.upper()];
      text = text.drop_front(std::max<size_t>(name.size(), 1));
    }
    return mentions;
  }

  /// By file and program.
  TextAnswers<std::pair<FileId, uint32_t>, NearNames> near_;
  TextAnswers<std::pair<FileId, uint32_t>, Mentions> mentions_;

  static constexpr size_t shortest = 4; ///< shorter names differ by a letter on purpose

  /// `R200`, `GUD_X`: a parameter that other programs set, a name as builders write them.
  static bool mayBeOfMachine(llvm::StringRef name) {
    return name.contains('_') ||
           (name.startswith_insensitive("R") && llvm::all_of(name.drop_front(), llvm::isDigit));
  }

  /// Alone in its place of a call it may name a program or a contour: the call's own rules speak.
  static bool isArgument(SourceRange name, const Block &block) {
    return llvm::any_of(block.items, [&](const Item &item) {
      return llvm::any_of(block.argumentsOf(item), [&](const Argument &argument) {
        return argument.begin == name.begin && argument.end == name.end;
      });
    });
  }

  static bool isSubprogram(const RuleContext &ctx) {
    const std::string shown = ctx.source().display();
    const llvm::StringRef ending = llvm::StringRef(shown).rsplit('.').second;
    return llvm::none_of(ctx.dialect().mainExtensions,
                         [&](const std::string &main) { return ending.equals_insensitive(main); });
  }

  bool defined_ = false; ///< programs define their names themselves

  /// An element of a contour that nothing has defined.
  void element(RuleContext &ctx) const {
    if (!ctx.block().hasAny(ctx.dialect().elementWords))
      return;
    if (const Word *word = DefinedElements::definedBy(ctx)) {
      memory().elements.define(*word, ctx);
      return;
    }
    // Alone in its block it may be another control's number, save in the middle of a contour.
    const bool contour =
        ctx.before().profile == ProfileMode::Recorded || ctx.before().compensation == phaseOn;
    if (ctx.before().may(Fact::UnknownCode) || (DefinedElements::alone(ctx) && !contour))
      return;
    for (const Word &word : ctx.block().words)
      if ((ctx.dialect().elementWords & maskOf(word.address)) && !memory().elements.find(word))
        if (auto finding = ctx.report(word))
          finding.message("nothing has defined the element `{0}`", ctx.text(word));
  }

  /// A value for a name that no cycle reads, where only cycles read names.
  void parameter(const Event &event, RuleContext &ctx) const {
    if (known_.empty() || !ctx.block().has(variableAddress) ||
        event.variable() < int64_t(firstNamedVariable) || known_.count(uint64_t(event.variable())))
      return;
    for (const Item &item : ctx.block().items)
      if (item.kind == ItemKind::Assignment &&
          ctx.block().keyOf(item.target) == uint64_t(event.variable()) &&
          isParameter(item, ctx.block()) &&
          !instructions_.count(
              ctx.text(SourceRange{ctx.source().id(), item.nameBegin, item.nameEnd}).upper()) &&
          !knownWithout(ctx.text(SourceRange{ctx.source().id(), item.nameBegin, item.nameEnd})) &&
          !isOfPart(item, ctx))
        if (auto finding = ctx.report(SourceRange{ctx.source().id(), item.nameBegin, item.nameEnd}))
          finding.severity(Severity::Warning)
              .message("no cycle reads `{0}`: the value goes nowhere",
                       ctx.text(SourceRange{ctx.source().id(), item.nameBegin, item.nameEnd}));
  }

  /// `R1=5` beside `<ENT=R1>`: only what a cycle may take is a word of the block, a variable of the
  /// program's own is not.
  static bool isParameter(const Item &item, const Block &block) {
    return llvm::any_of(block.words, [&](const Word &word) {
      return word.address == variableAddress && word.offset == item.begin;
    });
  }

  /// `CYC_DRILL2_DWELL` beside `CYC_COPY_PART = DRILL2`: a parameter of a part of which the table
  /// knows none. Whether there is such a part is another rule's business.
  bool isOfPart(const Item &item, const RuleContext &ctx) const {
    const auto textOf = [&](uint32_t begin, uint32_t end) {
      return ctx.text(SourceRange{ctx.source().id(), begin, end}).upper();
    };
    const std::string name = textOf(item.nameBegin, item.nameEnd);
    return llvm::any_of(ctx.block().items, [&](const Item &other) {
      if (other.kind != ItemKind::Assignment || other.end <= other.nameEnd)
        return false;
      const std::string value = textOf(other.nameEnd, other.end);
      const std::string part = llvm::StringRef(value).ltrim(" \t=").str();
      if (part.empty() || !llvm::isAlpha(part[0]))
        return false;
      const std::string inside = "_" + part + "_";
      const auto has = [&](const std::string &text) {
        return text.find(inside) != std::string::npos;
      };
      return has(name) && llvm::none_of(names_, has);
    });
  }

  /// Another mark of the type: variable-type-mismatch speaks.
  bool knownWithout(llvm::StringRef name) const {
    const std::string bare = name.ltrim('%').str();
    return known_.count(variableKey(bare)) || known_.count(variableKey("%" + bare)) ||
           known_.count(variableKey("%%" + bare));
  }

  std::set<std::string> instructions_; ///< of which another rule speaks
  std::set<uint64_t> known_;           ///< keys of the variables that codes read
  std::vector<std::string> names_;     ///< of those variables, in capitals
};

} // namespace
NCVET_RULE(SyntaxUnknownName, syntax_unknown_name)
} // namespace ncvet
