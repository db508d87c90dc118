// The blocks that come next: through calls, returns and jumps, as far as the texts tell it.
#include "analyzer/facts/blocks_ahead.h"
#include "tests/support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncvet::test {
namespace {

using ::testing::ElementsAre;

/// The first block of the file that is not empty.
Block firstBlock(const FileUnit &unit) {
  Block block;
  block.next = unit.index.programs().front().body;
  do
    unit.index.read(block.next, block);
  while (block.isEmpty());
  return block;
}

/// The blocks after the first one of a program's body, and how the list ends: "end" where the
/// program does, "?" where nobody knows. More than ten are not read.
std::vector<std::string> after(const std::string &dialect, const std::vector<ProgramFile> &files) {
  std::vector<std::string> texts;
  withProgram(dialect, files, "", [&](Project &, FileUnit &unit) {
    Block block = firstBlock(unit);
    BlocksAhead ahead(unit, block);
    constexpr unsigned most = 10;
    while (texts.size() < most && ahead.next(block)) {
      const SourceRange range = ahead.range(block);
      texts.push_back(ahead.unit().source.text(range.begin, range.end).str());
    }
    if (texts.size() < most)
      texts.push_back(ahead.isOver() ? "end" : "?");
  });
  return texts;
}
std::vector<std::string> after(const std::string &dialect, const std::string &text) {
  return after(dialect, {{"O0001.nc", text}});
}

TEST(BlocksAhead, GoThroughCallsAndComeBack) {
  const std::vector<std::string> due = {"M98 P20", "G1 X1", "M99", "X2", "M30", "?"};
  EXPECT_EQ(due, after("fanuc-mill", "O1\nG0\nM98 P20\nX2\nM30\nO20\nG1 X1\nM99\n"));
  EXPECT_EQ(due, after("fanuc-mill", {{"O0001.nc", "O1\nG0\nM98 P20\n(back)\nX2\nM30\n"},
                                      {"O0020.nc", "O20\n\nG1 X1\nM99\n"}}));
  EXPECT_THAT(after("haas-mill", "O1\nG0\nM97 P5\nM30\nN5 X1\nM99\n"),
              ElementsAre("M97 P5", "X1", "M99", "M30", "?"));
  EXPECT_THAT(
      after("sinumerik", {{"MAIN.MPF", "G0\nPOCKET\nX2\nM30\n"}, {"POCKET.SPF", "G1 X1\nM17\n"}}),
      ElementsAre("POCKET", "G1 X1", "M17", "X2", "M30", "?"));
  EXPECT_THAT(after("ecs", {{"MAIN.ecs", "N5 G0\nN10 L<EDGE>\nN20 X2\nN30 M30\n"},
                            {"EDGE.ecs", "N10 G1 X1\nN20 <RET>\n"}}),
              ElementsAre("N10 L<EDGE>", "G1 X1", "<RET>", "X2", "M30", "?"));
}

TEST(BlocksAhead, ComeBackToTheBlockThatTheReturnNames) {
  EXPECT_THAT(after("fanuc-mill", "O1\nG0\nM98 P20\nX2\nN9 X3\nM30\nO20\nM99 P9\n"),
              ElementsAre("M98 P20", "M99 P9", "X3", "M30", "?"));
}

TEST(BlocksAhead, FollowPlainJumps) {
  EXPECT_THAT(after("fanuc-mill", "O1\nG0\nGOTO 9\nX2\nN9 X3\nM30\n"),
              ElementsAre("GOTO 9", "X3", "M30", "?"));
  EXPECT_THAT(after("sinumerik", {{"MAIN.MPF", "G0\nGOTOF ON\nX2\nON: X3\n#\n"}}).at(1), "X3");
}

TEST(BlocksAhead, EndWhereOnlyTheRunDecides) {
  for (const char *block : {"IF[#1 EQ 2]GOTO 9", "GOTO #1", "WHILE[#1 LT 2]DO1", "M98 P#1",
                            "M98 P77", "G66 P20", "M99"}) {
    SCOPED_TRACE(block);
    const std::string text = "O1\nG0\n" + std::string(block) + "\nX2\nN9 M30\nO20\nM99\n";
    EXPECT_EQ(std::vector<std::string>({block, "?"}), after("fanuc-mill", text));
  }
}

TEST(BlocksAhead, EndWhereASwitchLeavesACallOut) {
  EXPECT_THAT(after("fanuc-mill", "O1\nG0\n/M98 P20\nX2\nM30\nO20\nX1\nM99\n"),
              ElementsAre("M98 P20", "?"));
}

/// How often a program runs is not counted: after the first pass another may come.
TEST(BlocksAhead, EndWhereACallRepeats) {
  EXPECT_THAT(after("fanuc-mill", "O1\nG0\nM98 P20 L2\nX2\nM30\nO20\nX1\nM99\n"),
              ElementsAre("M98 P20 L2", "X1", "M99", "?"));
}

TEST(BlocksAhead, OfALoopWithoutEndAreBounded) {
  withProgram("fanuc-mill", {{"O0001.nc", "O1\nG0\nN1 GOTO 1\n"}}, "",
              [](Project &, FileUnit &unit) {
                Block block = firstBlock(unit);
                BlocksAhead ahead(unit, block);
                unsigned count = 0;
                while (ahead.next(block))
                  ++count;
                EXPECT_GT(count, 100U);
                EXPECT_LT(count, 100000U);
                EXPECT_FALSE(ahead.isOver());
              });
}

} // namespace
} // namespace ncvet::test
