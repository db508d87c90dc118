// Report as logging commands of Azure Pipelines.
#include "formats/reports/writers.h"

namespace ncvet {

namespace {

/// `text` as the agent reads it back. In a property `;` and `]` end the value.
std::string azureText(llvm::StringRef text, bool property) {
  std::string out;
  for (const char byte : text) {
    if (byte == '%')
      out += "%AZP25";
    else if (byte == '\r')
      out += "%0D";
    else if (byte == '\n')
      out += "%0A";
    else if (property && byte == ';')
      out += "%3B";
    else if (property && byte == ']')
      out += "%5D";
    else
      out.push_back(byte);
  }
  return out;
}

class AzureWriter final : public ReportWriter {
public:
  void write(const Report &report, llvm::raw_ostream &out) override {
    for (const Notification &notification : report.notifications) {
      out << "##vso[task.logissue type=" << typeOf(notification.severity);
      if (!notification.path.empty())
        out << ";sourcepath=" << azureText(pathFromRoot(report, notification.path), true);
      out << ']' << azureText(notification.message, false) << '\n';
    }
    for (const Finding &finding : report.findings)
      if (!isHidden(finding))
        writeFinding(report, finding, out);
  }

private:
  /// There are two.
  static llvm::StringRef typeOf(Severity severity) {
    return severity == Severity::Error ? "error" : "warning";
  }

  static void writeFinding(const Report &report, const Finding &finding, llvm::raw_ostream &out) {
    const LineColumn position = positionOf(report, finding.range);
    const llvm::StringRef rule = report.rules[finding.rule].id;
    const std::string path = pathFromRoot(report, fileOf(report, finding.range).display());
    out << "##vso[task.logissue type=" << typeOf(finding.severity)
        << ";sourcepath=" << azureText(path, true) << ";linenumber=" << position.line
        << ";columnnumber=" << position.column << ";code=" << azureText(rule, true) << ']'
        << azureText(validText(report, finding.range, finding.message), false) << '\n';
  }
};

} // namespace

std::unique_ptr<ReportWriter> makeAzureWriter() { return std::make_unique<AzureWriter>(); }

} // namespace ncvet
