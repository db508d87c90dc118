// What a growing selection takes in, from the word under the cursor to the file.
#include "lsp/features/navigation/selection.h"

#include <algorithm>

namespace ncvet::lsp {

namespace {

struct Span {
  uint32_t begin, end;
  uint32_t size() const { return end - begin; }
};

/// Words, items and comments of the block that hold `offset`, and the block itself.
void insideBlock(Snapshot &snapshot, uint32_t offset, std::vector<Span> &spans) {
  if (const Occurrence *name = snapshot.names().at(offset))
    if (name->begin <= offset)
      spans.push_back({name->begin, name->end});
  Block block;
  snapshot.readAt(offset, block);
  for (const Word &word : block.words)
    spans.push_back({word.offset, block.endOf(word)});
  for (const Item &item : block.items)
    spans.push_back({item.begin, item.end});
  for (const Expression &expression : block.expressions)
    spans.push_back({expression.begin, expression.end});
  for (const Argument &argument : block.arguments)
    spans.push_back({argument.begin, argument.end});
  for (const Comment &comment : block.comments)
    spans.push_back({comment.begin, comment.end});
  if (block.numberEnd > block.numberBegin)
    spans.push_back({block.numberBegin, block.numberEnd});
  const llvm::StringRef text = snapshot.text().slice(block.begin, block.end);
  const auto blanks = uint32_t(text.size() - text.ltrim().size());
  spans.push_back({block.begin + blanks, block.begin + uint32_t(text.rtrim().size())});
}

} // namespace

std::vector<std::vector<SourceRange>> selections(Snapshot &snapshot,
                                                 llvm::ArrayRef<uint32_t> offsets) {
  std::vector<Part> parts = partsOf(snapshot);
  const std::vector<Part> structures = structuresOf(snapshot);
  parts.insert(parts.end(), structures.begin(), structures.end());
  std::vector<std::vector<SourceRange>> all;
  for (const uint32_t offset : offsets) {
    std::vector<Span> spans;
    insideBlock(snapshot, offset, spans);
    for (const Part &part : parts)
      spans.push_back({part.begin, part.end});
    spans.push_back({0, uint32_t(snapshot.text().size())});
    llvm::erase_if(spans, [&](const Span &span) {
      return span.begin >= span.end || offset < span.begin || offset > span.end;
    });
    std::stable_sort(spans.begin(), spans.end(),
                     [](const Span &a, const Span &b) { return a.size() < b.size(); });
    std::vector<SourceRange> &chain = all.emplace_back();
    for (const Span &span : spans)
      if (chain.empty() || (span.begin <= chain.back().begin && chain.back().end <= span.end &&
                            span.size() > chain.back().end - chain.back().begin))
        chain.push_back({snapshot.source().id(), span.begin, span.end});
    if (chain.empty())
      chain.push_back({snapshot.source().id(), 0, uint32_t(snapshot.text().size())});
  }
  return all;
}

} // namespace ncvet::lsp
