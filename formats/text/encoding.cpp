// Encodings: recognising, counting and decoding the bytes of part programs.
#include "formats/text/encoding.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/ConvertUTF.h"

#include <algorithm>
#include <cstring>

namespace ncvet {

namespace {

constexpr uint32_t replacementCharacter = 0xFFFD;

/// Windows-1252, 0x80 to 0x9F; above that it is Latin-1. Source: Unicode's CP1252.TXT.
constexpr uint16_t windows1252[32] = {
    0x20AC, 0xFFFD, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0xFFFD, 0x017D, 0xFFFD, 0xFFFD, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0xFFFD, 0x017E, 0x0178,
};

/// Windows-1250, 0x80 to 0xFF. Source: Unicode's CP1250.TXT.
constexpr uint16_t windows1250[128] = {
    0x20AC, 0xFFFD, 0x201A, 0xFFFD, 0x201E, 0x2026, 0x2020, 0x2021, 0xFFFD, 0x2030, 0x0160, 0x2039,
    0x015A, 0x0164, 0x017D, 0x0179, 0xFFFD, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
    0xFFFD, 0x2122, 0x0161, 0x203A, 0x015B, 0x0165, 0x017E, 0x017A, 0x00A0, 0x02C7, 0x02D8, 0x0141,
    0x00A4, 0x0104, 0x00A6, 0x00A7, 0x00A8, 0x00A9, 0x015E, 0x00AB, 0x00AC, 0x00AD, 0x00AE, 0x017B,
    0x00B0, 0x00B1, 0x02DB, 0x0142, 0x00B4, 0x00B5, 0x00B6, 0x00B7, 0x00B8, 0x0105, 0x015F, 0x00BB,
    0x013D, 0x02DD, 0x013E, 0x017C, 0x0154, 0x00C1, 0x00C2, 0x0102, 0x00C4, 0x0139, 0x0106, 0x00C7,
    0x010C, 0x00C9, 0x0118, 0x00CB, 0x011A, 0x00CD, 0x00CE, 0x010E, 0x0110, 0x0143, 0x0147, 0x00D3,
    0x00D4, 0x0150, 0x00D6, 0x00D7, 0x0158, 0x016E, 0x00DA, 0x0170, 0x00DC, 0x00DD, 0x0162, 0x00DF,
    0x0155, 0x00E1, 0x00E2, 0x0103, 0x00E4, 0x013A, 0x0107, 0x00E7, 0x010D, 0x00E9, 0x0119, 0x00EB,
    0x011B, 0x00ED, 0x00EE, 0x010F, 0x0111, 0x0144, 0x0148, 0x00F3, 0x00F4, 0x0151, 0x00F6, 0x00F7,
    0x0159, 0x016F, 0x00FA, 0x0171, 0x00FC, 0x00FD, 0x0163, 0x02D9,
};

uint32_t decodeByte(unsigned char byte, Encoding encoding) {
  if (byte < 0x80)
    return byte;
  if (encoding == Encoding::Windows1250)
    return windows1250[byte - 0x80];
  return byte < 0xA0 ? windows1252[byte - 0x80] : byte;
}

/// Length of the ASCII run at the begin of `bytes`.
size_t asciiRun(llvm::StringRef bytes) {
  size_t at = 0;
  for (uint64_t word; at + sizeof(word) <= bytes.size(); at += sizeof(word)) {
    std::memcpy(&word, bytes.data() + at, sizeof(word));
    if (word & 0x8080808080808080u)
      break;
  }
  while (at < bytes.size() && static_cast<unsigned char>(bytes[at]) < 0x80)
    ++at;
  return at;
}

/// Length of the valid UTF-8 sequence at the begin of `bytes`, 0 when there is none.
size_t utf8Sequence(llvm::StringRef bytes) {
  const auto *begin = reinterpret_cast<const llvm::UTF8 *>(bytes.data());
  const size_t length = llvm::getNumBytesForUTF8(*begin);
  if (length > bytes.size() || !llvm::isLegalUTF8Sequence(begin, begin + length))
    return 0;
  return length;
}

/// Whether there is a letter, in either code page.
bool isLetterAt(llvm::StringRef text, size_t at) {
  return at < text.size() &&
         (llvm::isAlpha(text[at]) || static_cast<unsigned char>(text[at]) >= 0xC0);
}

/// What one non-ASCII byte says for Windows-1250 (above 0) or Windows-1252 (below 0).
int pointsFor1250(llvm::StringRef text, size_t at) {
  const bool before = at > 0 && isLetterAt(text, at - 1);
  const bool after = isLetterAt(text, at + 1);
  const char next = at + 1 < text.size() ? llvm::toLower(text[at + 1]) : '\0';
  const char previous = at > 0 ? llvm::toLower(text[at - 1]) : '\0';
  switch (static_cast<unsigned char>(text[at])) {
  case 0x8D:
  case 0x8F:
  case 0x9D: // empty in 1252
    return 4;
  case 0x8A:
  case 0x9A:
  case 0x8E:
  case 0x9E: // the same in both, but of Czech and Slovak
    return 2;
  case 0xB3: // l with stroke, or a superscript three after a unit
    return after || (before && previous != 'm') ? 3 : 0;
  case 0xA3:
  case 0xA5:
  case 0xAF:
  case 0x8C:
  case 0x9C:
  case 0x9F:
    return before || after ? 3 : 0;
  case 0xB9:
  case 0xBC:
  case 0xBE:
  case 0xBF: // signs before or after words
    return before ? 3 : 0;
  case 0xD5:
  case 0xF5: // o with tilde is Portuguese, always before an e
    return next == 'e' ? 0 : 2;
  case 0xDB:
  case 0xFB:
    return 1;
  case 0xCC:
  case 0xEC:
  case 0xD9:
  case 0xF9:
  case 0xD2:
  case 0xF2: // Italian has them at the end
    return before && after ? 1 : 0;
  case 0xD8:
  case 0xF8: // the diameter sign
    return before || after ? 0 : -3;
  case 0xC5:
  case 0xE5:
  case 0xC0:
  case 0xE0:
    return -2;
  case 0xB2:
  case 0xBD:
    return -1;
  default:
    return 0;
  }
}

} // namespace

uint32_t byteOrderMark(llvm::StringRef text) { return text.startswith("\xEF\xBB\xBF") ? 3 : 0; }

bool isAscii(llvm::StringRef bytes) { return asciiRun(bytes) == bytes.size(); }

bool isValidUtf8(llvm::StringRef bytes) {
  while (true) {
    bytes = bytes.drop_front(asciiRun(bytes));
    if (bytes.empty())
      return true;
    const size_t length = utf8Sequence(bytes);
    if (length == 0)
      return false;
    bytes = bytes.drop_front(length);
  }
}

Encoding guessEncoding(llvm::StringRef text) {
  if (isValidUtf8(text))
    return Encoding::Utf8;
  int64_t points = 0;
  for (size_t at = 0; at < text.size(); ++at) {
    at += asciiRun(text.drop_front(at));
    if (at < text.size())
      points += pointsFor1250(text, at);
  }
  return points > 0 ? Encoding::Windows1250 : Encoding::Windows1252;
}

void appendUtf8(std::string &out, uint32_t codePoint) {
  char bytes[UNI_MAX_UTF8_BYTES_PER_CODE_POINT];
  char *end = bytes;
  if (llvm::ConvertCodePointToUTF8(codePoint, end))
    out.append(bytes, end);
}

void appendDecoded(std::string &out, llvm::StringRef bytes, Encoding encoding) {
  while (!bytes.empty()) {
    const size_t plain = asciiRun(bytes);
    out.append(bytes.data(), plain);
    bytes = bytes.drop_front(plain);
    if (bytes.empty())
      return;
    const uint32_t length = codePointLength(bytes, encoding);
    if (encoding != Encoding::Utf8)
      appendUtf8(out, decodeByte(static_cast<unsigned char>(bytes.front()), encoding));
    else if (length > 1)
      out.append(bytes.data(), length);
    else
      appendUtf8(out, replacementCharacter);
    bytes = bytes.drop_front(length);
  }
}

uint32_t codePointLength(llvm::StringRef bytes, Encoding encoding) {
  if (encoding != Encoding::Utf8)
    return 1;
  return std::max(1u, static_cast<uint32_t>(utf8Sequence(bytes)));
}

uint32_t countCodePoints(llvm::StringRef bytes, Encoding encoding) {
  if (encoding != Encoding::Utf8)
    return static_cast<uint32_t>(bytes.size());
  // Every byte but the continuations (10xxxxxx) begins a code point.
  return static_cast<uint32_t>(std::count_if(bytes.begin(), bytes.end(), [](char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0) != 0x80;
  }));
}

} // namespace ncvet
