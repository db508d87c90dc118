// Plain text: UTF-16 and binary files told by their bytes.
#include "formats/text/plain_text.h"

#include "llvm/ADT/STLExtras.h"

namespace ncvet {

namespace {

/// Bytes that are looked at: what a file is shows at its begin.
constexpr size_t lookedAt = 4096;
/// Fewer strange bytes than this are damage, not another kind of file.
constexpr size_t fewestStrange = 8;
/// One strange byte in so many: compressed data, which has the fewest, has one in fourteen.
constexpr size_t strangeShare = 32;

/// A control character that no punched tape and no serial line leaves in a program: those are the
/// ends of lines, tabulators, STX, ETX, EOT, DC1 to DC4 and the end-of-file mark of old systems.
bool isStrange(char byte) {
  const auto code = static_cast<unsigned char>(byte);
  return code < 0x20 && !llvm::StringRef("\t\n\v\f\r\2\3\4\x11\x12\x13\x14\x1A").contains(byte);
}

/// Without a mark: every second byte is zero, and hardly any of the others.
bool alternatesWithZeros(llvm::StringRef text) {
  size_t zeros[2] = {0, 0};
  for (size_t at = 0; at < text.size(); ++at)
    zeros[at % 2] += text[at] == '\0';
  const size_t pairs = text.size() / 2;
  return pairs >= 4 && std::max(zeros[0], zeros[1]) * 10 >= pairs * 9 &&
         std::min(zeros[0], zeros[1]) * 20 <= pairs;
}

bool isUtf16(llvm::StringRef text) {
  text = text.take_front(lookedAt);
  return text.startswith("\xFF\xFE") || text.startswith("\xFE\xFF") || alternatesWithZeros(text);
}

} // namespace

bool isBinary(llvm::StringRef text) {
  if (isUtf16(text))
    return false;
  // The leader and the trailer of a tape are blank.
  text = text.take_front(lookedAt).trim('\0');
  const auto strange = size_t(llvm::count_if(text, isStrange));
  return strange >= fewestStrange && strange * strangeShare > text.size();
}

std::string whyNoProgram(llvm::StringRef text) {
  if (isUtf16(text))
    return "it is UTF-16 text, which no control reads; save it as ASCII or UTF-8";
  return isBinary(text) ? "it is a binary file, no program" : "";
}

} // namespace ncvet
