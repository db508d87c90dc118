// A program number that belongs to the control.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class ProgramNameReserved final : public Rule {
public:
  void listen(Subscriptions &to) override {
    reserved_ = to.dialect().limits.reservedPrograms;
    protected_ = to.dialect().limits.protectedPrograms;
    if (!to.dialect().hiddenPrograms.empty()) {
      to.on(EventKind::Statement);
      to.onCode([](const CodeInfo &code) { return code.isProgram; });
    }
  }

  /// A program of the project, or one that this program declares, hides the control's.
  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code)
      return library(event, ctx);
    const Item &call = ctx.block().items[event.item()];
    if (call.kind == ItemKind::Definition)
      return variable(call, ctx);
    if (call.kind != ItemKind::Call || call.nameBegin == call.nameEnd)
      return;
    const SourceRange where{ctx.source().id(), call.nameBegin, call.nameEnd};
    const llvm::StringRef name = ctx.text(where);
    const CodeIndex hidden = ctx.dialect().keyword(name);
    if (hidden == noCode || !ctx.dialect().codes[hidden].isProgram)
      return;
    auto finding = ctx.report(where);
    if (!finding)
      return;
    finding.message("`{0}` calls a program of the project, not the control's own of that name: the "
                    "one hides the other",
                    name);
    const Defined *own = ctx.index().definition(ctx.index().programAt(ctx.block().begin), name);
    if (own && own->kind == ItemKind::Declaration)
      finding.note(ctx.range(*own), "the program is declared here");
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (!ctx.dialect().keywords.empty())
      return named(file, ctx);
    for (const ProgramInfo &program : file.index.programs()) {
      if (protected_ && program.hasHeader())
        ofBuilder(program, file, ctx);
      if (!program.hasHeader() || !llvm::is_contained(reserved_, int(program.number)))
        continue;
      if (auto finding =
              ctx.report(SourceRange{file.source.id(), program.headerBegin, program.headerEnd}))
        finding.message("the control writes O{0} itself: a program of this number is lost",
                        program.number);
    }
  }

private:
  int64_t protected_ = 0; ///< from here on numbers of four digits are the builder's; 0: none are

  /// A main program with a number under which machines keep and protect macros.
  void ofBuilder(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) const {
    constexpr int64_t last = 9999;
    constexpr size_t readable = 4u << 20; // a program that long was made by a machine
    if (program.number < protected_ || program.number > last ||
        program.end - program.body > readable)
      return;
    for (const Block &block : blocks(file.reader, program.body, program.end)) {
      if (!block.has(letterAddress('M')) ||
          !findCode(ctx.dialect(), block, {Action::ProgramEnd, Action::ProgramEndRewind}))
        continue;
      if (auto finding =
              ctx.report(SourceRange{file.source.id(), program.headerBegin, program.headerEnd}))
        finding.severity(Severity::Style)
            .message("O{0} is a main program: machines keep macros from O{1} on, and protect them",
                     program.number, protected_);
      return;
    }
  }

  /// A variable with the name of one of the control's codes or cycles.
  static void variable(const Item &definition, RuleContext &ctx) {
    const SourceRange where{ctx.source().id(), definition.nameBegin, definition.nameEnd};
    const llvm::StringRef name = ctx.text(where);
    const CodeIndex own = name.empty() ? noCode : ctx.dialect().keyword(name);
    // Of the words of groups syntax-unknown-name speaks.
    if (own == noCode || (ctx.dialect().codes[own].group != noGroup && !ctx.asked()))
      return;
    if (auto finding = ctx.report(where))
      finding.message("`{0}` is a word of the control itself ({1}): no variable can have its name",
                      name, ctx.dialect().codes[own].title);
  }

  /// `L<TRANS>` where the project has a program of that name as well.
  static void library(const Event &event, RuleContext &ctx) {
    const llvm::StringRef name = llvm::StringRef(ctx.code(event).name).split('<').second.rtrim('>');
    if (name.empty() || !ctx.index().reader().isHidden(name))
      return;
    if (auto finding = ctx.report(event))
      finding.message(
          "`{0}` is a program of the control, and the project has one of the same name: "
          "the one hides the other",
          ctx.text(*event.word));
  }

  /// Programs with names: one that is called like a word or a cycle of the control.
  static void named(const FileSummary &file, RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const ProgramInfo &program = file.index.programs().front();
    std::string name = program.name;
    SourceRange where{file.source.id(), program.headerBegin, program.headerEnd};
    if (!program.hasHeader()) {
      const std::string shown = file.source.display();
      name = llvm::StringRef(shown).substr(shown.rfind('/') + 1).split('.').first.upper();
      for (const Block &block : blocks(file.reader, program.begin, program.end)) {
        where = {file.source.id(), block.begin, block.end};
        if (!block.isEmpty())
          break;
      }
    }
    // Libraries are called `L<NAME>`, cycles by their name alone.
    const std::string &mark = dialect.lexical.callMark;
    CodeIndex own = mark.empty() ? noCode : dialect.keyword(mark + name);
    if (own == noCode) {
      own = dialect.keyword(name);
      if (own != noCode && dialect.codes[own].action != Action::Cycle)
        own = noCode;
    }
    if (own == noCode)
      return;
    if (auto finding = ctx.report(where))
      finding.message(
          "this program is called `{0}` like what the control has itself: one of the two "
          "hides the other",
          name);
  }

  llvm::ArrayRef<int> reserved_;
};

} // namespace
NCVET_RULE(ProgramNameReserved, program_name_reserved)
} // namespace ncvet
