// Report as JUnit's XML: each program is a suite, each finding a failed test; a program without
// findings is one that passed.
#include "formats/reports/writers.h"
#include "formats/reports/xml_text.h"

namespace ncvet {

namespace {

class JunitWriter final : public ReportWriter {
public:
  void write(const Report &report, llvm::raw_ostream &out) override {
    const std::map<std::string, Suite> suites = suitesOf(report);
    size_t tests = 0, failures = 0, errors = 0;
    for (const auto &[path, suite] : suites) {
      tests += suite.tests();
      failures += suite.findings.size();
      errors += suite.errors.size();
    }
    out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"" << report.toolName
        << "\" tests=\"" << tests << "\" failures=\"" << failures << "\" errors=\"" << errors
        << "\" time=\"0\">\n";
    for (const auto &[path, suite] : suites)
      writeSuite(report, path, suite, out);
    out << "</testsuites>\n";
  }

private:
  struct Suite {
    std::vector<const Finding *> findings;
    std::vector<const Notification *> errors;
    /// Without any there is one test, which passes.
    size_t tests() const { return std::max<size_t>(1, findings.size() + errors.size()); }
  };

  static std::map<std::string, Suite> suitesOf(const Report &report) {
    std::map<std::string, Suite> suites;
    for (const FileReport &file : report.files)
      suites[file.path];
    for (const Finding &finding : report.findings)
      if (!isHidden(finding))
        suites[fileOf(report, finding.range).display()].findings.push_back(&finding);
    for (const Notification &notification : report.notifications)
      if (notification.severity == Severity::Error)
        suites[notification.path.empty() ? report.toolName : notification.path].errors.push_back(
            &notification);
    return suites;
  }

  static void writeSuite(const Report &report, const std::string &path, const Suite &suite,
                         llvm::raw_ostream &out) {
    const std::string name = xmlPath(path);
    out << "  <testsuite name=\"" << name << "\" tests=\"" << suite.tests() << "\" failures=\""
        << suite.findings.size() << "\" errors=\"" << suite.errors.size()
        << "\" skipped=\"0\" time=\"0\">\n";
    for (const Notification *error : suite.errors)
      out << "    <testcase name=\"checked\" classname=\"" << name
          << "\" time=\"0\">\n      <error type=\"error\" message=\"" << xmlText(error->message)
          << "\"/>\n    </testcase>\n";
    for (const Finding *finding : suite.findings)
      writeFailure(report, name, *finding, out);
    if (suite.findings.empty() && suite.errors.empty())
      out << "    <testcase name=\"no findings\" classname=\"" << name << "\" time=\"0\"/>\n";
    out << "  </testsuite>\n";
  }

  static void writeFailure(const Report &report, llvm::StringRef suite, const Finding &finding,
                           llvm::raw_ostream &out) {
    const LineColumn position = positionOf(report, finding.range);
    const std::string message = xmlText(validText(report, finding.range, finding.message));
    // Tests are told apart by their names: several findings of a rule may be in one line.
    out << "    <testcase name=\"" << xmlText(report.rules[finding.rule].id) << " at "
        << position.line << ':' << position.column << "\" classname=\"" << suite
        << "\" time=\"0\">\n      <failure type=\"" << toString(finding.severity) << "\" message=\""
        << message << "\">" << suite << ':' << position.line << ':' << position.column << ": "
        << toString(finding.severity) << ": " << message << '\n';
    for (const Note &note : finding.notes)
      out << xmlPath(fileOf(report, note.range).display()) << ':'
          << positionOf(report, note.range).line << ": "
          << xmlText(validText(report, note.range, note.message)) << '\n';
    out << "</failure>\n    </testcase>\n";
  }
};

} // namespace

std::unique_ptr<ReportWriter> makeJunitWriter() { return std::make_unique<JunitWriter>(); }

} // namespace ncvet
