// Report as Checkstyle's XML, which continuous integration servers read.
#include "formats/reports/writers.h"
#include "formats/reports/xml_text.h"

namespace ncvet {

namespace {

class CheckstyleWriter final : public ReportWriter {
public:
  void write(const Report &report, llvm::raw_ostream &out) override {
    out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<checkstyle version=\"4.3\">\n";
    const std::string *open = nullptr; // path of the <file> element that is not closed yet
    for (const Finding &finding : report.findings) {
      if (isHidden(finding))
        continue;
      const std::string &path = fileOf(report, finding.range).display();
      if (!open || *open != path) {
        out << (open ? "  </file>\n" : "") << "  <file name=\"" << xmlPath(path) << "\">\n";
        open = &path;
      }
      writeFinding(report, finding, out);
    }
    out << (open ? "  </file>\n" : "") << "</checkstyle>\n";
  }

private:
  static void writeFinding(const Report &report, const Finding &finding, llvm::raw_ostream &out) {
    const LineColumn position = positionOf(report, finding.range);
    const llvm::StringRef severity =
        finding.severity == Severity::Style ? "info" : toString(finding.severity);
    out << "    <error line=\"" << position.line << "\" column=\"" << position.column
        << "\" severity=\"" << severity << "\" message=\""
        << xmlText(validText(report, finding.range, finding.message)) << "\" source=\""
        << report.toolName << '.' << xmlText(report.rules[finding.rule].id) << "\"/>\n";
  }
};

} // namespace

std::unique_ptr<ReportWriter> makeCheckstyleWriter() {
  return std::make_unique<CheckstyleWriter>();
}

} // namespace ncvet
