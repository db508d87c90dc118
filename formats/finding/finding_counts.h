// Findings of a report, counted by what becomes of them.
#pragma once

#include "formats/finding/finding.h"

#include <array>
#include <set>

namespace ncvet {

struct FindingCounts {
  std::array<size_t, 3> bySeverity{}; ///< of those that are shown
  size_t shown = 0;
  size_t known = 0;            ///< from the baseline
  size_t silenced = 0;         ///< by comments
  size_t safe = 0, unsafe = 0; ///< fixes of those that are shown
  std::set<FileId> files;      ///< with findings that are shown

  size_t of(Severity severity) const { return bySeverity[size_t(severity)]; }
};

FindingCounts countFindings(llvm::ArrayRef<Finding> findings);

} // namespace ncvet
