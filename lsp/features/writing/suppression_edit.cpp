// Comments that silence a rule: which form the control reads as a comment, and where it is allowed.
#include "lsp/features/writing/suppression_edit.h"

namespace ncvet::lsp {

namespace {

/// `text` as a comment that the reader takes for a block without content; empty: no form is one.
std::string asComment(const Dialect &dialect, llvm::StringRef text) {
  for (const auto &[open, close] : {std::pair("(", ")"), std::pair("; ", ""), std::pair("'", ""),
                                    std::pair("{", "}"), std::pair("\" ", "")}) {
    const std::string line = open + text.str() + close;
    const auto reader = makeReader(dialect, line);
    Block block;
    reader->read(reader->first(), block);
    if (block.comments.size() == 1 && block.isEmpty() && block.issues.empty() &&
        block.comments[0].begin == 0 && block.next >= line.size())
      return line;
  }
  return {};
}

llvm::StringRef lineEndOf(llvm::StringRef text) {
  const size_t end = text.find_first_of("\r\n");
  if (end == llvm::StringRef::npos || text[end] == '\n')
    return "\n";
  return text.substr(end, 2) == "\r\n" ? "\r\n" : "\r";
}

/// A comment as a line of its own before the block that begins at `block`.
std::optional<TextEdit> lineBefore(Snapshot &snapshot, uint32_t block, llvm::StringRef comment) {
  const std::string line = asComment(snapshot.dialect(), comment);
  if (line.empty())
    return std::nullopt;
  const SourceFile &source = snapshot.source();
  uint32_t at = source.lines().lineBegin(block);
  if (at < source.textBegin())
    at = source.textBegin();
  return TextEdit{{source.id(), at, at}, line + lineEndOf(source.text()).str()};
}

} // namespace

std::optional<TextEdit> allowHere(Snapshot &snapshot, uint32_t offset, llvm::StringRef rule) {
  Block block;
  snapshot.readAt(offset, block);
  return lineBefore(snapshot, block.begin, ("ncvet: allow " + rule).str());
}

std::optional<TextEdit> allowInFile(Snapshot &snapshot, llvm::StringRef rule) {
  const FileIndex &index = snapshot.unit().index;
  const ProgramInfo &first = index.programs().front();
  // After the head: some controls allow nothing before it.
  Block block;
  snapshot.readAt(first.begin, block);
  while ((block.kind == BlockKind::Tape || block.kind == BlockKind::ProgramHeader) &&
         block.next < snapshot.text().size())
    snapshot.unit().reader->read(block.next, block);
  return lineBefore(snapshot, block.begin, ("ncvet: allow-file " + rule).str());
}

} // namespace ncvet::lsp
