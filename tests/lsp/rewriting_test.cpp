// Changes of selected blocks: the text is another, and the machine does what the title says.
#include "lsp/features/writing/rewritings.h"
#include "tests/support/marked_text.h"
#include "tests/support/process.h"

#include "gtest/gtest.h"

namespace {

using namespace ncvet;
using lsp::AxisChanges;
using lsp::Rewriting;
using lsp::Selection;

/// The text after a change of what is between both marks; `refused: WHY` where it is not made.
std::string rewritten(llvm::StringRef dialect, llvm::StringRef program,
                      llvm::function_ref<Rewriting(Selection &)> change,
                      const std::string &path = "/nowhere/program.nc") {
  const auto text = test::markedText(dialect, program, path);
  Selection selection(*text, text.marks[0], text.marks[1], nullptr, nullptr);
  selection.checkBy(*text.session);
  const Rewriting result = change(selection);
  EXPECT_FALSE(result.title.empty());
  EXPECT_NE(result.refused.empty(), result.edits.empty()) << result.refused;
  if (!result.refused.empty())
    return "refused: " + result.refused;
  std::string made;
  if (result.file)
    made = "=== " + result.file->path + "\n" + result.file->text;
  return applyEdits(text->text(), result.edits) + made;
}

std::string distances(llvm::StringRef dialect, llvm::StringRef program) {
  return rewritten(dialect, program, lsp::toIncremental);
}
std::string places(llvm::StringRef dialect, llvm::StringRef program) {
  return rewritten(dialect, program, lsp::toAbsolute);
}
std::string mirrored(llvm::StringRef dialect, llvm::StringRef program, Axis axis = Axis::X) {
  AxisChanges changes;
  changes[size_t(axis)].factor = -1;
  return rewritten(dialect, program,
                   [&](Selection &one) { return lsp::transform(one, changes, "mirror"); });
}
std::string shifted(llvm::StringRef dialect, llvm::StringRef program, double x, double y) {
  AxisChanges changes;
  changes[0].shift = x;
  changes[1].shift = y;
  return rewritten(dialect, program,
                   [&](Selection &one) { return lsp::transform(one, changes, "shift"); });
}
std::string scaled(llvm::StringRef dialect, llvm::StringRef program, double factor) {
  AxisChanges changes;
  changes[0].factor = changes[1].factor = factor;
  return rewritten(dialect, program,
                   [&](Selection &one) { return lsp::transform(one, changes, "scale"); });
}

const std::string head = "O1\nG21 G17 G90 G40 G80\nG54 G00 X10. Y20.\n";

TEST(Rewriting, PlacesBecomeDistances) {
  EXPECT_EQ(
      distances("fanuc-mill", head + "<|>G01 X12.5 Y20. F100.\nX15.\nY18.5<|>\nG00 X0. Y0.\nM30\n"),
      head + "G91 G01 X2.5 Y0. F100.\nX2.5\nY-1.5\nG90\nG00 X0. Y0.\nM30\n");
  EXPECT_EQ(distances("sinumerik", "G90 G0 X1 Y2\n<|>G1 X5 F100\nY2.5\n<|>G90 X0\nM30\n"),
            "G90 G0 X1 Y2\nG91 G1 X4 F100\nY0.5\nG90 X0\nM30\n")
      << "the next block says its mode itself";
}

TEST(Rewriting, DistancesBecomePlaces) {
  EXPECT_EQ(places("fanuc-mill", head + "<|>G91 G01 X2.5 F100.\nY-1.5\n<|>G90 G00 X0. Y0.\nM30\n"),
            head + "G90 G01 X12.5 F100.\nY18.5\nG90 G00 X0. Y0.\nM30\n");
}

TEST(Rewriting, ALatheHasWordsForDistances) {
  const std::string before = "O1\nG21 G40 G97 G99\nT0101\nS800 M03\nG00 X60. Z2.\n";
  const std::string absolute = before + "<|>G01 X58. F0.2\nZ-10.<|>\nG00 X100.\nM30\n";
  const std::string incremental = before + "<|>G01 U-2. F0.2\nW-12.<|>\nG00 X100.\nM30\n";
  const auto bare = [](std::string text) {
    for (size_t at; (at = text.find("<|>")) != std::string::npos;)
      text.erase(at, 3);
    return text;
  };
  EXPECT_EQ(distances("fanuc-lathe", absolute), bare(incremental));
  EXPECT_EQ(places("fanuc-lathe", incremental), bare(absolute));
}

TEST(Rewriting, ALatheWhoseProgramHasCodesForDistancesIsLeftAlone) {
  const std::string before = "O1\nG21 G40 G97 G99\nT0101\nS800 M03\nG00 X60. Z2.\n";
  for (const char *dialect : {"fanuc-0t", "fanuc-lathe", "nct-104t"}) {
    const std::string program = before + "<|>G91 G01 X-2. F0.2\nG90 Z-10.<|>\nG00 X100.\nM30\n";
    EXPECT_EQ(distances(dialect, program).substr(0, 8), "refused:") << dialect;
    EXPECT_EQ(places(dialect, program).substr(0, 8), "refused:") << dialect;
  }
}

TEST(Rewriting, WhatIsNotAPlaceIsNotChanged) {
  EXPECT_EQ(distances("fanuc-mill", head + "#1=5.\n<|>G01 X#1 F100.\n<|>M30\n").substr(0, 8),
            "refused:");
  EXPECT_EQ(
      distances("fanuc-mill", head + "<|>G81 X1. Y1. Z-5. R2. F100.\n<|>G80\nM30\n").substr(0, 8),
      "refused:")
      << "R and Z of a cycle mean something else under G91";
  EXPECT_EQ(distances("fanuc-mill", head + "IF[#5041GT0]GOTO9\n<|>G01 X1. F100.\n<|>N9 M30\n")
                .substr(0, 8),
            "refused:")
      << "nobody knows whether the program comes here";
  EXPECT_EQ(distances("fanuc-mill", "O1\nG21 G90\n<|>G00 X1.\n<|>M30\n").substr(0, 8), "refused:")
      << "where the tool is before is not known";
}

TEST(Rewriting, AContourIsMirrored) {
  EXPECT_EQ(mirrored("fanuc-mill", head +
                                       "<|>G00 X1. Y1.\nG41 D1 G01 X5. F100.\nG03 X8. Y4. I0. J3.\n"
                                       "G02 X10. Y6. R2.\nG40 G01 X12.<|>\nG00 Y0.\nX0.\nM30\n"),
            head + "G00 X-1. Y1.\nG42 D1 G01 X-5. F100.\nG02 X-8. Y4. I0. J3.\n"
                   "G03 X-10. Y6. R2.\nG40 G01 X-12.\nG00 Y0.\nX0.\nM30\n");
  EXPECT_EQ(mirrored("fanuc-mill",
                     head + "<|>G91 G01 X5. F100.\nG02 X2. Y2. I2. J0.<|>\nG90 G00 X0. Y0.\nM30\n"),
            head + "G91 G01 X-5. F100.\nG03 X-2. Y2. I-2. J0.\nG90 G00 X0. Y0.\nM30\n")
      << "distances are mirrored where they begin";
}

TEST(Rewriting, AMirroredDirectionOfBlocksOutsideRefuses) {
  EXPECT_EQ(mirrored("fanuc-mill",
                     head + "G02 X12. Y22. I0. J2. F100.\n<|>X14. Y24. I2. J0.\n<|>G00 X0.\nM30\n")
                .substr(0, 8),
            "refused:")
      << "G02 comes from before the selection";
  EXPECT_EQ(mirrored("fanuc-mill", head + "G41 D1 G01 X12. F100.\n<|>X14.\nY30.\n<|>G40 X0.\nM30\n")
                .substr(0, 8),
            "refused:")
      << "so does the compensation";
}

TEST(Rewriting, BlocksAreShifted) {
  EXPECT_EQ(shifted("fanuc-mill",
                    head + "<|>G01 X1. Y2. F100.\nG02 X3. Y4. I2. J0.<|>\nG00 Z5.\nX0. Y0.\nM30\n",
                    10, -0.5),
            head + "G01 X11. Y1.5 F100.\nG02 X13. Y3.5 I2. J0.\nG00 Z5.\nX0. Y0.\nM30\n");
  EXPECT_EQ(shifted("fanuc-mill",
                    "O1\nG20 G90 G17\nG54 G00 X1. Y1.\n<|>G01 X2. F10.\n<|>G00 X0.\nM30\n", 25.4,
                    0),
            "O1\nG20 G90 G17\nG54 G00 X1. Y1.\nG01 X3. F10.\nG00 X0.\nM30\n")
      << "the shift is in mm, the program in inches";
}

TEST(Rewriting, BlocksAreScaled) {
  EXPECT_EQ(scaled("fanuc-mill",
                   head + "<|>G00 X1. Y1.\nG01 X3. F100.\nG02 X5. Y3. R2.<|>\nG00 X0. Y0.\nM30\n",
                   1.5),
            head + "G00 X1.5 Y1.5\nG01 X4.5 F100.\nG02 X7.5 Y4.5 R3.\nG00 X0. Y0.\nM30\n");
}

TEST(Rewriting, BlockSkipIsPutAndTakenAway) {
  EXPECT_EQ(
      rewritten("fanuc-mill", head + "<|>N5 G01 X1. F100.\nX2.<|>\nM30\n", lsp::toggleBlockSkip),
      head + "/N5 G01 X1. F100.\n/X2.\nM30\n");
  EXPECT_EQ(
      rewritten("fanuc-mill", head + "<|>/N5 G01 X1. F100.\n/2X2.<|>\nM30\n", lsp::toggleBlockSkip),
      head + "N5 G01 X1. F100.\nX2.\nM30\n");
}

TEST(Rewriting, NumbersOfASelectionLieBetweenThoseAroundIt) {
  const auto renumbered = [](llvm::StringRef program) {
    return rewritten("fanuc-mill", program,
                     [](Selection &one) { return lsp::renumberSelection(one, 10); });
  };
  EXPECT_EQ(renumbered("O1\nN10 G21 G90\n<|>N11 G54 G00 X0.\nN12 X1.\nN13 X2.<|>\nN100 M30\n"),
            "O1\nN10 G21 G90\nN20 G54 G00 X0.\nN30 X1.\nN40 X2.\nN100 M30\n");
  EXPECT_EQ(
      renumbered("O1\nN10 G21 G90\nGOTO12\n<|>N11 G54 G00 X0.\nN12 X1.\nN13 X2.<|>\nN20 M30\n"),
      "refused: the program does not come to line 4: what it moves there is not known");
  EXPECT_EQ(
      renumbered("O1\nN10 G21 G90\n<|>N18 G54 G00 X0.\nN3 #1=1\nN4 IF[#1EQ1]GOTO18<|>\nN16 M30\n")
          .substr(0, 8),
      "refused:");
  EXPECT_EQ(
      renumbered(
          "O1\nN10 G21 G90\n#1=0\n<|>N3 G54 G00 X#1\nN4 #1=#1+1\nIF[#1LT3]GOTO3<|>\nN16 M30\n"),
      "O1\nN10 G21 G90\n#1=0\nN12 G54 G00 X#1\nN14 #1=#1+1\nIF[#1LT3]GOTO12\nN16 M30\n");
}

std::string unrolled(llvm::StringRef dialect, llvm::StringRef program) {
  return rewritten(dialect, program, lsp::unroll);
}
std::string inlined(llvm::StringRef dialect, llvm::StringRef program) {
  return rewritten(dialect, program, lsp::inlineCall);
}
std::string extracted(llvm::StringRef dialect, llvm::StringRef program) {
  return rewritten(dialect, program, lsp::extractSubprogram);
}

TEST(Rewriting, ALoopOfMacroStatementsIsUnrolled) {
  for (const char *dialect : {"fanuc-mill", "fanuc-0m", "haas-mill", "nct-104m"})
    EXPECT_EQ(unrolled(dialect, head +
                                    "#1=0\n<|>WHILE[#1LT3]DO1\n(ONE HOLE)\nN50 G01 X[#1*5.] F100."
                                    "\n#1=#1+1\nEND1\n<|>G00 X0. Y0.\nM30\n"),
              head + "#1=0\n(ONE HOLE)\nN50 G01 X[#1*5.] F100.\n#1=#1+1\nG01 X[#1*5.] F100.\n"
                     "#1=#1+1\nG01 X[#1*5.] F100.\n#1=#1+1\nG00 X0. Y0.\nM30\n")
        << dialect;
}

TEST(Rewriting, JumpsBackAndBranchesAreUnrolled) {
  EXPECT_EQ(unrolled("fanuc-mill",
                     head + "#1=0\n<|>N20 #1=#1+1\nIF[#1EQ2]GOTO30\nG00 X[#1]\nN30 IF[#1LT3]GOTO20"
                            "<|>\nM30\n"),
            head + "#1=0\nN20 #1=#1+1\nG00 X[#1]\n#1=#1+1\n#1=#1+1\nG00 X[#1]\nM30\n")
      << "the second pass goes past the move";
}

TEST(Rewriting, LoopsAndRepeatsOfOtherControlsAreUnrolled) {
  EXPECT_EQ(unrolled("sinumerik", "G90 G0 X0 Y0\n<|>FOR R1=1 TO 3\nG0 X=R1\nENDFOR\n<|>M30\n"),
            "G90 G0 X0 Y0\nR1=1\nG0 X=R1\nR1=R1+1\nG0 X=R1\nR1=R1+1\nG0 X=R1\nR1=R1+1\nM30\n");
  EXPECT_EQ(unrolled("sinumerik", "G90 G0 X0 Y0\n<|>A: G91 X1\nY2\nE:\nREPEAT A E P=2\n<|>M30\n"),
            "G90 G0 X0 Y0\nA: G91 X1\nY2\nE:\nG91 X1\nY2\nG91 X1\nY2\nM30\n");
  EXPECT_EQ(
      unrolled("linuxcnc", "G21 G90 G17\nG0 X0 Y0\n#<i>=0\n<|>o100 while [#<i> LT 2]\n"
                           "G0 X#<i>\n#<i>=[#<i>+1]\no100 endwhile\n<|>M2\n"),
      "G21 G90 G17\nG0 X0 Y0\n#<i>=0\nG0 X#<i>\n#<i>=[#<i>+1]\nG0 X#<i>\n#<i>=[#<i>+1]\nM2\n");
  EXPECT_EQ(unrolled("linuxcnc", "G21 G91 G17\n<|>o100 repeat [3]\nG0 X1\no100 endrepeat\n<|>M2\n"),
            "G21 G91 G17\nG0 X1\nG0 X1\nG0 X1\nM2\n");
  EXPECT_EQ(unrolled("ecs", "N10 G0 X1 Y2\nN20 G91\n<|>N30 X1\nN40 Y1\nN50 <RPT:N30;N40;2>\n<|>N90 "
                            "G90\nN100 M30\n"),
            "N10 G0 X1 Y2\nN20 G91\nN30 X1\nN40 Y1\nN50 X1\nN60 Y1\nN70 X1\nN80 Y1\nN90 G90\nN100 "
            "M30\n")
      << "every block of this control has a number";
}

TEST(Rewriting, OnlyAWholeLoopIsUnrolled) {
  const auto refused = [](llvm::StringRef program) {
    return unrolled("fanuc-mill", head + program.str()).substr(0, 8) == "refused:";
  };
  EXPECT_TRUE(refused("#1=0\nWHILE[#1LT3]DO1\n<|>G00 X[#1]\n#1=#1+1\n<|>END1\nM30\n"))
      << "its head is not selected";
  EXPECT_TRUE(refused("<|>G00 X1.\nX2.\n<|>M30\n")) << "there is none";
  EXPECT_TRUE(refused("<|>WHILE[#5041LT3]DO1\nG00 X1.\nEND1\n<|>M30\n")) << "nobody knows";
  EXPECT_TRUE(refused("#1=0\n<|>WHILE[#1LT90000]DO1\nG00 X[#1]\n#1=#1+1\nEND1\n<|>M30\n"))
      << "the text would be too long";
}

TEST(Rewriting, ACalledProgramIsWrittenInPlaceOfItsCall) {
  const std::string main = "O1\nG21 G17 G90 G40 G80\nG54 G00 X10. Y20.\n";
  const std::string hole = "O2 (HOLE)\nN10 G91 G01 Z-1. F100.\nG90 G00 Z50.\nM99\n";
  EXPECT_EQ(inlined("fanuc-mill", main + "<|>N30 M98 P2<|>\nM30\n" + hole),
            main + "G91 G01 Z-1. F100.\nG90 G00 Z50.\nM30\n" + hole);
  EXPECT_EQ(inlined("fanuc-0m", main + "<|>M98 P2 L2\n<|>M30\n" + hole),
            main + "G91 G01 Z-1. F100.\nG90 G00 Z50.\nG91 G01 Z-1. F100.\nG90 G00 Z50.\nM30\n" +
                hole)
      << "as often as it runs";
  EXPECT_EQ(inlined("haas-mill", main + "<|>M97 P100\n<|>M30\nN100 G00 X5.\nX6. M99\n"),
            main + "G00 X5.\nX6.\nM30\nN100 G00 X5.\nX6. M99\n");
  EXPECT_EQ(inlined("linuxcnc", "o<a> sub\nG0 X5\nX6\no<a> endsub\nG21 G90\n<|>o<a> call\n<|>M2\n"),
            "o<a> sub\nG0 X5\nX6\no<a> endsub\nG21 G90\nG0 X5\nX6\nM2\n");
}

TEST(Rewriting, WhatIsOnlyRightInTheCalledProgramIsNotWrittenElsewhere) {
  const auto refused = [](llvm::StringRef call, llvm::StringRef called) {
    return inlined("fanuc-mill", (head + "<|>" + call + "\n<|>M30\nO2\n" + called).str())
               .substr(0, 8) == "refused:";
  };
  EXPECT_FALSE(refused("M98 P2", "G00 X1.\nM99\n"));
  EXPECT_TRUE(refused("G65 P2 A1.", "G00 X#1\nM99\n")) << "its variables are its own";
  EXPECT_TRUE(refused("M98 P2", "#1=1\nN10 #1=#1+1\nIF[#1LT4]GOTO10\nG00 X1.\nM99\n"))
      << "a block names another one";
  EXPECT_TRUE(refused("M98 P2", "G00 X1.\nM99\nG00 X2.\nM99\n")) << "nothing leads there";
  EXPECT_TRUE(refused("M98 P3", "G00 X1.\nM99\n")) << "it is not there";
  EXPECT_TRUE(refused("M98 P2", "G00 X1.\nM30\n")) << "it does not return";
}

std::string movesOf(llvm::StringRef dialect, llvm::StringRef program) {
  return rewritten(dialect, program, lsp::cyclesToMoves);
}
std::string cycleOf(llvm::StringRef dialect, llvm::StringRef program) {
  return rewritten(dialect, program, lsp::movesToCycle);
}

const std::string drillHead = "O1\nG21 G17 G90 G40 G80 G94\nT1 M06\nS800 M03\nG54 G00 X0. Y0.\n"
                              "G43 H1 Z50.\n";

TEST(Rewriting, ACycleIsWrittenAsItsMoves) {
  for (const char *dialect : {"fanuc-mill", "fanuc-0m", "haas-mill", "nct-104m"})
    EXPECT_EQ(movesOf(dialect, drillHead + "<|>G99 G81 X10. Y5. Z-4. R2. F200.\nX30. (LAST)\nG80\n"
                                           "<|>G00 Z50.\nM30\n"),
              drillHead + "G99 F200. G00 X10. Y5.\nZ2.\nG01 Z-4.\nG00 Z2.\n(LAST)\nG00 X30.\nG01 "
                          "Z-4.\nG00 Z2.\nG80\nG00 Z50.\nM30\n")
        << dialect;
  const auto refused = [](const std::string &blocks) {
    return movesOf("fanuc-mill", drillHead + "<|>" + blocks + "<|>G00 Z50.\nM30\n").substr(0, 8) ==
           "refused:";
  };
  EXPECT_TRUE(refused("G82 X10. Y5. Z-4. R2. P500 F200.\nG80\n")) << "a dwell is no move";
  EXPECT_TRUE(refused("G91 G81 X10. Z-4. R-48. F200.\nG80 G90\n")) << "distances";
  EXPECT_TRUE(refused("G00 X10.\nX20.\n")) << "no cycle runs";
}

TEST(Rewriting, ARowOfHolesBecomesACycle) {
  for (const char *dialect : {"fanuc-mill", "fanuc-0m", "haas-mill", "nct-104m"})
    EXPECT_EQ(cycleOf(dialect, drillHead + "<|>G00 X10. Y5.\nZ2.\nG01 Z-4. F200.\nG00 Z2.\nX30.\n"
                                           "G01 Z-4.\nG00 Z2.\n<|>G00 Z50.\nM30\n"),
              drillHead + "G99 G81 X10. Y5. Z-4. R2. F200.\nX30. Y5.\nG80\nG00 Z50.\nM30\n")
        << dialect;
  EXPECT_EQ(cycleOf("fanuc-mill", drillHead + "<|>G00 X10. Y5.\nZ2.\nG01 Z-4. F200.\nG00 Z50.\nX30."
                                              "\nZ2.\nG01 Z-4.\nG00 Z50.\n<|>X0.\nM30\n"),
            drillHead + "G98 G81 X10. Y5. Z-4. R2. F200.\nX30. Y5.\nG80\nX0.\nM30\n")
      << "up to where the row began";
  EXPECT_EQ(cycleOf("fanuc-mill", drillHead + "<|>G00 X10. Y5.\nZ2.\nG01 Z-4. F200.\nG00 Z2.\nX30."
                                              "\nG01 Z-5.\nG00 Z2.\n<|>G00 Z50.\nM30\n"),
            "refused: the holes are not alike");
}

TEST(Rewriting, SelectedBlocksBecomeASubprogram) {
  for (const char *dialect : {"fanuc-mill", "fanuc-0m", "haas-mill", "nct-104m"})
    EXPECT_EQ(extracted(dialect, "%\nO0001\nG21 G17 G90 G40 G80\nG54 G00 X10. Y20.\n<|>N30 G91 G01 "
                                 "X5. F100.\nY5. (SIDE)\nG90<|>\nG00 Z50.\nM30\n%\n"),
              "%\nO0001\nG21 G17 G90 G40 G80\nG54 G00 X10. Y20.\nN30 M98 P0002\nG00 Z50.\nM30\n"
              "O0002\nN30 G91 G01 X5. F100.\nY5. (SIDE)\nG90\nM99\n%\n")
        << dialect;
  EXPECT_EQ(extracted("linuxcnc", "G21 G90\nG0 X0 Y0\n<|>G0 X5\nX6\n<|>M2\n"),
            "o<part1> sub\nG0 X5\nX6\no<part1> endsub\nG21 G90\nG0 X0 Y0\no<part1> call\nM2\n");
}

TEST(Rewriting, WhereASubprogramIsAFileTheFileIsMade) {
  const std::string main = "G17 G90 G54 G40 G94\nT1 D1\nM6\nS800 M3\nG0 X10 Y20\nG0 Z2\n";
  EXPECT_EQ(rewritten("sinumerik",
                      main + "<|>N30 G91 G1 X5 F100 ; FIRST\nY5\nG90\n<|>G0 Z50\nM30\n",
                      lsp::extractSubprogram, "/nowhere/SHAFT.MPF"),
            main + "N30 PART1\nG0 Z50\nM30\n"
                   "=== /nowhere/PART1.SPF\nN30 G91 G1 X5 F100 ; FIRST\nY5\nG90\nM17\n");
  EXPECT_EQ(rewritten("ecs",
                      "%\nN10 G17 G90 G71\nN20 T1 M6\nN30 S800 M3\nN40 G0 X10 Y20\n<|>N50 G1 X5 "
                      "F100\nN60 Y5<|>\nN70 G0 Z50\nN80 M30\n",
                      lsp::extractSubprogram, "/nowhere/shaft.ecs"),
            "%\nN10 G17 G90 G71\nN20 T1 M6\nN30 S800 M3\nN40 G0 X10 Y20\nN50 L<PART1>\nN70 G0 "
            "Z50\nN80 M30\n=== /nowhere/part1.ecs\nN50 G1 X5 F100\nN60 Y5\nN70 M17\n")
      << "every block of this control has a number";
}

TEST(Rewriting, AnArchiveGetsTheSubprogramAsAFurtherUnit) {
  const std::string head = "%_N_SHAFT_MPF\n;$PATH=/_N_WKS_DIR/_N_JOB_WPD\nG17 G90 G54 G40 G94\nT1 "
                           "D1\nM6\nS800 M3\nG0 X10 Y20\nG0 Z2\n";
  EXPECT_EQ(rewritten("sinumerik", head + "<|>G1 X5 F100\nY5<|>\nG0 Z50\nM30\n",
                      lsp::extractSubprogram, "/nowhere/job.arc"),
            head + "PART1\nG0 Z50\nM30\n%_N_PART1_SPF\n;$PATH=/_N_WKS_DIR/_N_JOB_WPD\nG1 X5 "
                   "F100\nY5\nM17\n");
}

TEST(Rewriting, TheNewFileTakesNoNameThatIsInUse) {
  test::Shop shop;
  shop.file("part1.spf", "M17\n").file("PART2.MPF", "M30\n");
  const std::string main = "G17 G90 G54 G40 G94\nT1 D1\nM6\nS800 M3\nG0 X10 Y20\nG0 Z2\n";
  const std::string result =
      rewritten("sinumerik", main + "<|>G1 X5 F100\nY5\n<|>G0 Z50\nM30\n", lsp::extractSubprogram,
                (shop.path() / "shaft.mpf").string());
  EXPECT_NE(result.find("\nPART3\n"), std::string::npos) << result;
  EXPECT_NE(result.find("part3.spf\nG1 X5"), std::string::npos) << result;
}

TEST(Rewriting, AVariableOfTheProgramStaysInIt) {
  EXPECT_EQ(rewritten("sinumerik",
                      "DEF REAL DEPTH=5\nG17 G90 G54 G40 G94\nT1 D1\nM6\nS800 M3\nG0 X10 Y20\n"
                      "G0 Z2\n<|>G1 X=DEPTH F100\nY5\n<|>G0 Z50\nM30\n",
                      lsp::extractSubprogram, "/nowhere/shaft.mpf")
                .substr(0, 8),
            "refused:");
}

TEST(Rewriting, ACalledFileIsWrittenInPlaceOfItsCall) {
  test::Shop shop;
  shop.file("HOLE.SPF", "; ONE HOLE\nN10 G91 G1 Z-1 F100\nG90 G0 Z50\nM17\n")
      .file("hole.ecs", "N10 G91 G1 Z-1 F100\nN20 G90 G0 Z50\nN30 <RET>\n");
  const std::string main = "G17 G90 G54 G40 G94\nT1 D1\nM6\nS800 M3\nG0 X10 Y20\nG0 Z2\n";
  EXPECT_EQ(rewritten("sinumerik", main + "<|>HOLE P2<|>\nM30\n", lsp::inlineCall,
                      (shop.path() / "shaft.mpf").string()),
            main + "G91 G1 Z-1 F100\nG90 G0 Z50\nG91 G1 Z-1 F100\nG90 G0 Z50\nM30\n");
  EXPECT_EQ(rewritten("ecs", "%\nN10 G17 G90 G71\nN40 G0 X10 Y20\n<|>N50 L<HOLE><|>\nN80 M30\n",
                      lsp::inlineCall, (shop.path() / "shaft.ecs").string()),
            "%\nN10 G17 G90 G71\nN40 G0 X10 Y20\nN50 G91 G1 Z-1 F100\nN60 G90 G0 Z50\nN80 M30\n");
}

TEST(Rewriting, BlocksThatLeadElsewhereAreNoSubprogram) {
  const auto refused = [](llvm::StringRef program) {
    return extracted("fanuc-mill", head + program.str()).substr(0, 8) == "refused:";
  };
  EXPECT_TRUE(refused("#1=1\n<|>G00 X1.\nIF[#1EQ1]GOTO50\n<|>G00 X2.\nN50 M30\n"));
  EXPECT_TRUE(refused("#1=1\nGOTO40\n<|>G00 X1.\nN40 G00 X2.\n<|>M30\n"));
  EXPECT_TRUE(refused("<|>G00 X1.\nM30\n<|>"));
  EXPECT_TRUE(refused("<|>G00 X1.\n<|>M30\n")) << "one block";
}

TEST(Rewriting, AnyTextIsRewritten) {
  const llvm::StringRef broken =
      "<|>N10 G1 X= Y[ #[ IF[ <MIR:; CYCLE81(,,\nG65 P ((\n%\nGOTO\n\"<|>";
  AxisChanges changes;
  changes[0] = {-2, 3};
  for (const char *dialect : {"haas-lathe", "fanuc-0m", "sinumerik", "ecs", "mefi", "linuxcnc"}) {
    distances(dialect, broken);
    places(dialect, broken);
    rewritten(dialect, broken, lsp::toggleBlockSkip);
    rewritten(dialect, broken, [&](Selection &one) { return lsp::transform(one, changes, "x"); });
    rewritten(dialect, broken, [](Selection &one) { return lsp::renumberSelection(one, 10); });
    unrolled(dialect, broken);
    inlined(dialect, broken);
    extracted(dialect, broken);
    movesOf(dialect, broken);
    cycleOf(dialect, broken);
  }
}

} // namespace
