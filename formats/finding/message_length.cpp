// How much of a program a message quotes.
#include "formats/finding/message_length.h"

namespace ncvet {

namespace {

constexpr llvm::StringLiteral points = "...";
/// Bytes of a message: several quotations and what is said of them. A program that holds backticks
/// could make the parts look short.
constexpr size_t mostBytes = 1000;

/// A byte that begins a character.
bool isBegin(char c) { return (uint8_t(c) & 0xC0) != 0x80; }

/// Bytes of the first `most` characters.
size_t bytesOf(llvm::StringRef text, size_t most) {
  constexpr size_t widest = 4; // bytes of a character
  size_t at = 0;
  for (size_t seen = 0; at < text.size() && at < most * widest; ++at)
    if (isBegin(text[at]) && ++seen > most)
      break;
  return at;
}

void append(llvm::StringRef quoted, std::string &to) {
  if (bytesOf(quoted, mostQuoted) == quoted.size()) {
    to += quoted;
    return;
  }
  to += quoted.take_front(bytesOf(quoted, mostQuoted - points.size()));
  to += points;
}

} // namespace

std::string withShortQuotes(std::string message) {
  if (message.size() <= mostQuoted)
    return message;
  std::string shown;
  llvm::StringRef rest = message;
  while (!rest.empty() && shown.size() <= mostBytes) {
    const size_t open = rest.find('`');
    const size_t close = rest.find('`', open == llvm::StringRef::npos ? open : open + 1);
    if (close == llvm::StringRef::npos) {
      shown += rest;
      break;
    }
    shown += rest.take_front(open + 1);
    append(rest.slice(open + 1, close), shown);
    shown += '`';
    rest = rest.drop_front(close + 1);
  }
  if (shown.size() > mostBytes) {
    size_t end = mostBytes;
    while (end > 0 && !isBegin(shown[end]))
      --end;
    shown.resize(end);
    shown += points;
  }
  return shown;
}

void shortenQuotes(Finding &finding) {
  finding.message = withShortQuotes(std::move(finding.message));
  for (Note &note : finding.notes)
    note.message = withShortQuotes(std::move(note.message));
  if (finding.fix)
    finding.fix->description = withShortQuotes(std::move(finding.fix->description));
}

} // namespace ncvet
