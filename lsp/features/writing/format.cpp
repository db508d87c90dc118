// Formatting: edits are made block by block, and each is kept only if the block reads as before.
#include "lsp/features/writing/format.h"

#include "lsp/features/same_block.h"

namespace ncvet::lsp {

namespace {

bool isBlank(char c) { return c == ' ' || c == '\t'; }
bool isLineEnd(char c) { return c == '\n' || c == '\r'; }

/// Makes the edits of one block after the other.
class BlockFormatter {
public:
  BlockFormatter(llvm::StringRef text, FileId file, const FormatOptions &options)
      : text_(text), file_(file), options_(options) {}

  /// The edits of `block`, ascending; valid up to the next call.
  llvm::ArrayRef<TextEdit> format(const Block &block) {
    edits_.clear();
    if (!block.issues.empty())
      return edits_;
    collect(block);
    if (options_.words != WordSpacing::Keep)
      space();
    if (options_.trim)
      trim(block);
    return edits_;
  }

private:
  struct Piece {
    uint32_t begin, end;
    bool comment = false;
  };

  void piece(uint32_t begin, uint32_t end, bool comment = false) {
    while (!comment && begin < end && isBlank(text_[end - 1]))
      --end;
    if (begin < end)
      pieces_.push_back({begin, end, comment});
  }

  /// What must not be torn apart, in order; pieces in each other are one.
  void collect(const Block &block) {
    pieces_.clear();
    piece(block.numberBegin, block.numberEnd);
    piece(block.headerBegin, block.headerEnd);
    if (block.hasLabel())
      piece(block.labelBegin, block.labelEnd);
    for (const Word &word : block.words)
      piece(word.offset, block.endOf(word));
    for (const Item &item : block.items)
      piece(item.begin, item.end);
    for (const Comment &comment : block.comments)
      piece(comment.begin, comment.end, true);
    llvm::sort(pieces_, [](const Piece &a, const Piece &b) {
      return a.begin < b.begin || (a.begin == b.begin && a.end > b.end);
    });
    size_t kept = 0;
    for (const Piece &next : pieces_) {
      if (kept && next.begin < pieces_[kept - 1].end)
        pieces_[kept - 1].end = std::max(pieces_[kept - 1].end, next.end);
      else
        pieces_[kept++] = next;
    }
    pieces_.resize(kept);
  }

  /// One edit from the first gap that changes to the last one.
  void space() {
    const llvm::StringRef gap = options_.words == WordSpacing::One ? " " : "";
    uint32_t begin = 0, done = 0;
    std::string text;
    for (size_t i = 1; i < pieces_.size(); ++i) {
      const Piece &left = pieces_[i - 1], &right = pieces_[i];
      const llvm::StringRef between = text_.slice(left.end, right.begin);
      if (left.comment || right.comment || between == gap || !llvm::all_of(between, isBlank))
        continue;
      if (!done)
        begin = done = left.end;
      text += text_.slice(done, left.end);
      text += gap;
      done = right.begin;
    }
    if (done)
      edits_.push_back({{file_, begin, done}, std::move(text)});
  }

  void trim(const Block &block) {
    const auto end = std::min<uint32_t>(std::max(block.next, block.end), uint32_t(text_.size()));
    size_t piece = 0;
    for (uint32_t at = block.begin; at < end;) {
      const auto lineEnd = std::min<uint32_t>(
          uint32_t(std::min(text_.find_first_of("\r\n", at), text_.size())), end);
      // A block may end within a line; what follows is not its own.
      const bool endsHere = lineEnd == text_.size() || isLineEnd(text_[lineEnd]);
      uint32_t last = lineEnd;
      while (last > at && isBlank(text_[last - 1]))
        --last;
      while (piece < pieces_.size() && pieces_[piece].end <= last)
        ++piece;
      const bool held = piece < pieces_.size() && pieces_[piece].begin < lineEnd;
      if (endsHere && last < lineEnd && !held)
        edits_.push_back({{file_, last, lineEnd}, ""});
      at = lineEnd + 1;
    }
  }

  const llvm::StringRef text_;
  const FileId file_;
  const FormatOptions options_;
  std::vector<Piece> pieces_;
  std::vector<TextEdit> edits_;
};

/// A block that formatting changes.
struct ChangedBlock {
  uint32_t at;       ///< in the text
  uint32_t in;       ///< in the formatted text
  size_t begin, end; ///< its edits
};

/// Blocks with all their edits, before it is known which of these are kept.
struct Formatted {
  std::string text; ///< from the first block that changes
  std::vector<TextEdit> edits;
  std::vector<ChangedBlock> changed;
};

/// Formats the blocks that begin at the offsets of `blocks`, which end before `end`.
Formatted formatBlocks(Snapshot &snapshot, llvm::ArrayRef<uint32_t> blocks, uint32_t end,
                       const FormatOptions &options) {
  const llvm::StringRef text = snapshot.text();
  BlockFormatter formatter(text, snapshot.source().id(), options);
  Formatted all;
  Block block;
  uint32_t done = blocks.empty() ? 0 : blocks.front();
  const auto copyUpTo = [&](uint32_t to) {
    if (to > done)
      all.text += text.slice(done, to);
    done = std::max(done, to);
  };
  for (const uint32_t at : blocks) {
    snapshot.unit().reader->read(at, block);
    const llvm::ArrayRef<TextEdit> own = formatter.format(block);
    if (own.empty())
      continue;
    copyUpTo(at);
    all.changed.push_back(
        {at, uint32_t(all.text.size()), all.edits.size(), all.edits.size() + own.size()});
    for (const TextEdit &edit : own) {
      copyUpTo(edit.range.begin);
      all.text += edit.text;
      done = edit.range.end;
    }
    all.edits.insert(all.edits.end(), own.begin(), own.end());
  }
  if (!all.changed.empty())
    copyUpTo(end);
  return all;
}

/// The edits of blocks that are the same when they are read again, and not too long.
std::vector<TextEdit> soundEdits(Snapshot &snapshot, Formatted all) {
  const Reader &reader = *snapshot.unit().reader;
  const std::unique_ptr<Reader> again = makeReader(snapshot.dialect(), all.text);
  again->setHidesProgram([&](llvm::StringRef name) { return reader.isHidden(name); });
  Block block, fresh;
  std::vector<TextEdit> kept;
  for (const ChangedBlock &one : all.changed) {
    reader.read(one.at, block);
    again->read(one.in, fresh);
    size_t longer = 0, shorter = 0; // bytes that its edits put in and took away
    for (size_t i = one.begin; i < one.end; ++i) {
      longer += all.edits[i].text.size();
      shorter += all.edits[i].range.end - all.edits[i].range.begin;
    }
    const uint16_t limit = snapshot.dialect().limits.blockLength;
    const uint32_t length = fresh.end - fresh.begin;
    const bool tooLong = limit && length > limit && length > block.end - block.begin;
    if (!tooLong && fresh.next - one.in + shorter == block.next - one.at + longer &&
        sameBlock(block, snapshot.text(), fresh, all.text))
      for (size_t i = one.begin; i < one.end; ++i)
        kept.push_back(std::move(all.edits[i]));
  }
  return kept;
}

} // namespace

std::vector<TextEdit> formatEdits(Snapshot &snapshot, uint32_t begin, uint32_t end,
                                  const FormatOptions &options) {
  const llvm::ArrayRef<uint32_t> blocks = snapshot.blocks();
  auto first = std::upper_bound(blocks.begin(), blocks.end(), begin);
  if (first != blocks.begin())
    --first;
  const auto last = std::lower_bound(first, blocks.end(), std::max(end, begin + 1));
  const uint32_t past = last == blocks.end() ? uint32_t(snapshot.text().size()) : *last;
  return soundEdits(snapshot,
                    formatBlocks(snapshot, llvm::makeArrayRef(first, last), past, options));
}

} // namespace ncvet::lsp
