// Tests of the reports for continuous integration: each is read back as its consumer documents it.
#include "tests/support/sample_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

using namespace ncvet;
using namespace ncvet::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

namespace {

using Json = nlohmann::json;

std::vector<std::string> ciLines(const std::string &text) {
  std::vector<std::string> lines;
  for (llvm::StringRef rest = text; !rest.empty();) {
    const auto [line, after] = rest.split('\n');
    lines.push_back(line.str());
    rest = after;
  }
  return lines;
}

Json ciJson(const std::string &text) {
  Json value = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  EXPECT_FALSE(value.is_discarded()) << text;
  return value;
}

/// The keys of an object, which must be no others.
std::set<std::string> ciKeys(const Json &object) {
  std::set<std::string> keys;
  for (const auto &[key, value] : object.items())
    keys.insert(key);
  return keys;
}

/// A finding over two lines with all that formats have to escape.
struct Awkward : SampleReport {
  Awkward() {
    const SourceFile &file = sources.add("a,b;c:100%'|[1].nc", "G1 X1\nG1 X2\n");
    Finding finding = report.findings[1];
    finding.path.clear();
    finding.range = {file.id(), 0, 11};
    finding.message = "50% of `X1`, ['|'] & <\"x\">;\r\nend";
    report.findings = {finding};
    report.notifications.clear();
  }
};

} // namespace

TEST(GithubReport, IsACommandForEachFinding) {
  EXPECT_THAT(
      ciLines(written("github", SampleReport().report)),
      ElementsAre("::error file=gone.nc::cannot read gone.nc: No such file or directory",
                  "::warning title=ncvet%3A cycle-unintended-execution,file=programs/bore "
                  "\xC3\xB6.nc,line=5,endLine=5,col=1,endColumn=9::X30. Y0. drills again: G83 of "
                  "line 3 is still active",
                  "::error title=ncvet%3A missing-feed,file=programs/sub.nc,line=2,endLine=2,col=1,"
                  "endColumn=8::G1 without a feed",
                  "::notice title=ncvet%3A decimal-point,file=programs/sub.nc,line=2,endLine=2,"
                  "col=4,endColumn=8::X100 has no decimal point"));
}

TEST(GithubReport, EscapesWhatTheRunnerWouldReadAndGivesNoColumnsOfSeveralLines) {
  EXPECT_EQ(written("github", Awkward().report),
            "::error title=ncvet%3A missing-feed,file=a%2Cb;c%3A100%25'|[1].nc,line=1,endLine=2::"
            "50%25 of `X1`, ['|'] & <\"x\">;%0D%0Aend\n");
}

TEST(AzureReport, IsACommandForEachFinding) {
  EXPECT_THAT(ciLines(written("azure", SampleReport().report)),
              testing::Contains("##vso[task.logissue type=error;sourcepath=programs/sub.nc;"
                                "linenumber=2;columnnumber=1;code=missing-feed]G1 without a feed"));
  EXPECT_EQ(written("azure", Awkward().report),
            "##vso[task.logissue type=error;sourcepath=a,b%3Bc:100%AZP25'|[1%5D.nc;linenumber=1;"
            "columnnumber=1;code=missing-feed]50%AZP25 of `X1`, ['|'] & <\"x\">;%0D%0Aend\n");
}

TEST(TeamcityReport, DeclaresEachRuleOnceAndEscapesValues) {
  const std::vector<std::string> lines = ciLines(written("teamcity", SampleReport().report));
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                          [](const std::string &line) {
                            return line.rfind("##teamcity[inspectionType ", 0) == 0;
                          }),
            3);
  EXPECT_THAT(lines, testing::Contains(StartsWith(
                         "##teamcity[inspection typeId='cycle-unintended-execution' message='X30. "
                         "Y0. drills again: G83 of line 3 is still active' file='programs/bore "
                         "|0x00F6.nc' line='5' SEVERITY='WARNING']")));
  EXPECT_THAT(written("teamcity", Awkward().report),
              HasSubstr("message='50% of `X1`, |[|'|||'|] & <\"x\">;|r|nend' "
                        "file='a,b;c:100%|'|||[1|].nc' line='1' SEVERITY='ERROR'"));
}

TEST(GitlabReport, HasTheKeysThatGitlabReadsAndFingerprintsThatAreUnique) {
  SampleReport sample;
  // The same block in two files has one fingerprint within each of them.
  sample.report.findings[1].fingerprint = sample.report.findings[0].fingerprint;
  const Json issues = ciJson(written("gitlab", sample.report));
  ASSERT_EQ(issues.size(), 3u);
  std::set<std::string> fingerprints;
  for (const Json &issue : issues) {
    EXPECT_EQ(ciKeys(issue), (std::set<std::string>{"check_name", "description", "fingerprint",
                                                    "location", "severity"}));
    EXPECT_THAT(issue["severity"].get<std::string>(), testing::AnyOf("minor", "major", "critical"));
    EXPECT_THAT(issue["description"].get<std::string>(),
                StartsWith(issue["check_name"].get<std::string>() + ": "));
    EXPECT_GE(issue["location"]["lines"]["begin"].get<int>(), 1);
    EXPECT_TRUE(fingerprints.insert(issue["fingerprint"].get<std::string>()).second);
  }
  EXPECT_EQ(issues[0]["location"]["path"], "programs/bore \xC3\xB6.nc");
  EXPECT_EQ(ciJson(written("gitlab", Report())), Json::array());
}

TEST(RdjsonlReport, CountsColumnsInBytesAndSuggestsFixes) {
  SampleReport sample;
  const SourceFile &file = sample.sources.add("\xC3\xB6.nc", "(B\xF6hrer) G1 X100\n"); // Latin-1
  sample.report.findings[2].range = rangeOf(file, "X100");
  sample.report.findings[2].fix->edits = {{rangeOf(file, "X100"), "X100."}};
  sample.report.findings = {sample.report.findings[2]};
  const Json diagnostic = ciJson(written("rdjsonl", sample.report));
  EXPECT_EQ(diagnostic["severity"], "INFO");
  EXPECT_EQ(diagnostic["code"]["value"], "decimal-point");
  EXPECT_EQ(diagnostic["source"]["name"], "ncvet");
  // As text of UTF-8 the letter before it takes two bytes.
  EXPECT_EQ(
      diagnostic["location"],
      Json({{"path", "\xC3\xB6.nc"},
            {"range",
             {{"start", {{"line", 1}, {"column", 14}}}, {"end", {{"line", 1}, {"column", 18}}}}}}));
  EXPECT_EQ(diagnostic["suggestions"][0]["text"], "X100.");
  EXPECT_EQ(diagnostic["suggestions"][0]["range"], diagnostic["location"]["range"]);
}

TEST(RdjsonlReport, LeavesOutFixesOfSeveralEditsOfWhichOneAloneWouldBeWrong) {
  SampleReport sample;
  sample.report.findings[0].fix->edits.push_back({rangeOf(sample.bore, "M30"), "M2"});
  const Json first = ciJson(ciLines(written("rdjsonl", sample.report))[0]);
  EXPECT_FALSE(first.contains("suggestions"));
  EXPECT_EQ(first["relatedLocations"][0]["message"], "G83 becomes active here");
}

TEST(SonarqubeReport, NamesEveryRuleOfItsIssuesAndCountsColumnsFromZero) {
  const Json report = ciJson(written("sonarqube", SampleReport().report));
  std::set<std::string> rules;
  for (const Json &rule : report["rules"]) {
    EXPECT_EQ(ciKeys(rule), (std::set<std::string>{"cleanCodeAttribute", "description", "engineId",
                                                   "id", "impacts", "name", "severity", "type"}));
    EXPECT_EQ(rule["engineId"], "ncvet");
    EXPECT_THAT(rule["impacts"][0]["softwareQuality"].get<std::string>(),
                testing::AnyOf("SECURITY", "RELIABILITY", "MAINTAINABILITY"));
    rules.insert(rule["id"].get<std::string>());
  }
  ASSERT_EQ(report["issues"].size(), 3u);
  for (const Json &issue : report["issues"]) {
    EXPECT_TRUE(rules.count(issue["ruleId"].get<std::string>()));
    const Json range = issue["primaryLocation"]["textRange"];
    EXPECT_GE(range["startColumn"].get<int>(), 0);
    EXPECT_TRUE(range["endLine"] > range["startLine"] || range["endColumn"] > range["startColumn"]);
  }
  EXPECT_EQ(report["issues"][0]["secondaryLocations"][0]["message"], "G83 becomes active here");
  EXPECT_EQ(report["issues"][1]["secondaryLocations"][0]["message"], "O0002 is called here");
}

TEST(JunitReport, HasASuiteForEachProgramAndCountsThatAreRight) {
  SampleReport sample;
  sample.report.files.push_back({"programs/clean.nc", "haas-mill", 3, true, ""});
  const std::string xml = written("junit", sample.report);
  EXPECT_THAT(xml, HasSubstr("<testsuites name=\"ncvet\" tests=\"5\" failures=\"3\" errors=\"1\""));
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"programs/clean.nc\" tests=\"1\" failures=\"0\" "
                             "errors=\"0\""));
  EXPECT_THAT(xml,
              HasSubstr("<testcase name=\"missing-feed at 2:1\" classname=\"programs/sub.nc\""));
  EXPECT_THAT(xml, HasSubstr("<error type=\"error\" message=\"cannot read gone.nc"));
  EXPECT_THAT(written("junit", Awkward().report),
              HasSubstr("message=\"50% of `X1`, ['|'] &amp; &lt;&quot;x&quot;&gt;;"));
}

TEST(JsonLinesReport, HasTheFindingsOfTheJsonReport) {
  const SampleReport sample;
  const std::vector<std::string> lines = ciLines(written("jsonl", sample.report));
  const Json findings = ciJson(written("json", sample.report))["findings"];
  ASSERT_EQ(lines.size(), findings.size());
  for (size_t i = 0; i < lines.size(); ++i)
    EXPECT_EQ(ciJson(lines[i]), findings[i]);
}

TEST(MarkdownReport, CountsFindingsAndLeavesNothingOfAMessageToMarkdown) {
  const std::string text = written("markdown", SampleReport().report);
  EXPECT_THAT(text, StartsWith("### ncvet: 3 findings: 1 error, 1 warning, 1 style\n"));
  EXPECT_THAT(text, HasSubstr("| `missing-feed` | 1 | A cutting motion has no feed. |"));
  EXPECT_THAT(text,
              HasSubstr("| programs/sub.nc:2 | error | G1 without a feed | `missing-feed` |"));
  EXPECT_THAT(text, HasSubstr("**error**: cannot read gone.nc"));
  EXPECT_THAT(written("markdown", Awkward().report),
              HasSubstr("| 50% of `X1`, \\['\\|'\\] &amp; &lt;\"x\"&gt;;"));
}

TEST(Reports, ShowPathsFromTheRootOfTheProjectWhereTheCurrentFolderIsBelowIt) {
  SampleReport sample;
  sample.report.folder = "cell/mill";
  const SourceFile &file = sample.sources.add("../lathe/a.nc", "G1 X1\n");
  sample.report.findings[0].range = {file.id(), 0, 2};
  sample.report.findings[0].fix.reset();
  for (const char *format : {"github", "gitlab", "rdjsonl", "sonarqube", "azure", "sarif"}) {
    const std::string text = written(format, sample.report);
    EXPECT_THAT(text, HasSubstr("cell/lathe/a.nc")) << format;
    EXPECT_THAT(text, HasSubstr("cell/mill/programs/sub.nc")) << format;
    EXPECT_THAT(text, Not(HasSubstr("../"))) << format;
  }
}
