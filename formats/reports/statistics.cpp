// Findings counted by rule, for people: `--statistics`.
#include "formats/reports/writers.h"

#include "llvm/Support/Format.h"

#include <map>
#include <set>

namespace ncvet {

namespace {

class StatisticsWriter final : public ReportWriter {
public:
  void write(const Report &report, llvm::raw_ostream &out) override {
    struct Line {
      size_t findings = 0;
      std::set<FileId> files;
      Severity severity = Severity::Style;
    };
    std::map<RuleId, Line> byRule;
    for (const Finding &finding : report.findings) {
      if (isHidden(finding))
        continue;
      Line &line = byRule[finding.rule];
      ++line.findings;
      line.files.insert(finding.range.file);
      line.severity = std::max(line.severity, finding.severity);
    }
    std::vector<std::pair<RuleId, Line>> lines(byRule.begin(), byRule.end());
    llvm::stable_sort(
        lines, [](const auto &a, const auto &b) { return a.second.findings > b.second.findings; });
    size_t width = 0;
    for (const auto &[rule, line] : lines)
      width = std::max(width, report.rules[rule].id.size());
    for (const auto &[rule, line] : lines)
      out << llvm::format_decimal(int64_t(line.findings), 6) << " in "
          << llvm::format_decimal(int64_t(line.files.size()), 5) << " files  "
          << llvm::left_justify(toString(line.severity), 7) << "  "
          << llvm::left_justify(report.rules[rule].id, unsigned(width)) << "  "
          << report.rules[rule].summary << '\n';
  }
};

} // namespace

std::unique_ptr<ReportWriter> makeStatisticsWriter() {
  return std::make_unique<StatisticsWriter>();
}

} // namespace ncvet
