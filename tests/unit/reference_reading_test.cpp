// References as the text says them, and what the engine makes of programs that jump and call.
#include "analyzer/program/references.h"
#include "tests/support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncvet {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// "call program 1000 5x" for each reference of the first block.
std::vector<std::string> referencesOf(const char *dialect, const std::string &text) {
  constexpr const char *kinds[] = {"call", "jump", "return", "first", "last"};
  constexpr const char *named[] = {"program", "name",           "subprogram",  "block",
                                   "label",   "untold program", "untold block"};
  std::vector<std::string> found;
  test::withProgram(dialect, {{"PART.nc", text}}, "", [&](Project &, FileUnit &unit) {
    Block block;
    unit.reader->read(unit.reader->first(), block);
    ReferenceReader(*unit.dialect).all(block, unit.source.text(), [&](const Reference &one) {
      std::string line = kinds[unsigned(one.kind)];
      line += std::string(" ") + named[unsigned(one.to)] + " " + one.text.str();
      if (one.number >= 0 && std::to_string(one.number) != one.text)
        line += "=" + std::to_string(one.number);
      if (one.runs != 1)
        line += " " + std::to_string(one.runs) + "x";
      if (one.inCalled)
        line += " there";
      found.push_back(line);
    });
  });
  return found;
}

TEST(ReferenceReading, OfCallsByNumber) {
  EXPECT_THAT(referencesOf("fanuc-0m", "M98 P1000\n"), ElementsAre("call program 1000"));
  EXPECT_THAT(referencesOf("nct-104m", "M98 P51000\n"), ElementsAre("call program 1000 5x"));
  EXPECT_THAT(referencesOf("nct-104m", "M98 P50020\n"), ElementsAre("call program 0020=20 5x"));
  EXPECT_THAT(referencesOf("nct-104m", "M98 P1000 L3\n"), ElementsAre("call program 1000 3x"));
  EXPECT_THAT(referencesOf("fanuc-0m", "G65 P9010 A1.\n"), ElementsAre("call program 9010"));
  EXPECT_THAT(referencesOf("fanuc-0m", "M98 P51000\n"), ElementsAre("call program 51000"));
  EXPECT_THAT(referencesOf("haas-lathe", "M98 P51000\n"), ElementsAre("call program 51000"));
  EXPECT_THAT(referencesOf("haas-lathe", "M97 P200\n"), ElementsAre("call block 200"));
  EXPECT_THAT(referencesOf("fanuc-0m", "M98 P#1\n"), ElementsAre("call untold program "));
}

TEST(ReferenceReading, OfStatements) {
  EXPECT_THAT(referencesOf("fanuc-0m", "IF[#1EQ1]GOTO 30\n"), ElementsAre("jump block 30"));
  EXPECT_THAT(referencesOf("fanuc-0m", "GOTO#1\n"), ElementsAre("jump untold block "));
  EXPECT_THAT(referencesOf("sinumerik", "REPEAT BEGIN1 END1 P3\n"),
              ElementsAre("first label BEGIN1", "last label END1"));
  EXPECT_THAT(referencesOf("sinumerik", "CASE(R1) OF 1 GOTOF A1 DEFAULT GOTOB A2\n"),
              ElementsAre("jump label A1", "jump label A2"));
  EXPECT_THAT(referencesOf("linuxcnc", "o<hole> call [1]\n"), ElementsAre("call subprogram hole"));
}

std::vector<std::string>
problemsOf(const char *dialect, const std::string &program,
           RuleSelection (*select)(const Dialect &) = RuleSelection::defaults) {
  std::vector<std::string> found;
  for (const test::Seen &seen : test::analyseProgram(dialect, {{"PART.MPF", program}}, "", select))
    found.push_back(std::to_string(seen.line) + " " + seen.rule);
  return found;
}

/// Words in comments and names are no conditions.
TEST(ReferenceReading, RecursionIsSilencedByConditionsAlone) {
  const auto program = [](const std::string &body) {
    return "O0001\nG90 G17 G21 G54\nM98 P9100\nM30\nO9100\n" + body + "M98 P9100\nM99\n";
  };
  const auto recursion = Contains(HasSubstr("flow-recursion"));
  EXPECT_THAT(problemsOf("fanuc-0m", program("G0 X1.\n")), recursion);
  EXPECT_THAT(problemsOf("fanuc-0m", program("(SHIFT, NO GOTO, NO WHILE)\nG0 X1.\n")), recursion);
  EXPECT_THAT(problemsOf("fanuc-0m", "O0001\nG90 G17 G21 G54\n#500=0\nM98 P9100\nM30\nO9100\n"
                                     "#500=#500+1\nIF[#500GT1]GOTO10\nM98 P9100\nN10 M99\n"),
              Not(recursion));
}

const std::string otherLanguage = "N10 G54 G17 G71 G90 G94\nN20 T1 D1 M6\nG291\n";

/// What follows an end in another language is reached only where a jump may pass the end.
TEST(ReferenceReading, EndsInAnotherLanguageArePassedByJumpsAlone) {
  const auto unreachable = Contains(HasSubstr("flow-unreachable-block"));
  const std::string end = "M30\nX10\nX20\nX30\n";
  EXPECT_THAT(problemsOf("sinumerik", otherLanguage + "X5 ; NO GOTO HERE\n" + end), unreachable);
  EXPECT_THAT(problemsOf("sinumerik", otherLanguage + "IF[#1EQ1]GOTO10\n" + end), Not(unreachable));
}

/// A long text in another language: whether it jumps is found out once.
TEST(ReferenceReading, LongTextsInAnotherLanguageCostInProportion) {
  std::string program = otherLanguage;
  for (unsigned i = 0; i < 200'000; ++i)
    program += "X1\n";
  EXPECT_THAT(problemsOf("sinumerik", program + "G290\nM30\n"),
              Not(Contains(HasSubstr("flow-unreachable-block"))));
}

/// A move runs on while a value is read, unless the control is told to wait by a code.
TEST(ReferenceReading, CommentsDoNotMakeTheControlWait) {
  const auto program = [](const std::string &line) {
    return "N10 G54 G17 G71 G90 G94\nN20 T1 D1 M6\nN30 S2000 M3\nN40 G0 X0 Y0\nN50 Z5\n"
           "N60 G1 X50 F100\n" +
           line + "N70 R1=$AA_IW[X]\nN200 G0 Z50 M5\nN210 M30\n";
  };
  const auto early = Contains(HasSubstr("variable-read-ahead"));
  const auto all = [](const Dialect &) { return RuleSelection::everything(); };
  EXPECT_THAT(problemsOf("sinumerik", program("R2=1 ; NO STOPRE HERE\n"), all), early);
  EXPECT_THAT(problemsOf("sinumerik", program("STOPRE\n"), all), Not(early));
}

/// A program of the project hides a cycle where the file declares it, not where a comment does.
TEST(ReferenceReading, DeclarationsInCommentsDeclareNothing) {
  const std::string head = "N10 G54 G17 G71 G90 G94\nN20 T1 D1 M6\nN30 S2000 M3\n"
                           "N40 G0 X0 Y0\nN50 Z50\n";
  const std::string call = head + "N60 CYCLE81(5)\nN70 G0 Z50 M5\nN80 M30\n";
  EXPECT_THAT(problemsOf("sinumerik", "EXTERN CYCLE81(REAL)\n" + call),
              Not(Contains("7 cycle-missing-parameter")));
  EXPECT_THAT(problemsOf("sinumerik", "; EXTERN CYCLE81(REAL)\n" + call),
              Contains("7 cycle-missing-parameter"));
}

} // namespace
} // namespace ncvet
