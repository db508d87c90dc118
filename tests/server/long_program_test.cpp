// Programs whose checks take longer than a user waits for an answer.
#include "tests/support/language_client.h"

#include "gtest/gtest.h"

namespace {

using namespace ncvet::test;

/// Numbered blocks after a head whose `G90` is in line 2, from character 12 on.
std::string longProgram() {
  std::string text = "%\nO0001 (LONG)\nG17 G21 G40 G90 G80 G94\nT1 M6\nG54 G0 X0. Y0. S3000 M3\n"
                     "G43 H1 Z5.\nG1 Z-1. F900.\n";
  for (unsigned i = 1; i <= 300'000; ++i)
    text += "N" + std::to_string(i) + " G1 X" + std::to_string(i % 97) + ". Y" +
            std::to_string(i % 89) + ".\n";
  return text + "G0 Z50.\nM30\n%\n";
}

/// That it does not wait for the check `StatesInTime` tests say.
TEST(LongProgram, AHoverIsAnsweredWhileItIsChecked) {
  const std::string path = "/nowhere/long.nc";
  LanguageClient client;
  client.initialize(Json::object(), {{"dialect", "haas-mill"}});
  client.open(path, longProgram());
  client.diagnostics(path);
  const Json place = {{"textDocument", documentOf(path)}, {"position", at(150'000, 12)}};
  for (int version = 2; version < 8; ++version) {
    const Json range = {{"start", at(2, 12)}, {"end", at(2, 15)}};
    client.notify(
        "textDocument/didChange",
        {{"textDocument", {{"uri", "file://" + path}, {"version", version}}},
         {"contentChanges", {{{"range", range}, {"text", version % 2 ? "G90" : "G91"}}}}});
    const Json hover = client.request("textDocument/hover", place);
    EXPECT_NE(hover["contents"]["value"].get<std::string>().find("linear feed"), std::string::npos);
    client.diagnostics(path, version);
  }
  // Once it has been followed, the state is there.
  std::string told;
  for (int i = 0; i < 100 && told.find("G90") == std::string::npos; ++i)
    told = client.request("textDocument/hover", place)["contents"]["value"];
  EXPECT_NE(told.find("G90"), std::string::npos) << told;
}

} // namespace
