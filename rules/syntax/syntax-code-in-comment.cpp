// A comment that is nothing but a code word, and therefore does nothing.
#include "analyzer/facts/lookahead.h"

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

/// `T12 M6 (M5)`, `G84 Z-12. (M8)`: the size of a thread, beside the tool that cuts it.
bool isThread(llvm::StringRef code, const Dialect &dialect, const Block &block) {
  if (code[0] != 'M' || code[1] == '0')
    return false;
  return block.has(letterAddress('T')) || findReading(dialect, block, [](const CodeInfo &info) {
           return info.action == Action::ToolChange || taps(info.cycle);
         });
}

/// True for words of one letter and a number and nothing else.
bool isWords(llvm::StringRef text) {
  text = text.trim(" \t\r");
  if (text.empty())
    return false;
  while (!text.empty()) {
    if (!llvm::isAlpha(text[0]))
      return false;
    const llvm::StringRef number = text.drop_front().take_while(
        [](char c) { return llvm::isDigit(c) || c == '.' || c == '-'; });
    if (number.find_first_of("0123456789") == llvm::StringRef::npos)
      return false;
    text = text.drop_front(1 + number.size()).ltrim(" \t");
  }
  return true;
}

class SyntaxCodeInComment final : public Rule {
public:
  void listen(Subscriptions &) override {}

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    // Comments of this kind are rare: looking for them in the text spares every block a test.
    file.index.eachPlaceOf('(', [&](uint32_t open) { look(file, open, ctx); });
    const llvm::StringRef text = file.source.text();
    size_t lineEnd = 0;
    unsigned marks = 0; // in the line so far, which may be long
    file.index.eachPlaceOf('"', [&](uint32_t open) {
      if (open >= lineEnd) {
        lineEnd = std::min(text.find_first_of("\r\n", open), text.size());
        marks = 0;
      }
      if (++marks == 2)
        lookAfterSecondMark(file, open, ctx);
    });
  }

private:
  /// `" text " M3 S600`: the second mark of a comment that runs to the end of its line.
  void lookAfterSecondMark(const FileSummary &file, uint32_t open, RuleContext &ctx) const {
    const uint32_t begin = file.source.lines().lineBegin(open);
    const llvm::StringRef line =
        file.source.text().substr(begin).take_until([](char c) { return c == '\n' || c == '\r'; });
    const size_t second = open - begin;
    const size_t first = line.find('"');
    if (first == second || line.find('"', first + 1) != second ||
        !isWords(line.drop_front(second + 1)))
      return;
    Block block;
    file.reader.read(begin, block);
    if (llvm::none_of(block.comments, [&](const Comment &c) { return c.begin == begin + first; }))
      return;
    const size_t words = line.find_first_not_of(" \t", second + 1);
    const uint32_t from = begin + uint32_t(words);
    const SourceRange range{file.source.id(), from,
                            from + uint32_t(line.substr(words).rtrim().size())};
    if (auto finding = ctx.report(range))
      finding.message("`{0}` is in a comment that runs to the end of its line: the control does "
                      "not execute it",
                      ctx.text(range));
  }

  void look(const FileSummary &file, uint32_t open, RuleContext &ctx) const {
    constexpr size_t longest = 9;
    const llvm::StringRef text = file.source.text().substr(open, longest);
    const size_t close = text.find(')');
    if (close == llvm::StringRef::npos)
      return;
    const llvm::StringRef code = codeIn(text.take_front(close + 1));
    if (code.empty())
      return;
    const uint32_t end = open + uint32_t(close) + 1;
    Block block;
    file.reader.read(file.source.lines().lineBegin(open), block);
    // Alone in its line it is a code that somebody switched off; beside words it is a slip.
    // After an assignment it names a point or a step, as `(P1)` in the line before.
    if (block.isEmpty() || (block.words.empty() && !block.items.empty()) ||
        llvm::none_of(block.comments,
                      [&](const Comment &c) { return c.begin == open && c.end == end; }) ||
        isThread(code, ctx.dialect(), block))
      return;
    if (auto finding = ctx.report(SourceRange{file.source.id(), open, end}))
      finding.message("`{0}` is in a comment: the control does not execute it", code);
  }
};

} // namespace
NCVET_RULE(SyntaxCodeInComment, syntax_code_in_comment)
} // namespace ncvet
