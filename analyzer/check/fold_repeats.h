// Findings that repeat: what a program's writer or a post-processor does throughout, told once.
#pragma once

#include "formats/finding/finding.h"

#include <vector>

namespace ncvet {

/// Folds findings of one file and one rule that say the same thing into the first of them, with the
/// further places as notes and their edits in its fix. Only for rules whose page says so:
/// `"repeated": "same"`, the message is the same; `"repeated": "alike"`, apart from numbers;
/// `"repeated": "many"`, the same, once there are more than ten.
/// Suppressed findings stay as they are. `findings` are sorted by file and position.
void foldRepeats(std::vector<Finding> &findings);

} // namespace ncvet
