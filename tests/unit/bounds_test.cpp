// Texts that nobody would write, and that somebody half types: each of them is checked in a time
// that grows with its length. Where a quadratic check would take minutes, some seconds are allowed.
#include "analyzer/trace/trace.h"
#include "formats/text/program_file.h"
#include "tests/support/run_program.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace ncvet {
namespace {

/// Seconds of this thread's processor time, so that a busy machine does not matter.
double secondsOf(llvm::function_ref<void()> work) {
  timespec begin{}, end{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begin);
  work();
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
  return double(end.tv_sec - begin.tv_sec) + double(end.tv_nsec - begin.tv_nsec) * 1e-9;
}

/// What a check of the text finds, and whether it came to its end.
AnalysisResult check(const char *dialect, const std::string &text,
                     const AnalysisLimits &limits = {}) {
  AnalysisResult result;
  test::withProgram(dialect, {{"PART.nc", text}}, "", [&](Project &project, FileUnit &unit) {
    result = analyze(project, unit, RuleSelection::defaults(project.dialect()), limits);
  });
  return result;
}

double secondsToCheck(const char *dialect, const std::string &text) {
  return secondsOf([&] { check(dialect, text); });
}

std::string repeat(const std::string &text, unsigned times) {
  std::string all;
  for (unsigned i = 0; i < times; ++i)
    all += text;
  return all;
}

/// Generous: with sanitizers a check takes ten times as long.
constexpr double generous = 10;

TEST(Bounds, LoopsInsideLoopsCostInProportion) {
  constexpr unsigned deep = 40'000;
  EXPECT_LT(secondsToCheck("sinumerik", repeat("LOOP\n", deep) + repeat("ENDLOOP\n", deep)),
            generous);
}

TEST(Bounds, BracketsWithLabelsCostInProportion) {
  constexpr unsigned deep = 20'000;
  std::string subs, ends, loops;
  for (unsigned i = 1; i <= deep; ++i) {
    subs += "o" + std::to_string(i) + " sub\n";
    ends += "o" + std::to_string(deep + 1 - i) + " endsub\n";
    loops += "o" + std::to_string(i) + " while [#<_x> gt 1]\n";
  }
  EXPECT_LT(secondsToCheck("linuxcnc", subs + ends + "M2\n"), generous);
  EXPECT_LT(secondsToCheck("linuxcnc", loops + "M2\n"), generous);
}

/// What a rule finds out of a whole program it finds out once, not at each change.
TEST(Bounds, AProgramOfManyToolChangesIsFollowedToItsEnd) {
  constexpr unsigned changes = 1'500;
  const std::string turned = "T0202\nG0 X20. Z1.\nG1 Z-10. F.1\nG1 X24.\nT0101\nG0 X25. Z-9.\n";
  for (const char *dialect : {"fanuc-lathe", "fanuc-0t", "haas-lathe", "haas-ngc-lathe"})
    EXPECT_TRUE(check(dialect, "%\nO1\nG21 G40 G99 G54\nG97 S1000 M3\n" + repeat(turned, changes) +
                                   "M30\n%\n")
                    .complete)
        << dialect;
  const std::string milled = "T1 M6\nG43 H1 Z9.\nG0 X0 Y0\nG1 Z-1. F100.\nG0 Z9.\n";
  for (const char *dialect : {"fanuc-mill", "haas-mill", "linuxcnc"})
    EXPECT_TRUE(
        check(dialect, "%\nO1\nG21 G90 G54 S1000 M3\n" + repeat(milled, changes) + "M30\n%\n")
            .complete)
        << dialect;
}

TEST(Bounds, AProgramOfManyCyclesBelowZeroIsFollowedToItsEnd) {
  const std::string drilled = "G98 G81 X1. Y0. Z-5. R-1. F100.\nG80\n";
  for (const char *dialect : {"fanuc-mill", "haas-mill"})
    EXPECT_TRUE(check(dialect, "%\nO1\nG21 G90 G54 S1000 M3\nT1 M6\nG43 H1 Z50.\n" +
                                   repeat(drilled, 10'000) + "M30\n%\n")
                    .complete)
        << dialect;
}

TEST(Bounds, AProgramOfManyFeedModesIsFollowedToItsEnd) {
  constexpr unsigned changes = 1'500;
  const std::string cut = "G94\nX80 F120\nZ2\nG95\nX20\nG0 Z100\nG1 Z-4\n";
  EXPECT_TRUE(check("sinumerik", "G54 G17 G71 G90 G94\nT4 D1 M6\nS1800 M3\nG1 X0 F100\n" +
                                     repeat(cut, changes) + "M30\n")
                  .complete);
}

TEST(Bounds, AProgramOfManyTappingToolsIsFollowedToItsEnd) {
  constexpr unsigned tools = 2'000;
  const std::string tapped =
      "T1 M6 (TAP M8)\nS500 M3\nG0 X0 Y0 Z5.\nG84 Z-9. R2. F625.\nX9.\nG80\n";
  for (const char *dialect : {"haas-mill", "fanuc-mill"})
    EXPECT_TRUE(
        check(dialect, "%\nO1\nG21 G90 G94 G54\n" + repeat(tapped, tools) + "M30\n%\n").complete)
        << dialect;
}

TEST(Bounds, AProgramOfManyRoughedContoursIsFollowedToItsEnd) {
  constexpr unsigned contours = 1'000;
  std::string roughed;
  for (unsigned i = 1; i <= contours; ++i) {
    const std::string first = std::to_string(2 * i), last = std::to_string(2 * i + 1);
    roughed += "G0 X50. Z2.\nG71 U1. R.5\nG71 P" + first + " Q" + last + " U.2 W.1 F.2\nN" + first +
               " G0 X20.\nN" + last + " G1 Z-20.\n";
  }
  for (const char *dialect : {"fanuc-lathe", "haas-lathe"})
    EXPECT_TRUE(
        check(dialect, "%\nO1\nG21 G99\nT0101\nG97 S800 M3\n" + roughed + "M30\n%\n").complete)
        << dialect;
}

TEST(Bounds, AProgramOfManyGroovesIsFollowedToItsEnd) {
  constexpr unsigned many = 20'000;
  const std::string turned = "G00 X44. Z3.\nX36.\nG01 Z-30. F0.2\nX44.\n";
  const std::string groove = "G00 X40. Z-15.\nG01 X30. F0.06\nG00 X40.\nX150. Z120.\n";
  const auto text = [&](const std::string &grooves) {
    return "O2102 (COLLAR)\nG21 G40 G97 G99\nT0202\nS500 M03\n" + turned + grooves + "M30\n";
  };
  EXPECT_LT(secondsToCheck("fanuc-lathe", text(repeat(groove, many))), generous);
  EXPECT_LT(secondsToCheck("fanuc-lathe", text(repeat(turned + groove + "M00\n", many))), generous);
}

/// They are entered with other places where the tool has cut each time, at which none of them
/// looks.
TEST(Bounds, ManyProgramsThatCallOthersAreFollowedToTheirEnd) {
  constexpr unsigned many = 300, calls = 10;
  std::string text;
  for (unsigned i = 0; i < many; ++i) {
    text += "O" + std::to_string(1000 + i) + "\nG90 G21\nG1 X" + std::to_string(i * 7 % 50) +
            ". Y" + std::to_string(i * 11 % 50) + ". F200.\n";
    for (unsigned call = 0; call < calls && i + 1 < many; ++call)
      text += "M98 P" +
              std::to_string(1001 + i + (i * 31 + call * call * 17 + call) % (many - i - 1)) + "\n";
    text += "M99\n";
  }
  EXPECT_LT(secondsOf([&] { EXPECT_TRUE(check("fanuc-mill", text).complete); }), generous);
}

TEST(Bounds, AFileOfManyMacrosIsFollowedToItsEnd) {
  constexpr unsigned many = 2'000;
  std::string calls, macros;
  for (unsigned i = 1; i <= many; ++i) {
    const std::string number = std::to_string(1000 + i);
    calls += "G65 P" + number + " X1. Z-2.\nG65 P" + number + " X1.\n";
    macros += "O" + number + "\nG00 X#24\nG01 Z#26 F100.\nM99\n";
  }
  EXPECT_LT(secondsToCheck("fanuc-mill", "O0001 (MANY)\nG21 G90 G94\n" + calls + "M30\n" + macros),
            generous);
}

TEST(Bounds, AProgramOfManyDefinitionsIsFollowedToItsEnd) {
  constexpr unsigned variables = 3'000;
  std::string defined;
  for (unsigned i = 0; i < variables; ++i)
    defined += "DEF INT COUNT_" + std::to_string(i) + "\n";
  EXPECT_TRUE(check("sinumerik", defined + "G0 X0\nM30\n").complete);
}

TEST(Bounds, ManyNamesThatAreAlmostDefinedCostInProportion) {
  constexpr unsigned many = 6'000;
  std::string defined, used;
  for (unsigned i = 0; i < many; ++i) {
    std::string name;
    for (unsigned rest = i, k = 0; k < 4; ++k, rest /= 10)
      name += char('A' + 2 * (rest % 10));
    defined += "DEF REAL WEG" + name + "QQ\n";
    used += "R1=WEG" + name + "QX\n";
  }
  const std::string text = defined + "N1 G54 G17 G90\n" + used + "M30\n";
  EXPECT_LT(secondsToCheck("sinumerik", text), generous);
  EXPECT_LT(secondsToCheck("sinumerik", "PROC PART\n" + defined + used + "M17\n"), generous);
}

/// An editor checks at every key: here a repeat whose last number is still to be typed.
TEST(Bounds, AHalfTypedRepeatIsNoHang) {
  EXPECT_LT(secondsToCheck("ecs", "N80 G1 X10 Y10 F100\nN20 G1 X20\n<RPT:N80;N\nN90 G0 X0\n"),
            generous);
}

TEST(Bounds, ABlockOfThousandsOfWordsIsNone) {
  const AnalysisResult result = check("fanuc-0m", "O1\nG0 X0\n" + repeat("M3", 20'000) + "\nM30\n");
  const auto isTold = [](const Finding &finding) {
    return allRules()[finding.rule].info.id == "syntax-error";
  };
  EXPECT_EQ(1, llvm::count_if(result.findings, isTold));
  EXPECT_LT(secondsToCheck("sinumerik", repeat("A:", 500'000) + "\nM30\n"), generous);
  EXPECT_LT(secondsToCheck("fanuc-0m", "O1\n" + repeat("(A)", 500'000) + "\nM30\n"), generous);
  EXPECT_LT(secondsToCheck("fanuc-0m", "O1\n" + repeat("((A)", 100'000) + "\nM30\n"), generous);
}

TEST(Bounds, AMessageQuotesALineOfATerminal) {
  const std::string sum = "[1" + repeat("+1", 100'000) + "/0]";
  for (const Finding &finding : check("fanuc-0m", "O1\nG0 X" + sum + "\nM30\n").findings)
    EXPECT_LT(finding.message.size(), 1'100u);
}

/// The motions of a cycle count: without the limit it would be three million of them.
TEST(Bounds, MotionsOfCyclesAreWork) {
  struct Counter : TraceSink {
    void moved(const TracedMove &) override { ++moves; }
    void lost(const FileUnit &, SourceRange, llvm::StringRef) override { isLost = true; }
    uint64_t moves = 0;
    bool isLost = false;
  } counter;
  const std::string text = "O1\nG21 G17 G90 G54\nT1 M6\nG0 X0 Y0\nG43 H1 Z50. S1000 M3\n#1=0\n"
                           "WHILE [#1 LT 1000] DO1\n"
                           "G99 G83 X#1 Y0. Z-1000. R1. Q1. F100\n"
                           "#1=#1+1\nEND1\nG80\nM30\n";
  AnalysisLimits limits;
  limits.repeatedBlocks = 30'000;
  test::withProgram("fanuc-0m", {{"PART.nc", text}}, "", [&](Project &project, FileUnit &unit) {
    trace(project, unit, limits, counter, TracedPath::Programmed);
  });
  EXPECT_TRUE(counter.isLost);
  EXPECT_GT(counter.moves, limits.repeatedBlocks / 2);
  EXPECT_LT(counter.moves, 4 * limits.repeatedBlocks);
}

/// A program's work is counted and not timed: what is cut is cut at the same block every time.
TEST(Bounds, WhatIsCutIsCutAtTheSameBlock) {
  AnalysisLimits limits;
  limits.repeatedBlocks = 10'000;
  const std::string text = "O1\nG21 G17 G90\n#1=0\nWHILE [#1 LT 900000] DO1\n#1=#1+1\n"
                           "IF [#1 EQ 5000] THEN #2=1\nEND1\nG1 X[1/0]\nM30\n";
  const AnalysisResult first = check("fanuc-0m", text, limits);
  const AnalysisResult second = check("fanuc-0m", text, limits);
  EXPECT_FALSE(first.complete);
  EXPECT_EQ(first.cuts, second.cuts);
  EXPECT_EQ(first.findings.size(), second.findings.size());
}

std::string textOf(const std::string &path, uint64_t most) {
  auto text = readWholeFile(path, most);
  return text ? (*text)->getBuffer().str() : "error: " + llvm::toString(text.takeError());
}

TEST(ReadWholeFile, APipeIntoWhichNothingWritesIsToldAtOnce) {
  const test::TemporaryFolder folder;
  const std::string pipe = (folder.path() / "pipe").string();
  ASSERT_EQ(0, mkfifo(pipe.c_str(), 0600));
  EXPECT_EQ("error: it is a pipe into which nothing writes", textOf(pipe, 100));
}

TEST(ReadWholeFile, APipeThatIsWrittenToIsRead) {
  const test::TemporaryFolder folder;
  const std::string pipe = (folder.path() / "pipe").string();
  ASSERT_EQ(0, mkfifo(pipe.c_str(), 0600));
  const int both = ::open(pipe.c_str(), O_RDWR); // so that it has a writer from the beginning
  ASSERT_GE(both, 0);
  ASSERT_EQ(3, ::write(both, "M30", 3));
  std::thread closer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ::close(both);
  });
  EXPECT_EQ("M30", textOf(pipe, 100));
  closer.join();
}

TEST(ReadWholeFile, DevicesFoldersAndWhatIsTooLargeAreNoFiles) {
  const test::TemporaryFolder folder;
  EXPECT_EQ("error: it is not a regular file", textOf("/dev/zero", 100));
  EXPECT_EQ("error: it is a folder", textOf(folder.path().string(), 100));
  const std::string file = (folder.path() / "a").string();
  std::ofstream(file) << "12345";
  EXPECT_EQ("12345", textOf(file, 5));
  EXPECT_EQ("error: it is too large", textOf(file, 4));
}

} // namespace
} // namespace ncvet
