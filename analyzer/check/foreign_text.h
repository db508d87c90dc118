// A text that is no program of its control: one finding in place of one for every block.
#pragma once

#include "analyzer/program/project.h"
#include "analyzer/setup/session.h"

namespace ncvet {

/// What is known of a text as a whole.
struct TextOrigin {
  uint64_t blocks = 0;   ///< with content
  bool detected = false; ///< its control was found out, nobody named it
  bool sure = true;      ///< that it is for this control
  /// The control that the text is for by its own marks, when it is another one; asked only where
  /// it matters.
  llvm::function_ref<OtherControl()> otherControl;
};

/// Folds the findings of `unit` into one when they have one cause: several blocks are wrong and the
/// text bears the marks of another control, or much of it cannot be read: a twentieth where its
/// control is not sure, a sixth where it was found out, a fifth where somebody has named it. Of
/// less every block that cannot be read is told.
void foldForeignText(Project &project, const FileUnit &unit, const TextOrigin &origin,
                     std::vector<Finding> &findings);

} // namespace ncvet
