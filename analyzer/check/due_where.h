// Findings that are due in some texts only: a plotter's program need not start a spindle.
#pragma once

#include "analyzer/program/project.h"
#include "formats/finding/finding.h"

#include <vector>

namespace ncvet {

/// Takes out findings of rules whose pages say what a text must program (`"dueWhere"`), where
/// neither `unit` nor the file of the finding does so.
void dropUndue(Project &project, const FileUnit &unit, std::vector<Finding> &findings);

} // namespace ncvet
