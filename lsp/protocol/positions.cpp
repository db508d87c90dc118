// Positions of the protocol, counted in UTF-8, UTF-16 or UTF-32 units.
#include "lsp/protocol/positions.h"

#include <algorithm>

namespace ncvet::lsp {

std::optional<PositionEncoding> parsePositionEncoding(llvm::StringRef name) {
  for (const PositionEncoding encoding :
       {PositionEncoding::Utf8, PositionEncoding::Utf16, PositionEncoding::Utf32})
    if (name == toString(encoding))
      return encoding;
  return std::nullopt;
}

llvm::StringRef toString(PositionEncoding encoding) {
  switch (encoding) {
  case PositionEncoding::Utf8:
    return "utf-8";
  case PositionEncoding::Utf16:
    return "utf-16";
  case PositionEncoding::Utf32:
    return "utf-32";
  }
  return {};
}

uint32_t Positions::units(llvm::StringRef bytes) const {
  if (isAscii(bytes))
    return uint32_t(bytes.size());
  const Encoding text = source_.encoding();
  if (encoding_ == PositionEncoding::Utf8)
    return text == Encoding::Utf8 ? uint32_t(bytes.size())
                                  : uint32_t(source_.displayText(bytes).size());
  uint32_t count = countCodePoints(bytes, text);
  // Characters outside of the first plane, four bytes of UTF-8 each, are pairs in UTF-16.
  if (encoding_ == PositionEncoding::Utf16 && text == Encoding::Utf8)
    count += uint32_t(std::count_if(bytes.begin(), bytes.end(),
                                    [](char c) { return static_cast<uint8_t>(c) >= 0xF0; }));
  return count;
}

Position Positions::at(uint32_t offset) {
  offset = std::min<uint32_t>(offset, uint32_t(source_.text().size()));
  const LineIndex &lines = source_.lines();
  const uint32_t begin = lines.lineBegin(offset);
  if (begin != lineBegin_ || offset < lastOffset_) {
    line_ = lines.lineOf(offset) - 1;
    lineBegin_ = lastOffset_ = begin;
    lastCharacter_ = 0;
  }
  lastCharacter_ += units(source_.text(lastOffset_, offset));
  lastOffset_ = offset;
  return {line_, lastCharacter_};
}

uint32_t Positions::offset(Position position) {
  const LineIndex &lines = source_.lines();
  if (position.line >= source_.text().size()) // no text has more lines than bytes
    return uint32_t(source_.text().size());
  const uint32_t begin = lines.beginOfLine(position.line + 1);
  const llvm::StringRef line = source_.text(begin, lines.lineEnd(begin));
  if (position.character >= line.size() && encoding_ == PositionEncoding::Utf8 &&
      source_.encoding() == Encoding::Utf8)
    return begin + uint32_t(line.size());
  const llvm::StringRef ascii = line.take_front(position.character);
  if (isAscii(ascii))
    return begin + uint32_t(ascii.size());
  const Encoding text = source_.encoding();
  uint32_t at = 0, character = 0;
  while (at < line.size()) {
    const uint32_t length = codePointLength(line.drop_front(at), text);
    const uint32_t width = units(line.substr(at, length));
    if (character + width > position.character)
      break;
    character += width;
    at += length;
  }
  return begin + at;
}

} // namespace ncvet::lsp
