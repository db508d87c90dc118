// Reads blocks of MEFI programs: from one N to the next, over any number of lines.
#include "tests/support/read_blocks.h"

#include <gtest/gtest.h>

namespace ncvet {
namespace {

class MefiReading : public test::BlockReading {
protected:
  MefiReading() : BlockReading("mefi") {}
};

TEST_F(MefiReading, ABlockRunsToTheNextNOverLinesAndComments) {
  const auto blocks = blocksOf("N10 G81 F100\nR30=2 \" N20 is no block here\nR31=-15\nN X50\n");
  ASSERT_EQ(blocks.size(), 2u);
  EXPECT_EQ(blocks[0].number, 10);
  EXPECT_EQ(blocks[0].words.size(), 4u);
  EXPECT_EQ(blocks[0].comments.size(), 1u);
  EXPECT_EQ(blocks[1].number, -1);
  EXPECT_NE(blocks[1].find('X'), nullptr);
}

TEST_F(MefiReading, ABareNIsABlockAndALeadingCommentIsNone) {
  const auto blocks = blocksOf("\" flange\nN\nN10 M30\n");
  ASSERT_EQ(blocks.size(), 3u);
  EXPECT_EQ(blocks[0].kind, BlockKind::Empty);
  EXPECT_EQ(blocks[1].kind, BlockKind::Normal);
  EXPECT_TRUE(blocks[1].isEmpty());
}

TEST_F(MefiReading, AnAssignmentIsAWordAndAnItemAtTheSamePlace) {
  const auto blocks = blocksOf("N R31 = -15.5 CYC_COPY_PART = DRILL1");
  ASSERT_EQ(blocks.size(), 1u);
  const Block &block = blocks[0];
  ASSERT_EQ(block.items.size(), 2u);
  ASSERT_EQ(block.words.size(), 2u);
  EXPECT_EQ(block.words[0].address, variableAddress);
  EXPECT_EQ(block.words[0].value(), -15.5);
  EXPECT_EQ(block.words[0].offset, block.items[0].begin);
  EXPECT_EQ(block.keyOf(block.items[0].target), variableKey("r31"));
}

TEST_F(MefiReading, ACallHasItsArgumentsInOrder) {
  const auto blocks = blocksOf("N TRANSLATE(10,0,-5)");
  ASSERT_EQ(blocks.size(), 1u);
  ASSERT_NE(blocks[0].argument(3), nullptr);
  EXPECT_EQ(blocks[0].argument(3)->value(), -5);
  EXPECT_EQ(blocks[0].argument(4), nullptr);
  EXPECT_TRUE(blocks[0].has(keywordAddress));
}

TEST_F(MefiReading, NamesHideTheirLettersAndNumbersTheirSlips) {
  const auto blocks = blocksOf("N ENDPROGRAM\nN10 X1O0 R29=2,5 Y\n");
  ASSERT_EQ(blocks.size(), 2u);
  EXPECT_TRUE(blocks[0].has(keywordAddress));
  EXPECT_EQ(issuesOf(blocks[1]), (std::vector<SyntaxIssueKind>{SyntaxIssueKind::MalformedNumber,
                                                               SyntaxIssueKind::DecimalComma,
                                                               SyntaxIssueKind::MissingValue}));
}

TEST_F(MefiReading, ALetterOAmongDigitsAndASecondSignSpoilANumber) {
  for (const char *text :
       {"N10 S8OO", "N10 Y-3O", "N10 X--5", "N10 R31=--15", "N10 GO X5", "N10 X5 MO5", "N10 XO.5"})
    EXPECT_EQ(issuesOf(blocksOf(text)[0]), std::vector{SyntaxIssueKind::MalformedNumber}) << text;
  EXPECT_EQ(issuesOf(blocksOf("N10 GOTO")[0]), std::vector{SyntaxIssueKind::UnknownWord});
}

TEST_F(MefiReading, AParameterWithoutItsSignIsReadAsIfItHadOne) {
  for (const char *text : {"N10 R31-15", "N10 R31 -15"}) {
    const Block block = blocksOf(text)[0];
    EXPECT_EQ(issuesOf(block), std::vector{SyntaxIssueKind::MissingEquals}) << text;
    ASSERT_EQ(block.words.size(), 1u);
    EXPECT_EQ(block.words[0].value(), -15);
  }
  EXPECT_TRUE(blocksOf("N10 G2 X5 R31")[0].issues.empty()) << "the radius of an arc";
}

TEST_F(MefiReading, BeginningAnywhereReadsTheSameBlocks) {
  const auto blocks =
      blocksOf("\" a\nN PROGRAM\nN10 G0 X0 N20 X50\nN\nN30 CALLCYCLE(CYC_COPY)\nN M30");
  for (const Block &block : blocks) {
    Block again;
    reader_->read(block.begin, again);
    EXPECT_EQ(again.next, block.next);
    EXPECT_EQ(again.words.size(), block.words.size());
  }
  EXPECT_EQ(blocks.size(), 7u);
}

} // namespace
} // namespace ncvet
