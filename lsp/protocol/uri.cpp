// URIs of documents: percent escapes, and the form of `file:` URIs.
#include "lsp/protocol/uri.h"

#include "formats/text/percent.h"

namespace ncvet::lsp {

std::string pathOfUri(llvm::StringRef uri) {
  llvm::StringRef rest = uri;
  if (!rest.consume_front_insensitive("file://"))
    return uri.str();
  // The authority is empty or this machine's.
  const size_t slash = rest.find('/');
  if (slash == llvm::StringRef::npos)
    return uri.str();
  return percentDecoded(rest.drop_front(slash));
}

std::string uriOfPath(llvm::StringRef path) {
  if (!path.startswith("/"))
    return path.str();
  std::string uri = "file://";
  appendPercentEncoded(uri, path);
  return uri;
}

} // namespace ncvet::lsp
