// Formatting and renumbering: the text changes, what the control does never.
#include "analyzer/trace/trace.h"
#include "lsp/features/same_block.h"
#include "lsp/features/writing/format.h"
#include "lsp/features/writing/renumber.h"
#include "tests/support/marked_text.h"

#include "gtest/gtest.h"

namespace {

using namespace ncvet;
using lsp::FormatOptions;
using lsp::WordSpacing;

std::string formatted(llvm::StringRef dialect, llvm::StringRef program,
                      WordSpacing words = WordSpacing::One) {
  const auto text = test::markedText(dialect, program);
  FormatOptions options;
  options.words = words;
  return applyEdits(text->text(),
                    lsp::formatEdits(*text, 0, uint32_t(text->text().size()), options));
}

std::string renumbered(llvm::StringRef dialect, llvm::StringRef program) {
  const auto text = test::markedText(dialect, program);
  const lsp::Renumbering result = lsp::renumber(*text);
  return result.refusal.empty() ? applyEdits(text->text(), result.edits)
                                : "refused: " + result.refusal;
}

/// The motions of a program, one a line.
class TraceText : public TraceSink {
public:
  void moved(const TracedMove &traced) override {
    out << int(traced.move.kind);
    for (const Interval &axis : traced.move.to)
      out << ' ' << axis.lo << ' ' << axis.hi;
    out << ' ' << traced.move.feed.lo << ' ' << traced.move.value.lo << '\n';
  }
  void lost(const FileUnit &, SourceRange, llvm::StringRef) override { out << "lost\n"; }
  std::string text;
  llvm::raw_string_ostream out{text};
};

std::string traceOf(llvm::StringRef dialect, llvm::StringRef program) {
  const auto text = test::markedText(dialect, program);
  TraceText sink;
  trace(text->project(), text->unit(), AnalysisLimits(), sink);
  return sink.out.str();
}

struct Sample {
  const char *dialect, *program;
};
/// Programs with jumps, calls, profiles and repeats, badly spaced.
constexpr Sample samples[] = {
    {"haas-lathe", "O1\nN1G28 \nN2 T101\nN3G97S500M03\nN4G00X50.Z2.\nN5G71P7Q9U.5W.1D2.F.2\nN6M01\n"
                   "N7G00X20.\nN8G01Z-20.  F.1\nN9 X50.\nN11G70P7Q9\nM97P20\nM30\nN20G00X60.\n"
                   "M99\n"},
    {"fanuc-0m", "O1\nN5G21G90G00X0Y0\n#1=0\nN7WHILE[#1LT3]DO1\n#1=#1+1\nG01X#1F100.\nEND1\n"
                 "IF[#1EQ3]GOTO9\nX50.\nN9M98P20\nM30\nO20\nN5G01Y5.\nM99\n"},
    {"sinumerik", "N10 G0X1Y2\nR1=0\nN20 ANF: R1=R1+1\nG1X=R1 F100\nIF R1<3 GOTOB N20\nGOTOF "
                  "N40\nX99\nN40 CYCLE81(10,0,2,-8)\nN50 M30\n"},
    {"ecs", "N1G0X1Y2\nN2G1X5F100\nN3 <RPT:N2;N3;2>\nN4<JMP:N6>\nN5X99\nN6M30\n"},
    {"mefi", "N1G0X1\n Z5\nN2G1X5F100 S500\nN3M30\n"},
    {"linuxcnc", "N1G21G90\nN2G0X1Y2(there)\no100 repeat [3]\nG1X5F100\no100 endrepeat\nN3M2\n"},
};

TEST(Format, OneBlankBetweenWords) {
  EXPECT_EQ(formatted("haas-mill", "O1\nN10G01X1.  Y2.(A  COMMENT)  \nM30\n"),
            "O1\nN10 G01 X1. Y2.(A  COMMENT)\nM30\n");
  EXPECT_EQ(formatted("sinumerik", "N10G1X10 Y=R1+2 F100 ; text  \nMSG(\"a  b\")\n"),
            "N10 G1 X10 Y=R1+2 F100 ; text  \nMSG(\"a  b\")\n");
  EXPECT_EQ(formatted("ecs", "N10G81X5<ENT=-10><RAP=2>\n"), "N10 G81 X5 <ENT=-10> <RAP=2>\n");
}

TEST(Format, NoBlanksBetweenWords) {
  EXPECT_EQ(formatted("haas-mill", "O1\nN10 G01 X1. Y2.\nM30\n", WordSpacing::None),
            "O1\nN10G01X1.Y2.\nM30\n");
}

TEST(Format, WhatWouldReadOtherwiseStays) {
  // `X1 EX2`: glued together they are one number with an exponent.
  const std::string glued = formatted("sinumerik", "G0 X1 Y2\nTRANS X5\n", WordSpacing::None);
  const auto before = test::markedText("sinumerik", "G0 X1 Y2\nTRANS X5\n");
  const auto after = test::markedText("sinumerik", glued);
  Block a, b;
  for (size_t i = 0; i < before->blocks().size(); ++i) {
    before->unit().reader->read(before->blocks()[i], a);
    after->unit().reader->read(after->blocks()[i], b);
    EXPECT_TRUE(lsp::sameBlock(a, before->text(), b, after->text())) << glued;
  }
}

TEST(Format, BlocksWithFaultsStay) {
  const llvm::StringRef broken = "O1\nG01X1.(OPEN\nG01X--1.\n";
  EXPECT_EQ(formatted("haas-mill", broken), broken);
}

TEST(Format, OnlyTheRangeChanges) {
  const auto text = test::markedText("haas-mill", "O1\nG00X1.\n<|>G00X2.<|>\nG00X3.\nM30\n");
  EXPECT_EQ(applyEdits(text->text(), lsp::formatEdits(*text, text.marks[0], text.marks[1])),
            "O1\nG00X1.\nG00 X2.\nG00X3.\nM30\n");
}

TEST(Format, ProgramsMoveAsBefore) {
  for (const Sample &sample : samples) {
    const std::string motions = traceOf(sample.dialect, sample.program);
    for (const WordSpacing words : {WordSpacing::One, WordSpacing::None}) {
      const std::string text = formatted(sample.dialect, sample.program, words);
      EXPECT_EQ(traceOf(sample.dialect, text), motions) << text;
      EXPECT_EQ(formatted(sample.dialect, text, words), text);
    }
    EXPECT_NE(formatted(sample.dialect, sample.program), sample.program) << sample.dialect;
  }
}

TEST(Renumber, TargetsFollowTheirBlocks) {
  EXPECT_EQ(renumbered("fanuc-0m", "O1\nN1 G00\nN5 GOTO7\nN6 X1.\nN7 M30\nO2\nN3 G00\nM99\n"),
            "O1\nN10 G00\nN20 GOTO40\nN30 X1.\nN40 M30\nO2\nN10 G00\nM99\n");
  EXPECT_EQ(
      renumbered("haas-lathe", "O1\nG71 P1 Q2 U.5 W.1 D2. F.2\nN1 G00 X1.\nN2 G01 X2.\nM30\n"),
      "O1\nG71 P10 Q20 U.5 W.1 D2. F.2\nN10 G00 X1.\nN20 G01 X2.\nM30\n");
  EXPECT_EQ(renumbered("sinumerik", "N1 G0 X1\nGOTOB N1\n"), "N10 G0 X1\nGOTOB N10\n");
  EXPECT_EQ(renumbered("ecs", "N1 G0 X1\nN2 <RPT:N1;N2;2>\n"), "N10 G0 X1\nN20 <RPT:N10;N20;2>\n");
}

TEST(Renumber, ProgramsMoveAsBefore) {
  for (const Sample &sample : samples) {
    const std::string text = renumbered(sample.dialect, sample.program);
    EXPECT_EQ(traceOf(sample.dialect, text), traceOf(sample.dialect, sample.program)) << text;
    EXPECT_NE(text, sample.program) << sample.dialect;
  }
}

TEST(Renumber, AComputedTargetRefuses) {
  EXPECT_EQ(renumbered("fanuc-0m", "O1\nN1 G00\n#1=1\nGOTO#1\nM30\n").substr(0, 8), "refused:");
  EXPECT_EQ(renumbered("fanuc-0m", "O1\nN1 G00\nGOTO 99\nM30\n").substr(0, 8), "refused:");
}

TEST(Renumber, ANumberThatCannotBeReadRefuses) {
  EXPECT_EQ(renumbered("linuxcnc", "N10,5 G0 X1\nM2\n").substr(0, 8), "refused:");
}

TEST(Renumber, LeadingZerosKeepTheirWidth) {
  EXPECT_EQ(renumbered("haas-mill", "O1\nN0001 G00\nN0002 M30\n"), "O1\nN0010 G00\nN0020 M30\n");
}

TEST(Format, AnyTextIsFormatted) {
  const llvm::StringRef broken = "N10 G1 X= Y[ #[ IF[ <MIR:; CYCLE81(,,\nG65 P ((\n%\nGOTO\n\"";
  for (const char *dialect : {"haas-lathe", "fanuc-0m", "sinumerik", "ecs", "mefi", "linuxcnc"}) {
    formatted(dialect, broken);
    formatted(dialect, broken, WordSpacing::None);
    renumbered(dialect, broken);
  }
}

} // namespace
