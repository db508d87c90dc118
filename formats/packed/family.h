// A control and those whose tables it extends.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/StringRef.h"

#include <string>
#include <vector>

namespace ncvet {

/// The built-in control with those whose tables it extends, the nearest first.
std::vector<std::string> familyOf(llvm::StringRef dialect);

/// The first of the family that is in `list`; empty: none.
std::string firstOf(llvm::ArrayRef<std::string> family, llvm::ArrayRef<std::string> list);

} // namespace ncvet
