// Names of G and M codes: "G84.2", "M3" and "M03".
#pragma once

#include "llvm/ADT/StringRef.h"

#include <cstdint>
#include <optional>
#include <string>

namespace ncvet {

struct CodeName {
  char letter = 'G';
  uint32_t numberTimesTen = 0; ///< 842 for G84.2
};

/// The largest number of a code that a table may name; it bounds the lookup tables.
constexpr uint32_t maxCodeNumber = 6553;

/// Reads "G84.2", "M3", "M03"; none for anything else or a number above `maxCodeNumber`.
std::optional<CodeName> parseCodeName(llvm::StringRef text);

/// As the tables write it: "G01" for 10, "G84.2" for 842.
std::string toString(const CodeName &name);

} // namespace ncvet
