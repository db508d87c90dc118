// Incremental index of a text: line starts, block numbers, labels, definitions.
#pragma once

#include "analyzer/program/text_piece.h"

#include <map>
#include <optional>
#include <vector>

namespace ncvet {

/// A block with a number.
struct NumberedBlock {
  int64_t number = 0;
  uint32_t offset = 0;
};

/// Each question is answered by one look at the whole text; after a change only the lines that it
/// touches are looked at again. Belongs to one thread.
class FileScan {
public:
  /// Lines of the text whose first byte of content is one of `marks`, in either case, ascending.
  const std::vector<uint32_t> &heads(const SourceFile &source, llvm::StringRef marks);
  /// Lines that begin with a number of a block, ascending by offset.
  const std::vector<NumberedBlock> &numbers(const SourceFile &source);
  /// Places of byte `c`, ascending; null: there are more than can be kept.
  const std::vector<uint32_t> *places(const SourceFile &source, char c);
  /// Calls `visit` for the pieces of [begin, end), which begins with a block, in their order, until
  /// it says false.
  void eachPiece(const PieceReader &reader, uint32_t begin, uint32_t end,
                 llvm::function_ref<bool(const TextPiece &)> visit);
  /// The piece of [begin, end) that begins with the block at `begin`; it holds until the next call.
  const TextPiece &pieceAt(const PieceReader &reader, uint32_t begin, uint32_t end);
  /// The text has become that of `after`.
  void edit(const TextChange &change, const SourceFile &after);
  void clear();

private:
  std::optional<std::vector<uint32_t>> heads_;
  std::optional<std::vector<NumberedBlock>> numbers_;
  std::map<char, std::vector<uint32_t>> places_;
  RunStore<TextPiece> pieces_;
  std::string marks_;
  bool lineFeeds_ = true; ///< how lines end, see `eachLine`
};

} // namespace ncvet
