// What the blocks of a piece of a text hold.
#include "analyzer/program/text_piece.h"

#include "formats/readers/table_words.h"

#include "llvm/ADT/STLExtras.h"

#include <cmath>

namespace ncvet {

namespace {

/// Blocks of a piece whose names are kept together.
constexpr uint64_t pieceBlocks = 512;
/// After so many plain blocks the next one that is not begins a piece of its own, and so many end
/// such a piece: who looks for them reads little else.
constexpr uint64_t plainBlocks = 32;

bool holdsNothing(const Block &block) { return block.isEmpty() && block.number < 0; }

/// See `TextPiece::isPlain`.
bool isPlain(const Block &block) {
  constexpr AddressMask control = maskOf('M') | maskOf(keywordAddress);
  if (holdsNothing(block))
    return block.kind == BlockKind::Empty;
  return block.kind == BlockKind::Normal && block.items.empty() && !block.hasAny(control) &&
         block.number < 0 && !block.hasLabel() && !block.words.empty();
}

bool isWhole(const Word &word) {
  return word.decimals == 0 ||
         (word.mantissa % 10 == 0 && word.value() == std::floor(word.value()));
}

TextPiece::Points &pointsOf(TextPiece &piece, AddressId address) {
  for (TextPiece::Points &known : piece.points)
    if (known.address == address)
      return known;
  return piece.points.emplace_back(TextPiece::Points{address});
}

} // namespace

bool TextPiece::mayName(const Dialect &dialect, llvm::ArrayRef<Action> actions) const {
  return llvm::any_of(codes, [&](CodeIndex code) {
    return llvm::is_contained(actions, dialect.codes[code].action);
  });
}

void TextPiece::move(const TextChange &change) {
  RunPlace::move(change);
  for (auto &[key, block] : labels)
    block = change.moved(block);
  for (auto &[name, defined] : definitions) {
    defined.begin = change.moved(defined.begin);
    defined.end = change.moved(defined.end);
  }
}

TextPiece PieceReader::read(uint32_t begin, uint32_t stop) const {
  TextPiece piece;
  piece.begin = piece.end = begin;
  Block block;
  uint64_t plain = 0; // in a row
  for (uint64_t read = 0; piece.end < stop && read < pieceBlocks; ++read) {
    reader_.read(piece.end, block);
    if (isPlain(block)) {
      if (++plain > plainBlocks && !piece.isPlain)
        break;
    } else {
      if (plain > plainBlocks)
        break;
      plain = 0;
      piece.isPlain = false;
    }
    look(piece, block);
    piece.end = block.next;
  }
  return piece;
}

void PieceReader::look(TextPiece &piece, const Block &block) const {
  piece.blocks += !holdsNothing(block);
  if (block.hasLabel())
    piece.labels.emplace_back(reader_.labelKey(source_.text(block.labelBegin, block.labelEnd)),
                              piece.end);
  lookAtWords(piece, block);
  lookAtItems(piece, block);
}

void PieceReader::lookAtWords(TextPiece &piece, const Block &block) const {
  constexpr AddressMask codes = maskOf('G') | maskOf('M') | maskOf(keywordAddress);
  piece.addresses |= block.addresses;
  if (block.hasAny(codes))
    for (const Word &word : block.words)
      if (const CodeIndex code = codeOf(dialect_, word);
          code != noCode && !llvm::is_contained(piece.codes, code))
        piece.codes.push_back(code);
  if (!(block.pointed | block.pointless))
    return;
  for (const Word &word : block.words) {
    if (!word.isNumber())
      continue;
    if (word.has(wordPoint) && isWhole(word))
      ++pointsOf(piece, word.address).with;
    else if (!word.has(wordPoint) && word.mantissa)
      ++pointsOf(piece, word.address).without;
  }
}

void PieceReader::lookAtItems(TextPiece &piece, const Block &block) const {
  for (const Item &item : block.items) {
    if (item.kind != ItemKind::Definition && item.kind != ItemKind::Declaration &&
        item.kind != ItemKind::Parameters && item.kind != ItemKind::Macro)
      continue;
    piece.definitions.emplace_back(
        source_.text(item.nameBegin, item.nameEnd).upper(),
        Defined{item.kind, item.type, item.arguments != 0, item.nameBegin, item.nameEnd});
    if (item.kind == ItemKind::Parameters)
      for (const Argument &parameter : block.argumentsOf(item))
        piece.definitions.emplace_back(
            source_.text(parameter.begin, parameter.end).upper(),
            Defined{ItemKind::Definition, parameter.type, false, parameter.begin, parameter.end});
  }
}

} // namespace ncvet
