// Report as GitLab's code quality artifact: one JSON list of issues in the form of Code Climate.
#include "formats/finding/fingerprint.h"
#include "formats/reports/writers.h"

#include "llvm/Support/xxhash.h"
#include <nlohmann/json.hpp>

namespace ncvet {

namespace {

using Json = nlohmann::ordered_json; // keys in the order of insertion

class GitlabWriter final : public ReportWriter {
public:
  void write(const Report &report, llvm::raw_ostream &out) override {
    out << '[';
    llvm::StringRef separator = "\n";
    for (const Finding &finding : report.findings) {
      if (isHidden(finding))
        continue;
      out << separator;
      dumpJson(issueJson(report, finding), out);
      separator = ",\n";
    }
    out << "\n]\n";
  }

private:
  /// Of GitLab's five.
  static llvm::StringRef severityOf(Severity severity) {
    switch (severity) {
    case Severity::Style:
      return "minor";
    case Severity::Warning:
      return "major";
    case Severity::Error:
      return "critical";
    }
    llvm_unreachable("no such severity");
  }

  /// A finding's own fingerprint names it within its file, this one within the report.
  static std::string fingerprintOf(const std::string &path, const Finding &finding) {
    return fingerprintString(llvm::xxHash64(path + '\0' + fingerprintString(finding.fingerprint)));
  }

  static Json issueJson(const Report &report, const Finding &finding) {
    const llvm::StringRef rule = report.rules[finding.rule].id;
    const std::string path = pathFromRoot(report, fileOf(report, finding.range).display());
    const Region region = regionOf(report, finding.range);
    Json result = Json::object();
    result["description"] = rule.str() + ": " + validText(report, finding.range, finding.message);
    result["check_name"] = rule.str();
    result["fingerprint"] = fingerprintOf(path, finding);
    result["severity"] = severityOf(finding.severity).str();
    result["location"] = {{"path", path},
                          {"lines", {{"begin", region.begin.line}, {"end", region.end.line}}}};
    return result;
  }
};

} // namespace

std::unique_ptr<ReportWriter> makeGitlabWriter() { return std::make_unique<GitlabWriter>(); }

} // namespace ncvet
