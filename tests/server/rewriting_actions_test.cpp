// Rewritings of selected blocks, as a client of the language server gets them.
#include "tests/support/language_client.h"

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

} // namespace
