// Text in XML reports.
#pragma once

#include "llvm/ADT/StringRef.h"

#include <string>

namespace ncvet {

/// `text` (valid UTF-8) as the value of an XML attribute, or between two tags. XML 1.0 has no place
/// for control characters, not even as references: they become their pictures.
std::string xmlText(llvm::StringRef text);

/// A path, whose bytes may be anything, as XML text.
std::string xmlPath(llvm::StringRef path);

} // namespace ncvet
