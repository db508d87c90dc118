// A text that is no program of its control: one finding in place of one for every block.
#pragma once

#include "analyzer/project.h"

namespace ncvet {

/// Folds the findings of `unit` into one when they have one cause: much of the file's text cannot
/// be read, or several blocks are wrong and the text bears the marks of another control. `blocks`:
/// blocks with content in the file. `otherControl` is asked only where it matters; it names the
/// control that the text is for, or nothing.
void foldForeignText(Project &project, const FileUnit &unit, uint64_t blocks,
                     llvm::function_ref<std::string()> otherControl,
                     std::vector<Finding> &findings);

} // namespace ncvet
