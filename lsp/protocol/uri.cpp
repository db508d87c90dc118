// URIs of documents: percent escapes, and the form of `file:` URIs.
#include "lsp/protocol/uri.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet::lsp {

std::string pathOfUri(llvm::StringRef uri) {
  llvm::StringRef rest = uri;
  if (!rest.consume_front_insensitive("file://"))
    return uri.str();
  // The authority is empty or this machine's.
  const size_t slash = rest.find('/');
  if (slash == llvm::StringRef::npos)
    return uri.str();
  rest = rest.drop_front(slash);
  std::string path;
  path.reserve(rest.size());
  for (size_t i = 0; i < rest.size(); ++i) {
    const bool escape = rest[i] == '%' && i + 2 < rest.size() && llvm::isHexDigit(rest[i + 1]) &&
                        llvm::isHexDigit(rest[i + 2]);
    if (escape) {
      path += char(llvm::hexFromNibbles(rest[i + 1], rest[i + 2]));
      i += 2;
    } else {
      path += rest[i];
    }
  }
  return path;
}

std::string uriOfPath(llvm::StringRef path) {
  if (!path.startswith("/"))
    return path.str();
  constexpr llvm::StringLiteral plain = "/-_.~";
  std::string uri = "file://";
  for (const char c : path)
    if (llvm::isAlnum(c) || plain.contains(c))
      uri += c;
    else
      uri += "%" + llvm::toHex(llvm::StringRef(&c, 1));
  return uri;
}

} // namespace ncvet::lsp
