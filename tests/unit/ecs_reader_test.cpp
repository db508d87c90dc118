// Reads blocks of ECS programs: words, items in angle brackets, labels, phases, expressions.
#include "tests/fuzz/reader_promises.h"
#include "tests/support/read_blocks.h"

#include <gtest/gtest.h>

namespace ncvet {
namespace {

class EcsReading : public test::BlockReading {
protected:
  EcsReading() : BlockReading("ecs") {}
};

TEST_F(EcsReading, WordsMayFollowEachOtherWithoutBlanks) {
  const Block block = blockOf("/N10G1X10.5Y-20DZ-1F100 {edge} 'to the corner\n");
  EXPECT_EQ(block.skip, 0);
  EXPECT_EQ(block.number, 10);
  ASSERT_EQ(block.words.size(), 5u);
  EXPECT_EQ(block.find('X')->value(), 10.5);
  EXPECT_EQ(block.find('Y')->value(), -20);
  EXPECT_EQ(block.find('Z'), nullptr) << "DZ is an address of its own";
  EXPECT_EQ(block.comments.size(), 2u);
  EXPECT_TRUE(block.issues.empty());
}

TEST_F(EcsReading, TheMinusOfAPlaneIsACodeOfItsOwn) {
  const Block up = blockOf("N10 G16XYZ+ G54.01\n");
  ASSERT_EQ(up.words.size(), 2u);
  EXPECT_EQ(up.words[0].mantissa, test::dialectNamed("ecs")->keyword("G16XYZ"));
  const Block down = blockOf("N10 G16XYZ- G54.01\n");
  ASSERT_EQ(down.words.size(), 3u);
  EXPECT_EQ(down.words[0].mantissa, test::dialectNamed("ecs")->keyword("G16XYZ"));
  EXPECT_EQ(down.words[1].mantissa, test::dialectNamed("ecs")->keyword("G16-"));
  EXPECT_EQ(down.words[1].offset, 10u);
  EXPECT_TRUE(down.issues.empty());
}

TEST_F(EcsReading, TheWordsOfAContourKeepTheirSigns) {
  const Block block = blockOf("N20 G1 X5 RC45 RA-2\n");
  ASSERT_EQ(block.words.size(), 4u);
  EXPECT_EQ(block.words[2].value(), 45);
  EXPECT_EQ(block.words[3].value(), -2);
}

TEST_F(EcsReading, AVariableIsAWordAndAnAssignmentAtTheSamePlace) {
  const Block block = blockOf("N30 G81 <ENT=-10><%CON = %CON+1> <CFF=CFZ>\n");
  ASSERT_EQ(block.items.size(), 3u);
  ASSERT_EQ(block.words.size(), 4u);
  EXPECT_EQ(block.words[1].address, variableAddress);
  EXPECT_EQ(block.words[1].value(), -10);
  EXPECT_EQ(block.words[1].offset, block.items[0].begin);
  EXPECT_EQ(block.keyOf(block.items[0].target), variableKey("ENT"));
  EXPECT_EQ(block.keyOf(block.items[1].target), variableKey("%CON"));
  EXPECT_NE(block.keyOf(block.items[1].target), variableKey("CON")) << "% belongs to the name";
  EXPECT_TRUE(block.issues.empty());
}

TEST_F(EcsReading, ExpressionsFollowTheControlsOrder) {
  const Block block = blockOf("R1=2+3*2**2 R2=-2**2 R3=133//40 R4=SQR(50**2+80**2)\n");
  ASSERT_EQ(block.items.size(), 4u);
  EXPECT_EQ(valueOf(block, block.items[0].value), 14);
  EXPECT_EQ(valueOf(block, block.items[1].value), -4);
  EXPECT_EQ(valueOf(block, block.items[2].value), 13);
  EXPECT_NEAR(valueOf(block, block.items[3].value), 94.34, 0.01);
}

TEST_F(EcsReading, ARadiusIsAWordAndAVariableTakesItsSign) {
  const Block block = blockOf("N10 G2 X10 Y0 R15\nN20 R15=3 X=R15\n");
  EXPECT_NE(block.find('R'), nullptr);
  EXPECT_TRUE(block.items.empty());
  const auto blocks = blocksOf("N20 R15=3 X=R15\n");
  EXPECT_EQ(blocks[0].items.size(), 1u);
  EXPECT_EQ(blocks[0].find('R'), nullptr);
  ASSERT_NE(blocks[0].find('X'), nullptr);
  EXPECT_TRUE(blocks[0].find('X')->has(wordExpression));
}

TEST_F(EcsReading, ComputedCodesAndTargetsAreExpressions) {
  const Block block = blockOf("N10 G<FTI(1.2)> X5 T<FTL(14.6)>\n");
  ASSERT_NE(block.find('G'), nullptr);
  EXPECT_EQ(valueOf(block, uint16_t(block.find('G')->mantissa)), 1);
  EXPECT_EQ(valueOf(block, uint16_t(block.find('T')->mantissa)), 14);
}

TEST_F(EcsReading, AChoiceHasThreeTargetsAndBothSeparators) {
  const Block block = blockOf("N10 <IFF<R1-5> : N20, N<R2>; [HOME]>\n");
  ASSERT_EQ(block.items.size(), 1u);
  const Item &item = block.items[0];
  EXPECT_EQ(item.kind, ItemKind::Jump);
  EXPECT_EQ(item.jump, JumpKind::BySign);
  const auto targets = block.argumentsOf(item);
  ASSERT_EQ(targets.size(), 3u);
  EXPECT_EQ(targets[0].kind, ArgumentKind::BlockNumber);
  EXPECT_EQ(targets[1].separator, ',');
  EXPECT_EQ(targets[2].separator, ';');
  EXPECT_EQ(targets[2].kind, ArgumentKind::Label);
  EXPECT_TRUE(block.issues.empty());
}

TEST_F(EcsReading, AChoiceOfTwoTargetsLacksOne) {
  EXPECT_EQ(issuesOf(blockOf("N10 <IFF<R1>: N20; N30>\n")),
            (std::vector<SyntaxIssueKind>{SyntaxIssueKind::MissingArgument}));
}

TEST_F(EcsReading, ArgumentsWithNamesTakeThePlacesOfTheTable) {
  const Block block = blockOf("N10 <G69: FIL=2; AX=XY>\n");
  const Word *axes = block.argument(1), *filter = block.argument(6);
  ASSERT_TRUE(axes && filter);
  EXPECT_EQ(block.endOf(*axes) - axes->offset, 2u);
  EXPECT_EQ(valueOf(block, uint16_t(filter->mantissa)), 2);
  EXPECT_TRUE(block.argument(2)->has(wordNoValue));
  const Block spline = blockOf("N20 <SPL:ON;P21;X>\n");
  ASSERT_TRUE(spline.argument(9));
  EXPECT_EQ(valueOf(spline, uint16_t(spline.argument(9)->mantissa)), 21);
}

TEST_F(EcsReading, ABlockNumberWithASignIsOneAllTheSame) {
  const Block block = blockOf("N-5 G0 X1\n");
  EXPECT_GE(block.number, 0);
  EXPECT_EQ(issuesOf(block), (std::vector<SyntaxIssueKind>{SyntaxIssueKind::MalformedNumber}));
}

TEST_F(EcsReading, ARepeatNamesItsBlocksAndItsCount) {
  const Block block = blockOf("N40 <RPT:N10;N30;<%NRP>>\n");
  ASSERT_EQ(block.items.size(), 1u);
  EXPECT_EQ(block.items[0].kind, ItemKind::Repeat);
  EXPECT_EQ(block.argumentsOf(block.items[0]).size(), 2u);
  EXPECT_EQ(block.variableOf(block.items[0].count), variableKey("%NRP"));
}

TEST_F(EcsReading, AnInputHasItsWayOutFirstAndThenItsPromptAndBounds) {
  const Block block = blockOf("N10 <INP: \"Radius [mm] <100\"; R0; N100;10;100>\n");
  ASSERT_EQ(block.items.size(), 1u);
  EXPECT_EQ(block.items[0].kind, ItemKind::Input);
  const auto arguments = block.argumentsOf(block.items[0]);
  ASSERT_EQ(arguments.size(), 4u);
  EXPECT_EQ(arguments[0].kind, ArgumentKind::BlockNumber);
  EXPECT_EQ(arguments[1].kind, ArgumentKind::Text);
  EXPECT_EQ(spelling(arguments[1].begin, arguments[1].end), "Radius [mm] <100");
  EXPECT_TRUE(block.issues.empty());
}

TEST_F(EcsReading, ABoundOfAnInputMayBeEmpty) {
  const Block block = blockOf("N10 <INP: \"R\"; R0; N100;;100>\n");
  ASSERT_EQ(block.items.size(), 1u);
  const auto arguments = block.argumentsOf(block.items[0]);
  ASSERT_EQ(arguments.size(), 4u);
  EXPECT_EQ(arguments[2].kind, ArgumentKind::Empty);
  EXPECT_TRUE(block.issues.empty());
}

TEST_F(EcsReading, CallsNameAProgramOrTheVariableThatDoes) {
  const auto blocks = blocksOf("N10 L<SUB1>\nN20 L <C:\\ECS.CNC\\PROGRAM\\SUB2>\nN30 L<&R12>\n");
  ASSERT_EQ(blocks.size(), 3u);
  for (const Block &block : blocks) {
    ASSERT_EQ(block.items.size(), 1u);
    EXPECT_EQ(block.items[0].kind, ItemKind::Call);
  }
  EXPECT_EQ(spelling(blocks[0].items[0].nameBegin, blocks[0].items[0].nameEnd), "SUB1");
  EXPECT_EQ(spelling(blocks[1].items[0].nameBegin, blocks[1].items[0].nameEnd), "SUB2");
  EXPECT_NE(blocks[2].items[0].value, noExpression);
}

TEST_F(EcsReading, LabelsAreKnownByEightCharactersBeforeAColon) {
  const auto blocks = blocksOf("[OBJECT 6]\nN10 <JMP:[F1:MAINWINDOW]>\n");
  EXPECT_TRUE(blocks[0].hasLabel());
  EXPECT_EQ(reader_->labelKey("OBJECT 6"), "OBJECT6");
  EXPECT_EQ(reader_->labelKey("F1:MAINWINDOW"), "F1");
  EXPECT_EQ(reader_->labelKey("CONTOUR10"), reader_->labelKey("CONTOUR11"));
  EXPECT_NE(reader_->labelKey("CONT10"), reader_->labelKey("CONT11"));
}

TEST_F(EcsReading, APhaseIsABlockWithItsNumber) {
  for (const char *text : {":20 {second side}\n", ":N20\n"}) {
    const Block block = blockOf(text);
    EXPECT_EQ(block.number, 20) << text;
    EXPECT_TRUE(block.mainBlock) << text;
    EXPECT_TRUE(block.issues.empty()) << text;
  }
}

TEST_F(EcsReading, WhatFollowsTheResetIsARemark) {
  const Block block = blockOf("% PLATE 12\n");
  EXPECT_EQ(block.comments.size(), 1u);
  EXPECT_EQ(block.find('P'), nullptr);
}

TEST_F(EcsReading, ParenthesesAreCommentsBetweenWordsAndBracketsInExpressions) {
  const Block block = blockOf("N10 (shown) X=(R1+2)*3 Y5\n");
  EXPECT_EQ(block.comments.size(), 1u);
  ASSERT_NE(block.find('Y'), nullptr);
  EXPECT_TRUE(block.issues.empty());
}

TEST_F(EcsReading, SlipsAreNamedAndReadingGoesOn) {
  using Kinds = std::vector<SyntaxIssueKind>;
  EXPECT_EQ(issuesOf(blockOf("N10 X- 40 Y5\n")), Kinds{SyntaxIssueKind::BlankInNumber});
  EXPECT_EQ(issuesOf(blockOf("N10 G0 X1 {start\n")), Kinds{SyntaxIssueKind::UnclosedComment});
  EXPECT_EQ(issuesOf(blockOf("N70 <RET\n")), Kinds{SyntaxIssueKind::UnbalancedBracket});
  EXPECT_EQ(issuesOf(blockOf("N10 G0 X1 ; go\n")), Kinds{SyntaxIssueKind::ForeignComment});
  EXPECT_EQ(issuesOf(blockOf("N10 X\xE2\x80\x93"
                             "5\n")),
            Kinds{SyntaxIssueKind::TypographicMinus});
  const Block block = blockOf("N10 X- 40 Y5\n");
  ASSERT_NE(block.find('Y'), nullptr);
  EXPECT_EQ(block.find('Y')->value(), 5);
}

/// Nothing is read after the text: seen by the sanitizers.
TEST_F(EcsReading, APlaneWithoutAxesAtTheEndIsACode) {
  for (const char *text : {"N10 G16", "N10 G16 ", "N10 G16\t\t"}) {
    const Block block = blockOf(text);
    ASSERT_NE(block.find('G'), nullptr) << text;
    EXPECT_EQ(block.find('G')->value(), 16) << text;
  }
}

/// Every form of the manual in one text; reading may begin at each of its blocks.
constexpr const char *everyForm = "% PLATE\n"
                                  "N1 G16XYZ+ <CFF=CFZ>\n"
                                  "N2 T1 M6 (mill 10)\n"
                                  "[OBJECT 6]\n"
                                  "/N10 G1 X=R1*2 DY-5 RC45 RA-2 F100 'edge\n"
                                  "N20 R1=SQR (R1**2 + R2**2) #271=5\n"
                                  "N30 G83 <ENT=-9><RAP=2> <RAL=5> <INI=R3> <IND=1>\n"
                                  "N40 <IFF<R1 - 5> : N50, N60, N70>\n"
                                  "N50 <INP: \"Radius [mm]\"; R0; N100;;100>\n"
                                  "N60 <JMC: PROG; N50> \n"
                                  "N70 <RPT:N10;N20;<%NRP>>\n"
                                  ":N80 {second side}\n"
                                  "N90 L<FORFLA> X0 Y0 I5 J0 <%NHL=6> <ARC=0> <RDF=0> <AIN=90>\n"
                                  "N95 L<&R12>\n"
                                  "N96 O5 = G2 I0 J0 R250\n"
                                  "N97 G1 G48 P2\n"
                                  "N98 <G69: AX=XYZ; E=0.02; S=ON>\n"
                                  "N99 <REP:N1;N2 X5 <<>> ] } ) ~ \xFF\n"
                                  "N100 G<FTI(R0)> X5 K\r\n"
                                  "N110 M30";

TEST_F(EcsReading, BeginningAnywhereReadsTheSameBlocks) {
  for (const Block &block : blocksOf(everyForm)) {
    Block again;
    reader_->read(block.begin, again);
    EXPECT_TRUE(fuzz::sameBlock(block, again)) << spelling(block.begin, block.end).str();
  }
  EXPECT_EQ(blocksOf(everyForm).size(), 20u);
}

TEST_F(EcsReading, EveryBeginningOfATextIsReadToItsEnd) {
  const llvm::StringRef whole = everyForm;
  for (size_t length = 0; length <= whole.size(); ++length)
    fuzz::readAll(*test::dialectNamed("ecs"), whole.take_front(length));
}

/// Such a block is most of a long program: nothing of it needs the stores of expressions.
TEST_F(EcsReading, APlainBlockIsWordsAlone) {
  const Block block = blockOf("N10 X1.5 Y2 F100\n");
  EXPECT_EQ(block.words.size(), 3u);
  EXPECT_EQ(block.words.capacity(), Block().words.capacity()) << "no store beyond the block's own";
  EXPECT_TRUE(block.items.empty());
  EXPECT_TRUE(block.expressions.empty());
  EXPECT_TRUE(block.operations.empty());
}

} // namespace
} // namespace ncvet
