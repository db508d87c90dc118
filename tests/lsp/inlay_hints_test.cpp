// Inlay hints: what certain blocks do not spell out.
#include "lsp/features/showing/inlay_hints.h"
#include "tests/support/marked_text.h"

#include "gtest/gtest.h"

namespace {

using namespace ncvet;
using lsp::HintKind;
using lsp::HintOptions;

/// The program with its hints in braces; motions too when they are wanted.
std::string hinted(llvm::StringRef dialect, llvm::StringRef program, bool motions = false) {
  const auto text = test::markedText(dialect, program);
  HintOptions options;
  options.on[size_t(HintKind::Motion)] = motions;
  std::string out;
  uint32_t at = 0;
  for (const lsp::InlayHint &hint :
       lsp::inlayHints(*text, 0, uint32_t(text->text().size()), options)) {
    out += text->text().slice(at, hint.offset).str() + "{" + hint.text + "}";
    at = hint.offset;
  }
  return out + text->text().drop_front(at).str();
}

TEST(InlayHints, ADwellWithoutAPointShowsItsUnit) {
  EXPECT_EQ(hinted("haas-lathe", "O1\nG04 P2\nG04 P2.\nG04 P2500\nM30\n"),
            "O1\nG04 P2{ 2 ms}\nG04 P2.\nG04 P2500{ 2.5 s}\nM30\n");
  EXPECT_EQ(hinted("linuxcnc", "G4 P2\nM2\n"), "G4 P2\nM2\n");
}

TEST(InlayHints, VariablesShowTheirValues) {
  EXPECT_EQ(hinted("fanuc-0m", "O1\nG21\n#100=5.\n#101=#100*2.\nG00 X#101\nM30\n"),
            "O1\nG21\n#100=5.\n#101=#100*2.{ = 10}\nG00 X#101{ = 10 mm}\nM30\n");
  EXPECT_EQ(hinted("sinumerik", "R1=4\nG0 X=R1+1\nM30\n"), "R1=4\nG0 X=R1+1{ = 5 mm}\nM30\n");
  EXPECT_EQ(hinted("mefi", "N10 R30=2\nN20 R31=R30\nN30 M30\n"),
            hinted("mefi", "N10 R30=2\nN20 R31=R30\nN30 M30\n"));
}

TEST(InlayHints, WhatDiffersFromPassToPassIsNotShown) {
  EXPECT_EQ(hinted("fanuc-0m", "O1\n#1=0\nWHILE[#1LT3]DO1\n#1=#1+1\nG00 X#1\nEND1\nM30\n"),
            "O1\n#1=0\nWHILE[#1LT3]DO1\n#1=#1+1\nG00 X#1\nEND1\nM30\n");
}

TEST(InlayHints, AComputedJumpShowsItsTarget) {
  EXPECT_EQ(hinted("fanuc-0m", "O1\n#1=2\nGOTO[#1*10]\nN10 M00\nN20 M30\n"),
            "O1\n#1=2\nGOTO[#1*10]{ → N20}\nN10 M00\nN20 M30\n");
}

TEST(InlayHints, ABareMoveShowsItsCodeWhenThatIsWanted) {
  EXPECT_EQ(hinted("haas-mill", "O1\nG01 X1. F100.\nX2.\nG83 Z-5. R1. Q1.\nX3.\nG80\nM30\n", true),
            "O1\nG01 X1. F100.\n{G01 }X2.\nG83 Z-5. R1. Q1.\n{G83 }X3.\nG80\nM30\n");
  EXPECT_EQ(hinted("haas-mill", "O1\nG01 X1. F100.\nX2.\nM30\n"), "O1\nG01 X1. F100.\nX2.\nM30\n");
}

TEST(InlayHints, OnlyTheRangeIsLookedAt) {
  const auto text = test::markedText("haas-mill", "O1\nG04 P1\n<|>G04 P2\n<|>G04 P3\nM30\n");
  const auto hints = lsp::inlayHints(*text, text.marks[0], text.marks[1]);
  ASSERT_EQ(hints.size(), 1u);
  EXPECT_EQ(hints[0].text, " 2 ms");
}

TEST(InlayHints, AfterSomethingUnknownNothingIsShown) {
  EXPECT_EQ(hinted("fanuc-0m", "O1\n#1=5\nIF[#5001GT1]GOTO20\n#2=#1+1\nN20 M30\n"),
            "O1\n#1=5\nIF[#5001GT1]GOTO20\n#2=#1+1\nN20 M30\n");
}

} // namespace
