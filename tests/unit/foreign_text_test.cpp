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

/// The lines of a comment that goes over several are no blocks, nor are its brackets.
TEST(ForeignText, CommentsOverManyLinesAreToldOnceToo) {
  std::string text = "O9037\n";
  for (int i = 0; i < 10; ++i)
    text += "(\nwhat this does\n)\nG00 X1.\n";
  const auto findings = check("fanuc-mill", text + "M99\n");
  ASSERT_EQ(1u, findings.size());
  EXPECT_NE(std::string::npos,
            findings[0].finding.message.find("cannot be read, most for their comments"))
      << findings[0].finding.message;
}

/// Broken comments are no other control's language: the first of them is named, as an error there.
TEST(ForeignText, ATextWhoseCommentsAreBrokenIsOfItsControl) {
  std::string text = "O<pocket> sub\n";
  for (int i = 0; i < 12; ++i)
    text += "( depth (mm). )\nG1 X#1 F100\n";
  const auto findings = check("auto", text + "O<pocket> endsub\nO<pocket> call\nM2\n");
  ASSERT_EQ(1u, findings.size());
  EXPECT_EQ(0u, findings[0].finding.message.find("12 of 28 blocks cannot be read, most for their "
                                                 "comments; the first: a `(` inside a comment"))
      << findings[0].finding.message;
  EXPECT_EQ(Severity::Error, findings[0].finding.severity);
  EXPECT_EQ(text.find("(mm"), findings[0].finding.range.begin);
}

TEST(ForeignText, ProseIsToldOnceWhereTheControlIsNamedToo) {
  EXPECT_EQ(1u, check("fanuc-0m", proseOfTwentyLines()).size());
}

TEST(ForeignText, AFewBlocksThatANamedControlCannotReadAreToldOneByOne) {
  std::string text = proseOfTwentyLines();
  for (int i = 0; i < 100; ++i)
    text.insert(text.find('\n') + 1, "G01 X" + std::to_string(i) + ". F100.\n");
  EXPECT_LE(20u, check("fanuc-0m", text).size());
}

TEST(ForeignText, AProgramOfAnotherControlIsToldOnceByItsName) {
  const auto findings = check("fanuc-0t", "$FLANGE.MIN%\n(FLANGE)\nPRES=1\nFLAN=318\nSPIG=268.975\n"
                                          "NM59 M59\nG50 S2000\nT0101\nG0 X100. Z10.\nM02\n");
  ASSERT_EQ(1u, findings.size());
  EXPECT_EQ(0u, findings[0].finding.message.find("5 of 10 blocks are for another control: Okuma ("))
      << findings[0].finding.message;
}

TEST(ForeignText, AProgramOfAControlWithATableIsToldOnceToo) {
  std::string text = "; MILLED\nDEF REAL DEPTH=5\nG54 G17 G90\nT1 D1 M6\nS2000 M3\n";
  for (int i = 0; i < 12; ++i)
    text += "N" + std::to_string(i) + " POCKET3(10,0,2,-5,40,30,6,0,0,0,2,0,0,200,100,0,11)\n";
  const auto findings = check("fanuc-0m", text + "M30\n");
  ASSERT_EQ(1u, findings.size());
  EXPECT_NE(std::string::npos,
            findings[0].finding.message.find("are for another control: sinumerik ("))
      << findings[0].finding.message;
}

TEST(ForeignText, AShortTextOfAControlWithoutATableIsNamedWhereNobodyNamedOne) {
  const auto findings = check("auto", "BEGIN PGM PLATE MM\nTOOL CALL 1 Z S2000\n"
                                      "L X+10 Y+5 R0 FMAX M3\nEND PGM PLATE MM\n");
  ASSERT_EQ(1u, findings.size());
  EXPECT_NE(std::string::npos, findings[0].finding.message.find("Heidenhain ("))
      << findings[0].finding.message;
}

TEST(ForeignText, AFewMistakesAreToldEach) {
  const auto findings =
      check("fanuc-0m", "O0001 (PLATE)\nG17 G21 G40 G49 G80 G90\nT1 M6\nG54 G0 X0 Y0\n"
                        "S1000 M3\nG43 Z50. H1\nG0 Z=2.\nG1 Z-1. F100.\nG1 X10.=\n"
                        "G0 Z50.\nM5\nM30\n");
  EXPECT_LE(2u, findings.size());
  for (const CheckedFinding &found : findings)
    EXPECT_EQ(std::string::npos, found.finding.message.find("another control"));
}

TEST(ForeignText, AGuessedControlGivesNoErrorAndNothingThatRestsOnItsFacts) {
  const auto findings = check("auto", "(POCKET)\nT1 M6\nM3\nG0 X0 Y0\nZ5\nG1 Z-1 F100\nG99.9 P1\n"
                                      "G2 X10 Y3 I5 J0\nG0 Z5\nM30\n");
  ASSERT_EQ(1u, findings.size());
  EXPECT_EQ("arc-radius-mismatch", allRules()[findings[0].finding.rule].info.id);
  EXPECT_EQ(Severity::Warning, findings[0].finding.severity);
}

/// What rests on codes of the control that the text is read as is not told of another one's.
TEST(ForeignText, OfAControlWithoutATableNothingIsSaidOfItsMoves) {
  EXPECT_EQ(0u, check("auto", "N0 T1.1\nN10 M6\nN20 G0 G90 G43 Z10 F100 S1000 M3\n"
                              "N140 G1 G42 G37 R20 X10 Y0\nN150 G3 G38 R20 I-10 J0\nN160 M30\n")
                    .size());
  EXPECT_EQ(0u, check("auto", "G21\n#region\nM98 P1001 L1\nM30\nO1001\nG1 X5 F100\n"
                              "M17\n")
                    .size());
}

TEST(ForeignText, LinesForASimulatorAreNoBlocks) {
  const char *const text = "[BILLET X100 Y80 Z30;\n[TOOLDEF T1 D2;\nO0001 (PART)\nG21 G17 G40\n"
                           "T1 M6\nG54 G0 X0 Y0 S1000 M3\nG43 H1 Z50.\nG1 Z-1. F100.\nX50.\n"
                           "G0 Z50.\nM5\nM30\n";
  for (const char *dialect : {"auto", "fanuc-mill"})
    for (const CheckedFinding &found : check(dialect, text))
      EXPECT_NE("syntax-error", allRules()[found.finding.rule].info.id)
          << dialect << found.finding.message;
}

TEST(ForeignText, WhatAGuessedControlCannotReadIsToldOnce) {
  const auto findings = check("auto", "O1 (PART)\nG0 X0 Y0\n?SET A\nG1 X5 F100\n?SET B\nX10\n"
                                      "?SET C\nM30\n");
  ASSERT_EQ(1u, findings.size());
  EXPECT_EQ(0u, findings[0].finding.message.find(
                    "3 of 8 blocks cannot be read: the text may be for another control; the first"))
      << findings[0].finding.message;
}

TEST(ForeignText, ATestOfColoursIsToldOnce) {
  const auto findings = check("sinumerik", "; SYNTAX TEST \"nc.sublime-syntax\"\nDEF REAL DEPTH=5\n"
                                           "T=\"MILL\" D1 M6\nDEF\n; ^ invalid\nG=10\n"
                                           "R1=\nM30\n");
  ASSERT_EQ(1u, findings.size());
  EXPECT_NE(std::string::npos, findings[0].finding.message.find("no program of a machine"))
      << findings[0].finding.message;
  EXPECT_EQ(Severity::Style, findings[0].finding.severity);
}

TEST(ForeignText, ACommandOfAControlThatWasFoundOutHasItsOwnOperands) {
  std::string text = "N201 R101=1\nN220 @136 R101 K50 K300\n";
  for (int i = 0; i < 30; ++i)
    text += "N225 G91 G1 X20 Y0 F500\n";
  EXPECT_EQ(0u, check("auto", text + "N240 R101=R101+1\nN250 @100 K-220\nN300 M30\n").size());
}

TEST(ForeignText, WordsOfAptInAProgramAreToldOnce) {
  const auto findings =
      check("sinumerik", "G55\nDIAMOF\n; part operation\nThe tool is CUTTER/ 0.8\n"
                         "Magazine slot number 1,1,1\nG95 G1 F0.1\nG96 S500\nM4\n"
                         "G90 X17 Z2\nZ0\nX-0.4\nX17 Z2\nEnd of program.\n");
  ASSERT_EQ(1u, findings.size());
  EXPECT_NE(std::string::npos, findings[0].finding.message.find("APT"))
      << findings[0].finding.message;
  EXPECT_EQ(Severity::Error, findings[0].finding.severity);
}

TEST(ForeignText, APieceOfAProgramLacksItsEndAsAStyle) {
  const auto severityOfEnd = [](const std::string &text) {
    std::optional<Severity> severity;
    for (const CheckedFinding &found : check("sinumerik", text))
      if (allRules()[found.finding.rule].info.id == "program-end-missing")
        severity = found.finding.severity;
    return severity;
  };
  EXPECT_EQ(Severity::Style, severityOfEnd("G0 X0 Y0\nR1=5\nG1 X=R1 F100\n"));
  EXPECT_EQ(Severity::Warning, severityOfEnd("T1 M6\nS1000 M3\nG0 X0 Y0\nG1 X5 F100\n"));
}

TEST(ForeignText, ATextOfNoMachineIsCalledSo) {
  const auto findings = check("fanuc-mill", "O4113 (MACRO EXAMPLE 1)\n{BEGIN}\n{$DRILL=100}\n"
                                            "{BEGIN_SUBS}\n100 (CIRCLE)\nRETURN\n{END_SUBS}\n"
                                            "N1 T{$TOOL1} M6\n{END}\n");
  ASSERT_EQ(1u, findings.size());
  EXPECT_NE(std::string::npos, findings[0].finding.message.find(
                                   "are no program of a machine: a template of the editor"))
      << findings[0].finding.message;
}

TEST(ForeignText, ACommandOfTheRouterThatWasFoundOutIsNoUnreadableBlock) {
  const auto findings = check("auto", "(msg start)\n{\"gc\":\"g00g17g21g40g49g80g90\"}\n"
                                      "{\"gc\":\"g55\"}\ng0x0y0z5\nf300\ng1x10\nm2\n");
  for (const CheckedFinding &found : findings)
    EXPECT_EQ(std::string::npos, found.finding.message.find("no block"));
}

TEST(ForeignText, WhatIsWrongOnEveryControlIsToldByItself) {
  std::string text = "; Source: mach3.gcode\nG21 G17 G90\nM3\nF140\nG0 X3.59 Y1.745\n";
  for (int i = 0; i < 3; ++i)
    text += "G02 X4.1 Y2.255 R0.255\nG02 X3.59 Y1.745 R0.255\n";
  const auto findings = check("fanuc-mill", text + "M5\nM30\n");
  ASSERT_FALSE(findings.empty());
  for (const CheckedFinding &found : findings)
    EXPECT_EQ(std::string::npos, found.finding.message.find("another control"))
        << found.finding.message;
}

TEST(ForeignText, AllLinesOfATextThatIsNotReadCount) {
  std::string text = "$OKUMA.SSB%\n(OKUMA OSP5020M)\n";
  for (int i = 0; i < 40; ++i)
    text += "G0 X" + std::to_string(i) + "\n";
  const auto findings = check("linuxcnc", text);
  ASSERT_EQ(1u, findings.size());
  EXPECT_NE(std::string::npos, findings[0].finding.message.find(" of 42 blocks"))
      << findings[0].finding.message;
}

} // namespace
} // namespace ncvet
