// Report as workflow commands of GitHub: annotations at the lines of a pull request, without any
// upload.
#include "formats/reports/writers.h"

namespace ncvet {

namespace {

/// `text` as the runner reads it back. In a property `:` and `,` end the value.
std::string githubText(llvm::StringRef text, bool property) {
  std::string out;
  for (const char byte : text) {
    if (byte == '%')
      out += "%25";
    else if (byte == '\r')
      out += "%0D";
    else if (byte == '\n')
      out += "%0A";
    else if (property && byte == ':')
      out += "%3A";
    else if (property && byte == ',')
      out += "%2C";
    else
      out.push_back(byte);
  }
  return out;
}

class GithubWriter final : public ReportWriter {
public:
  void write(const Report &report, llvm::raw_ostream &out) override {
    for (const Notification &notification : report.notifications) {
      out << "::" << commandOf(notification.severity);
      if (!notification.path.empty())
        out << " file=" << githubText(pathFromRoot(report, notification.path), true);
      out << "::" << githubText(notification.message, false) << '\n';
    }
    for (const Finding &finding : report.findings)
      if (!isHidden(finding))
        writeFinding(report, finding, out);
  }

private:
  static llvm::StringRef commandOf(Severity severity) {
    return severity == Severity::Style ? "notice" : toString(severity);
  }

  static void writeFinding(const Report &report, const Finding &finding, llvm::raw_ostream &out) {
    const Region region = regionOf(report, finding.range);
    out << "::" << commandOf(finding.severity)
        << " title=" << githubText(("ncvet: " + report.rules[finding.rule].id).str(), true)
        << ",file="
        << githubText(pathFromRoot(report, fileOf(report, finding.range).display()), true)
        << ",line=" << region.begin.line << ",endLine=" << region.end.line;
    // Columns of several lines are refused.
    if (region.begin.line == region.end.line)
      out << ",col=" << region.begin.column << ",endColumn=" << region.end.column;
    out << "::" << githubText(validText(report, finding.range, finding.message), false) << '\n';
  }
};

} // namespace

std::unique_ptr<ReportWriter> makeGithubWriter() { return std::make_unique<GithubWriter>(); }

} // namespace ncvet
