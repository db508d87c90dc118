// Loops inside another one that run in its first pass alone, as the text says it.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// The heads of those WHILE loops whose condition nothing makes true again: its variables are
/// written inside the loop and nowhere else in the loop round it. Nothing where a jump, a call or a
/// break may lead elsewhere. Reads the file.
std::vector<SourceRange> usedUpLoops(const FileSummary &file, const Dialect &dialect);

} // namespace ncvet
