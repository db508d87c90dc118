// Report as JSON, version 1: all that is known of the findings, one finding a line.
#include "formats/finding/finding_counts.h"
#include "formats/finding/fingerprint.h"
#include "formats/reports/writers.h"

#include <nlohmann/json.hpp>

namespace ncvet {

using Json = nlohmann::ordered_json; // keys in the order of insertion

namespace {

void addRegion(Json &object, const Report &report, const SourceRange &range) {
  const Region region = regionOf(report, range);
  object["path"] = fileOf(report, range).display();
  object["line"] = region.begin.line;
  object["column"] = region.begin.column;
  object["endLine"] = region.end.line;
  object["endColumn"] = region.end.column;
}

Json fixJson(const Report &report, const Fix &fix, const SourceRange &range) {
  Json edits = Json::array();
  for (const TextEdit &edit : fix.edits) {
    Json object = Json::object();
    addRegion(object, report, edit.range);
    object["text"] = validText(report, edit.range, edit.text);
    edits.push_back(std::move(object));
  }
  Json result = Json::object();
  result["description"] = validText(report, range, fix.description);
  result["safety"] = toString(fix.safety).str();
  result["edits"] = std::move(edits);
  return result;
}

class JsonWriter final : public ReportWriter {
public:
  void write(const Report &report, llvm::raw_ostream &out) override {
    out << "{\"version\":1,\"tool\":";
    dumpJson({{"name", report.toolName}, {"version", report.toolVersion}}, out);
    out << ",\n\"files\":[";
    llvm::StringRef separator = "\n";
    for (const FileReport &file : report.files) {
      out << separator;
      dumpJson({{"path", file.path},
                {"dialect", file.dialect},
                {"blocks", file.blocks},
                {"complete", file.complete},
                {"guess", guessJson(file)}},
               out);
      separator = ",\n";
    }
    out << "\n],\n\"findings\":[";
    separator = "\n";
    // One at a time: a file of a million blocks may have many.
    for (const Finding &finding : report.findings) {
      if (isHidden(finding))
        continue;
      out << separator;
      dumpJson(findingJson(report, finding), out);
      separator = ",\n";
    }
    out << "\n],\n\"absent\":[";
    separator = "\n";
    for (const AbsentFinding &finding : report.absent) {
      out << separator;
      dumpJson({{"rule", finding.rule},
                {"path", finding.path},
                {"line", finding.line},
                {"message", finding.message},
                {"fingerprint", fingerprintString(finding.fingerprint)}},
               out);
      separator = ",\n";
    }
    out << "\n],\n\"problems\":[";
    separator = "\n";
    for (const Notification &notification : report.notifications) {
      out << separator;
      dumpJson({{"severity", toString(notification.severity).str()},
                {"path", notification.path.empty() ? Json(nullptr) : Json(notification.path)},
                {"message", notification.message}},
               out);
      separator = ",\n";
    }
    out << "\n],\n\"summary\":";
    dumpJson(summaryJson(report), out);
    out << "}\n";
  }

private:
  static Json summaryJson(const Report &report) {
    const FindingCounts counts = countFindings(report.findings);
    return {{"files", report.files.size()},
            {"findings", counts.shown},
            {"errors", counts.of(Severity::Error)},
            {"warnings", counts.of(Severity::Warning)},
            {"style", counts.of(Severity::Style)},
            {"suppressed", counts.silenced},
            {"known", counts.known},
            {"absent", report.absent.size()},
            {"fixes", {{"safe", counts.safe}, {"unsafe", counts.unsafe}}}};
  }

  /// How the dialect was found out; null where somebody named it.
  static Json guessJson(const FileReport &file) {
    if (!file.guessed)
      return nullptr;
    return {{"sure", file.sure}, {"from", file.detail}};
  }
};

} // namespace

Json findingJson(const Report &report, const Finding &finding) {
  Json result = Json::object();
  result["rule"] = report.rules[finding.rule].id.str();
  result["severity"] = toString(finding.severity).str();
  result["certainty"] = toString(finding.certainty).str();
  result["message"] = validText(report, finding.range, finding.message);
  addRegion(result, report, finding.range);
  Json related = Json::array();
  for (const Note &note : finding.notes) {
    const LineColumn position = positionOf(report, note.range);
    related.push_back({{"path", fileOf(report, note.range).display()},
                       {"line", position.line},
                       {"column", position.column},
                       {"message", validText(report, note.range, note.message)}});
  }
  result["related"] = std::move(related);
  Json trace = Json::array();
  for (const PathStep &step : finding.path)
    trace.push_back({{"path", fileOf(report, step.range).display()},
                     {"line", positionOf(report, step.range).line},
                     {"message", validText(report, step.range, step.message)}});
  result["trace"] = std::move(trace);
  result["fix"] = finding.fix ? fixJson(report, *finding.fix, finding.range) : Json(nullptr);
  result["fingerprint"] = fingerprintString(finding.fingerprint);
  return result;
}

std::unique_ptr<ReportWriter> makeJsonWriter() { return std::make_unique<JsonWriter>(); }

} // namespace ncvet
