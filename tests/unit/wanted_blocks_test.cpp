// The blocks that may hold what somebody looks for, found by what pieces of the text hold.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/wanted_blocks.h"
#include "formats/dialect/loader.h"
#include "formats/readers/select/make_reader.h"
#include "tests/support/random_edits.h"

#include "gtest/gtest.h"

namespace ncvet::test {
namespace {

/// A program of several tools with long rows of plain moves, and some numbers without a point.
std::string program() {
  std::string text = "%\nO1 (TOOLS)\n";
  for (unsigned tool = 1; tool < 9; ++tool) {
    text += "T" + std::to_string(tool) + " M6\nG0 X0. Y0. S900 M3\nG43 H" + std::to_string(tool) +
            " Z5.\n";
    for (unsigned i = 1; i < 900; ++i)
      text += "X" + std::to_string(i) + (i % 70 ? ".5" : "") + " Y2.\n";
  }
  return text + "M30\n%\n";
}

/// Offsets of the blocks that `holds`, of those from `from` on.
template <typename Range, typename Holds>
std::vector<uint32_t> offsetsOf(Range &&range, uint32_t from, const Holds &holds) {
  std::vector<uint32_t> offsets;
  for (const Block &block : range)
    if (block.begin >= from && holds(block))
      offsets.push_back(block.begin);
  return offsets;
}

struct Points {
  uint64_t with = 0, without = 0;
};

Points pointsOf(const FileIndex &index, AddressId address) {
  Points sum;
  index.eachPiece([&](const TextPiece &piece) {
    for (const TextPiece::Points &points : piece.points)
      if (points.address == address) {
        sum.with += points.with;
        sum.without += points.without;
      }
  });
  return sum;
}

/// What is found over `kept`, and what reading every block finds.
void compare(const SourceFile &source, const Dialect &dialect, FileScan &kept, uint32_t from) {
  const auto reader = makeReader(dialect, source.text());
  const FileIndex index(source, *reader, dialect, &kept);
  for (const ProgramInfo &program : index.programs()) {
    const auto all = [&] { return blocks(*reader, program.body, program.end); };
    const auto hasTool = [](const Block &block) { return block.has(letterAddress('T')); };
    EXPECT_EQ(
        offsetsOf(blocksWith(index, program, maskOf(letterAddress('T')), from), from, hasTool),
        offsetsOf(all(), from, hasTool));
    const auto starts = [&](const Block &block) {
      return findCode(dialect, block, {Action::SpindleCw, Action::ToolChange}) != nullptr;
    };
    EXPECT_EQ(
        offsetsOf(blocksNaming(index, program, dialect, {Action::SpindleCw, Action::ToolChange}), 0,
                  starts),
        offsetsOf(all(), 0, starts));
  }
  Points due;
  for (const Block &block : blocks(*reader))
    for (const Word &word : block.words)
      if (word.address == letterAddress('X') && word.isNumber()) {
        due.with += word.has(wordPoint) && word.value() == double(int64_t(word.value()));
        due.without += !word.has(wordPoint) && word.mantissa;
      }
  const Points points = pointsOf(index, letterAddress('X'));
  EXPECT_EQ(points.with, due.with);
  EXPECT_EQ(points.without, due.without);
}

TEST(WantedBlocks, AreThoseThatReadingEveryBlockFindsAlsoAfterEdits) {
  const auto dialect = llvm::cantFail(loadDialect("haas-mill", builtinDialects()));
  std::string text = program();
  FileScan kept;
  RandomEdits random(3, text);
  for (unsigned i = 0; i < 60; ++i) {
    const auto source = SourceFile::fromText(0, "a.nc", text);
    compare(*source, *dialect, kept, uint32_t(text.size() / 60 * i));
    ASSERT_FALSE(HasFailure()) << "edit " << i;
    const std::string next = random.next(text).applied(text);
    kept.edit(changeBetween(text, next), *SourceFile::fromText(0, "a.nc", next));
    text = next;
  }
}

/// Which pieces are known is no matter to what is counted.
TEST(WantedBlocks, CountTheSameWhateverIsKnown) {
  const auto dialect = llvm::cantFail(loadDialect("haas-mill", builtinDialects()));
  const auto source = SourceFile::fromText(0, "a.nc", program());
  const auto reader = makeReader(*dialect, source->text());
  const FileIndex index(*source, *reader, *dialect);
  const auto counted = [&] {
    workDone = 0;
    for (const Block &block :
         blocksWith(index, index.programs().front(), maskOf(letterAddress('T'))))
      if (const Word *tool = block.find('T'); tool && tool->value() == 5)
        break;
    return workDone;
  };
  const uint64_t first = counted();
  EXPECT_GT(first, 0u);
  EXPECT_EQ(counted(), first);
}

} // namespace
} // namespace ncvet::test
