// Shapes of blocks, by which rules say that blocks do not interest them.
#include "analyzer/rule/block_shape.h"
#include "formats/readers/select/make_reader.h"
#include "tests/support/rule_pages.h"

namespace ncvet::test {
namespace {

/// The shapes of the blocks of a program that is executed line by line.
std::vector<uint64_t> shapesOf(const std::string &text) {
  std::vector<uint64_t> shapes;
  withProgram("fanuc-0m", {{"part.nc", text}}, "", [&](Project &, FileUnit &unit) {
    MachineState state = initialState(*unit.dialect);
    Outcome outcome;
    Block block;
    for (uint32_t at = 0; at < unit.source.text().size(); at = block.next) {
      unit.reader->read(at, block);
      const MachineState before = state;
      unit.executor().execute(block, before, state, outcome);
      shapes.push_back(shapeOf(*unit.dialect, block, outcome));
    }
  });
  return shapes;
}

TEST(BlockShape, CoordinatesDoNotMakeAnother) {
  const auto line = shapesOf("G1 X1. Y2.\nG1 X-3.5 Y2.\nG1 X7 Y4.\n");
  EXPECT_EQ(line[0], line[1]);
  EXPECT_NE(line[1], line[2]) << "rules see a point that is missing";
  const auto arc = shapesOf("G2 X10. Y0. R5.\nG2 X20. Y0. R6.\nG2 X30. Y0. I5. J0.\n");
  EXPECT_EQ(arc[0], arc[1]);
  EXPECT_NE(arc[1], arc[2]);
}

TEST(BlockShape, AnyOtherNumberMakesAnother) {
  const auto shapes = shapesOf("G1 X1. F100.\nG1 X2. F100.\nG1 X3. F200.\n"
                               "G81 X1. Z-2. R1.\nG81 X2. Z-2. R1.\nG81 X3. Z-2. R2.\n");
  EXPECT_EQ(shapes[0], shapes[1]);
  EXPECT_NE(shapes[1], shapes[2]);
  EXPECT_NE(shapes[4], shapes[5]) << "R of a cycle is no coordinate of an arc";
}

TEST(BlockShape, WhatMoreDecidesHasNone) {
  for (const uint64_t shape : shapesOf("#1=3\nX#1\n/ X5.\nG1 X\xC3\xA4\n"))
    EXPECT_EQ(shape, 0u);
}

TEST(BlockShape, OnlyWhatWasLookedAtTellsModesApart) {
  withProgram("fanuc-0m", {{"part.nc", "G1\n"}}, "", [&](Project &, FileUnit &unit) {
    const MachineState one = initialState(*unit.dialect);
    MachineState two = one;
    two.speed = Interval::exactly(500);
    StateUse use;
    EXPECT_EQ(modesOf(use, one, one), modesOf(use, two, two));
    use.others |= bitOf(StatePart::Speed);
    EXPECT_NE(modesOf(use, one, one), modesOf(use, two, two));
    EXPECT_TRUE(coversModes(use));
    two = one;
    two.compensation = phaseOn;
    EXPECT_NE(modesOf({}, one, one), modesOf({}, one, two)) << "it is looked at without notice";
    two = one;
    two.origin.set(StatePart::Cycle, {unit.source.id(), 0, 1});
    two.origin.set(StatePart::Tool, {unit.source.id(), 1, 2});
    EXPECT_EQ(modesOf({}, one, one), modesOf({}, two, two));
    use.ages = bitOf(StatePart::Cycle);
    EXPECT_NE(modesOf(use, one, one), modesOf(use, two, two)) << "the cycle is older than the tool";
    EXPECT_TRUE(coversModes(use));
    use.otherOrigins = 1;
    EXPECT_FALSE(coversModes(use)) << "where things were set is no mode";
  });
}

} // namespace
} // namespace ncvet::test
