// The language server as a client sees it: life cycle, broken messages, diagnostics, actions,
// hover.
#include "tests/support/language_client.h"
#include "tests/support/process.h"

#include "gtest/gtest.h"

namespace {

using namespace ncvet;
using test::at;
using test::codes;
using test::documentOf;
using test::Json;
using test::LanguageClient;
using test::Shop;

/// X30. drills again: nobody has cancelled the cycle.
const char *const boring = "%\nO1 (BORE)\nT1 M06\nG90 G54 G00 X0. Y0. S1000 M03\n"
                           "G43 Z50. H01\nG83 X10. Y10. Z-10. R2. Q2. F100.\nG00 X30. Y0.\n"
                           "G80\nG49\nG91 G28 Z0.\nM30\n%\n";

TEST(LanguageServer, EndsAsTheProtocolSays) {
  LanguageClient client;
  const Json result = client.initialize();
  EXPECT_EQ(result["serverInfo"]["name"], "ncvet");
  EXPECT_EQ(result["capabilities"]["positionEncoding"], "utf-16");
  EXPECT_EQ(client.shutDown(), 0);

  LanguageClient rude;
  rude.initialize();
  rude.notify("exit", nullptr);
  EXPECT_EQ(rude.exitCode(), 1);

  LanguageClient gone;
  gone.initialize();
  gone.hangUp();
  EXPECT_EQ(gone.exitCode(), 1);
}

TEST(LanguageServer, NothingIsAnsweredBeforeTheStartOrAfterTheEnd) {
  LanguageClient client;
  const Json early = client.answer(client.ask("textDocument/hover", Json::object()));
  EXPECT_EQ(early["error"]["code"], -32002);
  client.initialize();
  client.request("shutdown", nullptr);
  const Json late = client.answer(client.ask("textDocument/hover", Json::object()));
  EXPECT_EQ(late["error"]["code"], -32600);
}

TEST(LanguageServer, ABrokenMessageGetsAnErrorAndNoEnd) {
  LanguageClient client;
  client.initialize();
  client.sendBody("{ this is no JSON");
  EXPECT_EQ(client.complaint()["error"]["code"], -32700);
  client.sendBody("[1, 2]");
  EXPECT_EQ(client.complaint()["error"]["code"], -32600);
  client.sendBody(std::string(100000, '['));
  EXPECT_EQ(client.complaint()["error"]["code"], -32700);
  client.sendBytes("Content-Length: many\r\n\r\n");
  EXPECT_EQ(client.complaint()["error"]["code"], -32700);
  client.sendBytes("what is this\r\n");
  EXPECT_EQ(client.complaint()["error"]["code"], -32700);
  client.sendBody("{\"jsonrpc\":\"2.0\",\"method\":3}");
  EXPECT_EQ(client.complaint()["error"]["code"], -32600);
  const Json unknown = client.answer(client.ask("textDocument/nothing", Json::object()));
  EXPECT_EQ(unknown["error"]["code"], -32601);
  const Json wrong = client.answer(client.ask("textDocument/hover", {{"textDocument", 5}}));
  EXPECT_EQ(wrong["error"]["code"], -32602);
  EXPECT_EQ(client.shutDown(), 0);
}

TEST(LanguageServer, TakesFurtherHeaderFieldsAndVersionsThatAreNull) {
  LanguageClient client;
  client.initialize(Json::object(), {{"dialect", "haas-mill"}});
  client.open("/nowhere/O1.nc", "O1\nM30\n");
  EXPECT_TRUE(client.diagnostics("/nowhere/O1.nc").empty());
  const std::string body =
      Json{{"jsonrpc", "2.0"},
           {"method", "textDocument/didChange"},
           {"params",
            {{"textDocument", {{"uri", "file:///nowhere/O1.nc"}, {"version", nullptr}}},
             {"contentChanges", {{{"text", "O1\nG99999\nM30\n"}}}}}}}
          .dump();
  client.sendBytes("X-Sent-By: nobody\r\nCONTENT-LENGTH:  " + std::to_string(body.size()) +
                   " \r\nContent-Type: application/json\r\n\r\n" + body);
  EXPECT_EQ(codes(client.diagnostics("/nowhere/O1.nc")),
            std::vector<std::string>{"2 block-unknown-g-code"});
  EXPECT_EQ(client.shutDown(), 0);
}

/// Code that nothing reaches is tagged as unnecessary (1), and nothing else is.
TEST(LanguageServer, BlocksThatAreNotExecutedAreShownFaded) {
  LanguageClient client;
  client.initialize(
      Json::parse(R"({"textDocument":{"publishDiagnostics":{"tagSupport":{"valueSet":[1,2]}}}})"),
      {{"dialect", "fanuc-0m"}});
  client.open("/nowhere/O1.nc", "O1\nG21 G90 G54 T1 M6\nG0 X0 Y0 X5\nM30\nG0 X1\n");
  std::map<std::string, Json> tags;
  for (const Json &diagnostic : client.diagnostics("/nowhere/O1.nc"))
    tags[diagnostic["code"].get<std::string>()] =
        diagnostic.contains("tags") ? diagnostic["tags"] : Json();
  ASSERT_TRUE(tags.count("program-code-after-end") && tags.count("block-duplicate-address"));
  for (const auto &[rule, tag] : tags)
    EXPECT_EQ(tag, rule == "program-code-after-end" ? Json::parse("[1]") : Json()) << rule;
  EXPECT_EQ(client.shutDown(), 0);
}

TEST(LanguageServer, AFindingIsShownWithItsFurtherPlaceAndGoesWhenItsCauseGoes) {
  LanguageClient client;
  client.initialize(
      Json::parse(R"({"textDocument":{"publishDiagnostics":{"relatedInformation":true}}})"),
      {{"dialect", "haas-mill"}});
  client.open("/nowhere/bore.nc", "O1 (BORE)\nT1 M06\nG90 G54 G00 X0. Y0. S1000 M03\nG43 Z50. H01\n"
                                  "G83 X10. Y10. Z-10. R2. Q2. F100.\nG80\nX30. Y0.\nG49\nM30\n");
  const Json before = client.diagnostics("/nowhere/bore.nc");
  // Without the G80 of line 6 the cycle drills at the clamp.
  client.notify(
      "textDocument/didChange",
      {{"textDocument", {{"uri", "file:///nowhere/bore.nc"}, {"version", 2}}},
       {"contentChanges", {{{"range", {{"start", at(5, 0)}, {"end", at(6, 0)}}}, {"text", ""}}}}});
  const Json after = client.diagnostics("/nowhere/bore.nc", 2);
  const std::vector<std::string> was = codes(before), is = codes(after);
  EXPECT_NE(was, is);
  client.notify("textDocument/didChange",
                {{"textDocument", {{"uri", "file:///nowhere/bore.nc"}, {"version", 3}}},
                 {"contentChanges",
                  {{{"range", {{"start", at(5, 0)}, {"end", at(5, 0)}}}, {"text", "G80\n"}}}}});
  EXPECT_EQ(codes(client.diagnostics("/nowhere/bore.nc", 3)), was);
  client.notify("textDocument/didClose", {{"textDocument", documentOf("/nowhere/bore.nc")}});
  EXPECT_EQ(client.notification("textDocument/publishDiagnostics")["diagnostics"], Json::array());
}

TEST(LanguageServer, PositionsCountWhatTheClientCounts) {
  // `ü` is two bytes, the clef four; both are one character in UTF-32, and one and two in UTF-16.
  const std::string text = "O1\n(Gehäuse 𝄞) G00 G99999 X1.\nM30\n";
  const std::pair<const char *, int> encodings[] = {{"utf-8", 20}, {"utf-16", 17}, {"utf-32", 16}};
  for (const auto &[encoding, character] : encodings) {
    LanguageClient client;
    const Json result = client.initialize({{"general", {{"positionEncodings", {encoding}}}}},
                                          {{"dialect", "haas-mill"}});
    EXPECT_EQ(result["capabilities"]["positionEncoding"], encoding);
    client.open("/nowhere/a.nc", text);
    bool found = false;
    for (const Json &diagnostic : client.diagnostics("/nowhere/a.nc"))
      if (diagnostic["code"] == "block-unknown-g-code") {
        found = true;
        EXPECT_EQ(diagnostic["range"]["start"], at(1, unsigned(character))) << encoding;
      }
    EXPECT_TRUE(found) << encoding;
  }
}

TEST(LanguageServer, AQuickFixMendsItsFinding) {
  LanguageClient client;
  client.initialize(Json::object(), {{"dialect", "fanuc-0m"}});
  const std::string path = "/nowhere/bore.nc";
  client.open(path, "%\nO1\nT1 M06\nG90 G54 G00 X0. Y0. S1000 M03\nG43 Z50. H01\n"
                    "G01 Z-1. F100.\nG00 Z50.\nM30\n%\n");
  const Json diagnostics = client.diagnostics(path);
  ASSERT_FALSE(diagnostics.empty());
  const Json &left = diagnostics[0];
  ASSERT_EQ(left["code"], "tool-length-offset-left-on");
  const Json actions = client.request(
      "textDocument/codeAction", {{"textDocument", documentOf(path)},
                                  {"range", left["range"]},
                                  {"context", {{"diagnostics", {left}}, {"only", {"quickfix"}}}}});
  ASSERT_GE(actions.size(), 3u); // the fix, here, in this file
  const Json edits = actions[0]["edit"]["changes"]["file://" + path];
  ASSERT_EQ(edits.size(), 1u);
  EXPECT_EQ(edits[0]["newText"], "G49\n");
  client.notify(
      "textDocument/didChange",
      {{"textDocument", {{"uri", "file://" + path}, {"version", 2}}},
       {"contentChanges", {{{"range", edits[0]["range"]}, {"text", edits[0]["newText"]}}}}});
  EXPECT_EQ(codes(client.diagnostics(path, 2)), std::vector<std::string>());
}

TEST(LanguageServer, AQuickFixAtTheTargetOfAJumpMendsItsFinding) {
  LanguageClient client;
  client.initialize(Json::object(), {{"dialect", "fanuc-mill"}});
  const std::string path = "/nowhere/jump.nc";
  client.open(path, "%\nO1\nG17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S900 M3\n"
                    "G43 H1 Z5.\nG81 X10. Y10. Z-5. R2. F100.\nIF [#500 EQ 1] GOTO 100\nX20.\n"
                    "G0 G80 Z50.\nN100 T2 M6\nG54 G0 X0. Y0. S900 M3\nG43 H2 Z5.\nG0 Z50.\n"
                    "M30\n%\n");
  const Json diagnostics = client.diagnostics(path);
  ASSERT_EQ(codes(diagnostics), std::vector<std::string>{"11 cycle-left-active"});
  const Json actions =
      client.request("textDocument/codeAction", {{"textDocument", documentOf(path)},
                                                 {"range", diagnostics[0]["range"]},
                                                 {"context", {{"diagnostics", {diagnostics[0]}}}}});
  const Json edit = actions[0]["edit"]["changes"]["file://" + path][0];
  EXPECT_EQ(edit["range"]["start"]["character"], 5); // after the number
  client.notify("textDocument/didChange",
                {{"textDocument", {{"uri", "file://" + path}, {"version", 2}}},
                 {"contentChanges", {{{"range", edit["range"]}, {"text", edit["newText"]}}}}});
  EXPECT_EQ(codes(client.diagnostics(path, 2)), std::vector<std::string>());
}

/// A program that leaves a cycle on where a jump leads, after so many blocks: a fix would not help.
std::string unmended(int blocks) {
  std::string text = "%\nO1\nG17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S900 M3\n"
                     "G43 H1 Z5.\nG1 Z-1. F200.\n";
  for (int i = 0; i < blocks; ++i)
    text += "X" + std::to_string(i % 700) + ".125 Y" + std::to_string(i % 90) + ".25\n";
  return text + "G0 Z5.\nG81 X10. Y10. Z-5. R2. F100.\nIF [#500 EQ 1] GOTO 100\nX20.\n"
                "G0 G80 Z50.\n/N100 T2 M6\nG54 G0 X0. Y0. S900 M3\nG43 H2 Z5.\n"
                "G0 Z50.\nM30\n%\n";
}

/// A text of so many blocks is longer than a megabyte.
constexpr int manyBlocks = 80'000;

Json quickFixes(LanguageClient &client, const std::string &path, const Json &diagnostic) {
  return client.request("textDocument/codeAction",
                        {{"textDocument", documentOf(path)},
                         {"range", diagnostic["range"]},
                         {"context", {{"diagnostics", {diagnostic}}, {"only", {"quickfix"}}}}});
}

class UnmendedAfter : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Blocks, UnmendedAfter, testing::Values(0, manyBlocks));

TEST_P(UnmendedAfter, AFixThatTheCommandLineWouldNotMakeIsNotOffered) {
  LanguageClient client;
  client.initialize(Json::object(), {{"dialect", "fanuc-mill"}});
  const std::string path = "/nowhere/jump.nc";
  client.open(path, unmended(GetParam()));
  const Json diagnostics = client.diagnostics(path);
  EXPECT_FALSE(diagnostics.empty());
  for (const Json &diagnostic : diagnostics)
    for (const Json &action : quickFixes(client, path, diagnostic))
      EXPECT_EQ(action["title"].get<std::string>().substr(0, 6), "Allow ") << action.dump();
}

TEST(LanguageServer, AFixInALongTextIsTriedWhenItIsChosen) {
  LanguageClient client;
  client.initialize(
      {{"textDocument", {{"codeAction", {{"resolveSupport", {{"properties", {"edit"}}}}}}}}},
      {{"dialect", "fanuc-mill"}});
  const std::string path = "/nowhere/jump.nc";
  std::string text = unmended(manyBlocks);
  text.insert(text.find("G1 Z-1."), "X1. X1.\n");
  text.insert(text.find("G1 Z-1."), "X2. X2.\n");
  client.open(path, text);
  std::vector<std::string> made, refused;
  for (const Json &diagnostic : client.diagnostics(path))
    for (const Json &action : quickFixes(client, path, diagnostic)) {
      if (action.contains("edit"))
        continue; // what silences the finding
      const Json whole = client.answer(client.ask("codeAction/resolve", action));
      (whole.contains("result") ? made : refused).push_back(action["title"]);
      if (whole.contains("result")) {
        EXPECT_FALSE(whole["result"]["edit"]["changes"]["file://" + path].empty());
      }
    }
  EXPECT_EQ(made.size(), 2u) << "the first block, and both: then the second is known";
  EXPECT_EQ(refused.size(), 1u);
}

TEST(LanguageServer, AnswersWithTheUriThatTheClientWrites) {
  LanguageClient client;
  client.initialize(Json::object(), {{"dialect", "haas-mill"}});
  const std::string uri = "file:///nowhere/bore(1),%61.nc"; // few escape all that may be escaped
  client.notify("textDocument/didOpen",
                {{"textDocument",
                  {{"uri", uri},
                   {"languageId", "gcode"},
                   {"version", 1},
                   {"text", "%\nO1\nT1 M06\nG90 G54 G00 X0. Y0. S1000 M03\nG43 Z50. H01\n"
                            "M97 P10\nG01 Z-1. F0\nG00 Z50.\nM30\nN10 M99\n%\n"}}}});
  const Json told = client.notification("textDocument/publishDiagnostics");
  EXPECT_EQ(told["uri"], uri);
  ASSERT_FALSE(told["diagnostics"].empty());
  const Json at = {{"textDocument", {{"uri", uri}}}, {"position", {{"line", 5}, {"character", 5}}}};
  EXPECT_EQ(client.request("textDocument/definition", at)["uri"], uri);
  client.notify("textDocument/didClose", {{"textDocument", {{"uri", uri}}}});
  EXPECT_EQ(client.notification("textDocument/publishDiagnostics")["uri"], uri);
}

TEST(LanguageServer, WhatMendsAFindingComesBeforeWhatSilencesAnother) {
  LanguageClient client;
  client.initialize(Json::object(), {{"dialect", "sinumerik"}});
  const std::string path = "/nowhere/jump.mpf";
  client.open(path, "N10 GOTOF NEXT\nNEXT: Y=1\nN20 M30\n");
  const Json diagnostics = client.diagnostics(path);
  EXPECT_THAT(codes(diagnostics), testing::ElementsAre("2 feed-missing", "2 motion-mode-not-set"));
  const Json actions =
      client.request("textDocument/codeAction", {{"textDocument", documentOf(path)},
                                                 {"range", diagnostics[0]["range"]},
                                                 {"context", {{"diagnostics", Json::array()}}}});
  ASSERT_GE(actions.size(), 5u);
  EXPECT_EQ(actions[0]["title"], "write G01 before it");
  EXPECT_EQ(actions[1]["title"], "Allow feed-missing here");
}

TEST(LanguageServer, ACommentSilencesAFindingHereAndInTheFile) {
  const std::string path = "/nowhere/bore.nc";
  const std::string text = "%\nO1\nT1 M06\nG90 G54 G00 X0. Y0. S1000 M03\nG43 Z50. H01\n"
                           "G01 Z-1. F100.\nG00 Z50.\nM30\n%\n";
  for (const size_t which : {1, 2}) {
    LanguageClient client;
    client.initialize(Json::object(), {{"dialect", "fanuc-0m"}});
    client.open(path, text);
    const Json diagnostics = client.diagnostics(path);
    ASSERT_EQ(diagnostics.size(), 1u);
    const Json actions =
        client.request("textDocument/codeAction", {{"textDocument", documentOf(path)},
                                                   {"range", diagnostics[0]["range"]},
                                                   {"context", {{"diagnostics", Json::array()}}}});
    const Json edit = actions[which]["edit"]["changes"]["file://" + path][0];
    client.notify("textDocument/didChange",
                  {{"textDocument", {{"uri", "file://" + path}, {"version", 2}}},
                   {"contentChanges", {{{"range", edit["range"]}, {"text", edit["newText"]}}}}});
    EXPECT_EQ(codes(client.diagnostics(path, 2)), std::vector<std::string>()) << edit.dump();
  }
}

TEST(LanguageServer, ARequestThatIsCancelledWhileItWaitsIsNotAnswered) {
  LanguageClient client;
  client.initialize(Json::object(), {{"dialect", "haas-mill"}});
  std::string text = "O1\n";
  for (int i = 0; i < 20000; ++i)
    text += "G01 X" + std::to_string(i) + ". F100.\n";
  client.open("/nowhere/long.nc", text + "M30\n");
  const Json whole = {{"textDocument", documentOf("/nowhere/long.nc")}};
  std::vector<int64_t> ids;
  for (int i = 0; i < 30; ++i) // they are answered one after the other
    ids.push_back(client.ask("textDocument/semanticTokens/full", whole));
  client.notify("$/cancelRequest", {{"id", ids.back()}});
  EXPECT_TRUE(client.answer(ids.front()).contains("result"));
  EXPECT_EQ(client.answer(ids.back())["error"]["code"], -32800);
}

TEST(LanguageServer, HoverTellsTheMachinesState) {
  LanguageClient client;
  client.initialize(Json::object(), {{"dialect", "haas-mill"}});
  client.open("/nowhere/bore.nc", boring);
  const Json hover =
      client.request("textDocument/hover",
                     {{"textDocument", documentOf("/nowhere/bore.nc")}, {"position", at(6, 5)}});
  const std::string text = hover["contents"]["value"];
  EXPECT_NE(text.find("G83"), std::string::npos) << text;
  EXPECT_NE(text.find("X 10, Y 10"), std::string::npos) << text;
  EXPECT_NE(text.find("T1"), std::string::npos) << text;
}

TEST(LanguageServer, AProgramIsCheckedAgainWhenTheTextOfItsSubprogramChanges) {
  Shop shop;
  const std::string sub = "O2\nG91 X1.\nM99\n";
  shop.file("O0001.nc", "").file("O0002.nc", sub);
  const std::string main = (shop.path() / "O0001.nc").string(),
                    called = (shop.path() / "O0002.nc").string();
  LanguageClient client;
  client.initialize(Json::object(), {{"dialect", "haas-mill"}});
  client.open(main, "O1\nT1 M06\nG90 G54 G00 X0. Y0. S1000 M03\nM98 P2\nM98 P3\nM30\n");
  const std::vector<std::string> alone = codes(client.diagnostics(main));
  EXPECT_NE(std::find(alone.begin(), alone.end(), "5 flow-undefined-subprogram"), alone.end())
      << Json(alone).dump();
  // The subprogram is opened, and no longer returns.
  client.open(called, "O2\nG91 X1.\nG90\n");
  bool told = false;
  for (int i = 0; i < 3 && !told; ++i)
    for (const std::string &code : codes(client.diagnostics(called)))
      told |= code.find("flow") != std::string::npos || code.find("program-") != std::string::npos;
  EXPECT_TRUE(told);
}

TEST(LanguageServer, AClientThatPullsGetsDiagnosticsByRequestOnly) {
  LanguageClient client;
  const Json can = client.initialize({{"textDocument", {{"diagnostic", Json::object()}}}},
                                     {{"dialect", "haas-mill"}});
  EXPECT_TRUE(can["capabilities"].contains("diagnosticProvider"));
  const std::string path = "/nowhere/a.nc";
  client.open(path, "O1\nG00 G99999 X1.\nM30\n");
  const Json report =
      client.request("textDocument/diagnostic", {{"textDocument", documentOf(path)}});
  ASSERT_EQ(report["kind"], "full");
  EXPECT_EQ(codes(report["items"])[0], "2 block-unknown-g-code");
  const Json again =
      client.request("textDocument/diagnostic", {{"textDocument", documentOf(path)},
                                                 {"previousResultId", report["resultId"]}});
  EXPECT_EQ(again["kind"], "unchanged");
}

TEST(LanguageServer, TheWorkspaceIsCheckedWhenItIsWanted) {
  Shop shop;
  shop.file("good.nc", "O1\nM30\n").file("inner/bad.nc", "O2\nG99999\nM30\n");
  LanguageClient client;
  client.initialize({{"textDocument", {{"diagnostic", Json::object()}}}},
                    {{"dialect", "haas-mill"}, {"workspaceDiagnostics", true}},
                    workspaceOf(shop.path()));
  const Json report =
      client.request("workspace/diagnostic", {{"previousResultIds", Json::array()}});
  ASSERT_EQ(report["items"].size(), 2u);
  EXPECT_EQ(report["items"][0]["items"].size(), 0u);
  EXPECT_EQ(codes(report["items"][1]["items"])[0], "2 block-unknown-g-code");
}

TEST(LanguageServer, AClosedFileOfTheWorkspaceIsCheckedAgainWhenItIsWritten) {
  Shop shop;
  shop.file("a.nc", "O2\nG99999\nM30\n");
  LanguageClient client;
  client.initialize({{"textDocument", {{"diagnostic", Json::object()}}}},
                    {{"dialect", "haas-mill"}, {"workspaceDiagnostics", true}},
                    workspaceOf(shop.path()));
  const auto items = [&] {
    return client.request("workspace/diagnostic",
                          {{"previousResultIds", Json::array()}})["items"][0]["items"];
  };
  EXPECT_EQ(codes(items()), std::vector<std::string>{"2 block-unknown-g-code"});
  const auto written = std::filesystem::last_write_time(shop.path() / "a.nc");
  shop.file("a.nc", "O2\nM30\n");
  std::filesystem::last_write_time(shop.path() / "a.nc", written + std::chrono::seconds(2));
  EXPECT_EQ(items(), Json::array());
}

TEST(LanguageServer, SettingsOfTheStartHoldWhereLaterOnesSayNothing) {
  LanguageClient client;
  client.initialize({{"workspace", {{"configuration", true}}}},
                    {{"dialect", "haas-mill"}, {"ignore", {"block-unknown-g-code"}}});
  const auto answer = [&](Json section) {
    client.notify("workspace/didChangeConfiguration", {{"settings", nullptr}});
    client.reply(client.serverRequest("workspace/configuration"),
                 Json::array({std::move(section)}));
  };
  answer(Json::object());
  client.open("/nowhere/a.nc", "O1\nG99999\nM30\n");
  EXPECT_EQ(codes(client.diagnostics("/nowhere/a.nc")), std::vector<std::string>());
  answer({{"ignore", Json::array()}});
  EXPECT_EQ(codes(client.diagnostics("/nowhere/a.nc")),
            std::vector<std::string>{"2 block-unknown-g-code"});
}

TEST(LanguageServer, AChangedConfigurationCountsAtOnce) {
  Shop shop;
  shop.file(".ncvet.json", R"({"dialect": "haas-mill", "ignore": ["block-unknown-g-code"]})");
  const std::string path = (shop.path() / "a.nc").string();
  LanguageClient client;
  client.initialize();
  client.open(path, "O1\nG99999\nM30\n");
  EXPECT_EQ(codes(client.diagnostics(path)), std::vector<std::string>());
  shop.file(".ncvet.json", R"({"dialect": "haas-mill"})");
  client.notify(
      "workspace/didChangeWatchedFiles",
      {{"changes", {{{"uri", "file://" + (shop.path() / ".ncvet.json").string()}, {"type", 2}}}}});
  EXPECT_EQ(codes(client.diagnostics(path)), std::vector<std::string>{"2 block-unknown-g-code"});
}

TEST(LanguageServer, WrongSettingsAreSaidAndTheRestCounts) {
  LanguageClient client;
  client.initialize(Json::object(),
                    {{"dialect", "haas-mill"}, {"ignore", {"no-such-rule"}}, {"profile", 5}});
  const Json first = client.notification("window/showMessage");
  EXPECT_NE(first["message"].get<std::string>().find("ncvet.profile"), std::string::npos) << first;
  const Json second = client.notification("window/showMessage");
  EXPECT_NE(second["message"].get<std::string>().find("no-such-rule"), std::string::npos) << second;
  client.open("/nowhere/a.nc", "O1\nG99999\nM30\n");
  EXPECT_EQ(codes(client.diagnostics("/nowhere/a.nc"))[0], "2 block-unknown-g-code");
}

/// Long documents are looked at before anybody asks, with every change: the answers stay those of a
/// server that sees the text for the first time.
TEST(LanguageServer, ALongDocumentIsAnsweredAlikeAfterManyChanges) {
  std::string text = "%\nO1 (LONG)\nT1 M06\nG90 G54 G00 X0. Y0. S1000 M03\nG43 Z50. H01\n"
                     "G01 Z-1. F200.\n";
  for (int i = 0; text.size() < 600000; ++i)
    text += "X" + std::to_string(i % 90) + "." + std::to_string(i % 7) + " Y" +
            std::to_string(i % 60) + ".\n";
  text += "G00 Z50.\nG49\nG91 G28 Z0.\nM30\n%\n";
  const std::string path = "/nowhere/long.nc";
  const Json options = {{"dialect", "haas-mill"}};
  LanguageClient client;
  client.initialize(Json::object(), options);
  client.open(path, text);
  Json last = client.diagnostics(path);
  // On a busy machine a program may still be followed; a later answer is of all of it.
  const auto ask = [&](LanguageClient &server, unsigned line) {
    Json hover;
    for (int again = 0; again < 100; ++again) {
      hover = server.request("textDocument/hover",
                             {{"textDocument", documentOf(path)}, {"position", at(line, 0)}});
      if (hover.dump().find("still being followed") == std::string::npos)
        break;
    }
    return hover;
  };
  const char *const lines[] = {"F77.\n", "T2 M06\n", "(X)\n", "G91\n", "X1.\n"};
  int version = 1;
  for (const unsigned line : {1000u, 20000u, 6u, 30000u, 12u}) {
    const std::string added = lines[version % 5];
    size_t offset = 0;
    for (unsigned i = 0; i < line; ++i)
      offset = text.find('\n', offset) + 1;
    text.insert(offset, added);
    const Json place = at(line, 0);
    client.notify(
        "textDocument/didChange",
        {{"textDocument", {{"uri", "file://" + path}, {"version", ++version}}},
         {"contentChanges", {{{"range", {{"start", place}, {"end", place}}}, {"text", added}}}}});
    if (line % 20 == 0) // nobody asks about the others
      last = client.diagnostics(path, version);
    LanguageClient fresh;
    fresh.initialize(Json::object(), options);
    fresh.open(path, text);
    for (const unsigned asked : {3u, 900u, 25000u})
      EXPECT_EQ(ask(client, asked), ask(fresh, asked)) << "line " << asked << " after " << added;
    if (line % 20 != 0)
      last = client.diagnostics(path, version);
    EXPECT_EQ(last, fresh.diagnostics(path)) << added;
    EXPECT_EQ(fresh.shutDown(), 0);
  }
  client.notify("textDocument/didClose", {{"textDocument", documentOf(path)}});
  EXPECT_EQ(client.shutDown(), 0);
}

} // namespace
