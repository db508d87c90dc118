// What surrounds the cursor: told by the text before it, as the block is not complete yet.
#include "lsp/features/cursor_context.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet::lsp {

namespace {

/// Longer pieces of a block are not looked back over.
constexpr uint32_t mostBytesBack = 1u << 16;

bool isTypedCharacter(char c) { return llvm::isAlnum(c) || c == '_' || c == '$'; }

/// Whether the control writes instructions in angle brackets: its table names such codes.
bool hasAngleInstructions(const Dialect &dialect) {
  return llvm::any_of(dialect.codes, [](const CodeInfo &code) {
    return llvm::StringRef(code.name).startswith("<");
  });
}

llvm::StringRef nameBefore(llvm::StringRef text) {
  text = text.rtrim(" \t");
  size_t begin = text.size();
  while (begin > 0 && isTypedCharacter(text[begin - 1]))
    --begin;
  return text.drop_front(begin);
}

/// Scans the block up to the cursor for brackets.
void findBracket(CursorContext &context, llvm::StringRef text, uint32_t from, bool angles) {
  llvm::SmallVector<CursorContext::Bracket, 4> open;
  bool quoted = false;
  size_t comment = 0;
  const auto &comments = context.block.comments;
  for (uint32_t p = from; p < context.offset; ++p) {
    while (comment < comments.size() && comments[comment].end <= p)
      ++comment;
    if (comment < comments.size() && comments[comment].begin <= p) {
      p = std::min(comments[comment].end, context.offset) - 1;
      continue;
    }
    const char c = text[p];
    if (c == '"')
      quoted = !quoted;
    if (c == '\n' || c == '\r')
      quoted = false;
    if (quoted)
      continue;
    if (c == '(' || c == '[' || (angles && c == '<')) {
      CursorContext::Bracket bracket;
      bracket.at = p;
      bracket.kind = c;
      bracket.argumentBegin = p + 1;
      if (c != '<')
        bracket.name = nameBefore(text.slice(from, p));
      open.push_back(bracket);
    } else if (!open.empty() && (c == ')' || c == ']' || (angles && c == '>'))) {
      open.pop_back();
    } else if (!open.empty() && c == ':' && open.back().kind == '<' && open.back().name.empty()) {
      open.back().name = text.slice(open.back().at + 1, p).trim(" \t");
      open.back().argumentBegin = p + 1;
    } else if (!open.empty() && (c == ',' || c == ';')) {
      ++open.back().argument;
      open.back().argumentBegin = p + 1;
    }
  }
  context.inString = quoted;
  if (!open.empty())
    context.bracket = open.back();
}

} // namespace

CursorContext cursorContext(Snapshot &snapshot, uint32_t offset) {
  CursorContext context;
  const llvm::StringRef text = snapshot.text();
  context.offset = std::min(offset, uint32_t(text.size()));
  snapshot.readAt(context.offset, context.block);
  // After the last line end a new block begins.
  const bool onNewLine =
      context.offset > 0 && (text[context.offset - 1] == '\n' || text[context.offset - 1] == '\r');
  if (onNewLine && context.block.next <= context.offset &&
      !snapshot.dialect().lexical.blocksSpanLines) {
    context.block.clear();
    context.block.begin = context.block.end = context.block.next = context.offset;
  }
  const uint32_t least = context.offset > mostBytesBack ? context.offset - mostBytesBack : 0;
  const uint32_t from = std::min(std::max(context.block.begin, least), context.offset);
  for (const Comment &comment : context.block.comments) {
    const bool closed = comment.end > comment.begin && text[comment.end - 1] == ')';
    context.inComment |=
        comment.begin < context.offset &&
        (context.offset < comment.end || (!closed && context.offset == comment.end));
  }
  context.typedBegin = context.offset;
  while (context.typedBegin > from && isTypedCharacter(text[context.typedBegin - 1]))
    --context.typedBegin;
  context.typed = text.slice(context.typedBegin, context.offset);
  context.before = text.slice(from, context.typedBegin).rtrim(" \t");
  findBracket(context, text, from, hasAngleInstructions(snapshot.dialect()));
  return context;
}

} // namespace ncvet::lsp
