// The names of stored variables that have a meaning beyond the table whose codes leave them.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/StringRef.h"

#include <cstdint>

namespace ncvet {

enum class StoredName : uint8_t {
  Below,
  Cylinder,
  LeastX,
  LeastY,
  LeastZ,
  GreatestX,
  GreatestY,
  GreatestZ,
  LeastOn,
  GreatestOn,
  TravelFromX,
  TravelFromY,
  TravelFromZ,
  TravelToX,
  TravelToY,
  TravelToZ
};

struct StoredNameInfo {
  llvm::StringLiteral name; ///< as tables write it in `stores`: "_BELOW"
  llvm::StringLiteral meaning;
};
/// In the order of the enumeration.
llvm::ArrayRef<StoredNameInfo> storedNames();

/// Key of the variable.
uint64_t storedKey(StoredName name);

} // namespace ncvet
