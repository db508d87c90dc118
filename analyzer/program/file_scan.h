// Incremental index of a text: line starts, block numbers, labels, definitions.
#pragma once

#include "analyzer/program/span_store.h"
#include "formats/readers/reader.h"

#include <map>
#include <optional>
#include <vector>

namespace ncvet {

/// A block with a number.
struct NumberedBlock {
  int64_t number = 0;
  uint32_t offset = 0;
};

/// A name that a program defines for itself.
struct Defined {
  ItemKind kind = ItemKind::Definition; ///< Definition, Parameters, Declaration, Macro
  VariableType type = VariableType::None;
  bool array = false;
  uint32_t begin = 0, end = 0; ///< where its name is
};

/// What the blocks of a piece of the text hold.
struct TextPiece : RunPlace {
  /// Each block with content holds words only: no number, label, M code or statement.
  bool isPlain = true;
  std::vector<std::pair<std::string, uint32_t>> labels;     ///< by key, with their blocks
  std::vector<std::pair<std::string, Defined>> definitions; ///< by name in capitals

  void move(const TextChange &change);
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
  void eachPiece(const SourceFile &source, const Reader &reader, uint32_t begin, uint32_t end,
                 llvm::function_ref<bool(const TextPiece &)> visit);
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
