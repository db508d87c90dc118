// Codes that a machine's INI file makes: read from the files near a program, as a piece of a
// profile.
#pragma once

#include "analyzer/setup/config.h"
#include "formats/dialect/dialect.h"

namespace ncvet {

/// What the INI files of `folder`, and of the two folders above it, remap (`REMAP=M428 argspec=PQ
/// ngc=switch`), as the text of a machine profile; nothing when they make no code that `dialect`
/// does not have. Only codes are made: a code of the control that is remapped stays as it is.
std::optional<MachineSource> remapsNear(llvm::StringRef folder, const Dialect &dialect);
/// Notes the files that `remapsNear` reads, where lookups are recorded: once for each file that
/// rests on them, as what they make is kept.
void noteRemapsNear(llvm::StringRef folder);

} // namespace ncvet
