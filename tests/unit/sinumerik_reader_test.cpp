// Reads blocks of Sinumerik programs: words with and without `=`, statements, calls by name.
#include "tests/support/read_blocks.h"

#include <gtest/gtest.h>

namespace ncvet {
namespace {

class SinumerikReading : public test::BlockReading {
protected:
  SinumerikReading() : BlockReading("sinumerik") {}
};

TEST_F(SinumerikReading, WordsMayFollowEachOtherWithoutBlanks) {
  const Block block = blockOf("/2 N10G1X10.5Y-20F100 ; along the edge\n");
  EXPECT_EQ(block.skip, 2);
  EXPECT_EQ(block.number, 10);
  ASSERT_EQ(block.words.size(), 4u);
  EXPECT_EQ(block.find('X')->value(), 10.5);
  EXPECT_EQ(block.find('Y')->value(), -20);
  EXPECT_EQ(block.comments.size(), 1u);
  EXPECT_TRUE(block.issues.empty());
}

TEST_F(SinumerikReading, AWideColonEndsALabelAndIsTold) {
  for (const char *colon : {"\xEF\xBC\x9A", "\xA3\xBA", "\xEF\xBF\xBD\xEF\xBF\xBD"}) {
    const Block block = blockOf(("ERROR1" + std::string(colon) + "MSG(\"stopped\")\n").c_str());
    EXPECT_TRUE(block.hasLabel());
    ASSERT_EQ(block.issues.size(), 1u);
    EXPECT_EQ(block.issues[0].kind, SyntaxIssueKind::InvalidCharacter);
  }
  EXPECT_FALSE(blockOf("R1=5 ;ERROR1\xEF\xBC\x9A\n").hasLabel());
}

TEST_F(SinumerikReading, AnAddressOfSeveralLettersTakesAnEqualsSign) {
  const Block block = blockOf("G2 X10 Y=AC(5) CR=-7.5 I=IC(R1+2) AP=30\n");
  ASSERT_EQ(block.words.size(), 6u);
  EXPECT_EQ(block.words[3].value(), -7.5);
  EXPECT_EQ(block.find('Y')->reading(), WordReading::Absolute);
  EXPECT_EQ(valueOf(block, uint16_t(block.find('Y')->mantissa)), 5);
  EXPECT_EQ(block.find('I')->reading(), WordReading::Incremental);
  EXPECT_TRUE(block.issues.empty());
}

TEST_F(SinumerikReading, TheFirstSpindleIsTheOneWithoutANumber) {
  const Block block = blockOf("S1=500 M1=3 S2=900 M2=4\n");
  ASSERT_EQ(block.words.size(), 2u);
  EXPECT_EQ(block.find('S')->value(), 500);
  EXPECT_EQ(block.find('M')->value(), 3);
  EXPECT_EQ(block.items.size(), 2u); // of a spindle that the program does not speak of otherwise
}

TEST_F(SinumerikReading, AChoiceWithoutItsJumpNamesItsTargetAllTheSame) {
  const Block block = blockOf("CASE(R20) OF 1 SMALL 2 GOTOF LARGE DEFAULT GOTOF ENDING\n");
  EXPECT_EQ(block.issues.size(), 1u);
  ASSERT_EQ(block.items.size(), 1u);
  EXPECT_EQ(block.items[0].arguments, 5u); // two values, three targets
}

TEST_F(SinumerikReading, ParametersAfterTheAttributesAreReadAllTheSame) {
  const Block block = blockOf("PROC SLOT SAVE (REAL LENGTH, REAL DEPTH)\n");
  EXPECT_EQ(block.issues.size(), 1u);
  ASSERT_EQ(block.items.size(), 1u);
  EXPECT_EQ(block.items[0].arguments, 2u);
}

TEST_F(SinumerikReading, HeadersNameTheProgram) {
  const auto blocks = blocksOf("%_N_SHAFT_MPF\n;$PATH=/_N_MPF_DIR\n%GROOVE_SPF\n%\n");
  ASSERT_EQ(blocks.size(), 4u);
  EXPECT_EQ(blocks[0].kind, BlockKind::ProgramHeader);
  EXPECT_EQ(spelling(blocks[0].nameBegin, blocks[0].nameEnd), "SHAFT");
  EXPECT_EQ(blocks[1].kind, BlockKind::Empty);
  EXPECT_EQ(spelling(blocks[2].nameBegin, blocks[2].nameEnd), "GROOVE");
  EXPECT_EQ(blocks[3].kind, BlockKind::Tape);
}

TEST_F(SinumerikReading, ANameAloneIsACall) {
  const auto blocks = blocksOf("MILL1 P3\nL010\nOBD(10,,R1,\"TXT\") P=R2\nMCALL BOHR(5)\n"
                               "EXTCALL(\"BIG\")\nPCALL /_N_SPF_DIR/POS(1)\n");
  ASSERT_EQ(blocks.size(), 6u);
  for (const Block &block : blocks)
    EXPECT_TRUE(block.issues.empty());
  EXPECT_EQ(spelling(blocks[0].items[0].nameBegin, blocks[0].items[0].nameEnd), "MILL1");
  EXPECT_EQ(valueOf(blocks[0], blocks[0].items[0].count), 3);
  EXPECT_EQ(spelling(blocks[1].items[0].nameBegin, blocks[1].items[0].nameEnd), "L010");
  const auto arguments = blocks[2].argumentsOf(blocks[2].items[0]);
  ASSERT_EQ(arguments.size(), 4u);
  EXPECT_EQ(arguments[1].kind, ArgumentKind::Empty);
  EXPECT_EQ(arguments[3].kind, ArgumentKind::Text);
  EXPECT_EQ(spelling(arguments[3].begin, arguments[3].end), "TXT");
  EXPECT_TRUE(blocks[3].items[0].modal);
  EXPECT_TRUE(blocks[4].items[0].external);
  EXPECT_EQ(blocks[5].items[0].kind, ItemKind::Call);
}

TEST_F(SinumerikReading, ACalledSectionIsARepeatOfIt) {
  const auto blocks = blocksOf("CALL BLOCK FIRST TO LAST\nCALL BLOCK FIRST TO LAST<<R1\n");
  ASSERT_EQ(blocks.size(), 2u);
  ASSERT_EQ(blocks[0].items.size(), 1u);
  EXPECT_EQ(blocks[0].items[0].kind, ItemKind::Repeat);
  EXPECT_EQ(valueOf(blocks[0], blocks[0].items[0].count), 1);
  const auto labels = blocks[0].argumentsOf(blocks[0].items[0]);
  ASSERT_EQ(labels.size(), 2u);
  EXPECT_EQ(spelling(labels[0].begin, labels[0].end), "FIRST");
  EXPECT_EQ(spelling(labels[1].begin, labels[1].end), "LAST");
  ASSERT_EQ(blocks[1].items.size(), 1u); // which label that is only the run knows
  EXPECT_EQ(blocks[1].items[0].kind, ItemKind::Call);
  EXPECT_TRUE(blocks[1].items[0].external);
}

TEST_F(SinumerikReading, ACycleIsAWordWithArguments) {
  const Block block = blockOf("N60 MCALL CYCLE83(20,0,2,-40,,-12,,R5)\n");
  ASSERT_NE(block.argument(4), nullptr);
  EXPECT_EQ(block.argument(4)->value(), -40);
  EXPECT_TRUE(block.argument(5)->has(wordNoValue));
  EXPECT_TRUE(block.argument(8)->has(wordExpression));
  EXPECT_EQ(block.argument(9), nullptr);
  EXPECT_TRUE(block.issues.empty());
}

TEST_F(SinumerikReading, ComparisonsBindWeakest) {
  const auto blocks = blocksOf("R1=2+3*4-10/5\nR2=(1<2) AND (3>2)\nR3=NOT 0 OR 0\nR4='H1F'+'B101'\n"
                               "R5=1.5EX-3\nR6=7 DIV 2 + 7 MOD 4\nR7=ATAN2(1,1)\n");
  const double wanted[] = {12, 1, 1, 36, 0.0015, 6, 45};
  ASSERT_EQ(blocks.size(), 7u);
  for (size_t i = 0; i < 7; ++i) {
    EXPECT_TRUE(blocks[i].issues.empty()) << i;
    EXPECT_DOUBLE_EQ(valueOf(blocks[i], blocks[i].items[0].value), wanted[i]) << i;
  }
  EXPECT_EQ(issuesOf(blockOf("IF R1==1 AND R2==2 GOTOF A1\n")),
            std::vector{SyntaxIssueKind::AmbiguousExpression});
}

/// By these priorities `A==1 AND B==1` is `(A==(1 AND B))==1`: true where both are 1 or both are 0.
TEST_F(SinumerikReading, ComparisonsJoinedByAndAreDecidedByThePriorities) {
  const auto blocks = blocksOf("R1=(1==1 AND 1==1)\nR1=(1==1 AND 0==1)\nR1=(0==1 AND 1==1)\n"
                               "R1=(0==1 AND 0==1)\nR1=(0==1) AND (0==1)\n");
  const double wanted[] = {1, 0, 0, 1, 0};
  ASSERT_EQ(blocks.size(), std::size(wanted));
  for (size_t i = 0; i < blocks.size(); ++i)
    EXPECT_EQ(valueOf(blocks[i], blocks[i].items[0].value), wanted[i]) << i;
}

TEST_F(SinumerikReading, JumpsMayBeSeveralInABlock) {
  const Block block = blockOf("N120 IF R1==1 GOTOF DONE IF R1==2 GOTOB N100\n");
  ASSERT_EQ(block.items.size(), 4u);
  EXPECT_EQ(block.items[1].jump, JumpKind::Forward);
  EXPECT_EQ(block.items[3].jump, JumpKind::Backward);
  EXPECT_EQ(block.argumentsOf(block.items[1])[0].kind, ArgumentKind::Label);
  EXPECT_EQ(block.argumentsOf(block.items[3])[0].kind, ArgumentKind::BlockNumber);
}

TEST_F(SinumerikReading, ACaseIsAJumpByValue) {
  const Block block = blockOf("CASE(R1) OF 1 GOTOF ONE 2 GOTOF TWO DEFAULT GOTOF OTHER\n");
  ASSERT_EQ(block.items.size(), 1u);
  EXPECT_EQ(block.items[0].jump, JumpKind::ByValue);
  EXPECT_EQ(block.items[0].arguments, 5u);
}

TEST_F(SinumerikReading, RepeatAloneIsALoopAndWithLabelsASection) {
  const auto blocks = blocksOf("REPEAT\nUNTIL R1<=0\nREPEAT A1 A2 P=3\nREPEATB HOLE P=2\n");
  EXPECT_EQ(blocks[0].items[0].structure, Structure::Repeat);
  EXPECT_EQ(blocks[1].items[0].structure, Structure::Until);
  EXPECT_EQ(blocks[2].items[0].kind, ItemKind::Repeat);
  EXPECT_EQ(blocks[2].items[0].arguments, 2u);
  EXPECT_EQ(valueOf(blocks[2], blocks[2].items[0].count), 3);
  EXPECT_TRUE(blocks[3].items[0].single);
}

TEST_F(SinumerikReading, DefinitionsHaveTypesSizesAndValues) {
  const auto blocks = blocksOf("DEF REAL A=5, B[3,2], C\nDEF STRING[20] NAME\n"
                               "PROC OBD(REAL A, INT N=1, VAR REAL OUT) SAVE DISPLOF\n"
                               "EXTERN OBD(REAL,INT,VAR REAL)\n");
  ASSERT_EQ(blocks[0].items.size(), 3u);
  EXPECT_EQ(blocks[0].items[1].arguments, 2u);
  EXPECT_EQ(blocks[1].items[0].type, VariableType::String);
  ASSERT_EQ(blocks[2].items[0].kind, ItemKind::Parameters);
  EXPECT_TRUE(blocks[2].items[0].restores);
  const auto parameters = blocks[2].argumentsOf(blocks[2].items[0]);
  ASSERT_EQ(parameters.size(), 3u);
  EXPECT_TRUE(parameters[2].byReference);
  EXPECT_EQ(blocks[3].items[0].kind, ItemKind::Declaration);
  for (const Block &block : blocks)
    EXPECT_TRUE(block.issues.empty());
}

TEST_F(SinumerikReading, LabelsMayBeGluedToTheirStatement) {
  const auto blocks = blocksOf("N10 LOOP1: G1 X10\nERR1:STOPRE\nA1:X5\n");
  EXPECT_EQ(spelling(blocks[0].labelBegin, blocks[0].labelEnd), "LOOP1");
  EXPECT_EQ(blocks[0].words.size(), 2u);
  EXPECT_TRUE(blocks[1].hasLabel());
  EXPECT_EQ(spelling(blocks[2].labelBegin, blocks[2].labelEnd), "A1");
}

TEST_F(SinumerikReading, SlipsAreIssuesAndTheRestIsRead) {
  EXPECT_EQ(issuesOf(blockOf("G1 X10,5 Y20\n")), std::vector{SyntaxIssueKind::DecimalComma});
  EXPECT_EQ(issuesOf(blockOf("G2 X10 CR20\n")), std::vector{SyntaxIssueKind::MissingEquals});
  EXPECT_EQ(issuesOf(blockOf("G1 X (edge) Y5\n")).back(), SyntaxIssueKind::ForeignComment);
  EXPECT_EQ(issuesOf(blockOf("TRAORI (SIEMENS 5-AXIS TRANSFORMATION)\n")),
            std::vector{SyntaxIssueKind::ForeignComment});
  EXPECT_EQ(issuesOf(blockOf("IF R1=2 GOTOF END1\n")),
            std::vector{SyntaxIssueKind::AssignmentInTest});
  EXPECT_EQ(issuesOf(blockOf("CYCLE81(50,0,2\n")), std::vector{SyntaxIssueKind::UnbalancedBracket});
  EXPECT_EQ(issuesOf(blockOf("CYCLE81(RTP=50,0,2,-5)\n")),
            std::vector{SyntaxIssueKind::NamedArgument});
}

TEST_F(SinumerikReading, ASynchronisedActionIsTheRestOfItsBlock) {
  for (const char *text :
       {"WHEN $A_IN[1]==1 DO DELDTG(X) $AC_MARKER[1]=2\n",
        "WHENEVER ($$AA_IM[X]>$$AA_IM[Y]) DO $AC_OVR=0\n",
        "id = 14 whenever($$a_ina[3] > 5) do $ac_marker[1] = $$a_ina[3]\n",
        "N10 ID=1 EVERY $A_DBB[5]<>0 DO POS[Q1]=$A_DBB[5] FA[Q1]=500\n",
        "IDS=20 WHENEVER G710 ($AC_PARAM[31]+$A_DBB[55]) DO $A_OUT[1]=1 ELSE $A_OUT[1]=0\n",
        "FROM ($AA_IM[X]>5) AND ($AA_IM[X]<9) DO RDISABLE\n", "DO $A_OUTA[1]=$AA_IM[X]*2\n",
        "WHEN TRUE DO SPOS=0 M8 H10 MOV[U]=1\n"}) {
    const Block block = blockOf(text);
    EXPECT_TRUE(block.issues.empty()) << text;
    // What the control does beside the program, and the number of the action.
    for (const Item &item : block.items)
      EXPECT_TRUE(item.kind == ItemKind::Output || item.kind == ItemKind::Instruction) << text;
  }
  // The path is the program's own.
  for (const char *text :
       {"DO G1 X5\n", "DO F100\n", "DO T2\n", "DO TRANS X5\n", "ID=1 WHEN $A_IN[1]==1 DO G41\n"})
    EXPECT_EQ(issuesOf(blockOf(text)), std::vector{SyntaxIssueKind::NoAction}) << text;
  EXPECT_TRUE(issuesOf(blockOf("DO G71\n")).empty());
  EXPECT_EQ(issuesOf(blockOf("R1=$$A_IN[1]\n")), std::vector{SyntaxIssueKind::BadExpression});
  EXPECT_EQ(issuesOf(blockOf("WHEN $A_IN[1]==1\n")), std::vector{SyntaxIssueKind::BadStatement});
  EXPECT_EQ(issuesOf(blockOf("WHEN $A_IN[1]=1 DO M8\n")),
            std::vector{SyntaxIssueKind::AssignmentInTest});
  // What nobody knows from here on.
  const Block written = blockOf("WHEN $A_IN[2]==1 DO $R[280]=$AA_IM[X]\n");
  ASSERT_EQ(written.items.size(), 2u);
  EXPECT_EQ(written.items[0].kind, ItemKind::Assignment);
  EXPECT_EQ(valueOf(written, written.items[0].target), double(blockOf("R280=1\n").keyOf(0)));
  EXPECT_TRUE(std::isnan(valueOf(written, written.items[0].value)));
}

TEST_F(SinumerikReading, AndOfWholeNumbersAsksWhetherTheyAreZero) {
  const auto blocks = blocksOf("R1=5 AND 2\nR1=5 B_AND 2\nR1=5 B_AND 4\nR1=0 OR 6\nR1=2 XOR 3\n"
                               "R1=2 B_XOR 3\nR1=NOT 5\nR1=(1==1) AND 8\n");
  const double wanted[] = {1, 0, 4, 1, 0, 1, 0, 1};
  ASSERT_EQ(blocks.size(), std::size(wanted));
  for (size_t i = 0; i < blocks.size(); ++i)
    EXPECT_EQ(valueOf(blocks[i], blocks[i].items[0].value), wanted[i]) << i;
}

TEST_F(SinumerikReading, ALinkOfAChainMayBeAlone) {
  EXPECT_TRUE(blockOf("MSG(<<R1)\n").issues.empty());
  EXPECT_TRUE(blockOf("TXT=<<R1<<\" mm\"\n").issues.empty());
  EXPECT_TRUE(blockOf("MSG(\"R1=\"<<R1<<\"; done\")\n").issues.empty());
}

TEST_F(SinumerikReading, APolynomialMovesItsAxisSomewhere) {
  const Block block = blockOf("PO[X]=(10,2,3) PO[Y]=(3,4)/(2,1) Z5\n");
  EXPECT_TRUE(block.issues.empty());
  ASSERT_EQ(block.words.size(), 3u);
  EXPECT_TRUE(std::isnan(valueOf(block, uint16_t(block.find('X')->mantissa))));
  EXPECT_EQ(spelling(block.words[1].offset, block.endOf(block.words[1])), "PO[Y]=(3,4)/(2,1)");
}

TEST_F(SinumerikReading, AStrayTextIsOneIssue) {
  for (const char *text : {"G1 X10 'A' Y20\n", "G1 X10 \"G2 X5\" Y20\n"}) {
    const Block block = blockOf(text);
    EXPECT_EQ(issuesOf(block), std::vector{SyntaxIssueKind::InvalidCharacter});
    ASSERT_EQ(block.words.size(), 3u);
    EXPECT_EQ(block.find('Y')->value(), 20);
  }
}

TEST_F(SinumerikReading, ADecimalCommaKeepsTheValueThatIsMeant) {
  const auto blocks = blocksOf("R1=0,5\nX=-1,25\nCR=7,5\n");
  for (const Block &block : blocks)
    EXPECT_EQ(issuesOf(block), std::vector{SyntaxIssueKind::DecimalComma});
  EXPECT_EQ(valueOf(blocks[0], blocks[0].items[0].value), 0.5);
  EXPECT_EQ(blocks[1].find('X')->value(), -1.25);
}

TEST_F(SinumerikReading, BlanksMayBeRoundTheEqualsSign) {
  const Block block = blockOf("X1 = 10 S2 = 500 M1 = 3 R1 = 7 CR = 5\n");
  EXPECT_TRUE(block.issues.empty());
  EXPECT_EQ(block.find('M')->value(), 3);
  EXPECT_TRUE(block.has(letterAddress('X')));
  EXPECT_EQ(block.items.size(), 2u); // the speed of the second spindle, and R1
}

TEST_F(SinumerikReading, AStrayValueIsOneIssue) {
  const Block block = blockOf("G0 = 10 X5\n");
  EXPECT_EQ(issuesOf(block), std::vector{SyntaxIssueKind::InvalidCharacter});
  EXPECT_EQ(block.find('X')->value(), 5);
  EXPECT_EQ(issuesOf(blockOf("G0[10] = 10 X5\n")), std::vector{SyntaxIssueKind::InvalidCharacter});
}

TEST_F(SinumerikReading, ALineOfProseIsOneIssue) {
  const Block block = blockOf("Magazine slot number 1,1,1\n");
  EXPECT_EQ(issuesOf(block), std::vector{SyntaxIssueKind::NotABlock});
  EXPECT_TRUE(block.isEmpty());
  EXPECT_TRUE(blockOf("ROUGH FAST X10\n").issues.empty()); // macros
}

TEST_F(SinumerikReading, StepsOfAShopfloorEditorNeedNotBeFound) {
  const auto blocks = blocksOf("E_HEAD(1,2,3);*RO*\nE_DR_SIN(5,100);*RO*\nPOCKETS\n");
  ASSERT_EQ(blocks.size(), 3u);
  EXPECT_TRUE(blocks[0].items[0].external);
  EXPECT_TRUE(blocks[1].items[0].external);
  EXPECT_FALSE(blocks[2].items[0].external);
  EXPECT_FALSE(blockOf("E_DR_SIN(5,100)\n").items[0].external); // a program of the shop's own
}

TEST_F(SinumerikReading, WhatOldEditorsLeaveIsBlank) {
  const auto blocks = blocksOf("\x11N10 M30\x13\n\x1A");
  ASSERT_EQ(blocks.size(), 2u);
  EXPECT_TRUE(blocks[0].issues.empty());
  EXPECT_EQ(blocks[1].kind, BlockKind::Empty);
}

TEST_F(SinumerikReading, ARedefinitionSaysNothingOfTheProgram) {
  const Block block = blockOf("REDEF $MN_USER_DATA_INT APR 7 APW 1\n");
  EXPECT_TRUE(block.issues.empty());
  ASSERT_EQ(block.items.size(), 1u);
  EXPECT_EQ(block.items[0].kind, ItemKind::Output);
}

TEST_F(SinumerikReading, BeginningAnywhereReadsTheSameBlocks) {
  const auto blocks = blocksOf(
      "%_N_A_MPF\nN10 G54 G17\n\nA1: IF R1==1 GOTOB A1\nDEF INT K\r\nMSG(\"a;b\") ; c\nM30");
  for (const Block &block : blocks) {
    Block again;
    reader_->read(block.begin, again);
    EXPECT_EQ(again.next, block.next);
    EXPECT_EQ(again.words.size(), block.words.size());
    EXPECT_EQ(again.items.size(), block.items.size());
  }
  EXPECT_EQ(blocks.size(), 7u);
}

} // namespace
} // namespace ncvet
