// What the analysis of a program found.
#pragma once

#include "formats/finding/finding.h"

#include <vector>

namespace ncvet {

struct AnalysisResult {
  std::vector<Finding> findings; ///< sorted by file, position, rule; suppressions not yet applied
  uint64_t blocks = 0;           ///< blocks with content in the file
  bool complete = true;          ///< false: cut short by a budget
  std::vector<std::string> cuts; ///< why, one line each
};

} // namespace ncvet
