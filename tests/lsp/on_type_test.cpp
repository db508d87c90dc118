// Edits while typing: the number of a new block.
#include "lsp/features/writing/on_type.h"
#include "tests/support/marked_text.h"

#include "gtest/gtest.h"

namespace {

using namespace ncvet;

/// The program after the line end at the mark was typed; as it was when nothing is inserted.
std::string typed(llvm::StringRef dialect, llvm::StringRef program) {
  const auto text = test::markedText(dialect, program);
  const auto edit = lsp::numberOfNewBlock(*text, text.marks[0]);
  return edit ? applyEdits(text->text(), {*edit}) : text->text().str();
}

TEST(OnType, TheNextNumberFollows) {
  EXPECT_EQ(typed("haas-mill", "O1\nN10 G00\nN20 X1.\n<|>"), "O1\nN10 G00\nN20 X1.\nN30 ");
  EXPECT_EQ(typed("haas-mill", "O1\nN5 G00\n<|>\nM30\n"), "O1\nN5 G00\nN15 \nM30\n");
  EXPECT_EQ(typed("sinumerik", "n2 G0 X1\nn4 X2\n<|>\n"), "n2 G0 X1\nn4 X2\nn6 \n");
  EXPECT_EQ(typed("mefi", "N1 G0 X1\nN2 X2\n<|>\n"), "N1 G0 X1\nN2 X2\nN3 \n");
}

TEST(OnType, BetweenTwoBlocksTheNumberIsBetweenTheirs) {
  EXPECT_EQ(typed("haas-mill", "O1\nN10 G00\nN20 X1.\n<|>\nN30 M30\n"),
            "O1\nN10 G00\nN20 X1.\nN25 \nN30 M30\n");
  EXPECT_EQ(typed("haas-mill", "O1\nN1 G00\nN2 X1.\n<|>\nN3 M30\n"),
            "O1\nN1 G00\nN2 X1.\n\nN3 M30\n");
}

TEST(OnType, TheRestOfALineThatIsCutInTwoGetsTheNumber) {
  EXPECT_EQ(typed("haas-mill", "O1\nN10G00X1.\n<|>Y2.\nM30\n"), "O1\nN10G00X1.\nN20Y2.\nM30\n");
}

TEST(OnType, ProgramsWithoutNumbersGetNone) {
  EXPECT_EQ(typed("haas-mill", "O1\nG00\n<|>\nM30\n"), "O1\nG00\n\nM30\n");
  EXPECT_EQ(typed("haas-mill", "O1\nN10 G00\nX1.\n<|>\nM30\n"), "O1\nN10 G00\nX1.\n\nM30\n");
  EXPECT_EQ(typed("haas-mill", "<|>"), "");
  EXPECT_EQ(typed("mefi", "N1 G0 X1\n Y2\n<|>\n"), "N1 G0 X1\n Y2\n\n");
}

} // namespace
