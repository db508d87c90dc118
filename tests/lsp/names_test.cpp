// Names of a text: which there are, what each place does with them, and what belongs together.
#include "lsp/features/names.h"
#include "tests/support/marked_text.h"

#include "gtest/gtest.h"

namespace {

using namespace ncvet;
using namespace ncvet::lsp;

std::string nameOf(NameKind kind) {
  switch (kind) {
  case NameKind::Program:
    return "program";
  case NameKind::Block:
    return "block";
  case NameKind::Label:
    return "label";
  case NameKind::Variable:
    return "variable";
  case NameKind::Subprogram:
    return "subprogram";
  case NameKind::Bracket:
    return "bracket";
  case NameKind::Macro:
    return "macro";
  case NameKind::Element:
    return "element";
  case NameKind::Tool:
    return "tool";
  }
  return "?";
}

std::string nameOf(NameUse use) {
  constexpr const char *names[] = {"defines", "declares", "writes", "reads", "calls",
                                   "jumps",   "returns",  "first",  "last"};
  return names[unsigned(use)];
}

/// "block 10 jumps" for every occurrence but definitions of blocks.
std::vector<std::string> usesOf(const char *dialect, llvm::StringRef program) {
  const auto text = test::markedText(dialect, program);
  std::vector<std::string> uses;
  for (const Occurrence &one : text->names().all())
    if (one.kind != NameKind::Block || one.use != NameUse::Definition)
      uses.push_back(nameOf(one.kind) + " " + text->names().text(one).str() + " " +
                     nameOf(one.use));
  return uses;
}

using Uses = std::vector<std::string>;

TEST(Names, OfAHaasLathe) {
  EXPECT_EQ(
      usesOf("haas-lathe", "%\nO01000 (SHAFT)\nT0101\nM97 P200\nM98 P2000 L2\n"
                           "G71 P10 Q20 D1. F0.2\nN10 G00 X#1\nN20 G01 X50. F#100\n"
                           "IF [#1 GT 2] GOTO 10\n#100 = #1 + #[102]\nG65 P9010 A1.\n"
                           "M96 P10 Q5\nM30\nN200 M99\n%\n"),
      (Uses{"program 01000 defines", "tool 0101 reads", "block 200 calls", "program 2000 calls",
            "block 10 first", "block 20 last", "variable 1 reads", "variable 100 reads",
            "variable 1 reads", "block 10 jumps", "variable 100 writes", "variable 1 reads",
            "variable 102 reads", "program 9010 calls", "block 10 jumps"}));
}

TEST(Names, OfAFanucMill) {
  EXPECT_EQ(usesOf("fanuc-0m", "O1\nM98 P2\nWHILE [#1 LT 3] DO1\n#1 = #1 + 1\nEND1\nN5 M30\n"
                               "O2\nG66 P3 A1\nM99 P5\nO3\nM99\n"),
            (Uses{"program 1 defines", "program 2 calls", "variable 1 reads", "variable 1 writes",
                  "variable 1 reads", "program 2 defines", "program 3 calls", "block 5 returns",
                  "program 3 defines"}));
}

TEST(Names, OfASinumerik) {
  EXPECT_EQ(usesOf("sinumerik", "%_N_SHAFT_MPF\nEXTERN HOLE(REAL)\nDEF REAL DEPTH=5, FIELD[3]\n"
                                "R1=DEPTH+FIELD[2]\nFIELD[1]=R2\nSTART: G0 X=R1\n"
                                "IF R1>3 GOTOF DONE\nHOLE(DEPTH)\nMCALL HOLE(3)\nMCALL\n"
                                "L10 P2\nREPEAT START DONE P=2\nDONE: M0\nGOTOB N50\n"
                                "FOR R3=1 TO 5\nENDFOR\nM30\n"),
            (Uses{"program SHAFT defines",  "program HOLE declares", "variable DEPTH defines",
                  "variable FIELD defines", "variable R1 writes",    "variable DEPTH reads",
                  "variable FIELD reads",   "variable FIELD writes", "variable R2 reads",
                  "label START defines",    "variable R1 reads",     "variable R1 reads",
                  "label DONE jumps",       "program HOLE calls",    "variable DEPTH reads",
                  "program HOLE calls",     "program L10 calls",     "label START first",
                  "label DONE last",        "label DONE defines",    "block 50 jumps",
                  "variable R3 writes"}));
}

TEST(Names, OfParametersAndContoursOfASinumerik) {
  EXPECT_EQ(
      usesOf("sinumerik", "PROC HOLE(REAL DEPTH, VAR REAL BACK)\nDEFINE FAST AS G0\n"
                          "BACK=DEPTH*2\nFAST\nCYCLE72(\"CONTOUR\",5,0,2,-5,2)\n"
                          "CYCLE72(\"BEGIN:END\",5,0,2,-5,2)\nM17\n"),
      (Uses{"program HOLE declares", "variable DEPTH defines", "variable BACK defines",
            "macro FAST defines", "variable BACK writes", "variable DEPTH reads",
            "macro FAST reads", "program CONTOUR calls", "label BEGIN first", "label END last"}));
}

TEST(Names, OfAnEcs) {
  EXPECT_EQ(
      usesOf("ecs", "[BEGIN] N10 R1=5\n<JMP:N10>\n<IFF<R1-3>: N10; [BEGIN]; N10>\n"
                    "<RPT:N10;N20;3>\nN20 L<HOLES>\nL<&R2>\n<JMC: OTHER; N50>\n"
                    "<INP: \"number\"; R0; N10>\nX=R1 M17\n"),
      (Uses{"label BEGIN defines", "variable R1 writes", "block 10 jumps", "variable R1 reads",
            "block 10 jumps", "label BEGIN jumps", "block 10 jumps", "block 10 first",
            "block 20 last", "program HOLES calls", "variable R2 reads", "program OTHER jumps",
            "block 50 jumps", "variable R0 writes", "block 10 jumps", "variable R1 reads"}));
}

TEST(Names, OfAMefi) {
  EXPECT_EQ(usesOf("mefi", "N10 T5 M6\n\"a comment\nN20 R30 = 2\nN30 M30\n"),
            (Uses{"tool 5 reads", "variable R30 writes"}));
}

TEST(Names, OfALinuxCnc) {
  EXPECT_EQ(usesOf("linuxcnc", "o100 sub\n#<depth> = [#1 + #<_safe>]\no101 if [EXISTS[#<depth>]]\n"
                               "o101 endif\no100 endsub [#<depth>]\no100 call [1] [2]\n"
                               "#<depth> = 3\nM2\n"),
            (Uses{"subprogram 100 defines", "variable depth writes", "variable 1 reads",
                  "variable _safe reads", "bracket 101 reads", "variable depth reads",
                  "bracket 101 reads", "subprogram 100 reads", "variable depth reads",
                  "subprogram 100 calls", "variable depth writes"}));
}

/// Numbers of the lines that hold the same name as the first mark.
std::vector<unsigned> linesOf(const test::MarkedText &text) {
  std::vector<unsigned> lines;
  const Names &names = text->names();
  if (const Occurrence *one = names.at(text.marks[0]))
    for (const uint32_t i : names.same(*one))
      lines.push_back(text->source().position(names.all()[i].begin).line);
  return lines;
}

using LineNumbers = std::vector<unsigned>;

TEST(Names, BlocksAndLocalVariablesBelongToTheirProgram) {
  EXPECT_EQ(linesOf(test::markedText("fanuc-0m", "O1\nN1<|>0 #1=1\nGOTO 10\nM30\n"
                                                 "O2\nN10 #1=2\nM99\n")),
            (LineNumbers{2, 3}));
  EXPECT_EQ(linesOf(test::markedText("fanuc-0m", "O1\n#<|>1=1\nM30\nO2\n#1=2\nM99\n")),
            (LineNumbers{2}));
  EXPECT_EQ(linesOf(test::markedText("fanuc-0m", "O1\n#<|>100=1\nM30\nO2\n#100=2\nM99\n")),
            (LineNumbers{2, 5}));
}

TEST(Names, AReturnToABlockNamesOneOfTheCaller) {
  EXPECT_EQ(linesOf(test::markedText("fanuc-0m", "O1\nM98 P3\nN<|>10 M30\nO2\nN10 M30\n"
                                                 "O3\nN10 M99 P10\n")),
            (LineNumbers{3, 7}));
  EXPECT_EQ(linesOf(test::markedText("fanuc-0m", "O1\nN<|>10 G0\nM99 P10\n")), (LineNumbers{2, 3}));
}

TEST(Names, ASubprogramBetweenBracketsHasVariablesOfItsOwn) {
  EXPECT_EQ(linesOf(test::markedText("linuxcnc", "o100 sub\n#<a> = 1\no100 endsub\n"
                                                 "#<<|>a> = 2\n(x)\n#3 = #<a>\n")),
            (LineNumbers{4, 6}));
}

TEST(Names, OnlyADefinitionMakesANameTheProgramsOwn) {
  EXPECT_EQ(linesOf(test::markedText("sinumerik", "%_N_A_MPF\nDEF REAL DEEP\nDE<|>EP=1\nM30\n"
                                                  "%_N_B_SPF\nDEEP=2\nM17\n")),
            (LineNumbers{2, 3}));
  EXPECT_EQ(linesOf(test::markedText("sinumerik", "%_N_A_MPF\nDE<|>EP=1\nM30\n"
                                                  "%_N_B_SPF\nDEEP=2\nM17\n")),
            (LineNumbers{2, 5}));
}

TEST(Names, ALabelIsTheSameInAllItsSpellings) {
  EXPECT_EQ(linesOf(test::markedText("ecs", "[BE<|>GIN: here] G0 X1\n<JMP:[ begin ]>\n")),
            (LineNumbers{1, 2}));
  EXPECT_EQ(linesOf(test::markedText("sinumerik", "Again: G0 X1\nGOTOB AG<|>AIN\n")),
            (LineNumbers{1, 2}));
}

TEST(Names, AtAPlaceBeforeInAndAfterTheName) {
  const auto text = test::markedText("fanuc-0m", "<|>N1<|>0<|> G0<|> X#10<|>1 Y1<|>0\n");
  const Names &names = text->names();
  EXPECT_TRUE(names.at(text.marks[0]));
  EXPECT_TRUE(names.at(text.marks[1]));
  EXPECT_TRUE(names.at(text.marks[2]));
  EXPECT_FALSE(names.at(text.marks[3]));
  EXPECT_TRUE(names.at(text.marks[4]));
  EXPECT_FALSE(names.at(text.marks[5]));
}

TEST(Names, WhatOnlyTheRunDecidesIsKnownToBeUntold) {
  const auto text = test::markedText("fanuc-0m", "O1\nGOTO #1\nM30\nO2\n#[#1] = 2\nM98 P#3\nM99\n");
  const Names &names = text->names();
  EXPECT_NE(names.untold(0).target, UntoldNames::nowhere);
  EXPECT_EQ(names.untold(0).variable, UntoldNames::nowhere);
  EXPECT_EQ(names.untold(1).target, UntoldNames::nowhere);
  EXPECT_NE(names.untold(1).variable, UntoldNames::nowhere);
  EXPECT_NE(names.untold(1).call, UntoldNames::nowhere);
}

} // namespace
