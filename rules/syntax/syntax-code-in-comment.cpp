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
    const llvm::StringRef text = file.source.text();
    Block block;
    for (size_t open = text.find('('); open != llvm::StringRef::npos;
         open = text.find('(', open + 1)) {
      const size_t close = text.find(')', open);
      if (close == llvm::StringRef::npos)
        return;
      if (close - open > 8)
        continue;
      const llvm::StringRef code = codeIn(text.slice(open, close + 1));
      if (code.empty())
        continue;
      file.reader.read(file.source.lines().lineBegin(uint32_t(open)), block);
      // Alone in its line it is a code that somebody switched off; beside words it is a slip.
      if (block.isEmpty() || llvm::none_of(block.comments, [&](const Comment &c) {
            return c.begin == open && c.end == close + 1;
          }))
        continue;
      if (auto finding =
              ctx.report(SourceRange{file.source.id(), uint32_t(open), uint32_t(close + 1)}))
        finding.message("`{0}` stands in a comment: the control does not execute it", code);
    }
  }
};

} // namespace
NCVET_RULE(SyntaxCodeInComment, syntax_code_in_comment)
} // namespace ncvet
