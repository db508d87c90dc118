// Reports: the order of output.
#include "formats/reports/report.h"

#include "formats/finding/finding_order.h"

#include <algorithm>
#include <tuple>

namespace ncvet {

std::tuple<llvm::StringRef, uint32_t, llvm::StringRef, uint32_t>
placeInReport(const Report &report, const Finding &finding) {
  // Of one file, byte offsets are in the order of lines and columns.
  return placeInOrder(
      finding, [&](FileId file) { return llvm::StringRef(report.sources->get(file).display()); },
      [&](RuleId rule) { return report.rules[rule].id; });
}

void sortReport(Report &report) {
  std::stable_sort(report.findings.begin(), report.findings.end(),
                   [&](const Finding &a, const Finding &b) {
                     const auto left = placeInReport(report, a), right = placeInReport(report, b);
                     return left != right ? left < right : a.message < b.message;
                   });
  std::stable_sort(report.files.begin(), report.files.end(),
                   [](const FileReport &a, const FileReport &b) { return a.path < b.path; });
  std::stable_sort(report.notifications.begin(), report.notifications.end(),
                   [](const Notification &a, const Notification &b) {
                     return std::tie(a.path, a.message) < std::tie(b.path, b.message);
                   });
  std::stable_sort(report.absent.begin(), report.absent.end(),
                   [](const AbsentFinding &a, const AbsentFinding &b) {
                     return std::tie(a.path, a.line, a.rule, a.fingerprint) <
                            std::tie(b.path, b.line, b.rule, b.fingerprint);
                   });
}

} // namespace ncvet
