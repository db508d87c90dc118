// The formats of reports: their list, and the writer of each.
#include "formats/reports/report_formats.h"

#include "formats/reports/writers.h"

namespace ncvet {

llvm::ArrayRef<ReportFormat> reportFormats() {
  static constexpr ReportFormat formats[] = {
      {"text", "for people: message, program line and marked range"},
      {"json", "all of it, version 1"},
      {"sarif", "SARIF 2.1.0, for code scanning and viewers"},
      {"gcc", "one line a finding, for editors and build tools"},
      {"checkstyle", "XML, for continuous integration servers"},
      {"html", "one page: programs, findings, and the path of the tool", true},
      {"github", "annotations of GitHub Actions, without an upload"},
      {"gitlab", "GitLab's code quality artifact"},
      {"junit", "XML of test results: a failed test for each finding"},
      {"rdjsonl", "for reviewdog, with fixes as suggestions"},
      {"sonarqube", "SonarQube's generic format of external issues"},
      {"azure", "logging commands of Azure Pipelines"},
      {"teamcity", "service messages of TeamCity"},
      {"jsonl", "a finding a line, as the JSON report has it"},
      {"markdown", "a summary for a pull request or a job's page"},
  };
  return formats;
}

std::unique_ptr<ReportWriter> makeReportWriter(llvm::StringRef format,
                                               const ReportOptions &options) {
  using Maker = std::unique_ptr<ReportWriter> (*)();
  static constexpr std::pair<llvm::StringLiteral, Maker> makers[] = {
      {"json", makeJsonWriter},
      {"sarif", makeSarifWriter},
      {"gcc", makeGccWriter},
      {"checkstyle", makeCheckstyleWriter},
      {"github", makeGithubWriter},
      {"gitlab", makeGitlabWriter},
      {"junit", makeJunitWriter},
      {"rdjsonl", makeRdjsonlWriter},
      {"sonarqube", makeSonarqubeWriter},
      {"azure", makeAzureWriter},
      {"teamcity", makeTeamcityWriter},
      {"jsonl", makeJsonlWriter},
      {"markdown", makeMarkdownWriter},
      {"html", makeHtmlWriter},
  };
  if (format == "text")
    return makeTextWriter(options);
  for (const auto &[name, make] : makers)
    if (name == format)
      return make();
  return nullptr;
}

} // namespace ncvet
