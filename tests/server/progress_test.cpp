// What clients are told of long requests, of edits before they are made, and of hints that are
// looked at.
#include "tests/support/language_client.h"
#include "tests/support/process.h"

#include "gtest/gtest.h"

namespace {

using namespace ncvet;
using test::at;
using test::documentOf;
using test::Json;
using test::LanguageClient;
using test::Shop;

/// A program, and others that call it.
class Called : public testing::Test {
protected:
  void start(Json capabilities, const std::string &text = "%\nO0020\nG00 X1.\nM99\n%\n") {
    shop.file("O0020.nc", text);
    for (int i = 1; i <= callers; ++i)
      shop.file("O000" + std::to_string(i) + ".nc",
                "%\nO000" + std::to_string(i) + "\nM98 P20\nM30\n%\n");
    client.initialize(std::move(capabilities), {{"dialect", "fanuc-mill"}},
                      Json::array({{{"uri", uri("")}, {"name", "shop"}}}));
    client.open(path("O0020.nc"), text);
  }
  std::string path(const std::string &name) const { return (shop.path() / name).string(); }
  std::string uri(const std::string &name) const { return "file://" + path(name); }
  Json here(unsigned line, unsigned character) const {
    return {{"textDocument", documentOf(path("O0020.nc"))}, {"position", at(line, character)}};
  }

  static constexpr int callers = 5;
  Shop shop;
  LanguageClient client;
};

TEST_F(Called, ReferencesComeInPartsWithTheirProgress) {
  start(Json::object());
  Json params = here(1, 3);
  params["context"] = {{"includeDeclaration", false}};
  const Json whole = client.request("textDocument/references", params);
  EXPECT_EQ(whole.size(), size_t(callers));
  params["partialResultToken"] = "part";
  params["workDoneToken"] = "work";
  const int64_t asked = client.ask("textDocument/references", params);
  Json parts = Json::array();
  std::vector<std::string> kinds;
  while (kinds.empty() || kinds.back() != "end") {
    const Json progress = client.notification("$/progress");
    ASSERT_TRUE(progress.is_object());
    if (progress["token"] == "part")
      parts.insert(parts.end(), progress["value"].begin(), progress["value"].end());
    else
      kinds.push_back(progress["value"]["kind"]);
  }
  const Json rest = client.answer(asked)["result"];
  parts.insert(parts.end(), rest.begin(), rest.end());
  EXPECT_EQ(parts, whole) << "the parts and the rest are what comes at once without them";
  EXPECT_EQ(kinds.front(), "begin");
  EXPECT_GT(kinds.size(), 2u) << "progress is told between begin and end";
}

TEST_F(Called, SymbolsOfTheWorkspaceHaveProgress) {
  start(Json::object());
  const int64_t asked = client.ask("workspace/symbol", {{"query", "O00"}, {"workDoneToken", 7}});
  EXPECT_EQ(client.notification("$/progress")["value"]["kind"], "begin");
  EXPECT_EQ(client.notification("$/progress")["value"]["kind"], "report");
  EXPECT_FALSE(client.answer(asked)["result"].empty());
}

TEST_F(Called, ARenameSaysWhatItsEditsAre) {
  start({{"workspace",
          {{"workspaceEdit",
            {{"documentChanges", true},
             {"resourceOperations", {"rename"}},
             {"changeAnnotationSupport", {{"groupsOnLabel", true}}}}}}}});
  Json params = here(1, 3);
  params["newName"] = "25";
  const Json edit = client.request("textDocument/rename", params);
  const Json notes = edit["changeAnnotations"];
  ASSERT_EQ(edit["documentChanges"].size(), size_t(callers) + 2) << edit.dump();
  for (const Json &step : edit["documentChanges"]) {
    const bool isFile = step.contains("kind");
    const Json &noted = isFile ? step : step["edits"][0];
    const std::string note = noted["annotationId"];
    ASSERT_TRUE(notes.contains(note)) << note;
    EXPECT_FALSE(notes[note]["label"].get<std::string>().empty());
    EXPECT_EQ(note, isFile                                           ? "file"
                    : step["textDocument"]["uri"] == uri("O0020.nc") ? "here"
                                                                     : "elsewhere");
  }
}

TEST_F(Called, AnUnsafeFixAsksBeforeItIsMade) {
  const char *const text = "%\nO0020\nG21 G17 G40 G80 G90\nT1 M06\nG54 G00 X0. Y0. S900 M03\n"
                           "G43 H1 Z5.\nG81 X1. Y1. Z-5. R2. F100.\nT2 M06\nG80\nM30\n%\n";
  start({{"workspace",
          {{"workspaceEdit",
            {{"documentChanges", true}, {"changeAnnotationSupport", Json::object()}}}}}},
        text);
  client.diagnostics(path("O0020.nc"));
  const Json actions =
      client.request("textDocument/codeAction",
                     {{"textDocument", documentOf(path("O0020.nc"))},
                      {"range", {{"start", at(0, 0)}, {"end", at(11, 0)}}},
                      {"context", {{"diagnostics", Json::array()}, {"only", {"quickfix"}}}}});
  unsigned asking = 0, silent = 0;
  for (const Json &action : actions) {
    const Json edit = action.value("edit", Json::object());
    if (!edit.contains("changeAnnotations")) {
      ++silent;
      continue;
    }
    EXPECT_EQ(edit["changeAnnotations"]["unsafe"]["needsConfirmation"], true);
    EXPECT_FALSE(action.value("isPreferred", false));
    EXPECT_FALSE(edit.contains("changes"));
    ++asking;
  }
  EXPECT_GT(asking, 0u) << actions.dump();
  EXPECT_GT(silent, 0u) << "comments that silence a rule change nothing";
}

TEST_F(Called, AHintIsExplainedWhenItIsLookedAt) {
  start({{"textDocument",
          {{"hover", {{"contentFormat", {"markdown"}}}},
           {"inlayHint", {{"resolveSupport", {{"properties", {"tooltip", "label.location"}}}}}}}}},
        "%\nO0020\nG21 G17 G90\nG04 P1500\nG01 X1. F100.\nX2.\nM30\n%\n");
  client.notify("workspace/didChangeConfiguration",
                {{"settings", {{"ncvet", {{"hints", {{"motion", true}}}}}}}});
  const Json hints = client.request("textDocument/inlayHint",
                                    {{"textDocument", documentOf(path("O0020.nc"))},
                                     {"range", {{"start", at(0, 0)}, {"end", at(8, 0)}}}});
  ASSERT_FALSE(hints.empty());
  bool dwell = false, motion = false;
  for (const Json &hint : hints) {
    EXPECT_FALSE(hint.contains("tooltip")) << "not before it is asked for";
    const Json told = client.request("inlayHint/resolve", hint);
    ASSERT_TRUE(told.contains("tooltip")) << told.dump();
    EXPECT_EQ(told["position"], hint["position"]);
    if (hint["position"]["line"] == 3)
      dwell = true;
    if (hint["position"]["line"] == 5) {
      motion = true;
      EXPECT_EQ(told["label"][0]["location"]["range"]["start"]["line"], 4)
          << "where the code was set: " << told.dump();
    }
  }
  EXPECT_TRUE(dwell);
  EXPECT_TRUE(motion);
}

TEST_F(Called, LoopsAreTypedTogether) {
  start(Json::object(), "%\nO0020\nWHILE[#1LT5]DO1\n#1=#1+1\nEND1\nM99\n%\n");
  const Json linked = client.request("textDocument/linkedEditingRange", here(4, 4));
  ASSERT_EQ(linked["ranges"].size(), 2u) << linked.dump();
  EXPECT_EQ(linked["ranges"][0]["start"], at(2, 14));
  EXPECT_TRUE(client.request("textDocument/linkedEditingRange", here(3, 1)).is_null());
}

/// The path of the tool is told once, and then what becomes of it.
TEST_F(Called, ThePathOfTheToolFollowsEdits) {
  const std::string text = "%\nO0020\nG21 G17 G40 G80 G90 G94\nT1 M06\nG54 G00 X0. Y0. S900 M03\n"
                           "G43 H1 Z5.\nG01 Z-1. F100.\nX10.\nX20.\nX30.\nM98 P1\nM30\n%\n";
  start(Json::object(), text);
  const auto path = [&](const std::string &previous) {
    return client.request("ncvet/path", {{"textDocument", documentOf(this->path("O0020.nc"))},
                                         {"previous", previous}});
  };
  const Json whole = path("");
  ASSERT_TRUE(whole.contains("path")) << whole.dump();
  EXPECT_EQ(whole["version"], 1);
  EXPECT_EQ(whole["path"]["files"][0], uri("O0020.nc"));
  EXPECT_EQ(whole["path"]["programmed"]["count"], 7);
  client.notify("textDocument/didChange",
                {{"textDocument", {{"uri", uri("O0020.nc")}, {"version", 2}}},
                 {"contentChanges",
                  {{{"range", {{"start", at(8, 0)}, {"end", at(8, 0)}}}, {"text", "X15.\n"}}}}});
  const Json next = path(whole["id"]);
  ASSERT_TRUE(next.contains("change")) << next.dump();
  EXPECT_EQ(next["version"], 2);
  EXPECT_EQ(next["change"]["programmed"]["removed"], 0);
  EXPECT_EQ(next["change"]["programmed"]["added"]["count"], 1);
  EXPECT_EQ(next["change"]["lines"]["by"], 1);
  EXPECT_TRUE(path(whole["id"]).contains("path")) << "of an older answer no change is known";
}

TEST_F(Called, ThePathIsFollowedAnewOnlyWhereOtherFilesAreOthers) {
  start(Json::object(), "%\nO0020\nG21 G17 G40 G80 G90 G94\nG54 G00 X0. Y0.\nX10.\nX20.\nM98 P99\n"
                        "M30\n%\n");
  std::string id;
  int version = 1;
  const auto told = [&] {
    const Json edit = {{"range", {{"start", at(5, 0)}, {"end", at(5, 0)}}}, {"text", "X15.\n"}};
    client.notify("textDocument/didChange",
                  {{"textDocument", {{"uri", uri("O0020.nc")}, {"version", ++version}}},
                   {"contentChanges", Json::array({edit})}});
    const Json answer = client.request(
        "ncvet/path", {{"textDocument", documentOf(path("O0020.nc"))}, {"previous", id}});
    id = answer["id"];
    return answer.contains("change") ? "change" : "path";
  };
  const auto saved = [&](const std::string &name) {
    client.notify("textDocument/didSave", {{"textDocument", {{"uri", uri(name)}}}});
  };
  EXPECT_STREQ(told(), "path");
  EXPECT_STREQ(told(), "change");
  saved("O0020.nc");
  EXPECT_STREQ(told(), "change") << "a save has changed nothing of what the path rests on";
  shop.file("O0099.nc", "%\nO0099\nG00 X7.\nM99\n%\n");
  saved("O0099.nc");
  EXPECT_STREQ(told(), "path") << "the call that led nowhere leads to it";
}

} // namespace
