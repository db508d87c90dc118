// A program number without a comment that names the program.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class StyleCommentMissing final : public Rule {
public:
  void listen(Subscriptions &to) override { named_ = to.dialect().limits.nameLength != 0; }

  void finish(const FileSummary &file, RuleContext &ctx) override {
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
