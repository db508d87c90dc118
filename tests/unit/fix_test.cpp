// Fixes: applying all safe ones gives no new finding, but advice where a mistake is mended, and a
// second time changes nothing.
#include "analyzer/check/fix.h"
#include "tests/support/rule_pages.h"

#include "llvm/Support/FileSystem.h"
#include <gtest/gtest.h>

namespace ncvet::test {
namespace {

Session sessionFor(const PageProgram &program) {
  SessionOptions options;
  options.dialect = program.dialect;
  options.profile = "all";
  if (!program.machine.empty())
    options.machine = MachineSource{"machine.json", program.machine};
  return Session(std::move(options));
}

struct Found {
  std::map<RuleId, unsigned> mistakes, advice; ///< errors and warnings by rule, and the others
  bool fixable = false;                        ///< one of them has a fix

  unsigned mistakesInAll() const {
    unsigned all = 0;
    for (const auto &[rule, count] : mistakes)
      all += count;
    return all;
  }
};

void expectNoMore(const std::map<RuleId, unsigned> &before, const std::map<RuleId, unsigned> &after,
                  const std::string &text) {
  for (const auto &[rule, count] : after) {
    const auto old = before.find(rule);
    EXPECT_LE(count, old == before.end() ? 0 : old->second)
        << allRules()[rule].info.id.str() << "\n"
        << text;
  }
}

Found check(Session &session, const std::string &text) {
  SourceSet sources;
  const FileOutcome outcome = checkFile(session, sources, sources.add("a.nc", text));
  EXPECT_EQ("", outcome.error);
  Found found;
  for (const CheckedFinding &checked : outcome.findings) {
    ++(checked.finding.severity == Severity::Style ? found.advice
                                                   : found.mistakes)[checked.finding.rule];
    found.fixable |= checked.finding.fix.has_value();
  }
  return found;
}

std::string fixed(Session &session, const std::string &text, bool unsafe) {
  SourceSet sources;
  return fixText(session, sources.add("a.nc", text), unsafe).text;
}

class FixLaws : public ::testing::TestWithParam<PageProgram> {};

TEST_P(FixLaws, NoNewFindingAndNothingLeftForASecondTime) {
  const PageProgram &program = GetParam();
  Session session = sessionFor(program);
  const std::string &text = program.files[0].text;
  const Found before = check(session, text);
  if (!before.fixable)
    return; // most programs, and some loop until the analysis gives up
  for (const bool unsafe : {false, true}) {
    const std::string once = fixed(session, text, unsafe);
    if (once == text)
      continue;
    const Found after = check(session, once);
    expectNoMore(before.mistakes, after.mistakes, once);
    if (after.mistakesInAll() == before.mistakesInAll())
      expectNoMore(before.advice, after.advice, once);
    EXPECT_EQ(once, fixed(session, once, unsafe));
  }
}

std::vector<PageProgram> programsOfOneFile() {
  std::vector<PageProgram> programs;
  for (PageProgram &program : allPagePrograms())
    if (program.files.size() == 1 && program.problem.empty())
      programs.push_back(std::move(program));
  return programs;
}

INSTANTIATE_TEST_SUITE_P(Pages, FixLaws, ::testing::ValuesIn(programsOfOneFile()),
                         [](const auto &info) { return info.param.name(); });

Session sessionOf(const char *dialect, std::vector<std::string> select) {
  SessionOptions options;
  options.dialect = dialect;
  options.rules.select = std::move(select);
  return Session(std::move(options));
}

size_t timesIn(llvm::StringRef part, const std::string &text) {
  return llvm::StringRef(text).count(part);
}

/// A finding in a called program is mended there, and not at the same place of the text that calls
/// it.
TEST(FixPromises, AFixIsInTheFileOfItsFinding) {
  const std::vector<ProgramFile> files = {
      {"O0001.nc", "%\nO0001 (PLATE)\nG21 G90 G54\nT1 M06\nG00 X20. Y20. S900 M03\n"
                   "G43 H1 Z5. M08\nM98 P1000\nG00 Z50. M09\nM30\n%\n"},
      {"O1000.nc", "%\nO1000\nG00 X-75 Y-75 Z5.\nG01 Z-1. F100\nX75.\nM99\n%\n"}};
  withProgram("fanuc-mill", files, "", [](Project &project, FileUnit &unit) {
    const AnalysisResult result = analyze(project, unit, RuleSelection::defaults(*unit.dialect));
    for (const Finding &finding : result.findings) {
      if (!finding.fix)
        continue;
      for (const TextEdit &edit : finding.fix->edits)
        EXPECT_EQ(finding.range.file, edit.range.file) << finding.message;
    }
  });
}

TEST(FixPromises, OfTwoValuesOfAnAddressNoneIsDeleted) {
  Session session = sessionOf("fanuc-0m", {"block-duplicate-address"});
  const std::string feeds = "O1\nG1 X1. F.00 F.0086\nM30\n",
                    depths = "O1\nG0 Z-1.375 G01 Z-1.365 F50.\nM30\n";
  EXPECT_EQ(feeds, fixed(session, feeds, /*unsafe=*/true));
  EXPECT_EQ(depths, fixed(session, depths, /*unsafe=*/true));
  EXPECT_EQ("O1\nG1 X1. F50.\nM30\n", fixed(session, "O1\nG1 X1. F50. F50.\nM30\n", false));
}

TEST(FixPromises, ABlockIsPutAfterTheNumberToWhichAJumpLeads) {
  Session session = sessionOf("fanuc-mill", {"cycle"});
  const auto program = [](const std::string &block) {
    return "%\nO1\nG17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S900 M3\nG43 H1 Z5.\n"
           "G81 X10. Y10. Z-5. R2. F100.\nIF [#500 EQ 1] GOTO 100\nX20.\nG0 G80 Z50.\n" +
           block + "\nG54 G0 X0. Y0. S900 M3\nG43 H1 Z5.\nG0 Z50.\nM30\n%\n";
  };
  EXPECT_EQ(program("N100 G80\nT1 M6"), fixed(session, program("N100 T1 M6"), /*unsafe=*/true));
  const auto called = [](const std::string &block) {
    return "%\nO1\nG17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S900 M3\nG43 H1 Z5.\n"
           "G81 X10. Y10. Z-5. R2. F100.\nM98 P100\nM30\nO100 " +
           block + "\nM99\n%\n";
  };
  EXPECT_EQ(called("G80\nT1 M6"), fixed(session, called("T1 M6"), /*unsafe=*/true));
  // A block that may be skipped becomes two that may be skipped alone: nothing is offered.
  EXPECT_EQ(program("/N100 T1 M6"), fixed(session, program("/N100 T1 M6"), /*unsafe=*/true));
}

TEST(FixPromises, ACycleIsEndedOnceForAllThatItCauses) {
  Session session = sessionOf("fanuc-0m", {"cycle"});
  const std::string bore =
      "O1200\nG21 G17 G40 G49 G80 G90 G94\nT3 M6\nG54 G0 X-20. Y-15. S1400 M3\n"
      "G43 H3 Z50.\nG98 G83 X-20. Y-15. Z-22. R2. Q5. F120.\nX20. Y-15.\n"
      "X30. Y0. (TO CLAMP)\nM9\nM5\nG49\nT5 M6\nG54 G0 X0. Y0. S900 M3\n"
      "G43 H5 Z50.\nM30\n";
  const std::string once = fixed(session, bore, /*unsafe=*/true);
  EXPECT_EQ(2u, timesIn("G80", once)) << once;
  EXPECT_NE(std::string::npos, once.find("G80\nX30. Y0. (TO CLAMP)")) << once;
}

TEST(FixPromises, AMistakeIsMendedThoughTheTextThenDeservesAdvice) {
  Session session = sessionOf("fanuc-0m", {});
  const std::string bore =
      "%\nO1200\nG21 G17 G40 G49 G80 G90 G94\nT3 M6\nG54 G0 X-20. Y-15. S1400 M3\n"
      "G43 H3 Z50.\nG98 G83 X-20. Y-15. Z-22. R2. Q5. F120.\nX20. Y-15.\nX20. Y15.\n"
      "X30. Y0. (TO CLAMP)\nM9\nM5\nG49\nT5 M6\nG54 G0 X0. Y0. S900 M3\n"
      "G43 H5 Z50.\nM5\nG49\nM30\n%\n";
  const std::string once = fixed(session, bore, /*unsafe=*/true);
  EXPECT_NE(std::string::npos, once.find("G80\nX30. Y0. (TO CLAMP)")) << once;
  EXPECT_EQ(0u, check(session, once).mistakesInAll()) << once;
}

TEST(FixPromises, ACycleThatACallerGoesOnWithIsNotEnded) {
  Session session = sessionOf("fanuc-0m", {"cycle"});
  const std::string text = "O1\nG21 G17 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S500 M3\n"
                           "G43 H1 Z50.\nM98 P2\nX30. Y0.\nX40. Y0.\nG80\nG0 Z100.\nM30\n"
                           "O2\nG98 G83 X10. Y0. Z-10. R2. Q2. F100.\nX20. Y0.\nM99\n";
  EXPECT_EQ(1u + 1u, timesIn("G80", fixed(session, text, /*unsafe=*/true)));
}

TEST(FixPromises, WhatDoesNotMendItsFindingIsNotDoneAgainAndAgain) {
  Session session = sessionOf("linuxcnc", {"modal-coolant-left-on"});
  const std::string text = "G21 G90 G54\nS500 M3\nM7\nG0 X1\nM9\nM5\nM2\n";
  EXPECT_EQ(text, fixed(session, text, /*unsafe=*/true));
}

TEST(FixPromises, ASubprogramInBracketsReturnsByItsOwnName) {
  Session session = sessionOf("linuxcnc", {"flow-program-end-in-subprogram"});
  const std::string text = "o<pocket> sub\nG0 Z5\nM2\no<pocket> endsub\n"
                           "G21 G90 G17\no<pocket> call\nM2\n";
  EXPECT_NE(
      std::string::npos,
      fixed(session, text, /*unsafe=*/true).find("G0 Z5\no<pocket> return\no<pocket> endsub"));
}

TEST(FixPromises, ATextWhoseControlIsAGuessIsLeftAlone) {
  Session session = sessionOf("auto", {"style-lower-case"});
  SourceSet sources;
  const FixedText result = fixText(session, sources.add("a.nc", "g0 x1\ng1 x2\n"), /*unsafe=*/true);
  EXPECT_TRUE(result.unsureControl);
  EXPECT_EQ("g0 x1\ng1 x2\n", result.text);
}

TEST(FixPromises, AMotionModeIsWrittenAsTheMessageSaysIt) {
  size_t count = 0;
  for (const PageProgram &program : allPagePrograms()) {
    if (program.rule != "motion-mode-not-set" || !program.wrong || program.files.size() != 1)
      continue;
    Session session = sessionFor(program);
    SourceSet sources;
    for (const CheckedFinding &checked :
         checkFile(session, sources, sources.add("a.nc", program.files[0].text)).findings) {
      const Finding &finding = checked.finding;
      const auto [before, after] = llvm::StringRef(finding.message).split("it runs as `");
      if (after.empty() || !finding.fix)
        continue;
      EXPECT_EQ((after.split('`').first + " ").str(), finding.fix->edits[0].text);
      ++count;
    }
  }
  EXPECT_GT(count, 0u);
}

TEST(FixPromises, ProgramsWithoutBlanksGetNone) {
  Session session = sessionOf("fanuc-0m", {"coordinate-work-offset-not-set"});
  const std::string compact =
      fixed(session, "O1\nG21G17G90\nT1M6\nG0X0.Y0.\nM30\n", /*unsafe=*/true);
  EXPECT_NE(std::string::npos, compact.find("G0G54X0.Y0.")) << compact;
}

TEST(FixText, CalledProgramsAreThoseOfTheEditor) {
  TemporaryFolder folder;
  const std::string main = (folder.path() / "main.nc").string(),
                    called = (folder.path() / "O0002.nc").string();
  std::ofstream(called) << "O2\nG54\nM99\n";
  SessionOptions options;
  options.dialect = "haas-mill";
  options.profile = "all";
  Session session(std::move(options));
  SourceSet sources;
  const SourceFile &file =
      sources.add(main, llvm::StringRef("O1\nG90 G21 G17\nM98 P2\nG00 X1. Y1.\nM30\n"), main);
  const auto open = std::make_shared<SourceSet::Overlay>();
  (*open)[called] = std::make_shared<const std::string>("O2\nM99\n");
  const auto writesOffset = [](const FixedText &fixed) {
    return fixed.text.find("G54") != std::string::npos;
  };
  EXPECT_FALSE(writesOffset(fixText(session, file, /*unsafe=*/true)));
  EXPECT_TRUE(writesOffset(fixText(session, file, /*unsafe=*/true, open)));
}

TEST(ReplaceFile, KeepsLinksAndPermissions) {
  TemporaryFolder folder;
  const std::string file = (folder.path() / "a.nc").string(),
                    link = (folder.path() / "link.nc").string();
  std::ofstream(file) << "M30\n";
  std::filesystem::create_symlink(file, link);
  std::filesystem::permissions(file, std::filesystem::perms(0640));
  ASSERT_FALSE(llvm::errorToBool(replaceFile(link, "M5\r\nM30\r\n")));
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(std::filesystem::perms(0640), std::filesystem::status(file).permissions());
  std::ifstream in(file, std::ios::binary);
  EXPECT_EQ("M5\r\nM30\r\n", std::string(std::istreambuf_iterator<char>(in), {}));
  size_t files = 0;
  for ([[maybe_unused]] const auto &entry : std::filesystem::directory_iterator(folder.path()))
    ++files;
  EXPECT_EQ(2u, files); // nothing temporary stays
}

TEST(ReplaceFile, SaysWhatCannotBeWritten) {
  TemporaryFolder folder;
  EXPECT_EQ("cannot write " + (folder.path() / "none.nc").string() + ": No such file or directory",
            llvm::toString(replaceFile((folder.path() / "none.nc").string(), "M30\n")));
}

} // namespace
} // namespace ncvet::test
