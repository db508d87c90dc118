// The outline of a document: symbols, folds, growing selections.
#include "lsp/features/navigation/folding.h"
#include "lsp/features/navigation/selection.h"
#include "lsp/features/navigation/symbols.h"
#include "tests/support/marked_text.h"

#include "gtest/gtest.h"

namespace {

using namespace ncvet;
using namespace ncvet::lsp;
using OutlineLines = std::vector<std::string>;

/// "2-7 T0101 ROUGH" for each symbol, children indented.
void describe(const SourceFile &source, const std::vector<Symbol> &symbols, unsigned depth,
              OutlineLines &lines) {
  for (const Symbol &symbol : symbols) {
    EXPECT_LE(symbol.full.begin, symbol.selection.begin);
    EXPECT_LE(symbol.selection.end, symbol.full.end);
    lines.push_back(std::string(depth, '.') +
                    std::to_string(source.position(symbol.full.begin).line) + "-" +
                    std::to_string(source.position(symbol.full.end).line) + " " + symbol.name +
                    (symbol.detail.empty() ? "" : " | " + symbol.detail));
    describe(source, symbol.children, depth + 1, lines);
  }
}

OutlineLines outlineOf(const char *dialect, llvm::StringRef program) {
  const auto text = test::markedText(dialect, program);
  OutlineLines lines;
  describe(text->source(), documentSymbols(*text), 0, lines);
  return lines;
}

TEST(Symbols, OfAHaasLathe) {
  EXPECT_EQ(
      outlineOf("haas-lathe", "%\nO01000 (SHAFT)\nG54\nT0101 (ROUGH)\nG71 P10 Q20 D1. F0.2\n"
                              "N10 G00 X1.\nN20 G01 X2.\n(FINISH)\nT0202\nG70 P10 Q20\n"
                              "T0200\nM97 P300\nM30\nN300 G0 U1.\nM99\n%\n"),
      (OutlineLines{"2-15 O01000 | SHAFT", ".4-7 T0101 ROUGH", "..5-5 G71 | roughing cycle along Z",
                    ".9-13 T0202 FINISH", "..10-10 G70 | finishing cycle", ".14-15 N300"}));
}

TEST(Symbols, OfAFanucMill) {
  EXPECT_EQ(outlineOf("fanuc-0m",
                      "O1\nT1 M6 (DRILL)\nG81 X1. Y1. Z-5. R2. F100\nX2.\nG80\nG0 Z50.\n"
                      "T2\nM6\nG0 X0\nM30\nO2\nM99\n"),
            (OutlineLines{"1-10 O1", ".2-7 T1 DRILL", "..3-5 G81 | drilling, rapid out", ".8-10 T2",
                          "11-12 O2"}));
}

TEST(Symbols, OfASinumerik) {
  EXPECT_EQ(
      outlineOf("sinumerik", "%_N_SHAFT_MPF\nT1 D1 ; ROUGH\nSTART: G0 X1\nT2 D1\nG0 X2\nM30\n"),
      (OutlineLines{"1-6 %_N_SHAFT_MPF", ".2-3 T1 ROUGH", "..3-3 START", ".4-6 T2"}));
}

TEST(Symbols, OfAnEcs) {
  EXPECT_EQ(outlineOf("ecs", "[BEGIN] T1 M6 (MILL)\nG0 X1\nM17\n"),
            (OutlineLines{"1-3 program", ".1-3 T1 MILL", "..1-1 BEGIN | MILL"}));
}

TEST(Symbols, OfAMefi) {
  EXPECT_EQ(outlineOf("mefi", "N10 T5 M6\nN20 G0 X1\nN30 M30\n"),
            (OutlineLines{"1-3 program", ".1-3 T5"}));
}

TEST(Symbols, OfALinuxCnc) {
  EXPECT_EQ(outlineOf("linuxcnc", "o<hole> sub (HOLE)\nG0 X1\no<hole> endsub\nT1 M6\nG0 X1\nM2\n"),
            (OutlineLines{"1-6 program", ".1-3 hole | HOLE", ".4-6 T1"}));
}

TEST(Symbols, OfTheWorkspaceAreFoundByAPartOfTheirName) {
  const auto text =
      test::markedText("sinumerik", "%_N_SHAFT_MPF\nSTART: G0\nSTOP: G0\n%_N_STAR_SPF\nM17\n");
  OutlineLines found;
  for (const NamedSymbol &symbol : workspaceSymbols(*text, "sta"))
    found.push_back(symbol.container + ":" + symbol.name);
  EXPECT_EQ(found, (OutlineLines{"%_N_SHAFT_MPF:START", ":%_N_STAR_SPF"}));
}

/// "2-5" for each fold.
OutlineLines foldsOf(const char *dialect, llvm::StringRef program) {
  const auto text = test::markedText(dialect, program);
  OutlineLines lines;
  for (const Fold &fold : folds(*text))
    lines.push_back(std::to_string(text->source().position(fold.range.begin).line) + "-" +
                    std::to_string(text->source().position(fold.range.end).line));
  return lines;
}

TEST(Folds, OfProgramsToolsLoopsAndComments) {
  EXPECT_EQ(foldsOf("fanuc-0m", "O1\n(A)\n(B)\nT1 M6\nWHILE [#1 LT 3] DO1\n#1=#1+1\nEND1\nT2 M6\n"
                                "G0 X1.\nM30\n%\nO2\nM99\n%\n"),
            (OutlineLines{"1-10", "2-3", "4-7", "5-6", "8-10", "12-13"}));
}

TEST(Folds, OfBranches) {
  EXPECT_EQ(foldsOf("sinumerik", "IF R1>2\nG0\nELSE\nG1\nENDIF\nLOOP\nG0\nENDLOOP\nM30\n"),
            (OutlineLines{"1-9", "1-2", "3-4", "6-7"}));
  EXPECT_EQ(foldsOf("linuxcnc", "o1 if [#1 GT 2]\nG0\no1 elseif [#1]\nG1\no1 else\nG1\no1 endif\n"),
            (OutlineLines{"1-7", "1-2", "3-4", "5-6"}));
}

TEST(Folds, OfProfiles) {
  EXPECT_EQ(foldsOf("haas-lathe", "G71 P10 Q20 D1. F0.2\nN10 X1.\nX2.\nN20 X3.\nM30\n"),
            (OutlineLines{"1-5", "2-4"}));
}

TEST(Folds, OfBlocksThatADialogWrote) {
  EXPECT_EQ(foldsOf("mefi", "N10 G0 X1\nN20 \"Automatically generated code\n\"HtmlFile = 'a'\n"
                            "G0 X2\nN30 M30\n"),
            (OutlineLines{"1-5", "2-4"}));
}

/// Text of each range of the growing selection at the first mark.
OutlineLines selectionOf(const char *dialect, llvm::StringRef program) {
  const auto text = test::markedText(dialect, program);
  OutlineLines lines;
  const auto chains = selections(*text, text.marks);
  EXPECT_EQ(chains.size(), text.marks.size());
  for (const SourceRange &range : chains.front())
    lines.push_back(text->text().slice(range.begin, range.end).str());
  return lines;
}

TEST(Selections, GrowFromTheWordToTheFile) {
  EXPECT_EQ(
      selectionOf("fanuc-0m", "O1\nWHILE [#1 LT 3] DO1\nG0 X1<|>0. Y2.\nEND1\nM30\nO2\nM99\n"),
      (OutlineLines{"X10.", "G0 X10. Y2.", "WHILE [#1 LT 3] DO1\nG0 X10. Y2.\nEND1",
                    "O1\nWHILE [#1 LT 3] DO1\nG0 X10. Y2.\nEND1\nM30",
                    "O1\nWHILE [#1 LT 3] DO1\nG0 X10. Y2.\nEND1\nM30\nO2\nM99\n"}));
}

TEST(Selections, TakeInNamesAndComments) {
  EXPECT_EQ(selectionOf("sinumerik", "X=DE<|>EP*2 ; a comment"),
            (OutlineLines{"DEEP", "DEEP*2", "X=DEEP*2", "X=DEEP*2 ; a comment"}));
  EXPECT_EQ(selectionOf("fanuc-0m", "G0 (A <|>B) X1.")[0], "(A B)");
}

} // namespace
