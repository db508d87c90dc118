// Renaming: the new text moves the machine as the old one does, or there is none.
#include "analyzer/trace/trace.h"
#include "formats/text/edit.h"
#include "lsp/features/writing/rename.h"
#include "tests/support/marked_text.h"

#include "gtest/gtest.h"
#include "llvm/ADT/StringExtras.h"

namespace {

using namespace ncvet;
using namespace ncvet::lsp;

/// Writes down what moves.
class Recorder : public TraceSink {
public:
  void moved(const TracedMove &traced) override {
    text_ += std::to_string(unsigned(traced.move.kind));
    for (const Interval &to : traced.move.to)
      text_ += " " + std::to_string(to.lo) + ":" + std::to_string(to.hi);
    text_ += " F" + std::to_string(traced.move.feed.lo) + "\n";
    ++moves_;
  }
  void lost(const FileUnit &, SourceRange, llvm::StringRef why) override {
    text_ += "lost: " + why.str() + "\n";
  }
  const std::string &text() const { return text_; }
  unsigned moves() const { return moves_; }

private:
  std::string text_;
  unsigned moves_ = 0;
};

/// The text with the first mark's name as `name`; "! why" when it keeps it. Both texts move alike.
std::string renamed(const char *dialect, llvm::StringRef program, llvm::StringRef name,
                    const char *path = "/nowhere/part.nc") {
  const auto text = test::markedText(dialect, program, path);
  const RenameEdits result = rename(*text, text.marks[0], name);
  if (!result.refused.empty()) {
    EXPECT_TRUE(result.edits.empty());
    return "! " + result.refused;
  }
  const std::string after = applyEdits(text->text(), result.edits);
  const auto other = test::markedText(dialect, after, path);
  Recorder before, renamed;
  trace(text->project(), text->unit(), {}, before);
  trace(other->project(), other->unit(), {}, renamed);
  EXPECT_EQ(before.text(), renamed.text()) << after;
  return after;
}

TEST(Rename, BlockNumbersWithAllTheirTargets) {
  EXPECT_EQ(renamed("haas-lathe",
                    "O1\nT101\nG71 P1<|>0 Q20 D1. F0.2\nN10 G0 X1.\nN20 G1 X2.\nG70 P10 Q20\n"
                    "IF [#1 EQ 2] GOTO 10\nM30\n",
                    "115"),
            "O1\nT101\nG71 P115 Q20 D1. F0.2\nN115 G0 X1.\nN20 G1 X2.\nG70 P115 Q20\n"
            "IF [#1 EQ 2] GOTO 115\nM30\n");
  EXPECT_EQ(renamed("haas-lathe", "O1\nM97 P200\nM30\nN<|>200 G0 X1.\nM99\n", "7"),
            "O1\nM97 P7\nM30\nN7 G0 X1.\nM99\n");
  EXPECT_EQ(renamed("fanuc-0m", "O1\nM98 P2\nG0 X1.\nN1<|>0 G0 X2.\nM30\nO2\nM99 P10\n", "12"),
            "O1\nM98 P2\nG0 X1.\nN12 G0 X2.\nM30\nO2\nM99 P12\n");
  EXPECT_EQ(renamed("ecs", "N10 G0 X1\n<RPT:N1<|>0;N20;3>\nN20 G0 X5\n<JMP:N20>\nM17\n", "15"),
            "N15 G0 X1\n<RPT:N15;N20;3>\nN20 G0 X5\n<JMP:N20>\nM17\n");
  EXPECT_EQ(renamed("mefi", "N10 G0 X1\nN2<|>0 G0 X2\nN30 M30\n", "25"),
            "N10 G0 X1\nN25 G0 X2\nN30 M30\n");
}

TEST(Rename, BlockNumbersOnlyWhereEveryTargetIsKnown) {
  EXPECT_EQ(renamed("fanuc-0m", "O1\nN1<|>0 G0\nGOTO #1\nM30\n", "20"),
            "! line 3 jumps to a block that only the run decides");
  EXPECT_EQ(renamed("fanuc-0m", "O1\nN1<|>0 G0\nN20 G0\nGOTO 10\nM30\n", "20"),
            "! `20` is in use already: line 3");
  EXPECT_EQ(renamed("fanuc-0m", "O1\nN1<|>0 G0\nM30\n", "A"), "! `A` is no number");
  EXPECT_EQ(renamed("fanuc-0m", "O1\nN1<|>0 G0\nM30\n", "1234567890"),
            "! `1234567890` has more than 8 digits");
  EXPECT_EQ(renamed("fanuc-0m", "O1\nGOTO 1<|>0\nM30\n", "20"),
            "! nothing in this program defines `10`");
  EXPECT_EQ(renamed("fanuc-0m", "O1\nM98 P2\nN1<|>0 M30\nO3\nM98 P2\nN10 M30\nO2\nM99 P10\n", "20"),
            "! line 8 means a block of another program as well");
}

TEST(Rename, Labels) {
  EXPECT_EQ(
      renamed("sinumerik", "G90\nSTART: G0 X1\nR1=R1+1\nIF R1<3 GOTOB STA<|>RT\nM30\n", "AGAIN"),
      "G90\nAGAIN: G0 X1\nR1=R1+1\nIF R1<3 GOTOB AGAIN\nM30\n");
  EXPECT_EQ(
      renamed("ecs", "[BE<|>GIN] G0 X1\n<IFF<R1-3>: [END]; [BEGIN]; [END]>\n[END] M17\n", "TOP"),
      "[TOP] G0 X1\n<IFF<R1-3>: [END]; [TOP]; [END]>\n[END] M17\n");
  EXPECT_EQ(renamed("ecs", "[BE<|>GIN] G0 X1\nM17\n", "BEGINNING"),
            "! of a label only 8 characters count");
  EXPECT_EQ(renamed("sinumerik", "AA<|>A: G0\nBBB: G0\nGOTOB AAA\n", "BBB"),
            "! `BBB` is in use already: line 2");
  EXPECT_EQ(renamed("sinumerik", "AA<|>A: G0\nGOTOB AAA\n", "1A"),
            "! `1A` is no name: two letters, then letters and digits");
  EXPECT_EQ(renamed("sinumerik", "AA<|>A: G0\nGOTOB AAA\n", "GOTOF"),
            "! `GOTOF` has a meaning of its own for the control");
  EXPECT_EQ(renamed("sinumerik", "AA<|>A: G0\nBBB: G0\nCALL BLOCK AAA TO BBB\n", "CCC"),
            "CCC: G0\nBBB: G0\nCALL BLOCK CCC TO BBB\n");
  EXPECT_EQ(renamed("sinumerik", "AA<|>A: G0\nBBB: G0\nCALL BLOCK AAA TO BBB<<R1\n", "CCC"),
            "! line 3 names `AAA` in a form that is not read closely");
}

TEST(Rename, Variables) {
  EXPECT_EQ(
      renamed("fanuc-0m", "O1\n#1=10\nWHILE [#1 LT 13] DO1\nG0 X#<|>1\n#1=#1+1\nEND1\nM30\n", "5"),
      "O1\n#5=10\nWHILE [#5 LT 13] DO1\nG0 X#5\n#5=#5+1\nEND1\nM30\n");
  EXPECT_EQ(
      renamed("fanuc-0m", "O1\n#100=10\nG65 P2 A1.\nG0 X#1<|>00\nM30\nO2\nG0 X#100\nM99\n", "105"),
      "O1\n#105=10\nG65 P2 A1.\nG0 X#105\nM30\nO2\nG0 X#105\nM99\n");
  EXPECT_EQ(renamed("sinumerik",
                    "DEF REAL DEPTH=5\nG90 G0 X=DE<|>PTH\nDEPTH=DEPTH+1\nG0 Y=DEPTH\nM30\n",
                    "DEEP"),
            "DEF REAL DEEP=5\nG90 G0 X=DEEP\nDEEP=DEEP+1\nG0 Y=DEEP\nM30\n");
  EXPECT_EQ(renamed("sinumerik", "R1=5\nG90 G0 X=R<|>1\nM30\n", "R7"), "R7=5\nG90 G0 X=R7\nM30\n");
  EXPECT_EQ(renamed("linuxcnc", "#<depth> = 5\nG90 G0 X#<de<|>pth>\nM2\n", "deep"),
            "#<deep> = 5\nG90 G0 X#<deep>\nM2\n");
  EXPECT_EQ(renamed("ecs", "R1=5\nG0 X=R<|>1\n<RET>\n", "R2"),
            "! a program that calls this one shares `R1`");
}

TEST(Rename, VariablesOnlyWhereTheirValueIsTheProgramsOwn) {
  EXPECT_EQ(renamed("fanuc-0m", "O1\nG0 X#<|>5021\nM30\n", "5022"),
            "! `5021` is a variable of the control");
  EXPECT_EQ(renamed("fanuc-0m", "O1\nG0 X#<|>1\nM30\n", "2"),
            "! `1` is read before it is written: its value comes from the call");
  EXPECT_EQ(renamed("fanuc-0m", "O1\n#<|>1=2\nM98 P2\nM30\nO2\nG0 X#1\nM99\n", "2"),
            "! line 3 calls a program that shares `1`");
  EXPECT_EQ(renamed("fanuc-0m", "O1\n#<|>100=2\nM98 P77\nM30\n", "101"),
            "! line 3 calls a program of another file, which shares `100`");
  EXPECT_EQ(renamed("fanuc-0m", "O1\n#<|>1=2\n#[#2]=3\nM30\n", "2"),
            "! line 3 names a variable that only the run decides");
  EXPECT_EQ(renamed("fanuc-0m", "O1\n#<|>1=2\n#2=3\nG0 X#1\nM30\n", "2"),
            "! `2` is in use already: line 3");
  EXPECT_EQ(renamed("fanuc-0m", "O1\n#<|>1=2\nG0 X#1\nM30\n", "100"),
            "! `100` would belong to other programs than before");
  EXPECT_EQ(renamed("fanuc-0m", "O1\n#<|>1=2\nDPRNT[X#1[53]]\nM30\n", "2"),
            "! line 3 names `1` in a form that is not read closely");
  EXPECT_EQ(renamed("sinumerik", "G0 X=DE<|>PTH\nM30\n", "DEEP"),
            "! nothing in this program defines `DEPTH`");
  EXPECT_EQ(renamed("sinumerik", "R1=5\nG0 X=R[R2] Y=R<|>1\nM30\n", "R7"),
            "! line 2 names a variable that only the run decides");
  EXPECT_EQ(renamed("sinumerik", "$TC<|>_DP6[1,1]=5\nM30\n", "DEEP"),
            "! `$TC_DP6[1,1]` is a variable of the control");
  EXPECT_EQ(renamed("linuxcnc", "#<depth> = 5\nG0 X#<de<|>pth>\nM2\n", "_deep"),
            "! `_deep` would belong to other programs than before");
  EXPECT_EQ(renamed("mefi", "N10 R<|>30 = 2\nN20 M30\n", "R31"),
            "! `R30` is a variable of the control");
}

TEST(Rename, SubprogramsBetweenBrackets) {
  EXPECT_EQ(renamed("linuxcnc", "o100 sub\nG90 G0 X#1\no100 endsub\no1<|>00 call [5]\nM2\n", "200"),
            "o200 sub\nG90 G0 X#1\no200 endsub\no200 call [5]\nM2\n");
  EXPECT_EQ(
      renamed("linuxcnc", "o100 sub\nG90 G0 X#1\no100 endsub\no1<|>00 call [5]\nM2\n", "hole"),
      "o<hole> sub\nG90 G0 X#1\no<hole> endsub\no<hole> call [5]\nM2\n");
  EXPECT_EQ(
      renamed("linuxcnc", "#1=0\no1<|> while [#1 LT 3]\n#1=[#1+1]\nG0 X#1\no1 endwhile\nM2\n", "2"),
      "#1=0\no2 while [#1 LT 3]\n#1=[#1+1]\nG0 X#1\no2 endwhile\nM2\n");
  EXPECT_EQ(renamed("linuxcnc", "o1 sub\no1 endsub\no<|>2 if [1]\no2 endif\nM2\n", "1"),
            "! `1` is in use already: line 1");
  EXPECT_EQ(renamed("linuxcnc", "o<ho<|>le> call\nM2\n", "pit"),
            "! `hole` is not defined in this file");
}

TEST(Rename, ProgramsOfTheFile) {
  EXPECT_EQ(renamed("fanuc-0m", "O1\nM98 P0<|>002\nG65 P2\nM30\nO0002\nG0 X1.\nM99\n", "30"),
            "O1\nM98 P30\nG65 P30\nM30\nO0030\nG0 X1.\nM99\n");
  EXPECT_EQ(renamed("nct-104m", "%O0001\nM98 P30002\nM30\n%\n%O0<|>002\nG0 X1.\nM99\n%\n", "30"),
            "%O0001\nM98 P30030\nM30\n%\n%O0030\nG0 X1.\nM99\n%\n");
  EXPECT_EQ(renamed("sinumerik", "%_N_A_MPF\nHOLE\nM30\n%_N_HO<|>LE_SPF\nPROC HOLE\nG0 X1\nM17\n",
                    "DRILL"),
            "%_N_A_MPF\nDRILL\nM30\n%_N_DRILL_SPF\nPROC DRILL\nG0 X1\nM17\n");
  EXPECT_EQ(renamed("fanuc-0m", "O1\nM98 P<|>2\nM30\nO2\nM99\nO3\nM99\n", "3"),
            "! `3` is in use already: line 6");
  EXPECT_EQ(renamed("fanuc-0m", "O1\nM98 P<|>2\nM30\n", "3"),
            "! program `2` is not defined in this file");
  EXPECT_EQ(renamed("fanuc-0m", "O<|>1\nM30\n", "3", "/nowhere/O0001.nc"),
            "! the file is named after the program: other files find it by that name");
  EXPECT_EQ(renamed("haas-lathe", "O<|>1\nM30\n", "8999"), "! `8999` is a program of the control");
  EXPECT_EQ(renamed("haas-lathe", "O<|>1\nM30\n", "123456"), "! `123456` has more than 5 digits");
  EXPECT_EQ(renamed("fanuc-0m", "O1\nM98 P#1\nM30\nO<|>2\nM99\n", "3"),
            "! line 2 calls a program that only the run decides");
}

TEST(Rename, IsPreparedWithThePresentNameOrTheReasonWhyNot) {
  const auto text = test::markedText("fanuc-0m", "O1\nN1<|>0 T<|>5 M6\n<|>G0 X1.\n");
  const RenameSpot block = prepareRename(*text, text.marks[0]);
  EXPECT_EQ(block.name, "10");
  EXPECT_EQ(block.refused, "");
  EXPECT_EQ(text->text().slice(block.range.begin, block.range.end), "10");
  EXPECT_FALSE(prepareRename(*text, text.marks[1]).refused.empty());
  EXPECT_EQ(prepareRename(*text, text.marks[2]).refused, "there is no name here");
}

} // namespace
