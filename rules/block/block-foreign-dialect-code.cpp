// A code or word that is used as another control reads it.
#include "analyzer/facts/foreign_block.h"
#include "analyzer/facts/foreign_condition.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class BlockForeignDialectCode final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onNotices(id);
    if (to.dialect().polarWords & maskOf(letterAddress('O')))
      to.on(EventKind::WordIssue);
    lineLengths_ = llvm::any_of(to.dialect().addresses,
                                [](const AddressInfo &address) { return address.lineLength; });
    if (lineLengths_)
      to.on(EventKind::WordIssue);
    isoSigns_ = to.dialect().facts->text.isoSignsForeign;
    carried_ = to.flag("tapeMarksCarried");
    variantNames_ = to.dialect().facts->text.variantNames;
    if (isoSigns_)
      to.on({EventKind::WordIssue, EventKind::Syntax, EventKind::Statement});
    if (variantNames_)
      to.on(EventKind::Syntax);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code) {
      if (!isSignal(ctx.code(event), ctx))
        ctx.reportNotices(id, event);
      if (!asksNumbers(ctx.code(event), id))
        sleepInShape();
      return;
    }
    if (event.kind == EventKind::Statement)
      return condition(ctx.block().items[event.item()], ctx);
    if (event.kind == EventKind::Syntax) {
      const SyntaxIssue &issue = ctx.block().issues[event.issue()];
      const SourceRange range = ctx.range(issue);
      if (variantNames_)
        return variantName(issue, range, ctx);
      if (issue.kind == SyntaxIssueKind::SymbolAsAddress && isIsoSign(ctx.text(range)))
        if (auto finding = ctx.report(range))
          finding.message("`{0}` is a variable of another control: here variables are R1 or have a "
                          "name",
                          ctx.text(range));
      return;
    }
    if (isoSigns_ && event.wordIssue() == WordIssue::Unknown) {
      for (const Word &word : ctx.block().words)
        if (!(ctx.dialect().known & maskOf(word.address)) && isIsoSign(ctx.text(word)))
          if (auto finding = ctx.report(word))
            finding.message("`{0}` is a program's number on another control: here a program is the "
                            "file, and has a name",
                            ctx.text(word));
      return;
    }
    if (event.wordIssue() != WordIssue::Special)
      return;
    if (lineLengths_)
      offsetNumber(ctx);
    programNumber(ctx);
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (isoSigns_ && (!carried_ || ctx.asked()))
      tapeMarks(file, ctx);
  }

private:
  /// `D1` with no direction beside it: no length of a line, but an offset as other controls have.
  static void offsetNumber(RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    if (ctx.block().hasAny(dialect.lineAngleWords))
      return;
    for (const CodeUse &use : ctx.codes()) // a motion that has no use for the word: another rule
      if (const CodeInfo &code = ctx.code(use);
          isMotion(code.action) && code.action == Action::Rapid)
        return;
    for (const Word &word : ctx.block().words)
      if (dialect.addresses[word.address].lineLength)
        if (auto finding = ctx.report(word))
          finding.message("`{0}` is no number of an offset here: a tool has its length and radius "
                          "with its change, and the word is the length of a line beside its "
                          "direction",
                          ctx.text(word));
  }

  /// `G83/R`: the manual's name of a variant.
  static void variantName(const SyntaxIssue &issue, SourceRange range, RuleContext &ctx) {
    if (issue.kind != SyntaxIssueKind::SymbolAsAddress)
      return;
    const llvm::StringRef text = ctx.text(range), code = text.split('/').first;
    if (auto finding = ctx.report(range))
      finding
          .message("`{0}` is the name of a variant in manuals: a program has `{1}`, and the "
                   "parameters choose the variant",
                   text, code)
          .fix(FixSafety::Unsafe, ("write `" + code + "`").str(), ctx.replace(range, code.str()));
  }

  /// `R1==1 && R2==2`, `R1!=1`, `WHILE R1<5 DO`: signs and words of other languages.
  static void condition(const Item &item, RuleContext &ctx) {
    const ForeignSign sign = foreignSignIn(item, ctx.source().text(item.begin, ctx.block().end));
    if (!sign)
      return;
    const auto at = item.begin + uint32_t(sign.at);
    const SourceRange range{ctx.source().id(), at, at + uint32_t(sign.foreign.size())};
    auto finding = ctx.report(range);
    if (!finding)
      return;
    if (sign.own.empty())
      finding
          .message("`{0}` begins the body of a loop in other languages: here it begins with the "
                   "next block",
                   sign.foreign)
          .fix(FixSafety::Unsafe, "delete the word", {{range.file, at - 1, range.end}, ""});
    else
      finding
          .message("`{0}` is a sign of other languages: here it is `{1}`", sign.foreign, sign.own)
          .fix(FixSafety::Unsafe, ("write `" + sign.own + "`").str(), ctx.replace(range, sign.own));
  }

  /// `%` alone: here a program's name and kind follow the sign.
  static void tapeMarks(const FileSummary &file, RuleContext &ctx) {
    Block block;
    for (const uint32_t line : file.index.tapeMarks()) {
      file.reader.read(line, block);
      if (block.kind != BlockKind::Tape)
        continue;
      const auto at = uint32_t(file.source.text().find('%', line));
      // `%_N_INITIAL_INI`: a file of the control that is no program.
      if (file.source.text().drop_front(at).startswith_insensitive("%_N_"))
        continue;
      const SourceRange mark{file.source.id(), at, at + 1};
      if (auto finding = ctx.report(mark))
        finding.severity(Severity::Style)
            .text("`%` alone is the tape mark of another control: here a name and its kind "
                  "follow it (`%_N_PLATE_MPF`)");
    }
  }

  /// `O1000` where O names an element of a contour: no program has a number.
  static void programNumber(RuleContext &ctx) {
    const Word *word = undefinedElement(ctx);
    if (!word || word->address != letterAddress('O'))
      return;
    if (auto finding = ctx.report(*word))
      finding.severity(Severity::Warning)
          .message("`{0}` is a {1} here, and none of this name is defined: programs have no number",
                   ctx.text(*word), ctx.dialect().addresses[word->address].title)
          .fix(FixSafety::Unsafe, "delete the block", ctx.remove(*word));
  }

  bool lineLengths_ = false;  ///< a word is the length of a line by its direction
  bool variantNames_ = false; ///< `G81/3` may be meant for `G81`
  bool carried_ = false;      ///< what sends programs to the control sets tape marks about them
  bool isoSigns_ = false;     ///< `%`, `O1000` and `#1` are another control's here

  static constexpr llvm::StringLiteral id{"block-foreign-dialect-code"};
};

} // namespace
NCVET_RULE(BlockForeignDialectCode, block_foreign_dialect_code)
} // namespace ncvet
