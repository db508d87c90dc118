// A comment that is nothing but a code word, and therefore does nothing.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

/// "M00" of "(M00)"; empty when the comment holds anything else.
llvm::StringRef codeIn(llvm::StringRef comment) {
  const llvm::StringRef inner = comment.drop_front().drop_back().trim(' ');
  if (inner.size() < 2 || inner.size() > 6 || (inner[0] != 'G' && inner[0] != 'M'))
    return {};
  unsigned digits = 0;
  for (const char c : inner.drop_front()) {
    if (!llvm::isDigit(c) && c != '.')
      return {};
    digits += llvm::isDigit(c);
  }
  return digits && digits <= 4 ? inner : llvm::StringRef();
}

class SyntaxCodeInComment final : public Rule {
public:
  void listen(Subscriptions &) override {}

  void finish(const FileSummary &file, RuleContext &ctx) override {
    // Comments of this kind are rare: looking for them in the text spares every block a test.
    file.source.eachPlaceOf('(', [&](uint32_t open) { look(file, open, ctx); });
  }

private:
  void look(const FileSummary &file, uint32_t open, RuleContext &ctx) {
    constexpr size_t longest = 9;
    const llvm::StringRef text = file.source.text().substr(open, longest);
    const size_t close = text.find(')');
    if (close == llvm::StringRef::npos)
      return;
    const llvm::StringRef code = codeIn(text.take_front(close + 1));
    if (code.empty())
      return;
    const uint32_t end = open + uint32_t(close) + 1;
    file.reader.read(file.source.lines().lineBegin(open), block_);
    // Alone in its line it is a code that somebody switched off; beside words it is a slip.
    if (block_.isEmpty() || llvm::none_of(block_.comments, [&](const Comment &c) {
          return c.begin == open && c.end == end;
        }))
      return;
    if (auto finding = ctx.report(SourceRange{file.source.id(), open, end}))
      finding.message("`{0}` stands in a comment: the control does not execute it", code);
  }

  Block block_;
};

} // namespace
NCVET_RULE(SyntaxCodeInComment, syntax_code_in_comment)
} // namespace ncvet
