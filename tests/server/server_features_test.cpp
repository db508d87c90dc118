// The language server's features as a client sees them: names, outline, colours, completion.
#include "tests/support/language_client.h"
#include "tests/support/process.h"

#include "gtest/gtest.h"
#include "llvm/ADT/STLExtras.h"

namespace {

using namespace ncvet;
using test::at;
using test::documentOf;
using test::Json;
using test::LanguageClient;
using test::Shop;

/// A lathe's program that calls one in another file, jumps, and cuts along a profile.
const char *const turning = "%\nO1 (SHAFT)\nT0101 (ROUGH)\nG50 S2000\nG96 S150 M03\n"
                            "G00 X60. Z2.\nG71 P10 Q20 U0.5 W0.1 D2. F0.3\n"
                            "N10 G00 X20.\nG01 Z-30. F0.2\nN20 X60.\nG70 P10 Q20\n"
                            "M98 P2\nGOTO 90\nN90 G28 U0. W0.\nM30\n%\n";

class Features : public ::testing::Test {
protected:
  void SetUp() override {
    shop_.file("O0001.nc", turning).file("O0002.nc", "%\nO2 (CHAMFER)\nG01 X10. F0.1\nM99\n%\n");
    path_ = (shop_.path() / "O0001.nc").string();
    client_.initialize(
        Json::parse(
            R"({"textDocument": {"documentSymbol": {"hierarchicalDocumentSymbolSupport": true},
                                         "hover": {"contentFormat": ["markdown"]},
                                         "completion": {"completionItem": {"snippetSupport": true}}}})"),
        {{"dialect", "haas-lathe"}}, workspaceOf(shop_.path()));
    client_.open(path_, turning);
  }
  Json ask(const std::string &method, Json more = Json::object()) {
    more["textDocument"] = documentOf(path_);
    return client_.request("textDocument/" + method, std::move(more));
  }

  Shop shop_;
  std::string path_;
  LanguageClient client_;
};

TEST_F(Features, ADefinitionMayLieInAnotherFile) {
  const Json sub = ask("definition", {{"position", at(11, 6)}});
  EXPECT_EQ(sub["uri"], "file://" + (shop_.path() / "O0002.nc").string());
  EXPECT_EQ(sub["range"]["start"]["line"], 1);
  const Json block = ask("definition", {{"position", at(12, 6)}});
  EXPECT_EQ(block["range"]["start"]["line"], 13);
  const Json profile = ask("definition", {{"position", at(6, 6)}});
  EXPECT_EQ(profile["range"]["start"]["line"], 7);
}

TEST_F(Features, ReferencesAndHighlightsOfABlockNumber) {
  const Json places =
      ask("references", {{"position", at(7, 1)}, {"context", {{"includeDeclaration", true}}}});
  std::vector<int> lines;
  for (const Json &place : places)
    lines.push_back(place["range"]["start"]["line"]);
  EXPECT_EQ(lines, (std::vector<int>{6, 7, 10}));
  EXPECT_EQ(ask("documentHighlight", {{"position", at(7, 1)}}).size(), 3u);
}

TEST_F(Features, TheOutlineHoldsProgramsToolsAndOperations) {
  const Json outline = ask("documentSymbol");
  ASSERT_EQ(outline.size(), 1u);
  EXPECT_NE(outline[0]["name"].get<std::string>().find("1"), std::string::npos);
  const std::string all = outline.dump();
  EXPECT_NE(all.find("T0101"), std::string::npos) << all;
  EXPECT_NE(all.find("G71"), std::string::npos) << all;
  const Json found = client_.request("workspace/symbol", {{"query", "2"}});
  EXPECT_NE(found.dump().find("O0002.nc"), std::string::npos) << found.dump();
}

TEST_F(Features, FoldsSelectionsAndLinks) {
  EXPECT_GE(ask("foldingRange").size(), 2u);
  const Json selections = ask("selectionRange", {{"positions", {at(8, 1)}}});
  ASSERT_EQ(selections.size(), 1u);
  EXPECT_TRUE(selections[0].contains("parent"));
  const Json links = ask("documentLink");
  ASSERT_EQ(links.size(), 1u);
  EXPECT_EQ(links[0]["target"], "file://" + (shop_.path() / "O0002.nc").string());
}

TEST_F(Features, CallsAreFollowedBothWays) {
  const Json items = ask("prepareCallHierarchy", {{"position", at(11, 6)}});
  ASSERT_EQ(items.size(), 1u);
  const Json incoming = client_.request("callHierarchy/incomingCalls", {{"item", items[0]}});
  ASSERT_EQ(incoming.size(), 1u);
  EXPECT_EQ(incoming[0]["fromRanges"][0]["start"]["line"], 11);
  const Json outgoing =
      client_.request("callHierarchy/outgoingCalls", {{"item", incoming[0]["from"]}});
  ASSERT_EQ(outgoing.size(), 1u);
  EXPECT_EQ(outgoing[0]["to"]["uri"], items[0]["uri"]);
}

TEST_F(Features, HoverTellsTheWordAndTheState) {
  const Json hover = ask("hover", {{"position", at(6, 1)}});
  const std::string text = hover["contents"]["value"];
  EXPECT_NE(text.find("G71"), std::string::npos) << text;
  EXPECT_NE(text.find("Before this block"), std::string::npos) << text;
  EXPECT_NE(text.find("X 60, Z 2"), std::string::npos) << text;
}

TEST(FeaturesOfMills, VariablesHaveTheirValuesBesideThemWhileTheProgramWaits) {
  LanguageClient client;
  client.initialize(Json::object(), {{"dialect", "fanuc-mill"}});
  const std::string path = "/nowhere/loop.nc";
  client.open(path, "O1\n#101=1\nG00 X#101 Y[#101+#2]\n#3=#101\nM30\n");
  const Json values = client.request(
      "textDocument/inlineValue",
      {{"textDocument", documentOf(path)},
       {"range", {{"start", at(0, 0)}, {"end", at(4, 0)}}},
       {"context",
        {{"frameId", 1}, {"stoppedLocation", {{"start", at(2, 0)}, {"end", at(2, 23)}}}}}});
  std::vector<std::string> asked;
  for (const Json &value : values)
    asked.push_back(std::to_string(value["range"]["start"]["line"].get<int>()) + " " +
                    value["expression"].get<std::string>());
  EXPECT_EQ(asked, (std::vector<std::string>{"1 #101", "2 #101", "2 #2"}))
      << "the block after that has not been executed";
  EXPECT_EQ(values[0]["range"]["start"]["character"], 0) << "with its mark";
}

TEST(FeaturesOfMills, WhereANameIsDeclared) {
  LanguageClient client;
  client.initialize(Json::object(), {{"dialect", "sinumerik"}});
  const std::string path = "/nowhere/SHAFT.MPF";
  client.open(path, "%_N_SHAFT_MPF\nEXTERN HOLE(REAL)\nHOLE(5)\nM30\n%_N_HOLE_SPF\n"
                    "PROC HOLE(REAL DEPTH)\nG0 X=DEPTH\nRET\n");
  const auto ask = [&](const char *method) {
    return client.request(method, {{"textDocument", documentOf(path)}, {"position", at(2, 1)}});
  };
  EXPECT_EQ(ask("textDocument/declaration")["range"]["start"]["line"], 1);
  EXPECT_EQ(ask("textDocument/implementation")["range"]["start"]["line"], 4);
}

TEST(FeaturesOfMills, HoverInASubprogramTellsWhatItHasSetItself) {
  LanguageClient client;
  client.initialize(Json::object(), {{"dialect", "fanuc-mill"}});
  const std::string path = "/nowhere/O0020.nc";
  client.open(path, "%\nO0020 (HOLE)\nG17 G21 G90\nG01 X1. F100.\nY5.\nM99\n%\n");
  const Json hover = client.request("textDocument/hover",
                                    {{"textDocument", documentOf(path)}, {"position", at(4, 1)}});
  const std::string text = hover["contents"]["value"];
  for (const char *told : {"G90", "G01", "G17", "G21", "F100"})
    EXPECT_NE(text.find(told), std::string::npos) << told << " is not in\n" << text;
}

TEST(FeaturesOfMills, HoverOnACompensatedContourTellsItsLargestTool) {
  LanguageClient client;
  client.initialize(Json::object(), {{"dialect", "haas-mill"}});
  // A square pocket's corners, rounded with 4 mm: no larger tool gets into them.
  client.open("/nowhere/pocket.nc",
              "O1\nT1 M06\nG90 G54 G00 X0. Y0. S900 M03\nG43 H1 Z5.\nG01 Z-1. F90.\n"
              "G41 D1 G01 X20. Y0.\nY16.\nG03 X16. Y20. I-4. J0.\nG01 X-20.\nY-20.\nX20.\nY0.\n"
              "G40 X0.\nG00 Z50.\nG49\nM30\n");
  const Json hover =
      client.request("textDocument/hover",
                     {{"textDocument", documentOf("/nowhere/pocket.nc")}, {"position", at(5, 1)}});
  EXPECT_NE(hover.dump().find("safe up to R4.00"), std::string::npos) << hover.dump();
  const Json lenses =
      client.request("textDocument/codeLens", {{"textDocument", documentOf("/nowhere/pocket.nc")}});
  const auto open = llvm::find_if(lenses, [](const Json &lens) { return lens.contains("data"); });
  ASSERT_NE(open, lenses.end()) << lenses.dump();
  EXPECT_EQ((*open)["range"]["start"]["line"], 5);
  EXPECT_EQ(client.request("codeLens/resolve", *open)["command"]["title"], "safe up to R4.00");
}

TEST_F(Features, CompletionKnowsTheWordsOfACycle) {
  const Json list = ask("completion", {{"position", at(6, 20)}});
  EXPECT_FALSE(list["items"].empty());
  bool resolved = false;
  for (const Json &item : list["items"])
    if (item.contains("data") && !resolved) {
      resolved = true;
      EXPECT_TRUE(client_.request("completionItem/resolve", item).contains("documentation"));
    }
  EXPECT_TRUE(resolved);
  const Json help = ask("signatureHelp", {{"position", at(6, 12)}});
  EXPECT_NE(help.dump().find("G71"), std::string::npos) << help.dump();
}

TEST(Completions, WhatTheyReplaceIsSaidOnceWhereTheClientKnowsThat) {
  LanguageClient client;
  client.initialize(Json::parse(R"({"textDocument": {"completion": {"completionList":
                       {"itemDefaults": ["commitCharacters", "editRange"]}}}})"),
                    {{"dialect", "haas-mill"}});
  client.open("/nowhere/a.nc", "O1\nG90 G54\nX1. G8\n");
  const Json list =
      client.request("textDocument/completion",
                     {{"textDocument", documentOf("/nowhere/a.nc")}, {"position", at(2, 6)}});
  EXPECT_EQ(list["itemDefaults"]["editRange"], Json({{"start", at(2, 4)}, {"end", at(2, 6)}}));
  ASSERT_FALSE(list["items"].empty());
  for (const Json &item : list["items"])
    EXPECT_FALSE(item.contains("textEdit")) << item;
}

TEST_F(Features, TokensThatChangeAreTheWholeOnesAgain) {
  const Json full = ask("semanticTokens/full");
  ASSERT_FALSE(full["data"].empty());
  client_.notify(
      "textDocument/didChange",
      {{"textDocument", {{"uri", "file://" + path_}, {"version", 2}}},
       {"contentChanges",
        {{{"range", {{"start", at(5, 0)}, {"end", at(5, 0)}}}, {"text", "(A)\nM08\n"}}}}});
  const Json delta = ask("semanticTokens/full/delta", {{"previousResultId", full["resultId"]}});
  std::vector<uint32_t> data = full["data"];
  ASSERT_EQ(delta["edits"].size(), 1u);
  const Json &edit = delta["edits"][0];
  const auto begin = data.begin() + edit["start"].get<int>();
  const auto after = data.erase(begin, begin + edit["deleteCount"].get<int>());
  const std::vector<uint32_t> put = edit["data"];
  data.insert(after, put.begin(), put.end());
  EXPECT_EQ(Json(data), ask("semanticTokens/full")["data"]);
}

TEST_F(Features, ABlockIsRenumberedWithItsTargets) {
  EXPECT_EQ(ask("prepareRename", {{"position", at(7, 1)}})["placeholder"], "10");
  const Json edit = ask("rename", {{"position", at(7, 1)}, {"newName", "15"}});
  const Json edits = edit["changes"]["file://" + path_];
  ASSERT_EQ(edits.size(), 3u); // G71, the block, G70
  for (const Json &one : edits)
    EXPECT_EQ(one["newText"], "15");
  // A number that is in use is refused, with the reason.
  const Json refused = client_.answer(client_.ask(
      "textDocument/rename",
      {{"textDocument", documentOf(path_)}, {"position", at(7, 1)}, {"newName", "20"}}));
  EXPECT_EQ(refused["error"]["code"], -32803) << refused.dump();
}

TEST_F(Features, FormattingPutsBlanksBetweenWords) {
  client_.notify(
      "textDocument/didChange",
      {{"textDocument", {{"uri", "file://" + path_}, {"version", 2}}},
       {"contentChanges",
        {{{"range", {{"start", at(5, 0)}, {"end", at(5, 12)}}}, {"text", "G00X60.Z2."}}}}});
  const Json edits = ask("formatting", {{"options", {{"tabSize", 2}, {"insertSpaces", true}}}});
  ASSERT_EQ(edits.size(), 1u) << edits.dump();
  EXPECT_EQ(edits[0]["range"]["start"]["line"], 5);
  EXPECT_EQ(edits[0]["newText"], " X60. ");
}

TEST_F(Features, OnlyTheMarkedLinesAreFormatted) {
  const std::string path = (shop_.path() / "O0003.nc").string();
  client_.open(path, "%\nO3\nG00X1.\nG00X2.\nM30\n%\n");
  const Json edits = client_.request("textDocument/rangeFormatting",
                                     {{"textDocument", documentOf(path)},
                                      {"range", {{"start", at(3, 0)}, {"end", at(3, 6)}}},
                                      {"options", {{"tabSize", 2}, {"insertSpaces", true}}}});
  ASSERT_EQ(edits.size(), 1u) << edits.dump();
  EXPECT_EQ(edits[0]["range"]["start"]["line"], 3);
}

TEST_F(Features, ANewBlockGetsTheNextNumber) {
  const std::string path = (shop_.path() / "O0003.nc").string();
  client_.open(path, "%\nO3\nN10 G00 X1.\nN20 X2.\n\nM30\n%\n");
  const Json edits = client_.request("textDocument/onTypeFormatting",
                                     {{"textDocument", documentOf(path)},
                                      {"position", at(4, 0)},
                                      {"ch", "\n"},
                                      {"options", {{"tabSize", 2}, {"insertSpaces", true}}}});
  ASSERT_EQ(edits.size(), 1u) << edits.dump();
  EXPECT_EQ(edits[0]["newText"], "N30 ");
}

TEST_F(Features, TokensOfLinesArePartOfThoseOfTheText) {
  constexpr size_t numbersOfToken = 5; // line and column from the last one, length, type, modifiers
  const std::vector<uint32_t> all = ask("semanticTokens/full")["data"];
  const Json range = {{"start", at(0, 0)}, {"end", at(5, 0)}};
  const std::vector<uint32_t> part = ask("semanticTokens/range", {{"range", range}})["data"];
  ASSERT_FALSE(part.empty());
  ASSERT_LT(part.size(), all.size());
  EXPECT_EQ(part, std::vector<uint32_t>(all.begin(), all.begin() + long(part.size())));
  uint32_t line = 0;
  for (size_t i = 0; i < part.size(); i += numbersOfToken)
    line += part[i];
  EXPECT_EQ(line, 4u); // G96, the last one of the lines
}

TEST_F(Features, ACommandShowsThePageOfARule) {
  const Json asked = {{"command", "ncvet.explain"}, {"arguments", {"feed-not-positive"}}};
  EXPECT_TRUE(client_.request("workspace/executeCommand", asked).is_null());
  const Json shown = client_.serverRequest("window/showDocument");
  const std::string page = shown["params"]["uri"];
  EXPECT_NE(page.find("feed-not-positive.md"), std::string::npos) << page;
  const Json unknown = {{"command", "ncvet.explain"}, {"arguments", {"no-such-rule"}}};
  const Json refused = client_.answer(client_.ask("workspace/executeCommand", unknown));
  EXPECT_EQ(refused["error"]["code"], -32602) << refused.dump();
}

TEST_F(Features, HintsAndLensesComeForTheWholeText) {
  const Json range = {{"start", at(0, 0)}, {"end", at(15, 0)}};
  EXPECT_TRUE(ask("inlayHint", {{"range", range}}).is_array());
  const std::string lenses = ask("codeLens").dump();
  EXPECT_NE(lenses.find("T0101"), std::string::npos) << lenses;
}

} // namespace
