// Code written in lower case.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class StyleLowerCase final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onChange({EventKind::Block}); }

  void on(const Event &, RuleContext &ctx) const override {
    const Block &block = ctx.block();
    if (!block.lowerCase)
      return;
    auto finding = ctx.report(ctx.blockRange());
    if (!finding)
      return;
    finding.text("code in lower case: some controls do not read it");
    // All letters of the block outside of its comments.
    const llvm::StringRef all = ctx.source().text();
    uint32_t at = block.begin;
    bool first = true;
    const auto upper = [&](uint32_t end) {
      if (at >= end)
        return;
      const SourceRange range{ctx.source().id(), at, end};
      const std::string text = all.slice(at, end).upper();
      if (text == all.slice(at, end))
        return;
      if (first)
        finding.fix(FixSafety::Safe, "write capitals", ctx.replace(range, text));
      else
        finding.edit(ctx.replace(range, text));
      first = false;
    };
    for (const Comment &comment : block.comments) {
      upper(comment.begin);
      at = comment.end;
    }
    upper(block.end);
  }
};

} // namespace
NCVET_RULE(StyleLowerCase, style_lower_case)
} // namespace ncvet
