// The blocks of the programs that a block calls.
#pragma once

#include "analyzer/program/project.h"
#include "formats/readers/block.h"

#include "llvm/ADT/STLExtras.h"

namespace ncvet {

/// Calls `visit` with the blocks of each program that `block`, one of `unit`, calls, and of those
/// that they call. False as soon as `visit` says so, and where one of the programs is not known or
/// goes on in another one.
bool eachCalledBlock(FileUnit &unit, const Block &block,
                     llvm::function_ref<bool(const Block &)> visit);

/// Whether the block holds a statement that calls a program, or goes on in another one.
bool entersProgram(const Block &block);

} // namespace ncvet
