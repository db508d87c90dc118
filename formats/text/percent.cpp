// Percent escapes of URIs (RFC 3986).
#include "formats/text/percent.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {

void appendPercentEncoded(std::string &out, llvm::StringRef path) {
  constexpr llvm::StringLiteral plain = "-._~/";
  for (const char byte : path) {
    if (llvm::isAlnum(byte) || plain.contains(byte)) {
      out += byte;
      continue;
    }
    const auto code = static_cast<unsigned char>(byte);
    out += '%';
    out += llvm::hexdigit(code >> 4);
    out += llvm::hexdigit(code & 15);
  }
}

std::string percentDecoded(llvm::StringRef text) {
  std::string bytes;
  bytes.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i) {
    const bool escape = text[i] == '%' && i + 2 < text.size() && llvm::isHexDigit(text[i + 1]) &&
                        llvm::isHexDigit(text[i + 2]);
    if (escape) {
      bytes += char(llvm::hexFromNibbles(text[i + 1], text[i + 2]));
      i += 2;
    } else {
      bytes += text[i];
    }
  }
  return bytes;
}

} // namespace ncvet
