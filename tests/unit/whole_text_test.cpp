// What a text as a whole says: findings that are due in some texts only, and findings that tell how
// the whole text is made.
#include "analyzer/check/checker.h"
#include "analyzer/rule/rule_table.h"

#include <gtest/gtest.h>

namespace ncvet {
namespace {

/// The findings of one rule.
std::vector<Finding> findingsOf(llvm::StringRef rule, const std::string &dialect,
                                const std::string &text) {
  SessionOptions options;
  options.dialect = dialect;
  Session session(std::move(options));
  SourceSet sources;
  const FileOutcome outcome = checkFile(session, sources, sources.add("part.nc", text));
  EXPECT_EQ("", outcome.error);
  std::vector<Finding> findings;
  for (const CheckedFinding &found : outcome.findings)
    if (allRules()[found.finding.rule].info.id == rule)
      findings.push_back(found.finding);
  return findings;
}

std::vector<std::string> messagesOf(llvm::StringRef rule, const std::string &dialect,
                                    const std::string &text) {
  std::vector<std::string> messages;
  for (const Finding &finding : findingsOf(rule, dialect, text))
    messages.push_back(finding.message);
  return messages;
}

std::vector<Severity> severitiesOf(llvm::StringRef rule, const std::string &dialect,
                                   const std::string &text) {
  std::vector<Severity> severities;
  for (const Finding &finding : findingsOf(rule, dialect, text))
    severities.push_back(finding.severity);
  return severities;
}

const char *const plotted =
    "G21 G17 G90\nG0 X0 Y0 Z5\nF300\nG1 Z-1\nX40\nG0 Y20\nG1 X0\nG0 Z5\nM2\n";

TEST(WholeText, APlotterNeedsNoSpindleAndHasNoDepth) {
  EXPECT_EQ(0u, messagesOf("spindle-off-while-cutting", "linuxcnc", plotted).size());
  EXPECT_EQ(0u, messagesOf("motion-rapid-traverse-at-depth", "linuxcnc", plotted).size());
}

TEST(WholeText, AProgramThatStartsItsSpindleTooLateIsTold) {
  const std::string late = "G21 G17 G90\nS8000\n" + std::string(plotted);
  EXPECT_EQ(1u, messagesOf("spindle-off-while-cutting", "linuxcnc", late).size());
  const std::string milled = "G21 G17 G90\nS8000 M3\n" + std::string(plotted);
  EXPECT_EQ(0u, messagesOf("spindle-off-while-cutting", "linuxcnc", milled).size());
  EXPECT_EQ(1u, messagesOf("motion-rapid-traverse-at-depth", "linuxcnc", milled).size());
}

TEST(WholeText, ARouterWhoseSpindleHasASwitchIsWarnedOf) {
  const std::string rule = "spindle-off-while-cutting";
  const std::string cut = "G0 X0 Y0\nG43 Z5. H1\nG1 Z-1. F300.\nX40.\nG0 Z5.\nM30\n";
  const std::string head = "O1 (SIGN)\nG21 G17 G90\nG54\nT1 M6\n";
  EXPECT_EQ(std::vector{Severity::Warning}, severitiesOf(rule, "fanuc-0m", head + cut));
  // With a speed, a start was meant.
  EXPECT_EQ(std::vector{Severity::Error}, severitiesOf(rule, "fanuc-0m", head + "S8000\n" + cut));
}

TEST(WholeText, ALatheProgramOnAControlForMillsHasNoDepth) {
  EXPECT_EQ(0u, messagesOf("motion-rapid-traverse-at-depth", "linuxcnc",
                           "G18 G8 G21 G90\nM3 S800\nG0 X11 Z1\nG1 Z-35 F50\nG0 X14\nZ1\nM2\n")
                    .size());
}

/// Arcs of which none closes, one after another.
std::string openArcs(unsigned count) {
  std::string text = "O1 (ARCS)\nG21 G17 G90\nG54\nT1 M6\nS1000 M3\nG0 X0 Y0\nG43 Z5. H1\nF200.\n";
  for (unsigned i = 0; i < count; ++i)
    text += "G0 X0 Y0\nG2 X10. Y" + std::to_string(i + 1) + ". I3. J0\n";
  return text + "G0 Z5.\nM5\nM30\n";
}

TEST(WholeText, AFileWhoseArcsDoNotCloseIsToldOnce) {
  const auto all = messagesOf("arc-radius-mismatch", "fanuc-0m", openArcs(20));
  ASSERT_EQ(1u, all.size());
  EXPECT_NE(std::string::npos, all[0].find("19 more times in this file: the whole text is made so"))
      << all[0];
  EXPECT_EQ(3u, messagesOf("arc-radius-mismatch", "fanuc-0m", openArcs(3)).size());
}

TEST(WholeText, AnUnknownCodeIsToldOnce) {
  const std::string text = "G21 G17 G90\nG999\nX1\nG999\nM428\nM428\nM2\n";
  EXPECT_EQ(1u, messagesOf("block-unknown-g-code", "linuxcnc", text).size());
  EXPECT_EQ(1u, messagesOf("block-unknown-m-code", "linuxcnc", text).size());
}

TEST(WholeText, TheSameMistakeIsToldWithItsCount) {
  const auto all = messagesOf("feed-not-positive", "linuxcnc",
                              "G21 G17 G90\nS1000 M3\nG1 X1 F0\nX2 F0\nX3 F100\nM2\n");
  ASSERT_EQ(1u, all.size());
  EXPECT_NE(std::string::npos, all[0].find("; once more in this file")) << all[0];
}

TEST(WholeText, ACodeOfANewerVersionIsToldOnce) {
  const std::string curve = "G21 G17 G90\nF200\nG0 X0 Y0\nG6.2 X1 Y1 K0 P3\nX2 Y3 K0\nX4 Y0 K0\n"
                            "G6.2 K1\nG6.2 K1\nM2\n";
  EXPECT_EQ(0u, messagesOf("block-unknown-g-code", "linuxcnc", curve).size());
  const auto newer = messagesOf("block-option-required", "linuxcnc", curve);
  ASSERT_EQ(1u, newer.size());
  EXPECT_NE(std::string::npos, newer[0].find("2.10")) << newer[0];
}

TEST(WholeText, TheEndAfterALoopWithoutEndIsNoDeadCode) {
  const std::string loop = "O1 (RUN IN)\nG54\nT1 M6\nN10 G0 X0\nX50.\nGOTO 10\nM30\n";
  EXPECT_EQ(0u, messagesOf("flow-unreachable-block", "fanuc-0m", loop).size());
  const std::string again = "O1 (FEED)\nG54\nT1 M6\nG0 X0\nX50.\nM99\nM30\n";
  EXPECT_EQ(0u, messagesOf("program-code-after-end", "fanuc-0m", again).size());
  EXPECT_EQ(0u, messagesOf("flow-unreachable-block", "fanuc-0m", again).size());
  const std::string dead = "O1 (FEED)\nG54\nT1 M6\nG0 X0\nX50.\nM99\nG0 X100.\nM30\n";
  EXPECT_EQ(1u, messagesOf("program-code-after-end", "fanuc-0m", dead).size());
}

} // namespace
} // namespace ncvet
