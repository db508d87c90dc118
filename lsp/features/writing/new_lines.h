// Blocks that rewritings put in the place of others, one to a line.
#pragma once

#include "lsp/features/writing/selection.h"

namespace ncvet::lsp {

/// Lines of a text with so many blocks: nobody reads more.
constexpr size_t mostNewBlocks = 2000;

/// The text of a block without its number and its label.
std::string bareText(llvm::StringRef text, const Block &block);
/// The line end that the text uses.
llvm::StringRef lineEndOf(llvm::StringRef text);

/// Lines that take the place of selected blocks, in their order.
class NewLines {
public:
  explicit NewLines(Selection &selection) : selection_(selection) {}

  /// A block without a number. It gets one where the control wants one in every block.
  void add(std::string bare);
  /// A block as it is written in the text.
  void keep(const Block &block);
  /// Comments and empty lines, [begin, end) of the text, with their line ends.
  void keepText(uint32_t begin, uint32_t end);

  size_t blocks() const { return blocks_; }
  /// All lines, the last one without a line end. Where every block has a number, new ones between
  /// that of the first selected block and the one that comes after the selection; `refused` says
  /// that there are not enough.
  std::string text(std::string &refused) const;

private:
  struct Line {
    std::string bare;  ///< without its number
    std::string whole; ///< as it is in the text; empty: the block is new
    bool isBlock = true;
  };
  bool findNumbers(int64_t &first, int64_t &step) const;

  Selection &selection_;
  std::vector<Line> lines_;
  size_t blocks_ = 0;
};

} // namespace ncvet::lsp
