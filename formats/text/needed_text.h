// What a text must hold so that a regular expression can match in it: found without compiling it.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/StringRef.h"

#include <bitset>
#include <string>
#include <vector>

namespace ncvet {

/// Texts of which at least one is in each match of the extended regular expression; none: nothing
/// is known.
std::vector<std::string> neededTexts(llvm::StringRef pattern);

/// Says of short texts whether a long one holds them.
class HeldTexts {
public:
  explicit HeldTexts(llvm::StringRef text);
  bool holds(llvm::StringRef part) const;
  /// Whether a pattern with such `neededTexts` may match.
  bool holdsAny(llvm::ArrayRef<std::string> needed) const;

private:
  llvm::StringRef text_;
  std::bitset<256> letters_;
  std::bitset<256 * 256> pairs_; ///< of letters side by side
};

} // namespace ncvet
