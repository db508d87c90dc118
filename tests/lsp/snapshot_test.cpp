// A snapshot of a document: its blocks, and the block that holds a place.
#include "tests/support/marked_text.h"

#include "gtest/gtest.h"

namespace {

using namespace ncvet;

TEST(Snapshot, ABlockIsFoundFromAnyPlaceInIt) {
  const auto text = test::markedText("haas-mill", "O1\nG00 X<|>10.\nG01 Y5. F100.<|>\nM30\n");
  Block block;
  text->readAt(text.marks[0], block);
  ASSERT_EQ(block.words.size(), 2u);
  EXPECT_EQ(block.words[1].value(), 10);
  text->readAt(text.marks[1], block);
  EXPECT_EQ(block.words.size(), 3u);
  EXPECT_EQ(text->blocks().size(), 4u);
}

TEST(Snapshot, ABlockOfManyLinesIsOne) {
  const auto text = test::markedText("mefi", "N10 G0 X10\n   Z<|>5\nN20 M30\n");
  Block block;
  text->readAt(text.marks[0], block);
  EXPECT_EQ(block.number, 10);
  EXPECT_EQ(block.words.size(), 3u);
}

} // namespace
