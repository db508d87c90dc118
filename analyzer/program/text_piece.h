// Pieces of a text, and what their blocks hold: who looks for some of it reads few of them.
#pragma once

#include "analyzer/program/span_store.h"
#include "formats/readers/reader.h"
#include "formats/text/source.h"

#include <string>
#include <vector>

namespace ncvet {

/// A name that a program defines for itself.
struct Defined {
  ItemKind kind = ItemKind::Definition; ///< Definition, Parameters, Declaration, Macro
  VariableType type = VariableType::None;
  bool array = false;
  uint32_t begin = 0, end = 0; ///< where its name is
};

/// What the blocks of a piece of the text hold.
struct TextPiece : RunPlace {
  /// Whole numbers of an address: with a point, and other than 0 without one.
  struct Points {
    AddressId address = noAddress;
    uint32_t with = 0, without = 0;
  };

  /// Each block with content holds words only: no number, label, M code or statement.
  bool isPlain = true;
  AddressMask addresses = 0;    ///< of all words
  std::vector<CodeIndex> codes; ///< that they name, each once
  std::vector<Points> points;
  std::vector<std::pair<std::string, uint32_t>> labels;     ///< by key, with their blocks
  std::vector<std::pair<std::string, Defined>> definitions; ///< by name in capitals

  bool hasAny(AddressMask mask) const { return addresses & mask; }
  /// Whether a block may name such a code, see `findCode`.
  bool mayName(const Dialect &dialect, llvm::ArrayRef<Action> actions) const;
  void move(const TextChange &change);
};

/// Makes pieces of a text.
class PieceReader {
public:
  PieceReader(const SourceFile &source, const Reader &reader, const Dialect &dialect)
      : source_(source), reader_(reader), dialect_(dialect) {}

  /// The piece of the blocks from the one at `begin` on; it ends at `stop` or before it.
  TextPiece read(uint32_t begin, uint32_t stop) const;

private:
  void look(TextPiece &piece, const Block &block) const;
  void lookAtWords(TextPiece &piece, const Block &block) const;
  void lookAtItems(TextPiece &piece, const Block &block) const;

  const SourceFile &source_;
  const Reader &reader_;
  const Dialect &dialect_;
};

} // namespace ncvet
