// Tool paths for reports: motions with their modes, operations, and where a path ends.
#include "analyzer/trace/tool_path_trace.h"
#include "tests/support/run_program.h"

#include "llvm/Support/Path.h"
#include <gmock/gmock.h>

#include <cmath>

namespace ncvet {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

ToolPath pathOf(const char *dialect, const std::string &program, const std::string &machine = "",
                size_t most = 1000) {
  ToolPath path;
  test::withProgram(
      dialect, {{"PART.nc", program}}, machine,
      [&](Project &project, FileUnit &unit) { path = traceToolPath(project, unit, {}, most); });
  return path;
}

/// The setting and the operation of a move.
const PathSection &sectionOf(const ToolPath &path, uint32_t move) {
  const PathSection *found = &path.sections.front();
  for (const PathSection &section : path.sections)
    if (section.move <= move)
      found = &section;
  return *found;
}
const PathSetting &settingOf(const ToolPath &path, uint32_t move) {
  return path.settings[sectionOf(path, move).setting];
}

std::vector<std::string> operationsOf(const ToolPath &path) {
  std::vector<std::string> all;
  for (const PathOperation &operation : path.operations)
    all.push_back("T" + std::to_string(operation.tool) + " " + operation.comment + " " +
                  operation.cycle + " " + std::to_string(operation.line));
  return all;
}

TEST(ToolPath, MovesHaveTheirPlacesLinesAndModes) {
  const ToolPath path = pathOf("haas-mill", "%\nO0001 (PLATE)\nG21 G17 G40 G49 G80 G90 G94\n"
                                            "T2 M6\n"
                                            "G54 G0 X10. Y20. S3000 M3\n"
                                            "G43 H2 Z5.\n"
                                            "G1 Z-1. F200.\n"
                                            "G2 X30. Y20. I10. J0. F500.\n"
                                            "G0 Z50.\nM30\n%\n");
  ASSERT_EQ(path.programmed.moves.size(), 6u);
  const std::vector<PathMove> &moves = path.programmed.moves;
  EXPECT_EQ(moves[0].motion, PathMotion::Tool);
  EXPECT_EQ(moves[1].motion, PathMotion::Rapid);
  EXPECT_TRUE(std::isnan(moves[1].to[2])) << "where Z is, nobody has said yet";
  EXPECT_THAT(moves[2].to, ElementsAre(10, 20, 5));
  EXPECT_EQ(moves[4].motion, PathMotion::Arc);
  EXPECT_EQ(moves[4].line, 8u);
  ASSERT_EQ(path.programmed.arcs.size(), 1u);
  EXPECT_EQ(path.programmed.arcs[0].move, 4u);
  EXPECT_THAT(path.programmed.arcs[0].centre, ElementsAre(20, 20));
  EXPECT_EQ(path.programmed.arcs[0].turns, -0.5f);
  const PathSetting &setting = settingOf(path, 4);
  EXPECT_EQ(setting.tool, 2);
  EXPECT_EQ(setting.lengthOffset, 2);
  EXPECT_EQ(setting.workOffset, "G54");
  EXPECT_EQ(setting.spindle, PathSpindle::Clockwise);
  EXPECT_EQ(setting.speed, 3000);
  ASSERT_EQ(path.feeds.size(), 2u);
  EXPECT_EQ(path.feeds[0].move, 3u);
  EXPECT_EQ(path.feeds[0].value, 200);
  EXPECT_EQ(PathFeed(path.feeds[0].kind), PathFeed::PerMinute);
  EXPECT_EQ(path.feeds[1].move, 4u);
  EXPECT_EQ(path.end.kind, PathEnd::Whole);
  EXPECT_EQ(path.end.line, 10u);
}

TEST(ToolPath, XOfALatheIsARadius) {
  const ToolPath path = pathOf("haas-lathe", "%\nO0001\nG21 G18 G40 G99 G54\nT101\nG97 S800 M03\n"
                                             "G00 X40. Z2.\nG01 Z-10. F0.2\n"
                                             "G02 X60. Z-20. R10.\nG00 X100. Z50.\nM30\n%\n");
  EXPECT_TRUE(path.lathe);
  EXPECT_TRUE(path.diameter);
  EXPECT_EQ(path.programmed.moves[1].to[0], 20);
  ASSERT_EQ(path.programmed.arcs.size(), 1u);
  const PathArc &arc = path.programmed.arcs[0];
  // G02 from (X 20, Z -10) to (X 30, Z -20): the centre is outside, at X 30, Z -10.
  EXPECT_EQ(arc.first, 2);
  EXPECT_EQ(arc.second, 0);
  EXPECT_FLOAT_EQ(arc.centre[0], -10);
  EXPECT_FLOAT_EQ(arc.centre[1], 30);
  EXPECT_FLOAT_EQ(arc.turns, -0.25);
}

TEST(ToolPath, AToolACommentAfterACutAndAnotherCycleBeginOperations) {
  const ToolPath path = pathOf("haas-mill", "%\nO0001\nG21 G17 G40 G49 G80 G90 G94\n"
                                            "(FACE)\n"
                                            "T1 M6\n"
                                            "G54 G0 X0. Y0. S900 M3\n"
                                            "G43 H1 Z5.\n"
                                            "(NO CUT YET)\n"
                                            "G1 Z0. F300.\n"
                                            "X100.\n"
                                            "G0 Z50.\n"
                                            "(SLOT)\n"
                                            "G0 X20.\n"
                                            "G1 Z-3. F100.\n"
                                            "Y30.\n"
                                            "G0 Z50.\n"
                                            "T3 M6 (DRILL 8.5)\n"
                                            "G54 G0 X0. Y0. S1400 M3\n"
                                            "G43 H3 Z50.\n"
                                            "G98 G81 X10. Y10. Z-5. R2. F120.\n"
                                            "X20.\n"
                                            "G80\n"
                                            "G98 G82 X10. Y10. Z-6. R2. P100 F120.\n"
                                            "G80\nM30\n%\n");
  EXPECT_THAT(operationsOf(path), ElementsAre("T-1   3", "T1 FACE  5", "T1 SLOT  13",
                                              "T3 DRILL 8.5 G81 17", "T3  G82 23"));
}

TEST(ToolPath, MovesOfACycleNameIt) {
  const ToolPath path = pathOf("haas-mill", "%\nO0001\nG21 G17 G40 G49 G80 G90 G94\nT1 M6\n"
                                            "G54 G0 X0. Y0. S900 M3\nG43 H1 Z50.\n"
                                            "G98 G81 X10. Y10. Z-5. R2. F120.\n"
                                            "G80\nG0 X0. Y0.\nM30\n%\n");
  const std::vector<PathMove> &moves = path.programmed.moves;
  for (uint32_t i = 0; i < moves.size(); ++i)
    EXPECT_EQ(settingOf(path, i).cycle, moves[i].line == 7 ? "G81" : "") << i;
}

TEST(ToolPath, TheCentreIsBesideThePathWhereTheRadiusIsKnown) {
  const std::string program = "%\nO0001\nG21 G17 G40 G49 G80 G90 G94\nT2 M6\n"
                              "G54 G0 X-20. Y-20. S900 M3\nG43 H2 Z-5.\n"
                              "G41 D2 G1 X0. Y-10. F300.\n"
                              "Y50.\nX60.\nG40 X80. Y60.\nM30\n%\n";
  const ToolPath path =
      pathOf("haas-mill", program,
             R"({"dialect": "haas-mill", "tools": {"2": {"kind": "endmill", "radius": 5}}})");
  EXPECT_EQ(path.machine.tools.at(2).radius, 5);
  std::map<uint32_t, PathMove> lastOfLine;
  for (const PathMove &move : path.centre.moves)
    lastOfLine[move.line] = move;
  // On the left of the way up: five millimetres towards -X, and round the corner above it.
  EXPECT_FLOAT_EQ(lastOfLine[7].to[0], -5);
  EXPECT_FLOAT_EQ(lastOfLine[9].to[1], 55);
  EXPECT_EQ(settingOf(path, 4).side, 1);
  EXPECT_THAT(pathOf("haas-mill", program).centre.moves, IsEmpty()) << "the radius is not known";
}

TEST(ToolPath, TheNoseOfALathesToolHasACentreToo) {
  const ToolPath path = pathOf(
      "haas-lathe",
      "%\nO0001\nG21 G18 G40 G99 G54\nT101\nG97 S800 M03\nG00 X50. Z5.\n"
      "G42 G01 X40. Z2. F0.2\nZ-30.\nX60.\nG40 X70.\nG00 X100. Z50.\nM30\n%\n",
      R"({"dialect": "haas-lathe", "tools": {"1": {"kind": "turning", "radius": 0.8, "tip": 3}}})");
  std::map<uint32_t, PathMove> lastOfLine;
  for (const PathMove &move : path.centre.moves)
    lastOfLine[move.line] = move;
  EXPECT_NEAR(lastOfLine[8].to[0], 20.8, 1e-4) << "outside of the diameter 40";
  EXPECT_NEAR(lastOfLine[8].to[2], -30 + 0.8, 1e-4) << "before the shoulder";
}

TEST(ToolPath, ItSaysWhereOnlyTheRunDecides) {
  const ToolPath path =
      pathOf("haas-mill", "%\nO0001\nG21 G17 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0.\n"
                          "IF [#500 GT 3] GOTO 90\nG0 X10.\nN90 G0 X20.\nM30\n%\n");
  EXPECT_EQ(path.end.kind, PathEnd::Unknown);
  EXPECT_EQ(path.end.line, 6u);
  EXPECT_FALSE(path.end.why.empty());
  EXPECT_EQ(path.programmed.moves.size(), 2u);
}

TEST(ToolPath, ALongPathIsCutAndSaysSo) {
  std::string program = "%\nO0001\nG21 G17 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0.\n";
  for (int i = 0; i < 5000; ++i)
    program += "G0 X" + std::to_string(i) + ".\n";
  const ToolPath path = pathOf("haas-mill", program + "M30\n%\n", "", 100);
  EXPECT_EQ(path.end.kind, PathEnd::Cut);
  EXPECT_EQ(path.programmed.moves.size(), 100u);
  EXPECT_EQ(path.end.line, 104u);
}

TEST(ToolPath, SubprogramsInOtherFilesAreNamed) {
  ToolPath path;
  std::vector<std::string> names;
  test::withProgram("haas-mill",
                    {{"PART.nc", "%\nO0001\nG21 G17 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0.\n"
                                 "M98 P2 L2\nM30\n%\n"},
                     {"O0002.nc", "%\nO0002\nG91 G0 X5.\nG90\nM99\n%\n"}},
                    "", [&](Project &project, FileUnit &unit) {
                      path = traceToolPath(project, unit, {}, 100);
                      for (const FileId file : path.files)
                        names.push_back(
                            llvm::sys::path::filename(project.sources().get(file).display()).str());
                    });
  EXPECT_THAT(names, ElementsAre("PART.nc", "O0002.nc"));
  ASSERT_EQ(path.programmed.moves.size(), 4u);
  EXPECT_EQ(path.programmed.moves[3].file, 1);
  EXPECT_EQ(path.programmed.moves[3].to[0], 10);
}

TEST(ToolPath, TheProfileGivesTravelStockTimesAndOrigins) {
  const ToolPath path = pathOf("haas-mill", "%\nO0001\nG54 G0 X0. Y0.\nM30\n%\n",
                               R"({"dialect": "haas-mill", "feed": {"rapid": 25400, "max": 16500},
                 "axes": {"X": {"min": -762, "max": 0}},
                 "offsets": {"G54": {"X": -400, "Y": -200, "Z": -300}},
                 "stock": {"min": {"X": 0, "Z": -20}, "max": {"X": 100, "Z": 0}},
                 "options": {"acceleration": 3000, "toolChangeTime": 4.5}})");
  const PathMachine &machine = path.machine;
  EXPECT_EQ(machine.rapid, 25400);
  EXPECT_EQ(machine.envelope.min[0], -762);
  EXPECT_FALSE(machine.envelope.min[1]);
  EXPECT_EQ(machine.offsets.at("G54")[2], -300);
  ASSERT_TRUE(machine.stock);
  EXPECT_EQ(machine.stock->max[0], 100);
  EXPECT_FALSE(machine.stock->max[1]);
  EXPECT_EQ(machine.acceleration, 3000);
  EXPECT_EQ(machine.toolChange, 4.5);
}

} // namespace
} // namespace ncvet
