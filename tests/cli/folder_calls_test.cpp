// Folders whose programs call one another: each is checked, what they call is followed once.
#include "tests/support/process.h"

#include "gtest/gtest.h"
#include "llvm/ADT/Twine.h"
#include <gmock/gmock.h>

namespace ncvet::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string nameOf(unsigned number) { return "O" + std::to_string(number) + ".nc"; }

/// A milling program that calls so many others, the first of them `next`.
std::string calling(unsigned number, unsigned next, unsigned calls, unsigned last, bool isMain) {
  std::string text = "O" + std::to_string(number) + "\n";
  if (isMain)
    text += "G21 G17 G40 G49 G80 G90 G54\nT1 M6\nS2000 M3\nG43 H1 Z50.\n";
  text += "G0 X0. Y0.\nZ5.\nG1 X" + std::to_string(number % 50) + ". F0\n";
  for (unsigned i = 0; i < calls && next + i <= last; ++i)
    text += "M98 P" + std::to_string(next + i) + "\n";
  return text + "G0 Z50.\n" + (isMain ? "M30\n" : "M99\n");
}

class FolderCallsTest : public ::testing::Test {
protected:
  std::string check(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"check", "--dialect", "fanuc-mill", "--format", "json"});
    arguments.push_back(".");
    return shop.run(arguments).out;
  }
  static size_t count(llvm::StringRef text, llvm::StringRef what) { return text.count(what); }

  Shop shop;
};

TEST_F(FolderCallsTest, WhatIsWrongInEachOfThemIsFoundWhateverTheThreadsDo) {
  constexpr unsigned programs = 120, first = 1000, last = first + programs - 1;
  for (unsigned i = first; i <= last; ++i)
    shop.file(nameOf(i), calling(i, i + 1, 6, last, i == first));
  const std::string alone = check({"--no-cache", "-j", "1"});
  EXPECT_EQ(programs, count(alone, "\"rule\":\"feed-not-positive\""));
  EXPECT_EQ(alone, check({"--no-cache", "-j", "4"}));
  EXPECT_EQ(alone, check({}));
  EXPECT_EQ(alone, check({})) << "what is known is the same";
}

TEST_F(FolderCallsTest, ProgramsThatCallEachOtherInACircleAreFound) {
  constexpr unsigned programs = 60, first = 1000, last = first + programs - 1;
  for (unsigned i = first; i <= last; ++i)
    shop.file(nameOf(i), calling(i, i == last ? first : i + 1, 1, last, false));
  const std::string found = check({"--no-cache"});
  EXPECT_EQ(programs, count(found, "\"rule\":\"feed-not-positive\""));
  EXPECT_EQ(programs, count(found, "\"rule\":\"flow-recursion\""));
  EXPECT_THAT(found, HasSubstr("\"rule\":\"flow-nesting-too-deep\""));
  EXPECT_EQ(found, check({"--no-cache", "-j", "1"}));
}

/// What one of them has followed from some state, the others need not follow from there.
TEST_F(FolderCallsTest, ManyProgramsThatCallOthersAreFollowedToTheirEnd) {
  constexpr unsigned programs = 150, calls = 8, first = 1000;
  for (unsigned i = 0; i < programs; ++i) {
    std::string text = "O" + std::to_string(first + i) + "\nG90 G21\nG1 X" +
                       std::to_string(i * 7 % 50) + ". Y" + std::to_string(i * 11 % 50) + ". F0\n";
    for (unsigned call = 0; call < calls && i + 1 < programs; ++call)
      text += "M98 P" +
              std::to_string(first + 1 + i + (i * 31 + call * call * 17) % (programs - i - 1)) +
              "\n";
    shop.file(nameOf(first + i), text + "M99\n");
  }
  const std::string alone = check({"--no-cache", "-j", "1"});
  EXPECT_EQ(programs, count(alone, "\"rule\":\"feed-not-positive\""));
  EXPECT_THAT(alone, Not(HasSubstr("\"complete\":false")));
  EXPECT_EQ(alone, check({"--no-cache", "-j", "4"}));
  EXPECT_EQ(alone, check({}));
  EXPECT_EQ(alone, check({})) << "what is known is the same";
}

/// Where something decides whether a program of the circle calls the next one, the calls may end.
TEST_F(FolderCallsTest, ProgramsThatMayCallEachOtherInACircleAreNone) {
  constexpr unsigned programs = 60, first = 1000, last = first + programs - 1;
  for (unsigned i = first; i <= last; ++i)
    shop.file(nameOf(i), "O" + std::to_string(i) + "\nG1 X1. F100.\n" +
                             (i == first + 50 ? "IF[#500GT0]GOTO9\n" : "") + "M98 P" +
                             std::to_string(i == last ? first : i + 1) + "\nN9 M99\n");
  EXPECT_THAT(check({"--no-cache"}), Not(HasSubstr("flow-recursion")));
}

TEST_F(FolderCallsTest, ASubprogramThatNobodyHereCallsIsFollowedIntoWhatItCalls) {
  shop.file("O1.nc", "O1\nG1 X10. F0\nM98 P2\nM99\n");
  shop.file("O2.nc", "O2\nM98 P3\nG91 G1 X5.\nG90\nM99\n").file("O3.nc", "O3\nG4 P100\nM99\n");
  const std::string before = check({});
  EXPECT_EQ(1u, count(before, "\"rule\":\"feed-not-positive\"")) << before;
  // A caller that is new, and one that is gone, change what the others rest on.
  shop.file("O4.nc", "O4\nG21 G17 G40 G49 G80 G90 G54\nT1 M6\nG43 H1 Z50.\nS0 M3\nM98 P2\nM30\n");
  EXPECT_EQ(check({}), check({"--no-cache"}));
  shop.file("O4.nc", "O4\nG21 G17 G40 G49 G80 G90 G54\nM30\n");
  EXPECT_EQ(check({}), check({"--no-cache"}));
}

TEST_F(FolderCallsTest, BlocksAfterACallThatEndsTheProgramAreNotReached) {
  shop.file("O1.nc", "O1\nG21 G17 G40 G49 G80 G90 G54\nM98 P2\nM30\n");
  shop.file("O2.nc", "O2\nM98 P3\nG1 X10. F0\nM99\n").file("O3.nc", "O3\nG4 P100\nM30\n");
  EXPECT_THAT(check({"--no-cache"}), Not(HasSubstr("feed-not-positive")));
}

TEST_F(FolderCallsTest, WhatTakesMoreMemoryThanItMayIsCutAndSaidSo) {
  shop.file("a.nc", "O1\n#1=0\nWHILE[#1LT3000]DO1\n#1=#1+1\nEND1\nM30\n");
  const ProcessResult cut = shop.run({"check", "--no-cache", "--memory", "1", "a.nc"});
  EXPECT_THAT(cut.err, HasSubstr("cut short, findings may be missing: it took more memory"));
  EXPECT_THAT(shop.run({"check", "--no-cache", "--memory", "4000", "a.nc"}).err,
              Not(HasSubstr("cut short")));
}

} // namespace
} // namespace ncvet::test
