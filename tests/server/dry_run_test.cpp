// The debug adapter as an editor sees it: a dry run of a program, block by block.
#include "tests/support/debug_client.h"
#include "tests/support/process.h"

#include <chrono>
#include <deque>
#include <functional>
#include <regex>
#include <sstream>

using namespace ncvet::test;

namespace {

/// A mill's program with a subprogram that is called twice, and a loop.
constexpr const char *plate = "%\n"
                              "O0001 (PLATE)\n"            // 2
                              "G21 G17 G90 G40 G80\n"      // 3
                              "T1 M06\n"                   // 4
                              "G54 G00 X0. Y0. S800 M03\n" // 5
                              "G43 Z50. H01\n"             // 6
                              "#101=0\n"                   // 7
                              "WHILE[#101LT3]DO1\n"        // 8
                              "#101=#101+1\n"              // 9
                              "M98 P0002\n"                // 10
                              "END1\n"                     // 11
                              "M00\n"                      // 12
                              "G49 G00 Z100.\n"            // 13
                              "M30\n"                      // 14
                              "O0002 (HOLE)\n"             // 15
                              "G01 Z-1. F200.\n"           // 16
                              "G91 X[#101] Y1.\n"          // 17
                              "G90 G00 Z50.\n"             // 18
                              "M99\n"                      // 19
                              "%\n";

/// A session with one program.
class Debugged : public DebugClient {
public:
  explicit Debugged(const std::string &text, Json launch = Json::object()) {
    shop.file("a.nc", text);
    launch["program"] = path();
    if (!launch.contains("dialect"))
      launch["dialect"] = "fanuc-mill";
    if (!launch.contains("stopOnEntry"))
      launch["stopOnEntry"] = true;
    DebugClient::launch(std::move(launch));
  }
  std::string path() const { return (shop.path() / "a.nc").string(); }
  Json breakpoints(Json wanted) {
    return request("setBreakpoints", {{"source", {{"path", path()}}},
                                      {"breakpoints", std::move(wanted)}})["breakpoints"];
  }
  void filters(Json names) { request("setExceptionBreakpoints", {{"filters", std::move(names)}}); }

  Shop shop;
};

TEST(DryRun, StopsAtTheFirstBlockAndStepsIntoOverAndOut) {
  Debugged run(plate);
  EXPECT_EQ(run.begin()["reason"], "entry");
  EXPECT_EQ(run.line(), 3);
  for (const int line : {4, 5, 6, 7, 8, 9, 10}) {
    EXPECT_EQ(run.go("next")["reason"], "step");
    EXPECT_EQ(run.line(), line);
  }
  run.go("stepIn");
  const Json frames = run.frames();
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0]["line"], 16);
  EXPECT_EQ(frames[0]["name"], "O2");
  EXPECT_EQ(frames[1]["line"], 10) << "the caller is at its call";
  run.go("stepOut");
  EXPECT_EQ(run.line(), 11);
  run.go("next"); // the loop's test
  run.go("next");
  run.go("next");
  EXPECT_EQ(run.line(), 10);
  run.go("next"); // over the call
  EXPECT_EQ(run.line(), 11);
  EXPECT_EQ(run.scope("Variables")["#101"], "2");
  EXPECT_EQ(run.disconnect(), 0);
}

TEST(DryRun, WhatIsAskedAfterTheUserHasEndedItIsAnsweredWithNothing) {
  Debugged run(plate);
  run.begin();
  run.request("terminate");
  run.event("terminated");
  EXPECT_TRUE(run.frames().empty());
  EXPECT_TRUE(run.request("scopes", {{"frameId", 1}})["scopes"].empty());
  EXPECT_EQ(run.disconnect(), 0);
}

TEST(DryRun, ShowsTheMachineBeforeEachBlock) {
  Debugged run(plate);
  run.breakpoints({{{"line", 18}}});
  run.begin();
  EXPECT_EQ(run.go("continue")["reason"], "breakpoint");
  auto position = run.scope("Position");
  EXPECT_EQ(position["X"], "1");
  EXPECT_EQ(position["Y"], "1");
  EXPECT_EQ(position["Z"], "-1");
  auto drives = run.scope("Spindle and feed");
  EXPECT_EQ(drives["F"], "200");
  EXPECT_EQ(drives["S"], "800");
  EXPECT_EQ(drives["spindle"], "clockwise");
  auto offsets = run.scope("Offsets");
  EXPECT_EQ(offsets["tool"], "1");
  EXPECT_EQ(offsets["length offset H"], "1");
  bool isIncremental = false;
  for (const auto &[name, codes] : run.scope("Modes"))
    isIncremental |= codes == "G91";
  EXPECT_TRUE(isIncremental);
  EXPECT_EQ(run.evaluate("X"), "1");
  EXPECT_EQ(run.evaluate("#101*2", "hover"), "2");
  EXPECT_NE(run.refusal("evaluate", {{"expression", "G01"}, {"context", "hover"}}), "");
}

TEST(DryRun, ABreakpointMovesToTheNextBlock) {
  Debugged run(plate);
  const Json placed = run.breakpoints({{{"line", 1}}, {{"line", 15}}, {{"line", 40}}});
  EXPECT_EQ(placed[0]["verified"], true);
  EXPECT_EQ(placed[0]["line"], 3) << "neither the mark of the tape nor the program's head is one";
  EXPECT_EQ(placed[1]["line"], 16);
  EXPECT_EQ(placed[2]["verified"], false);
  const Json places = run.request(
      "breakpointLocations", {{"source", {{"path", run.path()}}}, {"line", 1}, {"endLine", 5}});
  ASSERT_EQ(places["breakpoints"].size(), 3u);
  EXPECT_EQ(places["breakpoints"][2]["line"], 5);
}

TEST(DryRun, ConditionsAreReadAsTheControlReadsThem) {
  Debugged run(plate);
  const Json placed = run.breakpoints({{{"line", 17}, {"condition", "#101 > 1"}}});
  run.begin();
  const Json stop = run.go("continue");
  EXPECT_EQ(stop["hitBreakpointIds"], Json::array({placed[0]["id"]}));
  EXPECT_EQ(run.evaluate("#101"), "2");
  run.breakpoints({{{"line", 17}, {"condition", "#101 EQ 3"}}});
  run.go("continue");
  EXPECT_EQ(run.evaluate("#101"), "3");
  const Json wrong = run.breakpoints({{{"line", 17}, {"condition", "#101 >"}}});
  EXPECT_EQ(wrong[0]["verified"], false);
}

TEST(DryRun, ConditionsAndMessagesKnowTheMachine) {
  Debugged run(plate);
  run.breakpoints({{{"line", 11}, {"logMessage", "hole {#101} at {X}, tool {T}"}},
                   {{"line", 18}, {"condition", "X >= 3"}}});
  run.begin();
  run.go("continue");
  EXPECT_EQ(run.evaluate("X"), "3") << "of 1 and 2 more";
  const std::string said = run.outputs();
  EXPECT_NE(said.find("hole 1 at 1, tool 1"), std::string::npos) << said;
  const Json wrong = run.breakpoints(
      {{{"line", 17}, {"condition", "Z <"}}, {{"line", 17}, {"condition", "Z < Q"}}});
  EXPECT_EQ(wrong[0]["verified"], false);
  EXPECT_EQ(wrong[1]["verified"], false);
}

TEST(DryRun, TheFirstGroupOfValuesIsNotEmpty) {
  const auto firstGroup = [](const std::string &text) {
    Debugged run(text);
    run.begin();
    return run.request("scopes", {{"frameId", run.frames()[0]["id"]}})["scopes"][0]["name"];
  };
  EXPECT_EQ(firstGroup(plate), "Variables");
  EXPECT_EQ(firstGroup("O1\nG54 G00 X0. Y0.\nM30\n"), "Position");
}

TEST(DryRun, HitCountsAndLogPoints) {
  Debugged run(plate);
  run.breakpoints({{{"line", 16}, {"logMessage", "hole {#101} at {#101*10}"}},
                   {{"line", 17}, {"hitCondition", ">= 3"}}});
  run.begin();
  run.go("continue");
  EXPECT_EQ(run.evaluate("#101"), "3");
  const std::string said = run.outputs();
  EXPECT_NE(said.find("hole 1 at 10"), std::string::npos) << said;
  EXPECT_NE(said.find("hole 3 at 30"), std::string::npos) << said;
}

TEST(DryRun, StopsWhereAProgramOfANameBegins) {
  Debugged run(plate);
  const Json placed =
      run.request("setFunctionBreakpoints",
                  {{"breakpoints", {{{"name", "O0002"}, {"hitCondition", "2"}}}}})["breakpoints"];
  EXPECT_EQ(placed[0]["verified"], true);
  run.begin();
  EXPECT_EQ(run.go("continue")["reason"], "function breakpoint");
  EXPECT_EQ(run.line(), 16);
  EXPECT_EQ(run.evaluate("#101"), "2");
}

TEST(DryRun, StopsAtToolChangesAndProgramStops) {
  Debugged run(plate);
  run.filters({"toolChange", "programStop"});
  run.begin();
  EXPECT_EQ(run.go("continue")["description"], "tool change");
  EXPECT_EQ(run.line(), 4);
  EXPECT_EQ(run.go("continue")["description"], "program stop");
  EXPECT_EQ(run.line(), 12);
  run.request("continue", {{"threadId", 1}});
  EXPECT_EQ(run.event("exited")["exitCode"], 0);
  run.event("terminated");
}

TEST(DryRun, StopsBeforeABlockWithAFinding) {
  Debugged run("%\nO1\nG90 G17 G21\nT1 M06\nG54 G00 X0. Y0. S800 M03\nG43 Z5. H01\nG01 X50. F0\n"
               "G49 G00 Z50.\nM30\n%\n");
  run.filters({"finding:error"});
  run.begin();
  const Json stop = run.go("continue");
  EXPECT_EQ(stop["description"], "finding");
  EXPECT_NE(stop["text"].get<std::string>().find("[feed-not-positive]"), std::string::npos)
      << stop.dump();
  EXPECT_EQ(run.line(), 7);
  EXPECT_EQ(run.request("exceptionInfo", {{"threadId", 1}})["exceptionId"], "finding");
  run.request("continue", {{"threadId", 1}});
  run.event("terminated");
}

/// What a program of this control shows to the operator, up to its end.
std::string shownBy(const std::string &dialect, const std::string &program) {
  Debugged run(program, {{"dialect", dialect}});
  run.filters(Json::array());
  run.begin();
  std::string shown;
  while (true) {
    run.request("stepIn", {{"threadId", 1}});
    const Json next = run.eventOf({"stopped", "terminated"});
    for (const Json &said : run.takeOutputs("stdout"))
      shown += std::to_string(said["line"].get<int>()) + ": " + said["output"].get<std::string>();
    if (!next.contains("reason"))
      break;
  }
  return shown;
}

TEST(DryRun, ShowsTheMessagesOfTheProgram) {
  EXPECT_EQ(shownBy("fanuc-mill", "O1\nG21 G90\n#3006=1(TURN PART)\n(NO MESSAGE)\n"
                                  "IF[1EQ2]THEN #3000=1(NOT THIS)\nG00 X1.\nM30\n"),
            "3: TURN PART\n");
  EXPECT_EQ(shownBy("linuxcnc", "G21 G90\n#<depth>=4\n(msg, hello)\n(DEBUG, depth is #<depth>)\n"
                                "(a comment)\nG0 X1\nM2\n"),
            "3: hello\n4: depth is 4\n");
  EXPECT_EQ(
      shownBy("sinumerik", "R1=3\nMSG(\"Part \" << R1 << \" of 4\")\nMSG(\"GO\")\nMSG()\nM30\n"),
      "2: Part 3 of 4\n3: GO\n");
  EXPECT_EQ(shownBy("ecs", "N1 G0 X1 (shown)\nN2 M30\n"), "1: shown\n");
}

TEST(DryRun, AStopWithAMessageIsAProgramStop) {
  Debugged run("O1\nG90 G21\n#3006=1(TURN PART)\n#3000=7(NO TOOL)\nM30\n");
  run.filters({"programStop"});
  run.begin();
  const Json stop = run.go("continue");
  EXPECT_EQ(stop["description"], "program stop");
  EXPECT_EQ(stop["text"], "TURN PART");
  EXPECT_EQ(run.line(), 3);
  const Json alarm = run.go("continue");
  EXPECT_EQ(alarm["description"], "alarm");
  EXPECT_EQ(alarm["text"], "the program stops itself with an alarm: NO TOOL");
}

TEST(DryRun, RunsToALine) {
  Debugged run(plate);
  run.breakpoints({{{"line", 16}}});
  run.begin();
  const auto target = [&](int line) {
    return run.request("gotoTargets",
                       {{"source", {{"path", run.path()}}}, {"line", line}})["targets"][0];
  };
  const auto goTo = [&](const Json &to) {
    run.request("goto", {{"threadId", 1}, {"targetId", to["id"]}});
    return run.event("stopped");
  };
  const Json hole = target(15);
  EXPECT_EQ(hole["line"], 16) << "the block at the line, or the next one";
  EXPECT_EQ(goTo(target(12))["reason"], "goto");
  EXPECT_EQ(run.line(), 12) << "past the breakpoint";
  EXPECT_EQ(run.evaluate("#101"), "3");
  goTo(hole);
  EXPECT_EQ(run.line(), 12) << "the program does not come there any more";
  EXPECT_EQ(run.evaluate("#101"), "3");
  EXPECT_NE(run.outputs().find("does not come to line 16"), std::string::npos) << run.outputs();
  EXPECT_NE(run.refusal("goto", {{"threadId", 1}, {"targetId", 99}}), "");
  EXPECT_EQ(run.go("next")["reason"], "step");
  EXPECT_EQ(run.line(), 13);
}

TEST(DryRun, AVariableIsGivenAnotherValue) {
  Debugged run(plate);
  run.breakpoints({{{"line", 17}}});
  run.begin();
  run.go("continue");
  const Json scopes = run.request("scopes", {{"frameId", run.frames()[0]["id"]}})["scopes"];
  ASSERT_EQ(scopes[0]["name"], "Variables");
  EXPECT_EQ(run.request("setVariable", {{"variablesReference", scopes[0]["variablesReference"]},
                                        {"name", "#101"},
                                        {"value", "2.5*2"}})["value"],
            "5");
  run.go("stepIn");
  EXPECT_EQ(run.scope("Position")["X"], "5") << "the block went by the new value";
  EXPECT_EQ(run.request("setExpression", {{"expression", "#102"}, {"value", "7"}})["value"], "7");
  EXPECT_EQ(run.evaluate("#103=#102+1", "repl"), "8");
  EXPECT_NE(run.refusal("setExpression", {{"expression", "X"}, {"value", "7"}}), "");
}

TEST(DryRun, AnOpenConditionAsksTheUser) {
  const std::string program = "O1\nG90 G21\n#100=1\nIF[#5041GT0]GOTO20\nG00 X1.\nGOTO30\n"
                              "N20 G00 X2.\nN30 M30\n";
  {
    Debugged run(program);
    run.begin();
    const Json stop = run.go("continue");
    EXPECT_EQ(stop["description"], "unknown");
    EXPECT_EQ(run.line(), 4);
    EXPECT_EQ(run.go("continue")["description"], "unknown") << "it is as open as before";
    run.evaluate("yes", "repl");
    run.go("next");
    EXPECT_EQ(run.line(), 7);
  }
  {
    Debugged run(program);
    run.begin();
    run.go("continue");
    run.evaluate("no", "repl");
    run.go("next");
    EXPECT_EQ(run.line(), 5);
  }
  Debugged run(program, {{"openConditions", "holds"}});
  run.breakpoints({{{"line", 5}}, {{"line", 7}}});
  run.begin();
  run.go("continue");
  EXPECT_EQ(run.line(), 7) << "the launch has said how open conditions go";
}

TEST(DryRun, GoesBack) {
  Debugged run(plate);
  run.breakpoints({{{"line", 17}}});
  run.begin();
  run.go("continue");
  run.go("continue");
  EXPECT_EQ(run.evaluate("#101"), "2");
  EXPECT_EQ(run.go("stepBack")["reason"], "step");
  EXPECT_EQ(run.line(), 16);
  EXPECT_EQ(run.evaluate("#101"), "2");
  run.go("reverseContinue");
  EXPECT_EQ(run.line(), 17);
  EXPECT_EQ(run.evaluate("#101"), "1");
  run.request("setExpression", {{"expression", "#101"}, {"value", "9"}});
  run.go("stepIn");
  run.go("stepBack");
  EXPECT_EQ(run.evaluate("#101"), "9") << "what the user did before is done again";
  run.go("reverseContinue");
  EXPECT_EQ(run.line(), 3) << "no breakpoint was hit before: the start";
}

TEST(DryRun, AnEndlessLoopIsPausedAtOnce) {
  Debugged run("O1\nG90 G21\n#100=0\nN10 #100=#100+1\nG00 X[#100]\nGOTO10\nM30\n");
  run.begin();
  run.request("continue", {{"threadId", 1}});
  ::usleep(300000);
  EXPECT_NE(run.refusal("stackTrace", {{"threadId", 1}}), "") << "it runs";
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(run.go("pause")["reason"], "pause");
  const auto took = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(took, std::chrono::milliseconds(100));
  EXPECT_GT(std::stod(run.evaluate("#100")), 100);
  run.request("continue", {{"threadId", 1}});
  EXPECT_EQ(run.disconnect(), 0) << "a session ends while its program runs";
}

TEST(DryRun, BreakpointsAreSetWhileTheProgramRuns) {
  Debugged run("O1\nG90 G21\n#100=0\nN10 #100=#100+1\nG00 X[#100]\nGOTO10\nM30\n");
  run.begin();
  run.request("continue", {{"threadId", 1}});
  run.breakpoints({{{"line", 5}}});
  EXPECT_EQ(run.event("stopped")["reason"], "breakpoint");
  EXPECT_EQ(run.line(), 5);
}

TEST(DryRun, ALoopThatNothingLeavesIsTold) {
  Debugged run("O1\nG90 G21\nN10 G00 X1.\nX2.\nGOTO10\nM30\n");
  run.breakpoints({{{"line", 3}, {"hitCondition", "20"}}});
  run.begin();
  EXPECT_EQ(run.go("continue")["reason"], "breakpoint");
  EXPECT_NE(run.outputs().find("[flow-endless-loop]"), std::string::npos) << run.outputs();
}

TEST(DryRun, WhereNothingLeadsOnThePlaceIsShown) {
  Debugged run("O1\nG90 G21\nG00 X1.\nM98 P0999\nM30\n");
  run.filters(Json::array());
  run.begin();
  const Json stop = run.go("continue");
  EXPECT_EQ(stop["description"], "the run ends here") << stop.dump();
  EXPECT_EQ(run.line(), 4);
  EXPECT_EQ(run.scope("Position")["X"], "1");
  run.request("continue", {{"threadId", 1}});
  EXPECT_EQ(run.event("exited")["exitCode"], 1);
}

TEST(DryRun, BlockSkipAndVariablesAreGivenAtTheLaunch) {
  const std::string program = "O1\nG90 G21\n/G00 X1.\n/2 G00 X2.\nG00 Y[#101]\nM30\n";
  Debugged run(program, {{"blockSkip", {2}}, {"variables", {{"#101", 4}}}});
  run.begin();
  std::vector<int> lines;
  for (int i = 0; i < 4; ++i) {
    lines.push_back(run.line());
    if (i < 3)
      run.go("stepIn");
  }
  EXPECT_EQ(lines, (std::vector<int>{2, 3, 5, 6}));
  EXPECT_EQ(run.scope("Position")["Y"], "4");
}

TEST(DryRun, RestartsWithTheTextThatIsOnDiskNow) {
  Debugged run(plate);
  run.breakpoints({{{"line", 17}}});
  run.begin();
  run.go("continue");
  std::string longer = plate;
  longer.insert(longer.find("T1"), "(MORE)\n");
  run.shop.file("a.nc", longer);
  run.request("restart");
  EXPECT_EQ(run.event("stopped")["reason"], "entry");
  EXPECT_EQ(run.go("continue")["reason"], "breakpoint");
  EXPECT_EQ(run.line(), 17);
  EXPECT_EQ(run.scope("Position")["Z"], "50")
      << "line 17 is the block before the one of the first run";
}

TEST(DryRun, ProgramsOfOtherFilesAreSources) {
  Shop shop;
  shop.file("O0001.nc", "%\nO0001\nG90 G21\nM98 P0002\nM30\n%\n")
      .file("O0002.nc", "%\nO0002\nG00 X3.\nM99\n%\n");
  DebugClient run;
  const std::string called = (shop.path() / "O0002.nc").string();
  run.launch({{"program", (shop.path() / "O0001.nc").string()}, {"dialect", "fanuc-mill"}});
  const Json placed = run.request(
      "setBreakpoints", {{"source", {{"path", called}}}, {"breakpoints", {{{"line", 4}}}}});
  EXPECT_EQ(placed["breakpoints"][0]["verified"], true);
  EXPECT_EQ(run.begin()["reason"], "breakpoint");
  EXPECT_EQ(run.frames()[0]["source"]["path"], called);
  EXPECT_EQ(run.scope("Position")["X"], "3");
  EXPECT_EQ(run.request("loadedSources")["sources"].size(), 2u);
}

TEST(DryRun, AClientMayNameFilesByTheirUris) {
  Shop shop;
  shop.file("a b.nc", plate);
  const std::string path = (shop.path() / "a b.nc").string(),
                    uri = "file://" + (shop.path() / "a%20b.nc").string();
  DebugClient run;
  run.request("initialize", {{"adapterID", "ncvet"}, {"pathFormat", "uri"}});
  run.request("launch", {{"program", path}, {"dialect", "fanuc-mill"}});
  run.event("initialized");
  const Json placed = run.request("setBreakpoints",
                                  {{"source", {{"path", uri}}}, {"breakpoints", {{{"line", 16}}}}});
  EXPECT_EQ(placed["breakpoints"][0]["verified"], true);
  EXPECT_EQ(run.begin()["reason"], "breakpoint");
  EXPECT_EQ(run.frames()[0]["source"]["path"], uri);
}

TEST(DryRun, ASessionIsEndedByTheUser) {
  Debugged run(plate);
  run.begin();
  EXPECT_EQ(run.request("threads")["threads"].size(), 1u);
  run.request("terminate");
  run.event("terminated");
  EXPECT_NE(run.refusal("continue", {{"threadId", 1}}), "");
  EXPECT_EQ(run.disconnect(), 0);
}

TEST(DryRun, WithoutDebuggingNothingStopsIt) {
  Debugged run(plate, {{"noDebug", true}});
  run.breakpoints({{{"line", 17}}});
  run.request("configurationDone");
  run.event("terminated");
}

TEST(DryRun, WhatIsWrongWithALaunchIsSaid) {
  const auto refused = [](Json arguments) {
    DebugClient run;
    run.request("initialize", {{"adapterID", "ncvet"}});
    return run.refusal("launch", std::move(arguments));
  };
  EXPECT_NE(refused(Json::object()).find("program"), std::string::npos);
  EXPECT_NE(refused({{"program", "/nowhere/a.nc"}}).find("/nowhere/a.nc"), std::string::npos);
  Shop shop;
  shop.file("a.nc", plate);
  const std::string path = (shop.path() / "a.nc").string();
  EXPECT_NE(refused({{"program", path}, {"dialect", "no-such"}}), "");
  EXPECT_NE(refused({{"program", path}, {"dialect", "fanuc-mill"}, {"blockSkip", {12}}}), "");
  EXPECT_NE(refused({{"program", path}, {"dialect", "fanuc-mill"}, {"openConditions", "maybe"}}),
            "");
  EXPECT_NE(refused({{"program", path}, {"dialect", "fanuc-mill"}, {"variables", {{"X", 1}}}}), "");
}

TEST(DryRun, WrongMessagesAreAnsweredAndTheSessionGoesOn) {
  Debugged run(plate);
  run.sendBody("{no json");
  run.sendBody("[1, 2]");
  run.sendBody(std::string(100000, '['));
  run.send({{"type", "request"}, {"command", 5}, {"seq", 1}});
  run.send({{"type", "response"}, {"request_seq", 1}, {"seq", 2}, {"success", true}});
  run.sendBytes("nonsense\r\nContent-Length: x\r\n\r\n");
  EXPECT_NE(run.refusal("no such command"), "");
  EXPECT_NE(run.refusal("setBreakpoints", {{"breakpoints", Json::array()}}), "");
  EXPECT_NE(run.refusal("setBreakpoints", {{"source", 5}}), "");
  EXPECT_NE(run.refusal("continue"), "") << "nothing runs yet";
  EXPECT_NE(run.refusal("launch", {{"program", run.path()}}), "") << "it is launched already";
  EXPECT_EQ(run.breakpoints({{{"line", -1}}, {{"line", 1e300}}, {{"line", "5"}}, 5}).size(), 4u);
  run.begin();
  for (const char *command : {"scopes", "stackTrace", "variables", "setVariable", "evaluate"})
    for (const Json &wrong : {Json(-1), Json(1u << 30), Json("x"), Json::array(), Json(nullptr)})
      run.response(run.ask(command, {{"frameId", wrong},
                                     {"variablesReference", wrong},
                                     {"startFrame", wrong},
                                     {"levels", wrong},
                                     {"expression", wrong}}));
  EXPECT_NE(run.refusal("evaluate", {{"expression", std::string(1 << 20, '[')}}), "");
  EXPECT_EQ(run.line(), 3);
  EXPECT_EQ(run.disconnect(), 0);
}

/// A control and a program of it that comes to two hundred blocks and more.
struct LongRun {
  const char *dialect;
  std::string program;
};
void PrintTo(const LongRun &run, std::ostream *out) { *out << run.dialect; }

std::string numberedLines(int count, const std::function<std::string(int)> &line) {
  std::string all;
  for (int i = 0; i < count; ++i)
    all += line(i) + "\n";
  return all;
}

/// A mill's program of the ISO kind: drilling, arcs, and a subprogram that runs thirty times.
std::string milledProgram(const std::string &runs) {
  return "%\nO0001 (PLATE)\nG21 G17 G90 G40 G80\nT1 M06\nG54 G00 X0. Y0. S800 M03\nG43 Z50. H01\n"
         "G01 Z2. F500.\n" +
         runs +
         "G90 G00 Z50.\nG98 G81 X10. Y10. Z-5. R2. F100.\nX20.\nY20.\nG80\nG00 X0. Y0.\n"
         "M05\nG91 G28 Z0.\nG90\nM30\n"
         "O0002\nG91 G01 X2. F300.\nG02 X4. Y4. I0. J4.\nG01 Y-1.5\nG04 P500\nX-5.\nG90 Z1.\n"
         "M99\n%\n";
}

std::string turnedProgram(const std::string &runs) {
  return "%\nO0001 (SHAFT)\nG21 G40 G97 G99\nT0101\nS800 M03\nG00 X60. Z2.\n" + runs +
         "G00 X100. Z50.\nM05\nM30\nO0002\nG01 U-0.5 F0.2\nW-1.\nG02 U2. W-1. R1.\nG01 U-1.5\n"
         "G04 X0.5\nW2.\nM99\n%\n";
}

std::vector<LongRun> longRuns() {
  const std::string loop = "#1=0\nWHILE[#1LT25]DO1\n#1=#1+1\nM98 P0002\nEND1\n";
  return {
      {"fanuc-0m", milledProgram(loop)},
      {"fanuc-mill", milledProgram(loop)},
      {"haas-mill", milledProgram(loop)},
      {"nct-104m", milledProgram("M98 P0002 L30\n")},
      {"fanuc-0t", turnedProgram(loop)},
      {"fanuc-lathe", turnedProgram(loop)},
      {"haas-lathe", turnedProgram("M98 P0002 L33\n")},
      {"haas-ngc-lathe", turnedProgram(loop)},
      {"nct-104t", turnedProgram("M98 P0002 L33\n")},
      {"din66025", "%1\n" +
                       numberedLines(210,
                                     [](int i) {
                                       return "N" + std::to_string(i + 1) +
                                              (i % 2 ? " G0" : " G1") + " X" + std::to_string(i) +
                                              " Y" + std::to_string(i * 3 % 7) + (i ? "" : " F100");
                                     }) +
                       "N999 M30\n"},
      {"sinumerik", "N10 G0 X0 Y0 Z5\nR1=0\nANF: R1=R1+1\nG1 X=R1 Y=IC(1) F100\nG91 Z-1\nG90\n"
                    "G3 X=R1+4 CR=2\nIF R1<50 GOTOB ANF\nFOR R2=1 TO 20\nG0 X=R2\nENDFOR\n"
                    "M30\n"},
      {"ecs", "N1 G0 X1 Y2\nN2 G1 X5 F100\nN3 G91\nN4 Y1\nN5 G90\nN6 <RPT:N2;N5;60>\nN7 M30\n"},
      {"mefi", numberedLines(205,
                             [](int i) {
                               return "N" + std::to_string(i + 1) + " G" + (i % 2 ? "0" : "1") +
                                      " X" + std::to_string(i) + "\n   Z" + std::to_string(-i % 9) +
                                      (i ? "" : " F100 S500");
                             }) +
                   "N999 M30\n"},
      {"linuxcnc", "G21 G90 G17\nG0 X0 Y0 Z5\n#<i>=0\no100 while [#<i> LT 30]\n#<i>=[#<i>+1]\n"
                   "G1 X#<i> F200\nG91 G2 X2 Y2 J2\nG90\no110 if [#<i> GT 20]\nG0 Z#<i>\no110 "
                   "endif\no100 endwhile\nM2\n"},
  };
}

class LongDryRun : public testing::TestWithParam<LongRun> {};
INSTANTIATE_TEST_SUITE_P(Controls, LongDryRun, testing::ValuesIn(longRuns()), [](const auto &info) {
  std::string name = info.param.dialect;
  std::erase(name, '-');
  return name;
});

TEST(DryRun, EveryControlHasALongRun) {
  std::set<std::string> known, run;
  std::istringstream in(Shop().run({"dialects"}).out);
  for (std::string line; std::getline(in, line);)
    known.insert(line.substr(0, line.find(' ')));
  for (const LongRun &one : longRuns())
    run.insert(one.dialect);
  EXPECT_EQ(run, known);
}

/// `G00` and `G0` are one code.
std::string bareCode(const std::string &code) {
  const size_t zeros = code.find_first_not_of('0', 1);
  return code.substr(0, 1) + (zeros == std::string::npos ? "0" : code.substr(zeros));
}

/// Codes that are in force for certain.
std::set<std::string> codesInForce(Debugged &run) {
  std::set<std::string> codes;
  for (const auto &[group, code] : run.scope("Modes"))
    codes.insert(bareCode(code));
  return codes;
}

/// The code of the motion that the trace tells.
std::set<std::string> codesOf(const Json &motion) {
  const std::string kind = motion["kind"];
  if (kind == "rapid" || kind == "linear")
    return {kind == "rapid" ? "G0" : "G1"};
  if (kind != "arc")
    return {};
  return {motion["direction"] == "cw" ? "G2" : "G3"};
}

/// Codes of one group each, of which a block that names one puts it in the place of the others.
const std::vector<std::set<std::string>> exclusiveCodes = {
    {"G17", "G18", "G19"}, {"G90", "G91"}, {"G40", "G41", "G42"}, {"G20", "G21"}};

/// Puts the codes that the text of a block names into those that are due.
void takeCodes(const std::string &block, std::set<std::string> &due) {
  static const std::regex word("G[0-9]+");
  for (std::sregex_iterator i(block.begin(), block.end(), word), end; i != end; ++i)
    for (const std::set<std::string> &group : exclusiveCodes)
      if (const std::string code = bareCode(i->str()); group.count(code)) {
        for (const std::string &other : group)
          due.erase(other);
        due.insert(code);
      }
}

/// What was executed between two stops is the block of the first one: where the trace says that
/// its motions end, the machine is at the second.
TEST_P(LongDryRun, TwoHundredStopsEqualTheTrace) {
  const auto &[dialect, program] = GetParam();
  Debugged run(program, {{"dialect", dialect}});
  const ProcessResult traced = run.shop.run({"trace", "--dialect", dialect, "a.nc"});
  EXPECT_EQ(traced.exitCode, 0) << traced.out << traced.err;
  std::deque<Json> motions;
  std::istringstream in(traced.out);
  for (std::string line; std::getline(in, line);)
    motions.push_back(Json::parse(line));
  run.filters(Json::array());
  run.begin();
  std::vector<std::string> lines;
  std::istringstream text(program);
  for (std::string line; std::getline(text, line);)
    lines.push_back(line);
  std::set<std::string> named;
  Json last, cut;
  constexpr int stops = 200;
  for (int stop = 0; stop < stops; ++stop) {
    const int line = run.line();
    ASSERT_EQ(run.go("stepIn")["reason"], "step") << "stop " << stop << ", line " << line;
    std::vector<std::set<std::string>> moved;
    for (; !motions.empty() && motions[0]["line"] == line; motions.pop_front()) {
      moved.push_back(codesOf(motions[0]));
      if (motions[0].contains("to"))
        last = motions[0]["to"];
      if (motions[0]["kind"] == "linear" || motions[0]["kind"] == "arc")
        cut = motions[0]["feed"];
    }
    auto position = run.scope("Position");
    for (const auto &[axis, value] : last.items()) {
      if (value.is_null()) {
        EXPECT_FALSE(position.count(axis) && std::isdigit(position[axis][0])) << line << axis;
        continue;
      }
      EXPECT_NEAR(std::atof(position[axis].c_str()), value.get<double>(), 1e-5)
          << "after line " << line << ", axis " << axis << ": " << position[axis];
    }
    const std::set<std::string> codes = codesInForce(run);
    takeCodes(lines.at(size_t(line - 1)), named);
    std::set<std::string> due = named;
    if (moved.size() == 1) // a cycle makes several motions, and its code is another
      due.insert(moved[0].begin(), moved[0].end());
    for (const std::string &code : due)
      EXPECT_TRUE(codes.count(code)) << "after line " << line << ", " << code;
    if (cut.is_number()) {
      EXPECT_NEAR(std::stod(run.scope("Spindle and feed")["F"]), cut.get<double>(), 1e-5)
          << "after line " << line;
    }
  }
  EXPECT_EQ(run.disconnect(), 0);
}

} // namespace
