// The playground in a real Chromium: what a person sees and does there. Skipped where Chromium,
// Node or the package are missing. NCVET_PICTURES=folder keeps a picture of each test.
#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/wasm/wasm_package.h"

#include <gmock/gmock.h>

using namespace ncvet::test;
using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class Playground : public testing::Test {
protected:
  void SetUp() override {
    if (!llvm::sys::findProgramByName("chromium"))
      GTEST_SKIP() << "chromium is not installed: ./dev packages browser";
    if (const std::string why = whyNoWasmPackage(); !why.empty())
      GTEST_SKIP() << why;
    const fs::path log = shop_.path() / "build.log";
    const fs::path script = fs::path(ncvet::places::sourceFolder()) / "playground" / "build.mjs";
    ASSERT_EQ(runOuter({"node", script.string(), (wasmPackage() / "lib").string(), site().string()},
                       log, 60),
              0)
        << contentsOf(log);
  }

  fs::path site() const { return shop_.path() / "site"; }

  /// Opens the page and evaluates the expressions in it, after `until`, a function that waits until
  /// a condition is true.
  Json resultsOf(std::vector<std::string> steps) {
    steps.insert(steps.begin(),
                 "window.until = async (is) => { for (let i = 0; i < 600; ++i) { try { if (is()) "
                 "return true; } catch {} await new Promise((go) => setTimeout(go, 50)); } return "
                 "'it did not become true: ' + is + ' ' + document.getElementById('state')."
                 "textContent; }; 0");
    shop_.file("steps.json", Json(steps).dump());
    const fs::path tests = fs::path(ncvet::places::sourceFolder()) / "tests";
    const fs::path log = shop_.path() / "browser.log";
    std::vector<std::string> command = {
        "node",   (tests / "wasm" / "served.mjs").string(),      site().string(),
        "node",   (tests / "browser" / "chromium.mjs").string(), "chromium",
        "{page}", (shop_.path() / "steps.json").string()};
    if (const char *pictures = std::getenv("NCVET_PICTURES"))
      command.push_back(
          (fs::path(pictures) /
           (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".png"))
              .string());
    runOuter(command, log, 180);
    const std::string text = contentsOf(log);
    const Json report = Json::parse(text, nullptr, false);
    Json results = Json::array();
    if (report.is_object()) {
      EXPECT_THAT(report["errors"], IsEmpty());
      EXPECT_THAT(report["requests"], Each(testing::AnyOf(StartsWith("http://127.0.0.1:"),
                                                          StartsWith("blob:http://127.0.0.1:"))))
          << "nothing is fetched from elsewhere";
      results = report["results"];
    } else {
      ADD_FAILURE() << text;
    }
    results.get_ref<Json::array_t &>().resize(steps.size());
    results.erase(0);
    return results;
  }

  Shop shop_;
};

/// Presses the first finding's button for its fix.
const std::string pressesFix =
    "[...document.querySelectorAll('#findings .acts button')].find((one) => "
    "one.textContent.startsWith('fix')).click(); 0";

/// What is selected in the program's text.
const std::string selected =
    "const area = document.getElementById('text'); area.value.slice(area.selectionStart, "
    "area.selectionEnd)";

/// Puts an example into the page, and waits for its findings and its drawing.
const std::string showsBore =
    "(async () => { await until(() => document.getElementById('example').options.length > 1);"
    "const list = document.getElementById('example'); list.value = 'bore.nc';"
    "list.dispatchEvent(new Event('change'));"
    "return await until(() => document.querySelectorAll('#findings .place').length === 2 &&"
    "document.getElementById('view').contentWindow.ncvet.path); })()";

TEST_F(Playground, ShowsFindingsAtTheirLinesAndTheToolPath) {
  const Json seen = resultsOf(
      {showsBore, "document.querySelector('#findings li').textContent",
       "document.querySelector('#numbers .warning').textContent",
       "document.getElementById('state').textContent",
       "document.getElementById('view').contentWindow.ncvet.path.json.programmed.count > 20 && "
       "document.getElementById('view').contentWindow.ncvet.pathPane.canvas.clientHeight > 300",
       "document.querySelectorAll('#findings .place')[1].click(); 0", selected,
       "document.getElementById('view').contentWindow.ncvet.selected.line"});
  EXPECT_EQ(seen[0], true);
  EXPECT_THAT(seen[1].get<std::string>(),
              AllOf(HasSubstr("14:1 warning"), HasSubstr("drills again"), HasSubstr("11")));
  EXPECT_EQ(seen[2], "● 14");
  EXPECT_THAT(seen[3].get<std::string>(), HasSubstr("fanuc-0m (guessed"));
  EXPECT_EQ(seen[4], true);
  EXPECT_EQ(seen[6], "M6");
  EXPECT_EQ(seen[7], 18);
}

TEST_F(Playground, AppliesAFixAndExplainsARule) {
  const Json seen = resultsOf(
      {showsBore, pressesFix,
       "until(() => document.querySelectorAll('#findings .place').length === 1)",
       "document.getElementById('text').value.split('\\n')[13]",
       "explain('cycle-left-active').then(() => document.querySelector('#page h1').textContent)",
       "document.getElementById('view').hidden"});
  EXPECT_EQ(seen[0], true);
  EXPECT_EQ(seen[2], true) << "one G80 ends the cycle for both; advice is left";
  EXPECT_EQ(seen[3], "G80");
  EXPECT_EQ(seen[4], "cycle-left-active");
  EXPECT_EQ(seen[5], true);
}

TEST_F(Playground, ChecksWhatIsTypedForTheControlThatIsChosen) {
  const Json seen = resultsOf(
      {"until(() => document.getElementById('control').options.length > 10)",
       "(() => { const area = document.getElementById('text'); area.value = '%\\nO1\\nG21 G90 "
       "G54\\nG01 X10. F0\\nM30\\n%\\n'; document.getElementById('control').value = 'haas-mill';"
       "area.dispatchEvent(new Event('input')); return 0; })()",
       "until(() => document.getElementById('findings').textContent.includes('feed-not-positive'))",
       "document.getElementById('state').textContent"});
  EXPECT_EQ(seen[0], true);
  EXPECT_EQ(seen[2], true);
  EXPECT_THAT(seen[3].get<std::string>(), StartsWith("haas-mill · "));
}

} // namespace
