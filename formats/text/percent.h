// Percent escapes of URIs (RFC 3986).
#pragma once

#include "llvm/ADT/StringRef.h"

#include <string>

namespace ncvet {

/// Appends a path as it is written in a URI: letters, digits and `-._~/` as they are, every other
/// byte as its escape.
void appendPercentEncoded(std::string &out, llvm::StringRef path);

/// The bytes that a part of a URI means. What is no escape is left as it is.
std::string percentDecoded(llvm::StringRef text);

} // namespace ncvet
