// Findings of a report, counted by what becomes of them.
#include "formats/finding/finding_counts.h"

namespace ncvet {

FindingCounts countFindings(llvm::ArrayRef<Finding> findings) {
  FindingCounts counts;
  for (const Finding &finding : findings) {
    if (finding.suppressed || finding.baselined) {
      ++(finding.suppressed ? counts.silenced : counts.known);
      continue;
    }
    ++counts.shown;
    ++counts.bySeverity[size_t(finding.severity)];
    counts.files.insert(finding.range.file);
    if (finding.fix && !finding.fix->edits.empty())
      ++(finding.fix->safety == FixSafety::Safe ? counts.safe : counts.unsafe);
  }
  return counts;
}

} // namespace ncvet
