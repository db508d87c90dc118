// Plain text: whether bytes can be a program at all.
#pragma once

#include "llvm/ADT/StringRef.h"

#include <string>

namespace ncvet {

/// Why `text` is no text that a reader could make anything of, for a message after the file's name:
/// UTF-16, or a binary file. Empty: it is plain text, and that includes any 8-bit encoding, the
/// blank leader of a punched tape, and some damage.
std::string whyNoProgram(llvm::StringRef text);
/// Whether that is because it is a binary file.
bool isBinary(llvm::StringRef text);

} // namespace ncvet
