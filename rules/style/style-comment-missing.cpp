// A program number without a comment that names the program, or a comment of the wrong kind.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class StyleCommentMissing final : public Rule {
public:
  void listen(Subscriptions &to) override {
    named_ = to.dialect().limits.nameLength != 0;
    if (to.dialect().facts->text.kindsOfComments)
      to.onChange({EventKind::Block});
  }

  /// A comment that the operator sees, in a block that works.
  void on(const Event &, RuleContext &ctx) const override {
    const Block &block = ctx.block();
    const auto shown = llvm::find_if(block.comments, [](const Comment &c) { return c.shown; });
    if (shown == block.comments.end() || !block.hasAny(ctx.dialect().axisWords))
      return;
    const SourceRange range = ctx.range(*shown);
    if (auto finding = ctx.report(range))
      finding.message("`{0}` is shown to the operator while the block runs: write a remark for "
                      "the programmer in braces",
                      ctx.source().displayText(ctx.text(range)));
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (named_) // the control's list shows the name
      return;
    Block block;
    for (const ProgramInfo &program : file.index.programs()) {
      if (!program.hasHeader())
        continue;
      file.reader.read(program.begin, block);
      if (!block.comments.empty())
        continue;
      if (auto finding =
              ctx.report(SourceRange{file.source.id(), program.headerBegin, program.headerEnd}))
        finding.text("no comment names the program: the control's list shows its number alone");
    }
  }

private:
  bool named_ = false; ///< programs have names, not numbers
};

} // namespace
NCVET_RULE(StyleCommentMissing, style_comment_missing)
} // namespace ncvet
