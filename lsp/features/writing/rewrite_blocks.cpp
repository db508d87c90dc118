// Block skip and block numbers of selected blocks.
#include "lsp/features/same_block.h"
#include "lsp/features/writing/renumber.h"
#include "lsp/features/writing/rewritings.h"

namespace ncvet::lsp {

namespace {

/// Whether a block of the text after the edits is the same but for its skip.
bool readsAlike(const Dialect &dialect, const Block &block, llvm::StringRef text,
                llvm::StringRef spelled, int8_t skip) {
  const std::unique_ptr<Reader> reader = makeReader(dialect, spelled);
  Block now, old = block;
  reader->read(0, now);
  old.skip = skip;
  return now.skip == skip && sameBlock(old, text, now, spelled);
}

} // namespace

Rewriting toggleBlockSkip(Selection &selection) {
  const llvm::ArrayRef<Block> blocks = selection.blocks();
  const bool all = llvm::all_of(blocks, [](const Block &block) { return block.skip >= 0; });
  Rewriting result;
  result.title = all ? "Take the block skip away" : "Put a block skip before the selection";
  const llvm::StringRef text = selection.snapshot().text();
  const FileId file = selection.snapshot().source().id();
  for (const Block &block : blocks) {
    if (!all && block.skip >= 0)
      continue;
    const llvm::StringRef own = text.slice(block.begin, block.end);
    const size_t at = own.find_first_not_of(" \t");
    size_t end = at;
    if (all && own[at] == '/') {
      end = at + 1;
      while (end < own.size() && llvm::isDigit(own[end]))
        ++end;
    }
    const std::string mark = all ? "" : "/";
    const std::string spelled = (own.take_front(at) + mark + own.drop_front(end)).str();
    if ((all && end == at) ||
        !readsAlike(selection.dialect(), block, text, spelled, all ? int8_t(-1) : int8_t(0))) {
      result.refused = selection.lineOf(block.begin) + " would be read as something else";
      break;
    }
    const auto from = uint32_t(block.begin + at);
    result.edits.push_back({{file, from, uint32_t(block.begin + end)}, mark});
  }
  if (result.refused.empty() && blocks.empty())
    result.refused = "the selection has no block";
  // With the skip switched off, as it is when a program is followed, nothing changes.
  selection.prove(result);
  if (!result.refused.empty())
    result.edits.clear();
  return result;
}

Rewriting renumberSelection(Selection &selection, int64_t step) {
  Rewriting result;
  result.title = "Renumber the selection";
  NumberOptions options;
  options.step = step;
  options.begin = selection.begin();
  options.end = selection.end();
  const Renumbering numbers = renumber(selection.snapshot(), options);
  result.edits = numbers.edits;
  result.refused = numbers.refusal;
  if (result.refused.empty() && result.edits.empty())
    result.refused = "no block of the selection would get another number";
  selection.prove(result);
  return result;
}

} // namespace ncvet::lsp
