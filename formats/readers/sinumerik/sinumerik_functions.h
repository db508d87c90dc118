// Functions of Sinumerik expressions.
#pragma once

#include "formats/readers/block.h"

namespace ncvet {

/// The function of this name, in capitals, with one number in and one number out; `Op::Unknown`:
/// it is none.
Op sinumerikFunction(llvm::StringRef upper);
/// `SQR(2)`: one letter off a function, and no function itself.
bool isMisspeltFunction(llvm::StringRef upper);

} // namespace ncvet
