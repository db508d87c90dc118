// What the spelling of a program's name says.
#pragma once

#include "formats/dialect/dialect.h"

namespace ncvet {

/// Whether files of programs end so (`SPF`), or names under which a control stores them
/// (`_N_SHAFT_SPF`).
bool isProgramEnding(llvm::StringRef ending, const Dialect &dialect);

/// The name alone: without folders, and without the marks with which a control stores programs.
llvm::StringRef bareProgramName(llvm::StringRef spelling, const Dialect &dialect);

} // namespace ncvet
