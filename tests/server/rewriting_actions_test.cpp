// Rewritings of selected blocks, as a client of the language server gets them.
#include "tests/support/language_client.h"
#include "tests/support/process.h"

using namespace ncvet::test;

namespace {

const std::string path = "/nowhere/contour.nc";
/// The contour is in lines 3 and 4, counted from 0.
constexpr const char *contour = "O1\nG21 G17 G90 G40 G80\nG54 G00 X10. Y20.\nG01 X12. Y20. F100.\n"
                                "X15.\nG00 X0. Y0.\nM30\n";

void openContour(LanguageClient &client) {
  client.initialize(Json::object(), {{"dialect", "fanuc-mill"}});
  client.open(path, contour);
  client.diagnostics(path);
}

TEST(RewritingActions, AreOfferedForASelection) {
  LanguageClient client;
  openContour(client);
  const auto offered = [&](const Json &end) {
    std::map<std::string, Json> byTitle;
    const Json actions =
        client.request("textDocument/codeAction",
                       {{"textDocument", documentOf(path)},
                        {"range", {{"start", at(3, 0)}, {"end", end}}},
                        {"context", {{"diagnostics", Json::array()}, {"only", {"refactor"}}}}});
    for (const Json &one : actions)
      byTitle[one["title"]] = one["edit"]["changes"]["file://" + path];
    return byTitle;
  };
  EXPECT_TRUE(offered(at(3, 0)).empty()) << "nothing is selected";
  const auto actions = offered(at(5, 0));
  ASSERT_TRUE(actions.count("Mirror the selection in X"));
  EXPECT_EQ(actions.at("Mirror the selection in X")[0]["newText"], "-12.");
  ASSERT_TRUE(actions.count("Give the coordinates of the selection as distances"));
  EXPECT_FALSE(actions.count("Renumber the selection")) << "no block has a number";
}

TEST(RewritingActions, ACommandShiftsASelection) {
  LanguageClient client;
  openContour(client);
  const auto command = [&](Json axes) {
    return client.ask("workspace/executeCommand",
                      {{"command", "ncvet.transform"},
                       {"arguments",
                        {{{"uri", "file://" + path},
                          {"range", {{"start", at(3, 0)}, {"end", at(5, 0)}}},
                          {"axes", std::move(axes)}}}}});
  };
  const int64_t shift = command({{"X", {{"shift", 5}}}});
  const Json asked = client.serverRequest("workspace/applyEdit");
  EXPECT_EQ(asked["params"]["edit"]["changes"]["file://" + path][0]["newText"], "17.");
  client.reply(asked, {{"applied", true}});
  EXPECT_TRUE(client.answer(shift).contains("result"));
  EXPECT_TRUE(client.answer(command({{"Z", {{"shift", 5}}}})).contains("error"))
      << "the selection has no Z";
  EXPECT_TRUE(client.answer(command({{"Q", {{"shift", 5}}}})).contains("error"));
}

TEST(RewritingActions, AFileIsMadeWhereTheEditorMakesFiles) {
  const std::string main = "/nowhere/SHAFT.MPF";
  const auto extracted = [&](const Json &operations) {
    LanguageClient client;
    client.initialize(
        {{"workspace",
          {{"workspaceEdit", {{"documentChanges", true}, {"resourceOperations", operations}}}}}},
        {{"dialect", "sinumerik"}});
    client.open(main, "G17 G90 G54 G40 G94\nT1 D1\nM6\nS800 M3\nG0 X10 Y20\nG0 Z2\nG1 X5 F100\n"
                      "Y5\nG0 Z50\nM30\n");
    client.diagnostics(main);
    return client.request(
        "textDocument/codeAction",
        {{"textDocument", documentOf(main)},
         {"range", {{"start", at(6, 0)}, {"end", at(8, 0)}}},
         {"context", {{"diagnostics", Json::array()}, {"only", {"refactor.extract"}}}}});
  };
  EXPECT_TRUE(extracted(Json::array()).empty());
  const Json actions = extracted({"create"});
  ASSERT_EQ(actions.size(), 1u) << actions.dump();
  const Json &steps = actions[0]["edit"]["documentChanges"];
  ASSERT_EQ(steps.size(), 3u) << actions.dump();
  const std::string made = "file:///nowhere/PART1.SPF";
  EXPECT_EQ(steps[0]["textDocument"]["uri"], "file://" + main);
  EXPECT_EQ(steps[0]["edits"][0]["newText"], "PART1");
  EXPECT_EQ(steps[1], (Json{{"kind", "create"}, {"uri", made}}));
  EXPECT_EQ(steps[2]["textDocument"]["uri"], made);
  EXPECT_EQ(steps[2]["edits"][0]["newText"], "G1 X5 F100\nY5\nM17\n");
}

/// Two programs on disk; the one that calls is open.
class Renamed : public testing::Test {
protected:
  void start(Json capabilities) {
    shop.file("O0001.nc", "%\nO0001\nM98 P20\nM30\n%\n")
        .file("O0020.nc", "%\nO0020\nG00 X1.\nM99\n%\n");
    client.initialize(std::move(capabilities), {{"dialect", "fanuc-mill"}},
                      Json::array({{{"uri", uri("")}, {"name", "shop"}}}));
    client.open(path("O0001.nc"), "%\nO0001\nM98 P20\nM30\n%\n");
  }
  std::string path(const std::string &name) const { return (shop.path() / name).string(); }
  std::string uri(const std::string &name) const { return "file://" + path(name); }

  Shop shop;
  LanguageClient client;
};

TEST_F(Renamed, AProgramWithItsFile) {
  start({{"workspace",
          {{"workspaceEdit", {{"documentChanges", true}, {"resourceOperations", {"rename"}}}}}}});
  const Json edit = client.request(
      "textDocument/rename",
      {{"textDocument", documentOf(path("O0001.nc"))}, {"position", at(2, 5)}, {"newName", "25"}});
  const Json steps = edit["documentChanges"];
  ASSERT_EQ(steps.size(), 3u) << edit.dump();
  EXPECT_EQ(steps[0]["textDocument"]["uri"], uri("O0001.nc"));
  EXPECT_EQ(steps[0]["edits"][0]["newText"], "25");
  EXPECT_EQ(steps[1]["textDocument"]["uri"], uri("O0020.nc"));
  EXPECT_TRUE(steps[1]["textDocument"]["version"].is_null()) << "it is not open";
  EXPECT_EQ(steps[1]["edits"][0]["newText"], "0025");
  EXPECT_EQ(steps[2],
            (Json{{"kind", "rename"}, {"oldUri", uri("O0020.nc")}, {"newUri", uri("O0025.nc")}}));
  const Json move = {{"files", {{{"oldUri", uri("O0020.nc")}, {"newUri", uri("O0025.nc")}}}}};
  EXPECT_TRUE(client.request("workspace/willRenameFiles", move).is_null())
      << "its changes are those of the rename";
}

TEST_F(Renamed, NotWhereTheEditorRenamesNoFiles) {
  start(Json::object());
  const Json answer = client.answer(client.ask(
      "textDocument/rename",
      {{"textDocument", documentOf(path("O0001.nc"))}, {"position", at(2, 5)}, {"newName", "25"}}));
  EXPECT_NE(answer["error"]["message"].get<std::string>().find("file"), std::string::npos);
}

TEST_F(Renamed, AFileTakesItsProgramAlong) {
  start(Json::object());
  const Json edit =
      client.request("workspace/willRenameFiles",
                     {{"files", {{{"oldUri", uri("O0020.nc")}, {"newUri", uri("O0025.nc")}}}}});
  EXPECT_EQ(edit["changes"][uri("O0001.nc")][0]["newText"], "25") << edit.dump();
  EXPECT_EQ(edit["changes"][uri("O0020.nc")][0]["newText"], "0025");
  EXPECT_TRUE(client
                  .request("workspace/willRenameFiles",
                           {{"files", {{{"oldUri", uri("x.py")}, {"newUri", uri("y.py")}}}}})
                  .is_null());
}

} // namespace
