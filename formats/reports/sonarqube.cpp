// Report in SonarQube's generic format for external issues: the rules that spoke, and the issues.
#include "formats/reports/writers.h"

#include <nlohmann/json.hpp>

namespace ncvet {

namespace {

using Json = nlohmann::ordered_json; // keys in the order of insertion

/// What SonarQube says of an issue, in its newer and in its older mode.
struct SonarWeight {
  const char *attribute, *quality, *impact; ///< clean code attribute, what it is about, how much
  const char *type, *severity;
};

SonarWeight weightOf(Severity severity) {
  switch (severity) {
  case Severity::Style:
    return {"CONVENTIONAL", "MAINTAINABILITY", "LOW", "CODE_SMELL", "MINOR"};
  case Severity::Warning:
    return {"LOGICAL", "RELIABILITY", "MEDIUM", "BUG", "MAJOR"};
  case Severity::Error:
    return {"LOGICAL", "RELIABILITY", "HIGH", "BUG", "CRITICAL"};
  }
  llvm_unreachable("no such severity");
}

class SonarqubeWriter final : public ReportWriter {
public:
  void write(const Report &report, llvm::raw_ostream &out) override {
    out << "{\"rules\":[";
    llvm::StringRef separator = "\n";
    for (const auto &[id, severity] : rulesOf(report)) {
      out << separator;
      dumpJson(ruleJson(report, id, severity), out);
      separator = ",\n";
    }
    out << "\n],\n\"issues\":[";
    separator = "\n";
    for (const Finding &finding : report.findings) {
      if (isHidden(finding))
        continue;
      out << separator;
      dumpJson(issueJson(report, finding), out);
      separator = ",\n";
    }
    out << "\n]}\n";
  }

private:
  /// The rules that spoke. The weight is the rule's: it is that of its gravest finding.
  static std::map<RuleId, Severity> rulesOf(const Report &report) {
    std::map<RuleId, Severity> rules;
    for (const Finding &finding : report.findings)
      if (!isHidden(finding)) {
        Severity &severity = rules.try_emplace(finding.rule, finding.severity).first->second;
        severity = std::max(severity, finding.severity);
      }
    return rules;
  }

  static Json ruleJson(const Report &report, RuleId id, Severity severity) {
    const RuleInfo &rule = report.rules[id];
    const SonarWeight weight = weightOf(severity);
    return {{"id", rule.id.str()},
            {"name", rule.id.str()},
            {"description", rule.summary.str()},
            {"engineId", report.toolName},
            {"cleanCodeAttribute", weight.attribute},
            {"type", weight.type},
            {"severity", weight.severity},
            {"impacts",
             Json::array({{{"softwareQuality", weight.quality}, {"severity", weight.impact}}})}};
  }

  /// Lines from 1, columns from 0. No range may be empty: then the whole line is given.
  static Json rangeJson(const Report &report, const SourceRange &range) {
    const Region region = regionOf(report, range);
    Json result = {{"startLine", region.begin.line}};
    if (range.empty())
      return result;
    result["endLine"] = region.end.line;
    result["startColumn"] = region.begin.column - 1;
    result["endColumn"] = region.end.column - 1;
    return result;
  }

  static Json locationJson(const Report &report, const SourceRange &range,
                           llvm::StringRef message) {
    return {{"message", validText(report, range, message)},
            {"filePath", pathFromRoot(report, fileOf(report, range).display())},
            {"textRange", rangeJson(report, range)}};
  }

  static Json issueJson(const Report &report, const Finding &finding) {
    Json result = {{"ruleId", report.rules[finding.rule].id.str()},
                   {"primaryLocation", locationJson(report, finding.range, finding.message)}};
    Json further = Json::array();
    for (const Note &note : finding.notes)
      further.push_back(locationJson(report, note.range, note.message));
    for (const PathStep &step : finding.path)
      further.push_back(locationJson(report, step.range, step.message));
    if (!further.empty())
      result["secondaryLocations"] = std::move(further);
    return result;
  }
};

} // namespace

std::unique_ptr<ReportWriter> makeSonarqubeWriter() { return std::make_unique<SonarqubeWriter>(); }

} // namespace ncvet
