// Positions of the protocol: lines and characters in the unit that client and server agreed on.
#pragma once

#include "formats/text/source.h"

namespace ncvet::lsp {

/// What a `character` counts.
enum class PositionEncoding : uint8_t { Utf8, Utf16, Utf32 };

/// `utf-8`, `utf-16`, `utf-32`; none for anything else.
std::optional<PositionEncoding> parsePositionEncoding(llvm::StringRef name);
llvm::StringRef toString(PositionEncoding encoding);

/// Line and character, both from 0.
struct Position {
  uint32_t line = 0, character = 0;
};

/// Converts places of one text, in both directions. One thread at a time; quick when places are
/// asked for in ascending order, however long a line is.
class Positions {
public:
  Positions(const SourceFile &source, PositionEncoding encoding)
      : source_(source), encoding_(encoding) {}

  Position at(uint32_t offset);
  /// Offset of a position; one after its line's end counts as that end, one after the text as the
  /// text's end, one inside a character as its begin.
  uint32_t offset(Position position);
  const SourceFile &source() const { return source_; }

private:
  /// Units of `bytes`.
  uint32_t units(llvm::StringRef bytes) const;

  const SourceFile &source_;
  PositionEncoding encoding_;
  /// The place that was asked for last.
  uint32_t line_ = 0, lineBegin_ = 0, lastOffset_ = 0, lastCharacter_ = 0;
};

} // namespace ncvet::lsp
