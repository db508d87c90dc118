// Texts that are for another control: told once, and what is wrong in a program is told of.
#include "analyzer/check/checker.h"
#include "analyzer/rule/rule_table.h"

#include <gtest/gtest.h>

namespace ncvet {
namespace {

std::vector<CheckedFinding> check(const std::string &dialect, const std::string &text) {
  SessionOptions options;
  options.dialect = dialect;
  Session session(std::move(options));
  SourceSet sources;
  FileOutcome outcome = checkFile(session, sources, sources.add("part.nc", text));
  EXPECT_EQ("", outcome.error);
  return std::move(outcome.findings);
}

std::string proseOfTwentyLines() {
  std::string prose = "O0001 (NOTES)\n";
  for (int i = 0; i < 20; ++i)
    prose += "clamp the part before you start spindle " + std::to_string(i) + "\nG4 P1000\n";
  return prose + "M30\n";
}

TEST(ForeignText, ProseIsToldOnceWhereNobodyNamedItsControl) {
  const auto findings = check("auto", proseOfTwentyLines());
  ASSERT_EQ(1u, findings.size());
  EXPECT_NE(std::string::npos, findings[0].finding.message.find("no program of this control"))
      << findings[0].finding.message;
}

TEST(ForeignText, WhatANamedControlCannotReadIsToldBlockByBlock) {
  EXPECT_LE(20u, check("fanuc-0m", proseOfTwentyLines()).size());
}

TEST(ForeignText, AProgramOfAnotherControlIsToldOnceByItsName) {
  const auto findings = check("fanuc-0t", "$FLANGE.MIN%\n(FLANGE)\nPRES=1\nFLAN=318\nSPIG=268.975\n"
                                          "NM59 M59\nG50 S2000\nT0101\nG0 X100. Z10.\nM02\n");
  ASSERT_EQ(1u, findings.size());
  EXPECT_NE(std::string::npos, findings[0].finding.message.find("Okuma"))
      << findings[0].finding.message;
}

TEST(ForeignText, AFewMistakesAreToldEach) {
  const auto findings =
      check("fanuc-0m", "O0001 (PLATE)\nG17 G21 G40 G49 G80 G90\nT1 M6\nG54 G0 X0 Y0\n"
                        "S1000 M3\nG43 Z50. H1\nG0 Z=2.\nG1 Z-1. F100.\nG1 X10.=\n"
                        "G0 Z50.\nM5\nM30\n");
  EXPECT_LE(2u, findings.size());
  for (const CheckedFinding &found : findings)
    EXPECT_EQ(std::string::npos, found.finding.message.find("blocks are wrong here"));
}

TEST(ForeignText, AGuessedControlGivesNoErrorAndNothingThatRestsOnItsFacts) {
  const auto findings = check("auto", "(POCKET)\nT1 M6\nM3\nG0 X0 Y0\nZ5\nG1 Z-1 F100\nG99.9 P1\n"
                                      "G2 X10 Y3 I5 J0\nG0 Z5\nM30\n");
  ASSERT_EQ(1u, findings.size());
  EXPECT_EQ("arc-radius-mismatch", allRules()[findings[0].finding.rule].info.id);
  EXPECT_EQ(Severity::Warning, findings[0].finding.severity);
}

} // namespace
} // namespace ncvet
