// Tests of formats/text: lines, columns, encodings, edits, opening files.
#include "formats/text/edit.h"
#include "formats/text/formatted.h"
#include "formats/text/source_set.h"
#include "formats/text/text_change.h"
#include "tests/support/temporary_folder.h"

#include "llvm/Support/FileSystem.h"
#include <gtest/gtest.h>

#include <random>

using namespace ncvet;

namespace {

std::unique_ptr<SourceFile> source(llvm::StringRef text) {
  return SourceFile::fromText(0, "part.nc", text);
}

/// The obvious, slow way to count lines.
uint32_t slowLineOf(llvm::StringRef text, uint32_t offset) {
  uint32_t line = 1;
  for (uint32_t at = 0; at < offset; ++at)
    if (text[at] == '\n' || (text[at] == '\r' && !text.substr(at + 1).startswith("\n")))
      ++line;
  return line;
}

std::pair<uint32_t, uint32_t> at(const SourceFile &file, uint32_t offset) {
  const LineColumn position = file.position(offset);
  return {position.line, position.column};
}

using LineAndColumn = std::pair<uint32_t, uint32_t>;

} // namespace

TEST(Formatted, TakesValuesOfAnyTypeInTheStylesOfTheForm) {
  EXPECT_EQ("G1 X12.500, twice: G1", formatted("{0} {1}{2:f3}, twice: {0}", "G1", 'X', 12.5));
  EXPECT_EQ("N007 and -3", formatted("N{0:d3} and {1}", 7u, -3));
  EXPECT_EQ("0.3333 of 18446744073709551615",
            formatted("{0} of {1}", llvm::format("%.4g", 1.0 / 3), ~uint64_t(0)));
}

TEST(Formatted, WithoutValuesIsTheTextItself) {
  EXPECT_EQ("{G80} ends it", formatted("{{G80} ends it"));
}

TEST(LineIndexTest, LinesEndWithLfCrLfOrALoneCr) {
  const llvm::StringRef text = "A\nB\r\nC\rD";
  const LineIndex lines(text);
  EXPECT_EQ(lines.lineOf(0), 1u);
  EXPECT_EQ(lines.lineOf(1), 1u); // a line end belongs to its line
  EXPECT_EQ(lines.lineOf(2), 2u);
  EXPECT_EQ(lines.lineOf(4), 2u); // the LF of CR LF
  EXPECT_EQ(lines.lineOf(5), 3u);
  EXPECT_EQ(lines.lineOf(7), 4u);
  EXPECT_EQ(lines.lineOf(8), 4u);
  EXPECT_EQ(lines.lineEnd(2), 3u);
  EXPECT_EQ(lines.lineEnd(4), 3u);
  EXPECT_EQ(lines.lineBegin(4), 2u);
  EXPECT_EQ(lines.lineEnd(7), 8u);
  EXPECT_EQ(lines.beginOfLine(1), 0u);
  EXPECT_EQ(lines.beginOfLine(3), 5u);
  EXPECT_EQ(lines.beginOfLine(4), 7u);
  EXPECT_EQ(lines.beginOfLine(5), 8u);
  EXPECT_EQ(lines.beginOfLine(4000000000u), 8u);
}

TEST(LineIndexTest, LinesAreCountedAsByteByByte) {
  std::mt19937 dice(3);
  for (unsigned turn = 0; turn < 200; ++turn) {
    std::string text(dice() % 9000, ' ');
    for (char &c : text)
      c = "\n\r"[dice() % 2];
    for (unsigned i = dice() % 9000; i > 0 && !text.empty(); --i)
      text[dice() % text.size()] = 'X';
    const LineIndex lines(text);
    const size_t offset = text.empty() ? 0 : dice() % text.size();
    EXPECT_EQ(lines.lineOf(uint32_t(offset)), slowLineOf(text, uint32_t(offset)));
  }
}

TEST(LineIndexTest, AFinalLineEndBeginsAnEmptyLastLine) {
  const LineIndex lines("G0 X1\n");
  EXPECT_EQ(lines.lineOf(6), 2u);
  EXPECT_EQ(lines.lineBegin(6), 6u);
  EXPECT_EQ(lines.lineEnd(6), 6u);
  EXPECT_EQ(lines.lineOf(1000), 2u);
}

TEST(LineIndexTest, AnEmptyTextHasOneLine) {
  const LineIndex lines("");
  EXPECT_EQ(lines.lineOf(0), 1u);
  EXPECT_EQ(lines.lineEnd(0), 0u);
  EXPECT_EQ(lines.beginOfLine(2), 0u);
}

TEST(LineIndexTest, AgreesWithSlowCountingOverManyCounterSteps) {
  std::mt19937 random(7);
  for (const llvm::StringRef alphabet :
       {"X1 \n", "X1 \r", "X\r\n", "XXXXXXXXXXXXXXXXXX\r\n", "X"}) {
    std::string text(300000, 'X');
    for (char &byte : text)
      byte = alphabet[random() % alphabet.size()];
    text.replace(100000, 30000, 30000, 'Y'); // a line longer than several steps
    text.replace(130000, 2, "\r\n");
    const LineIndex lines(text);
    // After, before and on the steps, where CR and LF may be parted.
    for (uint32_t offset : {200001u, 65535u, 65536u, 65537u, 110000u, 129999u, 130000u, 130001u,
                            130002u, 131072u, 0u, 299999u, 300000u}) {
      const uint32_t line = lines.lineOf(offset);
      ASSERT_EQ(line, slowLineOf(text, offset)) << offset;
      const uint32_t begin = lines.lineBegin(offset);
      EXPECT_EQ(lines.beginOfLine(line), begin);
      EXPECT_EQ(slowLineOf(text, begin), line);
      if (begin > 0) {
        EXPECT_EQ(slowLineOf(text, begin - 1), line - 1);
      }
      const uint32_t end = lines.lineEnd(offset);
      EXPECT_EQ(slowLineOf(text, end), line);
      EXPECT_TRUE(end == text.size() || text[end] == '\r' || text[end] == '\n');
      EXPECT_EQ(llvm::StringRef(text).slice(begin, end).find_first_of("\r\n"), std::string::npos);
    }
  }
}

TEST(LineIndexTest, FindsTheBeginOfEveryLine) {
  std::string text;
  for (int i = 0; i < 20000; ++i)
    text += i % 3 ? "G1 X1.5\n" : "M8\r";
  const LineIndex lines(text);
  EXPECT_EQ(lines.lineOf(lines.beginOfLine(19999)), 19999u);
  const LineIndex fresh(text);
  uint32_t expected = 0;
  for (uint32_t line = 1; line <= 20000; ++line) {
    if (line % 997 == 0) {
      ASSERT_EQ(fresh.beginOfLine(line), expected) << line;
    }
    expected += (line - 1) % 3 ? 8 : 3;
  }
}

TEST(LineIndexTest, GoesOnAfterAChangeOfTheText) {
  std::mt19937 random(3);
  const auto below = [&](size_t limit) { return limit == 0 ? 0 : size_t(random()) % limit; };
  std::string text;
  for (int i = 0; i < 4000; ++i)
    text += i % 5 ? "G1 X1.5\r\n" : i % 3 ? "\n\r" : "Y2.\r";
  auto before = std::make_unique<std::string>(text);
  LineIndex lines(*before);
  lines.countAll();
  for (unsigned edit = 0; edit < 400; ++edit) {
    const size_t begin = below(text.size() + 1);
    const size_t end = std::min(text.size(), begin + (edit % 7 ? below(30) : below(9000)));
    std::string put;
    for (size_t i = edit % 11 ? below(20) : below(12000); i > 0; --i)
      put += "X1\r\n"[below(4)];
    text.replace(begin, end - begin, put);
    auto after = std::make_unique<std::string>(text);
    LineIndex next(*after, lines, uint32_t(begin), uint32_t(end), uint32_t(put.size()));
    if (edit % 3)
      next.countAll();
    lines = next;
    before = std::move(after);
    const LineIndex fresh(*before);
    for (unsigned i = 0; i < 20; ++i) {
      const auto offset = uint32_t(below(text.size() + 1));
      ASSERT_EQ(lines.lineOf(offset), fresh.lineOf(offset)) << edit << " " << offset;
      ASSERT_EQ(lines.beginOfLine(uint32_t(i * 300)), fresh.beginOfLine(uint32_t(i * 300)));
    }
  }
}

/// `text` with the pieces that `changes` name, taken from the text that they lead to.
std::string replayed(std::string text, const TextChanges &changes, const std::string &after) {
  for (const TextChange &change : changes.fromFront())
    text.replace(change.begin, change.end - change.begin, after, change.begin, change.added);
  return text;
}

TEST(TextChangesTest, ManyChangesBecomePiecesThatLeadToTheSameText) {
  std::mt19937 random(5);
  const auto below = [&](size_t limit) { return limit == 0 ? 0 : size_t(random()) % limit; };
  for (unsigned round = 0; round < 300; ++round) {
    std::string text;
    for (unsigned i = 0; i < 12; ++i)
      text += "N" + std::to_string(i) + " X" + std::to_string(round) + "\n";
    SharedText version(std::make_shared<const std::string>(text));
    const SharedText first = version;
    TextChanges changes;
    for (size_t edits = below(9); edits > 0; --edits) {
      const size_t begin = below(text.size() + 1), end = begin + below(text.size() + 1 - begin) / 4;
      const std::string put = std::string("G1\nX2").substr(below(6), below(5));
      const TextChange change{uint32_t(begin), uint32_t(end), uint32_t(put.size())};
      text.replace(begin, end - begin, put);
      changes.add(change);
      SharedText next(std::make_shared<const std::string>(text));
      next.history = TextHistory::with(version, change);
      version = next;
    }
    ASSERT_EQ(replayed(*first.bytes, changes, text), text) << round;
    ASSERT_EQ(replayed(*first.bytes, changesBetween(first.bytes, version), text), text) << round;
    changes.joinInLines(text);
    ASSERT_EQ(replayed(*first.bytes, changes, text), text) << round;
    const std::vector<TextChange> pieces = changes.fromFront();
    for (size_t i = 1; i < pieces.size(); ++i)
      ASSERT_NE(text.substr(pieces[i - 1].endAfter(), pieces[i].begin - pieces[i - 1].endAfter())
                    .find('\n'),
                std::string::npos);
  }
}

TEST(TextChangesTest, ATextOfWhichNothingIsKnownIsCompared) {
  const auto before = std::make_shared<const std::string>("G0 X1\nG1 X2\n");
  const SharedText after(std::make_shared<const std::string>("G0 X1\nG1 X25\n"));
  const std::vector<TextChange> changes = changesBetween(before, after).fromFront();
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(replayed(*before, changesBetween(before, after), *after.bytes), *after.bytes);
  EXPECT_TRUE(changesBetween(before, SharedText(before)).empty());
}

TEST(SourceFileTest, ColumnsCountCodePointsOfUtf8) {
  const auto file = source("(B\xC3\xB6hrer \xE2\x8C\x80"
                           "5) X1\nX2\n");
  EXPECT_EQ(file->encoding(), Encoding::Utf8);
  EXPECT_EQ(at(*file, 0), LineAndColumn(1, 1));
  EXPECT_EQ(at(*file, 4), LineAndColumn(1, 4)); // after the o umlaut, which is two bytes
  EXPECT_EQ(at(*file, file->text().find("X1")), LineAndColumn(1, 13));
  EXPECT_EQ(at(*file, file->text().find("X2")), LineAndColumn(2, 1));
  EXPECT_EQ(at(*file, 4), LineAndColumn(1, 4));
}

TEST(SourceFileTest, ColumnsCountBytesOfAnEightBitFile) {
  const auto file = source("(B\xF6hrer) X1");
  EXPECT_EQ(file->encoding(), Encoding::Windows1252);
  EXPECT_EQ(at(*file, file->text().find("X1")), LineAndColumn(1, 10));
  EXPECT_EQ(file->displayLine(1), "(B\xC3\xB6hrer) X1");
}

TEST(SourceFileTest, AByteOrderMarkTakesNoColumnAndIsNotShown) {
  const auto file = source("\xEF\xBB\xBFG0 X1\nG1");
  EXPECT_EQ(file->textBegin(), 3u);
  EXPECT_EQ(at(*file, 0), LineAndColumn(1, 1));
  EXPECT_EQ(at(*file, 3), LineAndColumn(1, 1));
  EXPECT_EQ(at(*file, 6), LineAndColumn(1, 4));
  EXPECT_EQ(at(*file, 9), LineAndColumn(2, 1));
  EXPECT_EQ(file->displayLine(1), "G0 X1");
  EXPECT_EQ(file->displayLine(2), "G1");
  EXPECT_EQ(at(*source("\xEF\xBB\xBF"), 3), LineAndColumn(1, 1));
}

TEST(SourceFileTest, PositionsOfAFileWithLoneCrAreThoseOfItsLines) {
  const auto file = source("%\rO1\rG0 X1\r");
  EXPECT_EQ(at(*file, 5), LineAndColumn(3, 1));
  EXPECT_EQ(at(*file, 8), LineAndColumn(3, 4));
  EXPECT_EQ(at(*file, 11), LineAndColumn(4, 1));
  EXPECT_EQ(file->displayLine(3), "G0 X1");
}

TEST(SourceFileTest, APositionDoesNotDependOnWhatWasAskedBefore) {
  std::mt19937 random(11);
  std::string text;
  for (int i = 0; i < 3000; ++i) {
    const char *const pieces[] = {"X",        "\n",           "\r",    "\r\n",
                                  "\xC3\xB6", "\xE2\x8C\x80", "  G1 ", "G0 X100. Y200."};
    text += pieces[random() % 8];
  }
  const auto file = source(text);
  for (int i = 0; i < 2000; ++i) {
    const auto offset = static_cast<uint32_t>(random() % (text.size() + 1));
    ASSERT_EQ(at(*file, offset), at(*source(text), offset)) << offset;
  }
  EXPECT_EQ(at(*file, 4000000000u), at(*file, static_cast<uint32_t>(text.size())));
}

TEST(SourceFileTest, ALineAsLongAsTheFileIsNotCountedAgainForEachPosition) {
  std::string text;
  for (int i = 0; i < 400000; ++i)
    text += "X1.\xC3\xB6 ";
  const auto file = source(text);
  // Counting anew would read 20,000 times 1.2 MB on average; to and fro, as notes point back.
  for (uint32_t i = 0; i < 400000; i += 20 + i % 3) {
    const uint32_t word = i % 2 ? i : 400000 - i;
    ASSERT_EQ(at(*file, word * 6), LineAndColumn(1, word * 5 + 1));
  }
  EXPECT_EQ(file->lines().lineEnd(1000), text.size());
  EXPECT_EQ(file->lines().lineBegin(2000000), 0u);
}

TEST(EncodingTest, HungarianTextOfANctControlIsCentralEuropean) {
  const std::string text = "(F\xDAR\xC1S, M\xC9LY\xDCREG\xC9SZT\xD5 el\xF5tol\xE1s)";
  EXPECT_EQ(guessEncoding(text), Encoding::Windows1250);
  std::string shown;
  appendDecoded(shown, "el\xF5tol\xE1s", Encoding::Windows1250);
  EXPECT_EQ(shown, "el\xC5\x91tol\xC3\xA1s");
}

TEST(EncodingTest, CzechAndPolishTextsAreCentralEuropean) {
  EXPECT_EQ(guessEncoding("(pr\xF9m\xEC"
                          "r d\xEDry)"),
            Encoding::Windows1250);
  EXPECT_EQ(guessEncoding("(p\xF8\xED\x9Ati obr\xE1"
                          "b\xECn\xED)"),
            Encoding::Windows1250);
  EXPECT_EQ(guessEncoding("(ko\xF1"
                          "cowy, g\xB3"
                          "\xEA"
                          "boko\x9C\xE6)"),
            Encoding::Windows1250);
}

TEST(EncodingTest, WesternTextsAreWestern) {
  EXPECT_EQ(guessEncoding("(B\xF6hrer \xD8"
                          "5 T\xFCr)"),
            Encoding::Windows1252);
  EXPECT_EQ(guessEncoding("(per\xE7"
                          "age pi\xE8"
                          "ce)"),
            Encoding::Windows1252);
  EXPECT_EQ(guessEncoding("(operac\xF5"
                          "es de furo)"),
            Encoding::Windows1252);
  EXPECT_EQ(guessEncoding("(b\xE5rd, h\xF8jre)"), Encoding::Windows1252);
  EXPECT_EQ(guessEncoding("(12 cm\xB3 / mm\xB2)"), Encoding::Windows1252);
  EXPECT_EQ(guessEncoding("(pi\xF9 veloce, cos\xEC, gi\xE0)"), Encoding::Windows1252);
}

TEST(EncodingTest, BrokenUtf8IsNotUtf8) {
  EXPECT_FALSE(isValidUtf8("\xC3"));             // cut off
  EXPECT_FALSE(isValidUtf8("\xC0\xAF"));         // overlong
  EXPECT_FALSE(isValidUtf8("\xED\xA0\x80"));     // surrogate
  EXPECT_FALSE(isValidUtf8("\xF4\x90\x80\x80")); // above U+10FFFF
  EXPECT_FALSE(isValidUtf8("abcdefgh\x80"));
  EXPECT_TRUE(isValidUtf8("abcdefgh\xF0\x9F\x94\xA9"));
  EXPECT_TRUE(isValidUtf8(""));
}

TEST(EncodingTest, DecodedBytesAreAlwaysValidUtf8) {
  std::string all;
  for (int byte = 0; byte < 256; ++byte)
    all.push_back(static_cast<char>(byte));
  for (const Encoding encoding : {Encoding::Utf8, Encoding::Windows1250, Encoding::Windows1252}) {
    std::string shown;
    appendDecoded(shown, all, encoding);
    EXPECT_TRUE(isValidUtf8(shown));
    EXPECT_EQ(countCodePoints(shown, Encoding::Utf8), 256u);
  }
}

TEST(EncodingTest, TheCodePagesHaveTheLettersOfTheirLanguages) {
  auto shown = [](llvm::StringRef bytes, Encoding encoding) {
    std::string out;
    appendDecoded(out, bytes, encoding);
    return out;
  };
  EXPECT_EQ(shown("\x80\xD8\xF6\xFF", Encoding::Windows1252),
            "\xE2\x82\xAC\xC3\x98\xC3\xB6\xC3\xBF");
  EXPECT_EQ(shown("\x80\xD5\xF6\xF8", Encoding::Windows1250),
            "\xE2\x82\xAC\xC5\x90\xC3\xB6\xC5\x99");
}

TEST(EditTest, EditsApplyInTheOrderOfTheirPlaces) {
  const TextEdit insert{{0, 3, 3}, "G80 "};
  const TextEdit replace{{0, 3, 5}, "G1"};
  const TextEdit remove{{0, 8, 10}, ""};
  for (const auto &edits : {std::vector<TextEdit>{insert, replace, remove},
                            std::vector<TextEdit>{remove, replace, insert}})
    EXPECT_EQ(applyEdits("N1 G0 X1M8;", edits), "N1 G80 G1 X1;");
  EXPECT_EQ(applyEdits("G0", {}), "G0");
  EXPECT_EQ(applyEdits("G0", {TextEdit{{0, 2, 2}, "X1"}}), "G0X1");
}

TEST(EditTest, EditsOverlapWhenTheyTouchTheSameBytesOrInsertAtTheSamePlace) {
  const TextEdit word{{0, 3, 5}, "G1"};
  EXPECT_TRUE(overlaps(word, {{0, 4, 6}, ""}));
  EXPECT_TRUE(overlaps(word, {{0, 0, 9}, ""}));
  EXPECT_TRUE(overlaps(word, word));
  EXPECT_TRUE(overlaps(word, {{0, 4, 4}, "X"}));
  EXPECT_TRUE(overlaps({{0, 4, 4}, "X"}, word));
  EXPECT_TRUE(overlaps({{0, 4, 4}, "X"}, {{0, 4, 4}, "Y"}));
  EXPECT_FALSE(overlaps(word, {{0, 5, 6}, ""}));
  EXPECT_FALSE(overlaps(word, {{0, 3, 3}, "X"}));
  EXPECT_FALSE(overlaps(word, {{0, 5, 5}, "X"}));
  EXPECT_FALSE(overlaps(word, {{1, 3, 5}, ""}));
}

TEST(EditTest, ApplyingEditsOneByOneFromTheBackGivesTheSameText) {
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    std::string text;
    for (int i = 0; i < 60; ++i)
      text.push_back(static_cast<char>('A' + random() % 26));
    std::vector<TextEdit> edits;
    for (int i = 0; i < 12; ++i) {
      const auto begin = static_cast<uint32_t>(random() % 60);
      const TextEdit edit{{0, begin, static_cast<uint32_t>(begin + random() % (61 - begin) % 5)},
                          std::string(random() % 4, 'x')};
      if (std::none_of(edits.begin(), edits.end(),
                       [&](const TextEdit &other) { return overlaps(edit, other); }))
        edits.push_back(edit);
    }
    std::vector<TextEdit> sorted = edits;
    std::sort(sorted.begin(), sorted.end(), [](const TextEdit &a, const TextEdit &b) {
      return std::pair(a.range.begin, a.range.end) > std::pair(b.range.begin, b.range.end);
    });
    std::string expected = text;
    for (const TextEdit &edit : sorted)
      expected.replace(edit.range.begin, edit.range.end - edit.range.begin, edit.text);
    ASSERT_EQ(applyEdits(text, edits), expected);
  }
}

TEST(SourceSetTest, OpensFilesAndNumbersThem) {
  const test::TemporaryFolder folder;
  SourceSet set;
  const SourceFile &first = set.add("stdin.nc", "G0\n");
  auto second = set.open(folder.write("part.nc", "G1 X1\n"), "part.nc");
  ASSERT_TRUE(bool(second)) << llvm::toString(second.takeError());
  EXPECT_EQ(first.id(), 0u);
  EXPECT_EQ((*second)->id(), 1u);
  EXPECT_EQ(&set.get(1), *second);
  EXPECT_EQ(set.get(1).text(), "G1 X1\n");
  EXPECT_EQ(set.get(1).display(), "part.nc");
  EXPECT_EQ(set.size(), 2u);
}

TEST(SourceSetTest, RefusesWhatIsNotAFileOfProgramsInOneLine) {
  const test::TemporaryFolder folder;
  SourceSet set;
  EXPECT_EQ(llvm::toString(set.open(folder.path().string(), "programs").takeError()),
            "cannot read programs: it is a folder");
  EXPECT_EQ(llvm::toString(set.open((folder.path() / "none.nc").string(), "none.nc").takeError()),
            "cannot read none.nc: No such file or directory");
  EXPECT_EQ(llvm::toString(set.open("/dev/zero").takeError()),
            "cannot read /dev/zero: it is not a regular file");
  EXPECT_EQ(set.size(), 0u);
}

TEST(SourceSetTest, RefusesAFileOfFourGibibytes) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("big.nc", "");
  int descriptor = 0;
  ASSERT_FALSE(llvm::sys::fs::openFileForWrite(path, descriptor, llvm::sys::fs::CD_OpenExisting));
  const std::error_code error = llvm::sys::fs::resize_file(descriptor, uint64_t(1) << 32);
  llvm::sys::fs::file_t handle = descriptor;
  llvm::sys::fs::closeFile(handle);
  if (error)
    GTEST_SKIP() << "no sparse files here: " << error.message();
  SourceSet set;
  EXPECT_EQ(llvm::toString(set.open(path, "big.nc").takeError()),
            "cannot read big.nc: it is 4 GiB or larger");
}

TEST(SourceSetTest, ForgottenPagesAreReadAgainWhenAskedFor) {
  const test::TemporaryFolder folder;
  std::string text;
  while (text.size() < (9u << 20))
    text += "N10 G1 X1.5 Y2.5\n";
  SourceSet set;
  auto file = set.open(folder.write("long.nc", text), "long.nc");
  ASSERT_TRUE(bool(file)) << llvm::toString(file.takeError());
  for (uint32_t offset = 0; offset < text.size(); offset += 100000)
    (*file)->forget(offset);
  EXPECT_EQ((*file)->text(), text);
  (*file)->forget(0);
  (*file)->forget(8u << 20);
  EXPECT_EQ((*file)->position(static_cast<uint32_t>(text.size())).line, text.size() / 17 + 1);
}
