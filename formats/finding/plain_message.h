// Messages for places that show text as it is.
#pragma once

#include "llvm/ADT/StringRef.h"

#include <string>

namespace ncvet {

/// The message without the backticks round its codes: an editor's list of problems, a console.
inline std::string plainMessage(llvm::StringRef message) {
  std::string plain;
  plain.reserve(message.size());
  for (const char c : message)
    if (c != '`')
      plain += c;
  return plain;
}

} // namespace ncvet
