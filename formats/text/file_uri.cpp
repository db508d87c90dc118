// `file:` URIs and paths (RFC 8089): percent escapes, hosts, drives.
#include "formats/text/file_uri.h"

#include "formats/text/percent.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {

namespace path = llvm::sys::path;

namespace {

/// `C:` or `C:/…`.
bool hasDrive(llvm::StringRef path) {
  return path.size() >= 2 && llvm::isAlpha(path[0]) && path[1] == ':' &&
         (path.size() == 2 || path[2] == '/');
}

} // namespace

std::string pathOfUri(llvm::StringRef uri, path::Style style) {
  llvm::StringRef rest = uri;
  if (!rest.consume_front_insensitive("file://"))
    return uri.str();
  const size_t slash = rest.find('/');
  if (slash == llvm::StringRef::npos)
    return uri.str();
  const llvm::StringRef host = rest.take_front(slash);
  std::string found = percentDecoded(rest.drop_front(slash));
  if (path::is_style_posix(style))
    return found; // the host is empty or this machine
  if (hasDrive(llvm::StringRef(found).drop_front()))
    return found.substr(1);
  return host.empty() || host == "localhost" ? found : "//" + percentDecoded(host) + found;
}

std::string uriOfPath(llvm::StringRef given, path::Style style) {
  const std::string whole = path::convert_to_slash(given, style);
  llvm::StringRef path = whole;
  std::string uri = "file://";
  if (path::is_style_windows(style) && hasDrive(path)) {
    uri += ("/" + path.take_front(2)).str();
    path = path.drop_front(2);
  } else if (path::is_style_windows(style) && path.consume_front("//")) {
    // The first part of the path is the host.
  } else if (!path.startswith("/")) {
    return given.str();
  }
  appendPercentEncoded(uri, path);
  return uri;
}

std::string slashed(llvm::StringRef given) { return path::convert_to_slash(given); }

} // namespace ncvet
