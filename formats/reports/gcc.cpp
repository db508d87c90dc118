// Report in GCC's form: one line a finding, as editors and build tools read it.
#include "formats/reports/writers.h"

namespace ncvet {

namespace {

class GccWriter final : public ReportWriter {
public:
  void write(const Report &report, llvm::raw_ostream &out) override {
    for (const Finding &finding : report.findings) {
      if (isHidden(finding))
        continue;
      const LineColumn position = positionOf(report, finding.range);
      // What reads this form knows error, warning and note.
      const llvm::StringRef severity =
          finding.severity == Severity::Style ? "note" : toString(finding.severity);
      out << oneLine(fileOf(report, finding.range).display()) << ':' << position.line << ':'
          << position.column << ": " << severity << ": "
          << oneLine(validText(report, finding.range, finding.message)) << " ["
          << report.rules[finding.rule].id << "]\n";
    }
  }
};

} // namespace

std::unique_ptr<ReportWriter> makeGccWriter() { return std::make_unique<GccWriter>(); }

} // namespace ncvet
