// What is kept of a text from one version to the next is what a look at all of it finds.
#include "analyzer/program/file_scan.h"
#include "formats/dialect/loader.h"
#include "formats/readers/select/make_reader.h"
#include "tests/support/random_edits.h"

#include <gtest/gtest.h>

namespace ncvet {
namespace {

using test::RandomEdit;
using test::RandomEdits;

std::string seen(FileScan &scan, const SourceFile &source) {
  std::string all;
  for (const uint32_t line : scan.heads(source, "O%"))
    all += "head " + std::to_string(line) + "\n";
  for (const NumberedBlock &block : scan.numbers(source))
    all += "N" + std::to_string(block.number) + " " + std::to_string(block.offset) + "\n";
  for (const char c : {'(', ':'})
    for (const uint32_t place : *scan.places(source, c))
      all += c + std::to_string(place) + "\n";
  return all;
}

void editAndCompare(std::string text, unsigned seed) {
  FileScan kept;
  auto before = SourceFile::fromText(0, "a.nc", text);
  seen(kept, *before);
  RandomEdits edits(seed, text);
  for (unsigned i = 0; i < 300; ++i) {
    RandomEdit edit = edits.next(text);
    if (i % 9 == 0)
      edit.text += i % 2 ? "\nO7 (X: Y)\n/2 N40 G1" : "\rN5\r % :";
    const std::string next = edit.applied(text);
    const auto after = SourceFile::fromText(0, "a.nc", next);
    kept.edit(changeBetween(text, next), *after);
    FileScan fresh;
    ASSERT_EQ(seen(kept, *after), seen(fresh, *after))
        << "edit " << i << ": " << edit.begin << "-" << edit.end << " \"" << edit.text << "\"";
    text = next;
  }
}

TEST(FileScanTest, AChangeLeavesWhatAFreshLookFinds) {
  std::string text = "%\nO1 (A: B)\n";
  for (unsigned i = 1; i < 200; ++i)
    text += (i % 3 ? "N" + std::to_string(i * 10) + " " : "/ N 7") + " G1 X" + std::to_string(i) +
            (i % 20 ? "\n" : " (C)\n  o" + std::to_string(i) + "\n");
  for (unsigned seed = 0; seed < 4; ++seed)
    editAndCompare(text, seed);
}

TEST(FileScanTest, LinesMayEndWithACarriageReturnAlone) {
  std::string text = "%\rO1\r";
  for (unsigned i = 1; i < 100; ++i)
    text += "N" + std::to_string(i * 10) + " G1 X" + std::to_string(i) + "\r";
  for (unsigned seed = 0; seed < 4; ++seed)
    editAndCompare(text, seed);
}

/// Where few blocks hold more than words, only these and a few beside them must be read.
TEST(FileScanTest, AnMCodeMakesLittleOfItsNeighboursUnplain) {
  std::string text = "O1\n";
  for (unsigned i = 1; i < 2000; ++i)
    text += i % 400 ? "G1 X" + std::to_string(i) + "\n" : "M8\n";
  const auto source = SourceFile::fromText(0, "a.nc", text);
  const auto dialect = llvm::cantFail(loadDialect("haas-mill", builtinDialects()));
  const auto reader = makeReader(*dialect, text);
  FileScan scan;
  uint64_t plain = 0, others = 0;
  scan.eachPiece(PieceReader(*source, *reader, *dialect), 0, uint32_t(text.size()),
                 [&](const TextPiece &piece) {
                   (piece.isPlain ? plain : others) += piece.blocks;
                   return true;
                 });
  EXPECT_EQ(plain + others, 1999u);
  EXPECT_LT(others, 6 * 34u);
}

TEST(FileScanTest, AByteOrderMarkIsNoText) {
  FileScan kept;
  const auto before = SourceFile::fromText(0, "a.nc", "\xEF\xBB\xBFO1\nN1\n");
  EXPECT_EQ(seen(kept, *before), "head 3\nN1 6\n");
  const std::string next = "O1\nN1\n";
  const auto after = SourceFile::fromText(0, "a.nc", next);
  kept.edit(changeBetween(before->text(), next), *after);
  EXPECT_EQ(seen(kept, *after), "head 0\nN1 3\n");
}

} // namespace
} // namespace ncvet
