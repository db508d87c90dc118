// Keys of variables: a number for each variable of a program, with a name or without.
#pragma once

#include "llvm/ADT/StringRef.h"

#include <cstdint>

namespace ncvet {

/// Keys of named variables begin here; below are the numbers of numbered ones.
constexpr uint64_t firstNamedVariable = uint64_t(1) << 40;
/// Key of the variable `name`, made of the name, upper and lower case alike. A double holds it.
uint64_t variableKey(llvm::StringRef name);
/// Keys of the named variables that all programs share begin here: `#<_speed>`.
constexpr uint64_t firstSharedVariable = uint64_t(1) << 39;
/// Key of the variable `name` that all programs share.
uint64_t sharedVariableKey(llvm::StringRef name);
/// Key of a variable of the control: its number, or its name, which all programs share.
uint64_t controlVariableKey(llvm::StringRef spelling);
/// Key of element `index` of the array with this key.
uint64_t elementKey(uint64_t array, int64_t index);

} // namespace ncvet
