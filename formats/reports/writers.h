// Report writers: one maker a format, and what the writers share.
#pragma once

#include "formats/reports/report.h"

#include <nlohmann/json_fwd.hpp>

#include <memory>

namespace ncvet {

std::unique_ptr<ReportWriter> makeTextWriter(const ReportOptions &options);
std::unique_ptr<ReportWriter> makeJsonWriter();
std::unique_ptr<ReportWriter> makeSarifWriter();
std::unique_ptr<ReportWriter> makeGccWriter();
std::unique_ptr<ReportWriter> makeCheckstyleWriter();
std::unique_ptr<ReportWriter> makeHtmlWriter();
std::unique_ptr<ReportWriter> makeGithubWriter();
std::unique_ptr<ReportWriter> makeGitlabWriter();
std::unique_ptr<ReportWriter> makeJunitWriter();
std::unique_ptr<ReportWriter> makeRdjsonlWriter();
std::unique_ptr<ReportWriter> makeSonarqubeWriter();
std::unique_ptr<ReportWriter> makeAzureWriter();
std::unique_ptr<ReportWriter> makeTeamcityWriter();
std::unique_ptr<ReportWriter> makeJsonlWriter();
std::unique_ptr<ReportWriter> makeMarkdownWriter();

/// A range as reports give it: positions from 1 in code points, end exclusive, begin <= end.
struct Region {
  LineColumn begin;
  LineColumn end;
};

const SourceFile &fileOf(const Report &report, const SourceRange &range);
Region regionOf(const Report &report, const SourceRange &range);
LineColumn positionOf(const Report &report, const SourceRange &range);

/// `text` as valid UTF-8. Messages and fixes quote programs: what is not UTF-8 in them is in the
/// encoding of the file that `range` lies in.
std::string validText(const Report &report, const SourceRange &range, llvm::StringRef text);

/// `display` as seen from the root of the project, which tools of code hosts want: without `..` as
/// long as the root is known.
std::string pathFromRoot(const Report &report, llvm::StringRef display);

/// True for findings that only SARIF shows.
inline bool isHidden(const Finding &finding) { return finding.suppressed || finding.baselined; }

/// `text` (valid UTF-8) on one line, fit for a terminal: control characters as their pictures.
std::string oneLine(llvm::StringRef text);

/// All of a finding, as the JSON report has it.
nlohmann::ordered_json findingJson(const Report &report, const Finding &finding);

/// Writes `value` without blanks. Bytes that are not UTF-8 become U+FFFD.
void dumpJson(const nlohmann::ordered_json &value, llvm::raw_ostream &out);

} // namespace ncvet
