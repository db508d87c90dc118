// Reads blocks of ECS programs: labels, instructions and variables in angle brackets, expressions.
#include "formats/dialect/loader.h"
#include "formats/readers/reader.h"
#include "interp/expression.h"
#include "tests/support/run_program.h"

#include <gtest/gtest.h>

namespace ncvet {
namespace {

class EcsReading : public testing::Test {
protected:
  std::vector<Block> blocksOf(llvm::StringRef text) {
    text_ = text.str();
    dialect_ = test::dialectNamed("ecs");
    reader_ = makeReader(*dialect_, text_);
    std::vector<Block> blocks;
    for (uint32_t at = reader_->first(); at < text_.size(); at = blocks.back().next) {
      reader_->read(at, blocks.emplace_back());
      EXPECT_GT(blocks.back().next, at);
    }
    return blocks;
  }
  Block blockOf(llvm::StringRef text) { return blocksOf(text).front(); }
  llvm::StringRef spelling(uint32_t begin, uint32_t end) const {
    return llvm::StringRef(text_).slice(begin, end);
  }
  double valueOf(const Block &block, uint16_t index) const {
    const Value value = evaluate(block, index, MachineState(), nullptr);
    return value.isConstant() ? value.number.value() : std::nan("");
  }
  /// The word along `axis`: a place, or with `kind` Increment a distance.
  const Word *along(const Block &block, Axis axis, AddressKind kind) const {
    for (const Word &word : block.words)
      if (dialect_->addresses[word.address].kind == kind &&
          dialect_->addresses[word.address].axis == axis)
        return &word;
    return nullptr;
  }
  std::vector<SyntaxIssueKind> issuesOf(const Block &block) const {
    std::vector<SyntaxIssueKind> kinds;
    for (const SyntaxIssue &issue : block.issues)
      kinds.push_back(issue.kind);
    return kinds;
  }
  std::string text_;
  std::shared_ptr<const Dialect> dialect_;
  std::unique_ptr<Reader> reader_;
};

TEST_F(EcsReading, WordsNumbersAndTheThreeKindsOfComment) {
  const Block block = blockOf("/N10 G1 X10.5 DY-20 F100 (edge) {to the operator} 'rest of it X5\n");
  EXPECT_GE(block.skip, 0);
  EXPECT_EQ(block.number, 10);
  EXPECT_EQ(block.find('X')->value(), 10.5);
  const Word *distance = along(block, Axis::Y, AddressKind::Increment);
  ASSERT_NE(distance, nullptr);
  EXPECT_EQ(distance->value(), -20);
  EXPECT_EQ(block.comments.size(), 3u);
  EXPECT_TRUE(block.issues.empty());
}

TEST_F(EcsReading, AxesMayTakeTheirValueFromAnExpression) {
  const Block block = blockOf("N10 X=2+3*4 Y=(1+2)*3 Z=0-SQR(16)\n");
  EXPECT_TRUE(block.issues.empty());
  EXPECT_EQ(valueOf(block, uint16_t(block.find('X')->mantissa)), 14);
  EXPECT_EQ(valueOf(block, uint16_t(block.find('Y')->mantissa)), 9);
}

TEST_F(EcsReading, EightCharactersOfALabelCount) {
  const auto blocks = blocksOf("[DRILLINGA1]\nN10 G0 X1\n[SLOT: the second]\n<JMP:[DRILLINGB2]>\n");
  EXPECT_TRUE(blocks[0].hasLabel());
  EXPECT_EQ(reader_->labelKey("DRILLINGA1"), reader_->labelKey("DRILLINGB2"));
  EXPECT_NE(reader_->labelKey("DRILL"), reader_->labelKey("SLOT"));
  EXPECT_EQ(reader_->labelKey("SLOT: the second"), reader_->labelKey("SLOT"));
  ASSERT_EQ(blocks[3].items.size(), 1u);
  EXPECT_EQ(blocks[3].items[0].kind, ItemKind::Jump);
  EXPECT_EQ(blocks[3].argumentsOf(blocks[3].items[0])[0].kind, ArgumentKind::Label);
}

TEST_F(EcsReading, VariablesInAngleBracketsAreAssignments) {
  const Block block = blockOf("N10 G81 <RAP=2><ENT=-10+4> <%NHL=3> <%%PGC=5> R5=7 V1050=1\n");
  EXPECT_TRUE(block.issues.empty());
  ASSERT_EQ(block.items.size(), 6u);
  for (const Item &item : block.items)
    EXPECT_EQ(item.kind, ItemKind::Assignment);
  EXPECT_EQ(valueOf(block, block.items[0].value), 2);
  EXPECT_EQ(valueOf(block, block.items[1].value), -6);
}

TEST_F(EcsReading, TheChoiceHasThreeTargetsAndNoWayOn) {
  const Block block = blockOf("N30 <IFF<R1-5>: N40; [MIDDLE]; N60>\n");
  ASSERT_EQ(block.items.size(), 1u);
  EXPECT_EQ(block.items[0].jump, JumpKind::BySign);
  const auto targets = block.argumentsOf(block.items[0]);
  ASSERT_GE(targets.size(), 3u);
  EXPECT_TRUE(block.issues.empty());
  EXPECT_EQ(issuesOf(blockOf("N30 <IFF<R1>: N40; N50>\n")),
            std::vector{SyntaxIssueKind::MissingArgument});
  EXPECT_EQ(issuesOf(blockOf("N30 <IFF<R1>: N40; N50; N60; N70>\n")),
            std::vector{SyntaxIssueKind::TooManyArguments});
}

TEST_F(EcsReading, RepeatsNameASectionAndPerhapsACount) {
  const auto blocks = blocksOf("<RPT:N10;N50;3>\n<RPT:[A];[B];<R1+1>>\n<RPT:N10;N50>\n");
  for (const Block &block : blocks) {
    ASSERT_EQ(block.items.size(), 1u);
    EXPECT_EQ(block.items[0].kind, ItemKind::Repeat);
    EXPECT_EQ(block.items[0].arguments, 2u);
    EXPECT_TRUE(block.issues.empty());
  }
  EXPECT_EQ(valueOf(blocks[0], blocks[0].items[0].count), 3);
  EXPECT_NE(blocks[1].items[0].count, noExpression);
  EXPECT_EQ(blocks[2].items[0].count, noExpression);
}

TEST_F(EcsReading, CallsNameAProgramOrAVariableThatHoldsItsName) {
  const auto blocks = blocksOf("N10 L<HOLES>\nN20 L <&R12>\nN30 L100 = G1 X0 Y5 RC0\n");
  EXPECT_EQ(blocks[0].items.size(), 1u);
  EXPECT_EQ(blocks[0].items[0].kind, ItemKind::Call);
  EXPECT_EQ(spelling(blocks[0].items[0].nameBegin, blocks[0].items[0].nameEnd), "HOLES");
  EXPECT_EQ(blocks[1].items[0].kind, ItemKind::Call);
  EXPECT_TRUE(blocks[2].items.empty() || blocks[2].items[0].kind != ItemKind::Call);
  for (const Block &block : blocks)
    EXPECT_TRUE(block.issues.empty());
}

TEST_F(EcsReading, FreePlanesAndOriginsAreCodes) {
  const Block block = blockOf("N1 G16XYZ+ G54.01 T1 M6\n");
  EXPECT_TRUE(block.issues.empty());
  ASSERT_EQ(block.words.size(), 4u);
  EXPECT_EQ(block.words[0].mantissa, dialect_->keyword("G16XYZ"));
  EXPECT_EQ(block.words[1].mantissa, dialect_->keyword("G54.01"));
  EXPECT_EQ(block.find('T')->value(), 1);
}

TEST_F(EcsReading, SlipsAreIssuesAndTheRestIsRead) {
  EXPECT_EQ(issuesOf(blockOf("N10 G1 X10,5 Y20\n")), std::vector{SyntaxIssueKind::DecimalComma});
  EXPECT_EQ(issuesOf(blockOf("N10 <RET\n")), std::vector{SyntaxIssueKind::UnbalancedBracket});
  EXPECT_EQ(issuesOf(blockOf("N10 G0 X Y5\n")), std::vector{SyntaxIssueKind::MissingValue});
  const Block block = blockOf("N10 ? G1 X5\n");
  EXPECT_EQ(issuesOf(block), std::vector{SyntaxIssueKind::InvalidCharacter});
  EXPECT_EQ(block.find('X')->value(), 5);
}

TEST_F(EcsReading, BeginningAnywhereReadsTheSameBlocks) {
  const auto blocks = blocksOf("%\n:1\nN10 G16XYZ+ <CFF=CFZ>\n\n[A1]\n<IFF<R1>: N10; [A1]; N30>\r\n"
                               "N30 <INP: \"a;b\"; R1; N10;0;9> ' c\nN40 M30");
  for (const Block &block : blocks) {
    Block again;
    reader_->read(block.begin, again);
    EXPECT_EQ(again.next, block.next);
    EXPECT_EQ(again.words.size(), block.words.size());
    EXPECT_EQ(again.items.size(), block.items.size());
  }
  EXPECT_EQ(blocks.size(), 8u);
}

} // namespace
} // namespace ncvet
