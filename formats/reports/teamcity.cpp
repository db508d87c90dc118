// Report as service messages of TeamCity: inspections of the rules that spoke.
#include "formats/reports/writers.h"

#include "llvm/Support/ConvertUTF.h"
#include "llvm/Support/Format.h"

#include <set>

namespace ncvet {

namespace {

/// `text` (valid UTF-8) as a value between quotation marks. What is not ASCII is given by its
/// code: the encoding of a build log is anybody's guess.
std::string teamcityText(llvm::StringRef text) {
  llvm::SmallVector<llvm::UTF16, 128> units;
  llvm::convertUTF8ToUTF16String(text, units);
  std::string out;
  llvm::raw_string_ostream stream(out);
  for (const llvm::UTF16 unit : units) {
    if (unit == '\n')
      stream << "|n";
    else if (unit == '\r')
      stream << "|r";
    else if (unit < 0x80 && llvm::StringRef("|'[]").contains(char(unit)))
      stream << '|' << char(unit);
    else if (unit < 0x20 || unit >= 0x7F)
      stream << "|0x" << llvm::format_hex_no_prefix(unit, 4, /*Upper=*/true);
    else
      stream << char(unit);
  }
  return stream.str();
}

class TeamcityWriter final : public ReportWriter {
public:
  void write(const Report &report, llvm::raw_ostream &out) override {
    std::set<RuleId> rules;
    for (const Finding &finding : report.findings)
      if (!isHidden(finding))
        rules.insert(finding.rule);
    for (const RuleId id : rules) {
      const RuleInfo &rule = report.rules[id];
      out << "##teamcity[inspectionType id='" << teamcityText(rule.id) << "' name='"
          << teamcityText(rule.id) << "' description='" << teamcityText(rule.summary)
          << "' category='" << report.toolName << ' ' << teamcityText(rule.category) << "']\n";
    }
    for (const Notification &notification : report.notifications)
      if (notification.severity == Severity::Error)
        out << "##teamcity[buildProblem description='" << teamcityText(notification.message)
            << "']\n";
    for (const Finding &finding : report.findings)
      if (!isHidden(finding))
        writeFinding(report, finding, out);
  }

private:
  static llvm::StringRef severityOf(Severity severity) {
    return severity == Severity::Error     ? "ERROR"
           : severity == Severity::Warning ? "WARNING"
                                           : "WEAK WARNING";
  }

  static void writeFinding(const Report &report, const Finding &finding, llvm::raw_ostream &out) {
    out << "##teamcity[inspection typeId='" << teamcityText(report.rules[finding.rule].id)
        << "' message='" << teamcityText(validText(report, finding.range, finding.message))
        << "' file='" << teamcityText(pathFromRoot(report, fileOf(report, finding.range).display()))
        << "' line='" << positionOf(report, finding.range).line << "' SEVERITY='"
        << severityOf(finding.severity) << "']\n";
  }
};

} // namespace

std::unique_ptr<ReportWriter> makeTeamcityWriter() { return std::make_unique<TeamcityWriter>(); }

} // namespace ncvet
