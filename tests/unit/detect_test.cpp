// Detection of the dialect, and of what is a program at all.
#include "analyzer/rule/rule_settings.h"
#include "analyzer/setup/detect.h"
#include "formats/text/needed_text.h"
#include "formats/text/read_file.h"
#include "tests/support/places.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

namespace ncvet {
namespace {

const Detector &detector() {
  static const Detector *const made = [] {
    auto detector = Detector::create();
    if (!detector) {
      ADD_FAILURE() << llvm::toString(detector.takeError());
      std::abort();
    }
    return new Detector(std::move(*detector));
  }();
  return *made;
}

const char *const mill =
    "%\nO1001 (COVER)\nN10 G21 G17 G40 G49 G80 G90\nN20 T1 M6\nN30 S2000 M3\n"
    "N40 G54 G0 X0. Y0.\nN50 G43 H1 Z50. M8\nN60 G81 X10. Y10. Z-5. R2. F100.\n"
    "N70 G80\nN80 G91 G28 Z0.\nN90 M30\n%\n";

TEST(Detection, SaysWhatSpokeForTheDialect) {
  const Detection found = detector().detect("cover.nc", mill);
  EXPECT_FALSE(found.dialect.empty());
  EXPECT_FALSE(found.reason.empty());
}

TEST(Detection, TextThatSaysNothingIsReadAsTheUsualControl) {
  const Detection empty = detector().detect("x", "");
  const Detection plain = detector().detect("x", "G0 X0\nG1 X1\n");
  EXPECT_EQ(empty.dialect, plain.dialect);
  EXPECT_NE("", empty.dialect);
}

TEST(Detection, DoesNotDependOnCaseOrLineEnds) {
  std::string crlf;
  for (const char c : llvm::StringRef(mill).lower()) {
    if (c == '\n')
      crlf += '\r';
    crlf += c;
  }
  EXPECT_EQ(detector().detect("a.nc", mill).dialect, detector().detect("a.nc", crlf).dialect);
}

TEST(Detection, TakesLittleTimeForAnyText) {
  std::string text;
  while (text.size() < 1u << 20)
    text += "N100 G01 X12.345 Y-67.89 Z1.5 F1200. (FINISH)\n";
  detector().detect("a.nc", text);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 10; ++i)
    detector().detect("a.nc", text);
  const auto each = (std::chrono::steady_clock::now() - begin) / 10;
  // The aim is a millisecond; a loaded machine and sanitizers get room.
  EXPECT_LT(each, std::chrono::milliseconds(500));
}

TEST(Detection, AnyBytesGiveAnAnswer) {
  std::string bytes;
  for (int i = 0; i < 512; ++i)
    bytes.push_back(char(i));
  EXPECT_NE("", detector().detect(bytes, bytes).dialect);
}

TEST(Detection, IsSureOfAProgramThatBearsMarksOfItsControl) {
  EXPECT_TRUE(detector().detect("arc.mpf", "G0 X0 Y0\nG1 X1 F100\nM30\n").sure);
  EXPECT_FALSE(detector().detect("x.nc", "G0 X0 Y0\nG1 X1 F100\nM30\n").sure);
  EXPECT_FALSE(detector().detect("x", "").sure);
}

TEST(Detection, RemarksInRoundBracketsAreNoSinumerikProgram) {
  const Detection found = detector().detect(
      "plate.nc", "(PLATE)\n(T4 D=5 CR=0 - ZMIN=-8 - FLAT END MILL)\nG90 G94\nG17\nG21\nT4\n"
                  "S5000 M3\nG54\nG0 X8 Y7.75\nZ15\nG1 Z-4 F1000\nM30\n");
  EXPECT_EQ("fanuc-mill", found.dialect);
  EXPECT_FALSE(found.sure);
}

TEST(Detection, HabitsOfManyControlsMakeNoneSure) {
  const Detection found = detector().detect("cover.nc", mill);
  EXPECT_EQ("fanuc-mill", found.dialect);
  EXPECT_FALSE(found.sure);
}

TEST(Detection, TellsModernFanucFromTheOldOneByMarksOfEach) {
  const auto of = [](llvm::StringRef line) {
    return detector().detect("O1001", "%\nO1001\nG21 G17 G40 G90\nT1 M6\n" + line.str() +
                                          "\nG0 G43 H1 Z50.\nM30\n%\n");
  };
  for (const char *line : {"G54.1 P12\nG05.1 Q1", "M98 Q100", "M198 P20", "(ROBODRILL)", "M29 S500",
                           "(FANUC 0I-MF)"}) {
    EXPECT_EQ("fanuc-mill", of(line).dialect) << line;
    EXPECT_TRUE(of(line).sure) << line;
  }
  EXPECT_EQ("fanuc-0m", of("(FANUC 0-M)").dialect);
  EXPECT_EQ("haas-mill", of("G154 P12").dialect);
  EXPECT_EQ("fanuc-lathe",
            detector().detect("O1", "%\nO1\nT0101\nG71 U2. R1.\nG71 P1 Q2 U.4 F.3\nM30\n").dialect);
}

TEST(Detection, ArcCentreCodesAreNoFanucProgram) {
  const Detection found = detector().detect(
      "horse.tap", "N100G00G21G17G90G40G49G80\nN110G91.1\nN120T1M06\nN140G00G43Z6H1\n"
                   "N150S12000M03\nN200G00X44.05Y21.75\nN210G1Z-0.2F600\nM30\n");
  EXPECT_EQ("linuxcnc", found.dialect);
  EXPECT_FALSE(found.sure);
}

TEST(Detection, NamesAControlThatHasNoTable) {
  struct Sample {
    const char *text, *control;
  };
  for (const Sample &sample : {
           Sample{"%00201\nN0 T1.1\nN10 M6\nN20 G0 G90 G43 Z10 F10 S1000 M3\nN30 X16 Y25\n",
                  "Fagor"},
           Sample{"0 BEGIN PGM PLATE MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n2 TOOL CALL 1 Z S2000\n",
                  "Heidenhain"},
           Sample{"$FLANGE.MIN%\n(FLANGE)\nG50 S2000\nG0 X100 Z10\nT0101\n", "Okuma"},
           Sample{"%PM\nN9000\nN10 G54\nN20 G99 X105 Z1237\nN180 G13 N1=8001 N2=8011\n", "Philips"},
           Sample{"%MPF 90\nL100\nN1 @371 R52 K2 K0\nN10 G0 G17 G40 G53 Z631.6 D0\n",
                  "Sinumerik 810"},
           Sample{"BEGIN PGM PLATE MM\nTOOL CALL 1 Z S2000\nL X+10 R0 FMAX M3\n", "Heidenhain"},
           Sample{"O1000\n(MAZAK INTEGREX)\nG10.9 X1\nT1 T2 M6\n", "Mazak"},
           Sample{"$1\nO100\nG114.1 H1 D2\nM30\n", "Mitsubishi"},
           Sample{"; generated by PrusaSlicer\nG28\nM104 P185\nG1 X10\n", "3D printer"},
           Sample{"(Grbl)\nG21\n$H\nG0 X10\n", "Grbl"},
           Sample{"(Block-name: Header)\n(Block-enable: 1)\nG21\nG0 X10\n", "Grbl"},
           Sample{"{BEGIN}\n{$DRILL=100}\nGOSUB 100\n{END_SUBS}\nG0 X10\n", "GCodeWorkShop"},
           Sample{"M104 S200\nG28\nG92 E0\nG1 X10 Y10 E2.5 F1500\n", "3D printer"},
           Sample{"G90\n#486 = #832\nIF #486!=0 GOTO99\nN99 M30\n", "DDCS"},
           Sample{"[BILLET X100 Y80 Z30;\n[TOOLDEF T1 D2;\nN10 G21 G94;\n", "Denford"},
           Sample{"G159 N1\nG01 R100 Q0\nG20 K1 X20\n", "Fagor"},
           Sample{"G00G21G17G90G40G49G80\nG71G91.1\nS18000M3\nG94\nG0 Z28\nT1\nM6\n", "Mach"},
           Sample{"#<_half>=[#<_width> / 2]\n$SD/Run=/Probing/Init.nc\no210 if [#<_half> LT 0]\n"
                  "o210 endif\nG38.2 X5 F50\n",
                  "FluidNC"},
           Sample{"%PM9000\nN9000\nG22 N=9001\n", "Philips"},
           Sample{"G100 T5 X0 Y0 Z50. S3000 M3\nG1 Z-2. F200\n", "Brother"},
           Sample{"(DFS,P100)\nN10 G1 X10 F100\n", "Bosch"},
           Sample{"PROGRAMMKOPF\n#MATERIAL STAHL\nREVOLVER\nROHTEIL\n", "CNC PILOT"},
           Sample{"PARTNO TEST\nLOADTL/1\nGOTO/10,0,5\n", "APT"},
       }) {
    const Detection found = detector().detect("x.nc", sample.text);
    EXPECT_FALSE(found.sure) << sample.control;
    EXPECT_NE(std::string::npos, found.reason.find(sample.control)) << found.reason;
  }
}

TEST(Detection, AControlWithoutATableIsReadAsTheOneNearestToIt) {
  const char *const mach = "; set up for Mach3\nG20\nG0 X1.5 Y2.\nG2 X2.2 Y6.4 R0.4 F60\nM30\n";
  const char *const tinyG = "(a test)\n{\"gc\":\"g0x0y0\"}\nG0 X10 Y20\nG1 X20 F100\nM2\n";
  for (const char *const text : {mach, tinyG}) {
    const Detection found = detector().detect("a.gcode", text);
    EXPECT_EQ("fanuc-mill", found.dialect) << text;
    EXPECT_NE("", found.other) << text;
    EXPECT_FALSE(found.sure) << text;
  }
}

TEST(Detection, CommentsOfAnotherControlDoNotOutweighParameters) {
  const Detection found = detector().detect(
      "grid.nc", "%; SINUMERIK GRID\n(grid of holes)\nR20=4 ; columns\nR30=0\nR31=0\n"
                 "G0 X0 Y0 Z50\nG1 X=R30*R22 Y=0 F500\nR30=R30+1\nM30\n");
  EXPECT_EQ("sinumerik", found.dialect);
}

TEST(Detection, PlainBlocksAreForTheUsualControl) {
  const Detection found =
      detector().detect("part.nc", "N10 G21 G90 G94\nN20 M03 S3000\nN30 G00 X30 Y30 Z5\n"
                                   "N40 G81 X50 Y50 Z-5 R2 F600\nN50 G80\nN60 G54\nN80 M30\n");
  EXPECT_EQ("fanuc-mill", found.dialect);
}

TEST(Detection, WhatPostProcessorsWriteForSeveralControlsMakesNoneSure) {
  const Detection found = detector().detect(
      "1001.nc", "%\nO01001\n(T1 D=6.35 CR=0. - FLAT END MILL)\nN10 G90 G94 G17\nN15 G21\n"
                 "N20 G53 G0 Z0.\nN25 T1 M6\nN30 S5000 M3\nN35 G54\nN40 G0 X1. Y1.\n"
                 "N45 G43 Z15. H1\nN50 G53 G0 Z0.\nM30\n%\n");
  EXPECT_FALSE(found.sure) << found.dialect << ": " << found.reason;
}

TEST(Detection, AToolNumberInACommentIsNoFagorProgram) {
  const Detection found =
      detector().detect("part.gcode", "( M6 T1.0 )\nG21\nG90\nG0 X0 Y0\nG1 X10 F100\nM30\n");
  EXPECT_EQ("", found.other);
}

TEST(Detection, LinesForASimulatorAreNoReasonToDoubt) {
  const Detection found = detector().detect(
      "a.nc", "[BILLET X58 Z48.92\nO1\nT0101\nG71 U2. R1.\nG71 P1 Q2 U.4 F.3\nM30\n");
  EXPECT_EQ("fanuc-lathe", found.dialect);
  EXPECT_TRUE(found.sure) << found.reason;
  EXPECT_TRUE(found.otherIsAlike);
}

TEST(Detection, WhatIsSaidInACommentIsNoStatement) {
  for (const char *text : {"%\nO9002\n(M98 P1 call Op1 as a subprogram)\nM98 P1\nM99\n%\n",
                           "(MSG Spindle Warm Up, hit cycle start)\nG0 X1\n(MSG 64% complete)\n"})
    EXPECT_EQ("", detector().detect("a.nc", text).other) << text;
}

TEST(Detection, TheNameOfAMachineInACommentMakesTheGuessUnsure) {
  const std::string turned = "N10 G28 U0 W0\nN20 T0101\nN30 G96 S180 M3\nN40 G71 U2. R1.\n"
                             "N50 G71 P60 Q90 U.4 W.1 F.3\nG76 P010060 Q100 R50\nM30\n";
  EXPECT_TRUE(detector().detect("a.nc", turned).sure);
  for (const char *name : {"(MAZAK QUICK TURN 200)\n", "(OKUMA LB3000EX)\n"}) {
    const Detection found = detector().detect("a.nc", name + turned);
    EXPECT_FALSE(found.sure) << name << found.reason;
    EXPECT_EQ("", found.other) << name;
  }
}

TEST(Detection, ACommentThatNamesACycleOrALatheMakesNoMillSure) {
  EXPECT_FALSE(detector()
                   .detect("a.nc", "O0107 (FANUC G71 TYPE I example)\nG28\nT101\nG50 S2000\n"
                                   "G71 P10 Q20 U0.01 W0.005 D0.15 F0.012\nM30\n")
                   .dialect == "fanuc-mill");
  EXPECT_FALSE(detector()
                   .detect("a.nc", "O8004 (5-AXIS MILLING ON LATHE)\nT0505 M06\nG43.4 H05\n"
                                   "G01 X1.2 Y0.1 Z-0.3 B45. F200.\nM30\n")
                   .sure);
}

TEST(Detection, WhatIsLeftOutOfAGuessIsNamedRight) {
  const UnsureReports &unsure = detector().unsure();
  EXPECT_EQ(Severity::Warning, unsure.highest);
  EXPECT_FALSE(unsure.ignore.empty());
  for (const std::string &name : unsure.ignore)
    EXPECT_TRUE(bool(rulesNamed(name))) << name;
  for (const auto *categories : {&unsure.toldOfOthers, &unsure.differsInAlike})
    for (const std::string &name : *categories)
      EXPECT_TRUE(bool(rulesNamed(name))) << name;
  EXPECT_TRUE(detector().isTold("syntax", false));
  EXPECT_FALSE(detector().isTold("feed", false));
  EXPECT_TRUE(detector().isTold("feed", true));
  EXPECT_FALSE(detector().isTold("flow", true));
}

TEST(Detection, ALatheWithTwoSpindlesThatIsNamedIsAFanuc) {
  EXPECT_EQ("fanuc-lathe",
            detector()
                .detect("a.nc", "%\nO1001\n(MACHINE PUMA)\nG0 G18 G20 G40 G54 G80 G99 M110\n"
                                "G0 G28 G53 B0.\nG28 U0. V0.\nG28 W0.\nG50 S4000\nT0101\nM8\n"
                                "G97 S441 M3 P11\nG0 Z0.0466\nX1.04 Y0.\nG96 S120 M3 P11\nM30\n%\n")
                .dialect);
}

TEST(LooksLikeProgram, BlocksDoAndProseDoesNot) {
  EXPECT_TRUE(looksLikeProgram(mill));
  EXPECT_TRUE(looksLikeProgram("g0 x0 y0\ng1 z-1. f100\n/m30\n"));
  EXPECT_TRUE(looksLikeProgram("#1=10\nG1 X#1\nM99\n"));
  EXPECT_FALSE(looksLikeProgram(""));
  EXPECT_FALSE(looksLikeProgram("Tool list for cover\nT1 face mill 50 mm\nT2 drill\nT3 tap\n"));
  EXPECT_FALSE(looksLikeProgram("10;20;30\n40;50;60\n"));
  EXPECT_FALSE(looksLikeProgram("{ \"a\": 1 }\n"));
}

/// Half of the controls have programs in files named .iso.
TEST(Detection, AnEndingOfSeveralControlsMakesNoneSure) {
  const Detection found = detector().detect(
      "PART.iso", "G90 (MAIN)\nM98 P1000 L1\nM30\nO1000 (SUBPROGRAM)\nG04 P0.1\nM99\n");
  EXPECT_EQ(found.dialect, "fanuc-mill");
  EXPECT_FALSE(found.sure);
}

TEST(Detection, AUnitAmongTheFirstCodesIsNoRoughingCycle) {
  EXPECT_EQ(detector()
                .detect("PART.nc", "N10 G54 G71 G90 G94 M03 S1200 T0101\nN15 G00 X0 Y0 Z5\n"
                                   "N20 G01 Z-1 F100\nN30 M05 M30\n")
                .dialect,
            "din66025");
}

TEST(Detection, TheNumberOfASpindleIsOfALathe) {
  EXPECT_EQ(detector()
                .detect("PART.nc", "O1001\nG0 G18 G40 G54 G80 G99\nG28 U0.\nG28 W0.\nG50 S4000\n"
                                   "T0101\nG97 S441 M3 P11\nG0 X50. Z2.\nM30\n")
                .dialect,
            "fanuc-lathe");
}

TEST(Detection, AFiveDigitNumberIsNoFanuc) {
  const Detection found = detector().detect(
      "a.nc", "%\nO00001 (PLATE)\nT1 M06 (DRILL)\nG90 G54 G00\nS2000 M03\nG43 H01 Z0.5 M08\n"
              "G81 Z-.135 R.25 F10.0\nX-.75 Y-.75\nG80\nM30\n%\n");
  EXPECT_EQ("haas-mill", found.dialect) << found.reason;
  EXPECT_FALSE(found.sure);
}

TEST(Detection, DataOfACycleBeforeTheSignOfABlocksEndCount) {
  EXPECT_EQ("fanuc-lathe", detector()
                               .detect("a.nc", "O0004 (GROOVE) ;\nG50 X44.0 Z2.0 ;\nG74 R0.3 ;\n"
                                               "G74 X10.0 Z-12.0 P6.0 Q4.0 F0.15 ;\nM30 ;\n")
                               .dialect);
}

TEST(Detection, AMakersNameInACommentNamesNoKindOfMachine) {
  const Detection found =
      detector().detect("a.nc", "%\nO0001\nT100\nG99 G97\nM3 S2000\nG0 X10 Z0\nG1 X0 F0.02\n"
                                "G0 X40.0\nG0 C0\nT3200\nG0 X20. Z7. Y0\nG1 X-20.0 F0.02\n"
                                "(machine=FANUC_STAR)\nM30\n");
  EXPECT_EQ("fanuc-lathe", found.dialect) << found.reason;
}

TEST(Detection, ANumberInACommentIsNoVariableOfAnotherControl) {
  EXPECT_EQ("", detector()
                    .detect("a.ngc", "G97 S250 M3 (RPM 250)\n;G96 S80 M3 (VC80 MAX)\n"
                                     "G76 P1.5 Z-40 I2 J0.25 K2 H3\nM2\n")
                    .other);
}

TEST(Detection, OlderControlsAndSimulatorsAreNamed) {
  EXPECT_EQ("Sinumerik 810 or 850",
            detector()
                .detect("a.spf", "N100 G54\nN140 S2000 M03\n"
                                 "N200 R01=1 R02=0. R03=1 R12=5.0 R15=80.0 R24=1.5 L903\n")
                .other);
  EXPECT_EQ("Huazhong",
            detector().detect("a.nc", "%9811\n;cycle for HNC8\nIF[AR[#223] EQ 90]\nENDIF\n").other);
  const Detection simulated = detector().detect(
      "a.nc", "($SetPartSize(100, 100, 20, 1) )\n(Fanuc sample)\n%\nO123 (SAMPLE)\nT06 M6\n");
  EXPECT_EQ("the simulator CNCSimulator", simulated.other);
  EXPECT_FALSE(simulated.sure);
}

TEST(Detection, WordsOfOneControlDecideWhateverTheEnding) {
  const char *const turned =
      "N10 WORKPIECE(,,,\"CYLINDER\",0,0,-160,-160,80)\nN20 G18 G90 G95 G40 DIAMON G500\n"
      "N30 T1 D1\nN40 G97 S400 M3\n";
  EXPECT_EQ("sinumerik", detector().detect("a.nc", turned).dialect);
  EXPECT_EQ("sinumerik", detector().detect("a.nc", "T=\"CAL_TYPA\"\nM6\nD1\nHOME\nM17\n").dialect);
  EXPECT_EQ("linuxcnc",
            detector().detect("a.nc", "F10 (feed)\nG5.2 P1 L3\n X0 Y1 P1\nG5.3\nM2\n").dialect);
  EXPECT_EQ("haas-mill", detector()
                             .detect("a.nc", "O00011 (SLOT)\nT17 D17 M06\nG52 X0 Y0\n"
                                             "G101 Y0.\nM98 P100\nG100 Y0.\nM30\n")
                             .dialect);
}

TEST(Detection, TheFirstTextIsToldAsAnyOther) {
  namespace fs = std::filesystem;
  size_t programs = 0;
  for (const auto &file :
       fs::recursive_directory_iterator(fs::path(places::sourceFolder()) / "tests" / "programs")) {
    if (!file.is_regular_file() || file.path().extension() == ".cpp")
      continue;
    auto text = readFile(file.path().string());
    ASSERT_TRUE(bool(text)) << llvm::toString(text.takeError());
    const std::string name = file.path().filename().string();
    auto fresh = llvm::cantFail(Detector::create());
    const Detection first = fresh.detect(name, (*text)->getBuffer());
    const Detection later = detector().detect(name, (*text)->getBuffer());
    EXPECT_EQ(later.dialect, first.dialect) << name;
    EXPECT_EQ(later.reason, first.reason) << name;
    EXPECT_EQ(later.sure, first.sure) << name;
    EXPECT_EQ(later.other, first.other) << name;
    EXPECT_EQ(later.otherMarks, first.otherMarks) << name;
    ++programs;
  }
  EXPECT_GT(programs, 30u);
}

TEST(NeededTexts, AreInEachMatchOfAPattern) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(Texts{"HAAS"}, neededTexts("HAAS"));
  EXPECT_EQ(Texts({"GOTOF", "GOTOB"}), neededTexts("GOTO[FB] +[A-Z_]"));
  EXPECT_EQ(Texts({"G017.", "G017", "G17.", "G17"}), neededTexts("G0?17\\.?"));
  EXPECT_EQ(Texts({"FANUC", "MAZAK"}), neededTexts("(^|[ 0-9])FANUC|MAZAK *[0-9]+"));
  EXPECT_EQ(Texts{"MCALL"}, neededTexts("(N[0-9]+ *)?MCALL *"));
  EXPECT_EQ(Texts{"AB"}, neededTexts("(AB){2}C*"));
  EXPECT_EQ(Texts{"]"}, neededTexts("[]]"));
  for (const char *pattern : {"", "A?", "(A|)", "A*", "[^A]", ".", "(A|[^B])", "A{0,3}"})
    EXPECT_EQ(Texts{}, neededTexts(pattern)) << pattern;
  // Forms that are not read say nothing.
  for (const char *pattern : {"(?i)a", "\\dA", "[[:digit:]]A", "(A", "A)", "[A", "A{", "A\\"})
    EXPECT_EQ(Texts{}, neededTexts(pattern)) << pattern;
}

TEST(NeededTexts, AreLookedForInATextAsAWhole) {
  const HeldTexts held("G54.1 P12\nMCALL");
  for (const char *part : {"G", "G5", "54.1", "MCALL", "2\nM"})
    EXPECT_TRUE(held.holds(part)) << part;
  for (const char *part : {"X", "GP", "G54.2", "54.154", "CALLM"})
    EXPECT_FALSE(held.holds(part)) << part;
  EXPECT_TRUE(held.holdsAny({}));
  EXPECT_TRUE(held.holdsAny({"X", "P1"}));
  EXPECT_FALSE(held.holdsAny({"X", "P2"}));
}

} // namespace
} // namespace ncvet
