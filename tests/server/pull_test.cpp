// A client that asks for diagnostics (pull): what it is told beside its questions, and what the
// workspace's questions give.
#include "tests/support/language_client.h"
#include "tests/support/process.h"

#include "gtest/gtest.h"

#include <set>

namespace {

using namespace ncvet;
using test::at;
using test::codes;
using test::documentOf;
using test::Json;
using test::LanguageClient;
using test::Shop;

const Json pulling = Json::parse(R"({"textDocument":{"diagnostic":{}},
    "workspace":{"diagnostics":{"refreshSupport":true}}})");
const Json registering = Json::parse(R"({"textDocument":{"diagnostic":{"dynamicRegistration":true}},
    "workspace":{"diagnostics":{"refreshSupport":true}}})");

/// `main` calls a program in another file, in which a code is unknown.
class CallingPrograms : public testing::Test {
protected:
  void SetUp() override {
    shop.file("O0001.nc", mainText).file("O0002.nc", subText);
    main = (shop.path() / "O0001.nc").string();
    called = (shop.path() / "O0002.nc").string();
  }
  static Json pull(LanguageClient &client, const std::string &path) {
    return client.request("textDocument/diagnostic", {{"textDocument", documentOf(path)}});
  }
  Json published(LanguageClient &client, const std::string &path) {
    while (true) {
      Json params = client.notification("textDocument/publishDiagnostics");
      if (params.is_null() || params["uri"] == "file://" + path)
        return params;
    }
  }

  const std::string mainText = "O1\nT1 M06\nG90 G54 G00 X0. Y0. S1000 M03\nM98 P2\nM30\n";
  const std::string subText = "O2\nG99999\nM99\n";
  const std::vector<std::string> inSub{"2 block-unknown-g-code"};
  Shop shop;
  std::string main, called;
};

TEST_F(CallingPrograms, AFileThatIsOpenedWhileItsCallerIsCheckedKeepsTheCallersFindings) {
  const std::string caller = "O1\nT1 M06\nG90 G54 G00 X0. Y0. S1000 M03\nG43 H01 Z50.\nG81 X1. Y1. "
                             "Z-5. R2. F100.\nM98 P2\nG80\nM30\n",
                    sub = "O2\nX2.\nT2 M06\nM99\n";
  shop.file("O0001.nc", caller).file("O0002.nc", sub);
  LanguageClient client;
  client.initialize(Json::object(), {{"dialect", "haas-mill"}});
  client.open(main, caller); // as an editor that opens again what was open when it was left
  client.open(called, sub);
  const std::vector<std::string> due{"3 cycle-left-active"};
  Json told = client.diagnostics(called);
  for (int i = 0; i < 3 && codes(told) != due; ++i)
    told = client.diagnostics(called);
  ASSERT_EQ(codes(told), due);
  // It can be silenced here.
  const Json actions =
      client.request("textDocument/codeAction", {{"textDocument", documentOf(called)},
                                                 {"range", told[0]["range"]},
                                                 {"context", {{"diagnostics", {told[0]}}}}});
  EXPECT_EQ(actions[0]["title"], "Allow cycle-left-active here");
}

TEST_F(CallingPrograms, FindingsOfAClosedFileArePublished) {
  LanguageClient client;
  client.initialize(pulling, {{"dialect", "haas-mill"}});
  client.open(main, mainText);
  EXPECT_FALSE(pull(client, main).contains("relatedDocuments"));
  EXPECT_EQ(codes(published(client, called)["diagnostics"]), inSub);
  // Once it is open the client asks for it, and must not show the same twice.
  client.open(called, subText);
  EXPECT_EQ(codes(pull(client, called)["items"]), inSub);
  EXPECT_EQ(published(client, called)["diagnostics"], Json::array());
}

TEST_F(CallingPrograms, FindingsOfAClosedFileComeWithTheCallerWhereTheClientTakesThem) {
  LanguageClient client;
  Json capabilities = pulling;
  capabilities["textDocument"]["diagnostic"]["relatedDocumentSupport"] = true;
  client.initialize(capabilities, {{"dialect", "haas-mill"}});
  client.open(main, mainText);
  const Json report = pull(client, main);
  EXPECT_EQ(codes(report["relatedDocuments"]["file://" + called]["items"]), inSub);
}

TEST_F(CallingPrograms, TheWorkspaceTellsThemOnce) {
  LanguageClient client;
  client.initialize(pulling, {{"dialect", "haas-mill"}, {"workspaceDiagnostics", true}},
                    workspaceOf(shop.path()));
  client.open(main, mainText);
  pull(client, main);
  const Json items =
      client.request("workspace/diagnostic", {{"previousResultIds", Json::array()}})["items"];
  ASSERT_EQ(items.size(), 2u);
  EXPECT_EQ(codes(items[0]["items"]), std::vector<std::string>());
  EXPECT_EQ(codes(items[1]["items"]), inSub);
}

TEST(PullDiagnostics, AWorkspaceOfManyFilesComesInParts) {
  Shop shop;
  for (int i = 10; i < 80; ++i)
    shop.file("O00" + std::to_string(i) + ".nc", "O00" + std::to_string(i) + "\nG99999\nM30\n");
  LanguageClient client;
  client.initialize(pulling, {{"dialect", "haas-mill"}, {"workspaceDiagnostics", true}},
                    workspaceOf(shop.path()));
  const int64_t id = client.ask("workspace/diagnostic", {{"previousResultIds", Json::array()},
                                                         {"partialResultToken", "part"}});
  size_t files = 0;
  for (int i = 0; i < 2; ++i)
    files += client.notification("$/progress")["value"]["items"].size();
  EXPECT_EQ(files + client.answer(id)["result"]["items"].size(), 70u);
}

TEST(PullDiagnostics, TheWorkspaceIsOfferedOnlyWhileItIsWanted) {
  LanguageClient client;
  const Json can = client.initialize(registering, {{"dialect", "haas-mill"}});
  EXPECT_FALSE(can["capabilities"].contains("diagnosticProvider"));
  const auto next = [&] {
    const Json request = client.serverRequest("client/registerCapability");
    client.reply(request, nullptr);
    const Json &registration = request["params"]["registrations"][0];
    EXPECT_EQ(registration["method"], "textDocument/diagnostic");
    return registration["registerOptions"]["workspaceDiagnostics"].get<bool>();
  };
  EXPECT_FALSE(next());
  client.notify("workspace/didChangeConfiguration",
                {{"settings", {{"ncvet", {{"workspaceDiagnostics", true}}}}}});
  client.reply(client.serverRequest("client/unregisterCapability"), nullptr);
  EXPECT_TRUE(next());
}

TEST(PullDiagnostics, AreAskedForAgainWhenTheControlIsAnother) {
  const std::string path = "/nowhere/a.nc", text = "O1\nG99999\nM30\n";
  LanguageClient client;
  client.initialize(pulling);
  client.open(path, text, "ncvet-haas-mill");
  client.request("textDocument/diagnostic", {{"textDocument", documentOf(path)}});
  // A new setting.
  client.notify("workspace/didChangeConfiguration",
                {{"settings", {{"ncvet", {{"ignore", {"block-unknown-g-code"}}}}}}});
  client.reply(client.serverRequest("workspace/diagnostic/refresh"), nullptr);
  // Another language of the same text.
  client.notify("textDocument/didClose", {{"textDocument", documentOf(path)}});
  client.open(path, text, "ncvet-fanuc-mill");
  client.reply(client.serverRequest("workspace/diagnostic/refresh"), nullptr);
}

TEST(PullDiagnostics, AreAskedForAgainWhenAFileThatIsCalledIsThere) {
  Shop shop;
  const std::string path = (shop.path() / "O0001.nc").string();
  LanguageClient client;
  client.initialize(pulling, {{"dialect", "fanuc-mill"}});
  client.open(path, "%\nO0001\nM98 P20\nM30\n%\n");
  const auto rules = [&] {
    const Json report =
        client.request("textDocument/diagnostic", {{"textDocument", documentOf(path)}});
    std::set<std::string> all;
    for (const Json &one : report["items"])
      all.insert(one["code"]);
    return all;
  };
  EXPECT_TRUE(rules().count("flow-undefined-subprogram"));
  shop.file("O0020.nc", "%\nO0020\nG00 X1.\nM99\n%\n");
  client.notify(
      "workspace/didChangeWatchedFiles",
      {{"changes", {{{"uri", "file://" + (shop.path() / "O0020.nc").string()}, {"type", 1}}}}});
  client.reply(client.serverRequest("workspace/diagnostic/refresh"), nullptr);
  EXPECT_FALSE(rules().count("flow-undefined-subprogram"));
}

class BrokenConfiguration : public testing::Test {
protected:
  void SetUp() override {
    config = (shop.path() / ".ncvet.json").string();
    program = (shop.path() / "a.nc").string();
  }
  void write(LanguageClient &client, const std::string &text) {
    shop.file(".ncvet.json", text);
    client.notify("workspace/didChangeWatchedFiles",
                  {{"changes", {{{"uri", "file://" + config}, {"type", 2}}}}});
  }
  Json published(LanguageClient &client, const std::string &path) {
    while (true) {
      Json params = client.notification("textDocument/publishDiagnostics");
      if (params.is_null() || params["uri"] == "file://" + path)
        return params.is_null() ? params : params["diagnostics"];
    }
  }
  const std::string right = "{\n  \"dialect\": \"haas-mill\"\n}";
  const std::string wrong = "{\n  \"dialect\": \"haas-mill\",\n  \"ignore\": 5\n}";
  Shop shop;
  std::string config, program;
};

TEST_F(BrokenConfiguration, IsToldAtItsLineAndTheLastRightOneCounts) {
  shop.file(".ncvet.json", right);
  LanguageClient client;
  client.initialize();
  client.open(program, "O1\nG99999\nM30\n");
  const std::vector<std::string> found{"2 block-unknown-g-code"};
  EXPECT_EQ(codes(client.diagnostics(program)), found);

  write(client, wrong);
  const Json told = published(client, config);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0]["range"]["start"], at(2, 0));
  EXPECT_NE(client.notification("window/showMessage")["message"].get<std::string>().find("ignore"),
            std::string::npos);
  EXPECT_EQ(codes(client.diagnostics(program)), found);

  write(client, right);
  EXPECT_EQ(published(client, config), Json::array());
}

TEST_F(BrokenConfiguration, IsToldFromTheStart) {
  shop.file(".ncvet.json", wrong);
  LanguageClient client;
  client.initialize();
  client.open(program, "O1\nG99999\nM30\n");
  EXPECT_EQ(published(client, config).size(), 1u);
  write(client, right);
  EXPECT_EQ(published(client, config), Json::array());
  for (int i = 0; i < 3; ++i)
    if (!codes(client.diagnostics(program)).empty())
      return;
  ADD_FAILURE() << "the program is not checked with the mended configuration";
}

TEST(ControlOfADocument, IsToldToAClientThatShowsIt) {
  LanguageClient client;
  client.initialize({{"experimental", {{"ncvet", {{"control", true}}}}}});
  client.open("/nowhere/a.nc", "%\nO1 (A)\nM30\n%\n", "ncvet-haas-mill");
  const Json control = client.notification("ncvet/control");
  EXPECT_EQ(control["uri"], "file:///nowhere/a.nc");
  EXPECT_EQ(control["dialect"], "haas-mill");
  EXPECT_NE(control["title"].get<std::string>().find("Haas"), std::string::npos);
  EXPECT_FALSE(control["reason"].get<std::string>().empty());
}

/// The light bulb asks at each move of the cursor: only what is chosen is worked out.
TEST(CodeActions, AllSafeFixesAreMadeWhenTheyAreChosen) {
  const std::string path = "/nowhere/a.nc";
  LanguageClient client;
  client.initialize(
      {{"textDocument", {{"codeAction", {{"resolveSupport", {{"properties", {"edit"}}}}}}}}},
      {{"dialect", "haas-mill"}, {"profile", "all"}});
  client.open(path, "%\nO1 (A)\nT1 M06\ng90 G54 G00 X0. Y0. S1000 M03\nG43 Z50. H01\nG49\n"
                    "G91 G28 Z0.\nG90\nM30\n%\n");
  ASSERT_FALSE(client.diagnostics(path).empty());
  const Json actions =
      client.request("textDocument/codeAction",
                     {{"textDocument", documentOf(path)},
                      {"range", {{"start", at(0, 0)}, {"end", at(0, 0)}}},
                      {"context", {{"diagnostics", Json::array()}, {"only", {"source.fixAll"}}}}});
  ASSERT_EQ(actions.size(), 1u) << actions.dump();
  EXPECT_FALSE(actions[0].contains("edit"));
  const Json whole = client.request("codeAction/resolve", actions[0]);
  const Json &edit = whole["edit"]["changes"]["file://" + path][0];
  EXPECT_EQ(edit["newText"], "G"); // of g90
  EXPECT_EQ(edit["range"]["start"], at(3, 0));
}

} // namespace
