// Report in reviewdog's diagnostic format, one JSON object a line, with fixes as suggestions.
#include "formats/reports/writers.h"

#include <nlohmann/json.hpp>

namespace ncvet {

namespace {

using Json = nlohmann::ordered_json; // keys in the order of insertion

class RdjsonlWriter final : public ReportWriter {
public:
  void write(const Report &report, llvm::raw_ostream &out) override {
    for (const Finding &finding : report.findings) {
      if (isHidden(finding))
        continue;
      dumpJson(diagnosticJson(report, finding), out);
      out << '\n';
    }
  }

private:
  /// Columns of this format count the bytes of the line in UTF-8.
  static Json positionJson(const SourceFile &file, uint32_t offset) {
    const uint32_t begin =
        std::max(file.lines().lineBegin(offset), std::min(file.textBegin(), offset));
    return {{"line", file.lines().lineOf(offset)},
            {"column", 1 + file.displayText(file.text(begin, offset)).size()}};
  }

  static Json rangeJson(const Report &report, const SourceRange &range) {
    const SourceFile &file = fileOf(report, range);
    return {{"start", positionJson(file, range.begin)},
            {"end", positionJson(file, std::max(range.begin, range.end))}};
  }

  static Json locationJson(const Report &report, const SourceRange &range) {
    return {{"path", pathFromRoot(report, fileOf(report, range).display())},
            {"range", rangeJson(report, range)}};
  }

  static llvm::StringRef severityOf(Severity severity) {
    return severity == Severity::Error     ? "ERROR"
           : severity == Severity::Warning ? "WARNING"
                                           : "INFO";
  }

  /// A suggestion is one range of the file of its finding: fixes of several edits are left out, as
  /// one of them alone would be wrong.
  static bool isSuggestion(const Finding &finding) {
    return finding.fix && finding.fix->edits.size() == 1 &&
           finding.fix->edits.front().range.file == finding.range.file;
  }

  static Json diagnosticJson(const Report &report, const Finding &finding) {
    Json result = Json::object();
    result["message"] = validText(report, finding.range, finding.message);
    result["location"] = locationJson(report, finding.range);
    result["severity"] = severityOf(finding.severity).str();
    result["source"] = {{"name", report.toolName}};
    result["code"] = {{"value", report.rules[finding.rule].id.str()}};
    if (isSuggestion(finding)) {
      const TextEdit &edit = finding.fix->edits.front();
      result["suggestions"] = Json::array({{{"range", rangeJson(report, edit.range)},
                                            {"text", validText(report, edit.range, edit.text)}}});
    }
    if (!finding.notes.empty()) {
      Json related = Json::array();
      for (const Note &note : finding.notes)
        related.push_back({{"message", validText(report, note.range, note.message)},
                           {"location", locationJson(report, note.range)}});
      result["relatedLocations"] = std::move(related);
    }
    return result;
  }
};

} // namespace

std::unique_ptr<ReportWriter> makeRdjsonlWriter() { return std::make_unique<RdjsonlWriter>(); }

} // namespace ncvet
