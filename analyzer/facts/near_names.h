// The names that a program defines, to be found by a name that differs from one of them by a
// letter.
#pragma once

#include "analyzer/program/program_index.h"

#include "llvm/ADT/SmallVector.h"

#include <optional>

namespace ncvet {

/// Digits of names do not count, nor do capitals. A look-up costs as much as the name is long,
/// however many names there are.
class NearNames {
public:
  NearNames() = default;
  /// The variables of those definitions whose names have at least that many characters.
  NearNames(const FileIndex::Definitions &definitions, size_t shortest);

  /// The first in the text of those that differ by one letter; none: there is none.
  std::optional<Defined> near(llvm::StringRef name) const;

private:
  struct Name {
    std::string letters;
    Defined first; ///< of those with these letters
  };
  std::vector<Name> names_;
  /// Places in `names_` by what is left of the letters when one of them is taken out, or none: two
  /// names that differ by a letter have one of these in common.
  llvm::StringMap<llvm::SmallVector<uint32_t, 1>> byRest_;
};

} // namespace ncvet
