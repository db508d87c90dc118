// Tests of the SARIF report: its structure, what refers to what, and its URIs.
#include "tests/support/sample_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace ncvet;
using namespace ncvet::test;

namespace {

using Json = nlohmann::json;

Json runOf(const Report &report) {
  const std::string text = written("sarif", report);
  const Json log = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  EXPECT_FALSE(log.is_discarded()) << text;
  EXPECT_EQ(log["version"], "2.1.0");
  EXPECT_EQ(log["runs"].size(), 1u);
  return log["runs"][0];
}

/// Calls `visit` for every artifact location in `value`.
template <typename Visitor>
void forEachLocation(const Json &value, const Visitor &visit) {
  if (value.is_object() && value.contains("uri") && value.contains("index"))
    visit(value);
  if (value.is_structured())
    for (const Json &child : value)
      forEachLocation(child, visit);
}

Json uriOf(llvm::StringRef path) {
  SourceSet sources;
  Report report;
  report.sources = &sources;
  report.files = {{path.str(), "haas-mill", 1, true, ""}};
  return runOf(report)["artifacts"][0]["location"]["uri"];
}

} // namespace

TEST(SarifReportTest, RulesCarryTheirPages) {
  const Json driver = runOf(SampleReport().report)["tool"]["driver"];
  EXPECT_EQ(driver["name"], "ncvet");
  EXPECT_EQ(driver["version"], "0.1.0");
  ASSERT_EQ(driver["rules"].size(), 3u);
  const Json rule = driver["rules"][0];
  EXPECT_EQ(rule["id"], "cycle-unintended-execution");
  EXPECT_EQ(rule["name"], "CycleUnintendedExecution");
  EXPECT_EQ(rule["help"]["markdown"],
            "# cycle-unintended-execution\n\nA cycle stays active until `G80`.\n");
  EXPECT_EQ(rule["defaultConfiguration"]["level"], "warning");
  EXPECT_EQ(driver["rules"][2]["defaultConfiguration"]["level"], "note");
  EXPECT_EQ(driver["rules"][2]["defaultConfiguration"]["enabled"], false);
}

TEST(SarifReportTest, ResultsNameRulePlaceAndFingerprint) {
  const Json run = runOf(SampleReport().report);
  EXPECT_EQ(run["columnKind"], "unicodeCodePoints");
  ASSERT_EQ(run["results"].size(), 3u);
  for (const Json &result : run["results"]) {
    EXPECT_EQ(run["tool"]["driver"]["rules"][result["ruleIndex"].get<size_t>()]["id"],
              result["ruleId"]);
    EXPECT_EQ(result["locations"].size(), 1u);
    EXPECT_EQ(result["message"]["text"],
              result["message"]["arguments"][0].get<std::string>() + ".");
  }
  const Json first = run["results"][0];
  EXPECT_EQ(first["level"], "warning");
  EXPECT_EQ(first["message"]["text"], "X30. Y0. drills again: G83 of line 3 is still active.");
  EXPECT_EQ(first["partialFingerprints"]["ncvet/v1"], "0123456789abcdef");
  EXPECT_EQ(first["partialFingerprints"]["primaryLocationLineHash"], "0123456789abcdef:1");
  EXPECT_EQ(first["locations"][0]["physicalLocation"]["region"],
            Json({{"startLine", 5},
                  {"startColumn", 1},
                  {"endLine", 5},
                  {"endColumn", 9},
                  {"snippet", {{"text", "X30. Y0."}}}}));
  EXPECT_EQ(first["relatedLocations"][0]["message"]["text"], "G83 becomes active here.");
  EXPECT_FALSE(first.contains("codeFlows"));
  EXPECT_FALSE(first.contains("suppressions"));
  EXPECT_FALSE(first.contains("baselineState"));
  EXPECT_EQ(run["results"][2]["level"], "note");
}

TEST(SarifReportTest, HoldsTheRulesThatResultsNameAndNoOther) {
  SampleReport sample;
  sample.report.findings.erase(sample.report.findings.begin() + 1);
  const Json run = runOf(sample.report);
  ASSERT_EQ(run["tool"]["driver"]["rules"].size(), 2u);
  for (const Json &result : run["results"])
    EXPECT_EQ(run["tool"]["driver"]["rules"][result["ruleIndex"].get<size_t>()]["id"],
              result["ruleId"]);
}

TEST(SarifReportTest, HelpIsForReadersAndShowsTheControlsThatWereChecked) {
  SampleReport sample;
  const std::string page = "```json\n{\"summary\": \"x\"}\n```\n\n# rule\n\n## Wrong\n\n"
                           "```nc ecs wrong\nG1\n' ^^ expect: definite\n```\n\n"
                           "```nc haas-mill wrong\nG1 X1\n(^^ expect: definite)\n```\n\n"
                           "Source: manual L12.\n";
  std::vector<RuleInfo> rules = SampleReport::rules().vec();
  rules[0].help = page;
  sample.report.rules = rules;
  const Json rule = runOf(sample.report)["tool"]["driver"]["rules"][0];
  EXPECT_EQ(rule["help"]["markdown"], "# rule\n\n## Wrong\n\n```nc haas-mill\nG1 X1\n```\n\n");
  EXPECT_EQ(rule["helpUri"],
            "data:text/plain,See%20%60ncvet%20explain%20cycle-unintended-execution%60.");
}

TEST(SarifReportTest, TheCodeFlowIsThePathAndEndsAtTheFinding) {
  const Json result = runOf(SampleReport().report)["results"][1];
  const Json steps = result["codeFlows"][0]["threadFlows"][0]["locations"];
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0]["location"]["message"]["text"], "O0002 is called here.");
  EXPECT_EQ(steps[0]["location"]["physicalLocation"]["region"]["startLine"], 6);
  EXPECT_EQ(steps[1]["location"]["physicalLocation"]["region"]["startLine"], 2);
  EXPECT_EQ(result["properties"]["certainty"], "possible");
}

TEST(SarifReportTest, AFixDeletesARegionAndInsertsText) {
  SampleReport sample;
  Fix &fix = *sample.report.findings[0].fix;
  fix.edits.push_back({rangeOf(sample.sub, "M99"), ""});
  fix.edits.push_back({rangeOf(sample.bore, "M30"), "M2"});
  const Json changes = runOf(sample.report)["results"][0]["fixes"][0]["artifactChanges"];
  ASSERT_EQ(changes.size(), 2u); // one a file
  ASSERT_EQ(changes[0]["replacements"].size(), 2u);
  const Json insertion = changes[0]["replacements"][0];
  EXPECT_EQ(insertion["insertedContent"]["text"], "G80\n");
  EXPECT_EQ(insertion["deletedRegion"],
            Json({{"startLine", 5}, {"startColumn", 1}, {"endLine", 5}, {"endColumn", 1}}));
  EXPECT_EQ(changes[0]["replacements"][1]["insertedContent"]["text"], "M2");
  EXPECT_FALSE(changes[1]["replacements"][0].contains("insertedContent"));
}

TEST(SarifReportTest, EveryLocationRefersToItsArtifact) {
  const Json run = runOf(SampleReport().report);
  size_t count = 0;
  forEachLocation(run, [&](const Json &location) {
    ++count;
    EXPECT_EQ(run["artifacts"][location["index"].get<size_t>()]["location"]["uri"],
              location["uri"]);
    EXPECT_TRUE(run["originalUriBaseIds"].contains(location["uriBaseId"].get<std::string>()));
  });
  EXPECT_GT(count, 10u);
  EXPECT_EQ(run["artifacts"].size(), 3u);
}

TEST(SarifReportTest, UrisArePercentEncoded) {
  EXPECT_EQ(uriOf("a/b.nc"), "a/b.nc");
  EXPECT_EQ(uriOf("./a/./b.nc"), "a/b.nc");
  EXPECT_EQ(uriOf("../b.nc"), "../b.nc");
  EXPECT_EQ(uriOf("C:SUB 1#?%.nc"), "C%3ASUB%201%23%3F%25.nc");
  EXPECT_EQ(uriOf("b\xC3\xB6hrer\xFF.nc"), "b%C3%B6hrer%FF.nc");
  EXPECT_EQ(uriOf("/srv/nc/b.nc"), "file:///srv/nc/b.nc");
}

TEST(SarifReportTest, SuppressedFindingsSayThatTheSourceSuppressesThem) {
  SampleReport sample;
  sample.report.findings[1].suppressed = true;
  const Json results = runOf(sample.report)["results"];
  EXPECT_EQ(results[0]["suppressions"], Json::array());
  EXPECT_EQ(results[1]["suppressions"][0]["kind"], "inSource");
}

TEST(SarifReportTest, ABaselineTellsNewUnchangedAndAbsentApart) {
  SampleReport sample;
  sample.report.baselineUsed = true;
  sample.report.findings[1].baselined = true;
  sample.report.absent = {{"missing-feed", "programs/sub.nc", "G1 without a feed", 9, 77},
                          {"retired-rule", "programs/old.nc", "it was so", 1, 78}};
  const Json run = runOf(sample.report);
  const Json &results = run["results"];
  ASSERT_EQ(results.size(), 5u);
  EXPECT_EQ(results[0]["baselineState"], "new");
  EXPECT_EQ(results[1]["baselineState"], "unchanged");
  EXPECT_EQ(results[3]["baselineState"], "absent");
  EXPECT_EQ(results[3]["ruleIndex"], 1);
  EXPECT_EQ(results[3]["locations"][0]["physicalLocation"]["region"]["startLine"], 9);
  EXPECT_EQ(results[4]["ruleId"], "retired-rule");
  EXPECT_FALSE(results[4].contains("ruleIndex"));
}

TEST(SarifReportTest, TheInvocationTellsOfUnreadableFilesAndCutAnalyses) {
  SampleReport sample;
  const Json failed = runOf(sample.report)["invocations"][0];
  EXPECT_EQ(failed["executionSuccessful"], false);
  const Json &notifications = failed["toolExecutionNotifications"];
  ASSERT_EQ(notifications.size(), 2u);
  EXPECT_EQ(notifications[0]["level"], "error");
  EXPECT_EQ(notifications[0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"],
            "gone.nc");
  EXPECT_EQ(notifications[1]["message"]["text"], "analysis cut short: findings may be missing.");
  EXPECT_EQ(notifications[1]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"],
            "programs/sub.nc");
  sample.report.notifications.clear();
  sample.report.files[1].complete = true;
  const Json done = runOf(sample.report)["invocations"][0];
  EXPECT_EQ(done["executionSuccessful"], true);
  EXPECT_EQ(done["toolExecutionNotifications"], Json::array());
}

TEST(SarifReportTest, TheToolsPageIsAnAbsoluteUri) {
  SampleReport sample;
  sample.report.toolUri = "https://example.org/ncvet";
  EXPECT_EQ(runOf(sample.report)["tool"]["driver"]["informationUri"], "https://example.org/ncvet");
  sample.report.toolUri = "www.example.org";
  const Json uri = runOf(sample.report)["tool"]["driver"]["informationUri"];
  EXPECT_EQ(uri.get<std::string>().rfind("data:text/plain,ncvet", 0), 0u);
}
