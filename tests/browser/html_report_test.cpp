// The HTML report in a real Chromium: what a person sees and does there. Skipped without Chromium
// and Node.
#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

using namespace ncvet::test;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class HtmlReportInChromium : public testing::Test {
protected:
  void SetUp() override {
    for (const char *name : {"chromium", "node"})
      if (!llvm::sys::findProgramByName(name))
        GTEST_SKIP() << name << " is not installed: ./dev packages browser";
  }

  /// Writes a report of the shop's files, opens it, and evaluates the expressions in it.
  Json open(const std::vector<std::string> &arguments, const std::vector<std::string> &steps,
            const std::string &fragment = "") {
    std::vector<std::string> command = {"check", "--format", "gcc", "--report", "html:report.html"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    shop_.run(command);
    shop_.file("steps.json", Json(steps).dump());
    const std::string page = "file://" + (shop_.path() / "report.html").string() + fragment;
    const fs::path script =
        fs::path(ncvet::places::sourceFolder()) / "tests" / "browser" / "chromium.mjs";
    const fs::path log = shop_.path() / "browser.log";
    runOuter({"node", script.string(), "chromium", page, (shop_.path() / "steps.json").string()},
             log, 120);
    const std::string text = contentsOf(log);
    Json result = Json::parse(text, nullptr, false);
    if (!result.is_object()) {
      ADD_FAILURE() << text;
      return {{"results", Json::array()}, {"errors", Json::array()}, {"requests", Json::array()}};
    }
    EXPECT_THAT(result["errors"], IsEmpty());
    EXPECT_THAT(result["requests"], Each(StartsWith("file:"))) << "nothing is fetched";
    EXPECT_EQ(result["results"].size(), steps.size());
    return result;
  }
  Json resultsOf(const std::vector<std::string> &arguments, const std::vector<std::string> &steps,
                 const std::string &fragment = "") {
    Json results = open(arguments, steps, fragment)["results"];
    results.get_ref<Json::array_t &>().resize(steps.size());
    return results;
  }

  Shop shop_;
};

/// Four holes; the cycle is left on and drills into the clamp.
constexpr const char *leftOverCycle = "%\nO1200 (FLANGE)\n"
                                      "G21 G17 G40 G49 G80 G90 G94\n"
                                      "T3 M6\n"
                                      "G54 G0 X-20. Y-15. S1400 M3\n"
                                      "G43 H3 Z50.\n"
                                      "G98 G83 X-20. Y-15. Z-22. R2. Q5. F120.\n"
                                      "X20. Y-15.\n"
                                      "X30. Y0. (TO CLAMP)\n"
                                      "M5\nG80\nM30\n%\n";

TEST_F(HtmlReportInChromium, ShowsProgramFindingAndToolPath) {
  shop_.file("bore.nc", leftOverCycle);
  const Json seen = resultsOf(
      {"--dialect", "fanuc-0m", "bore.nc"},
      {"ncvet.report.findings.length > 0", "document.querySelector('.row.current').dataset.line",
       "document.querySelector('.row.current code').textContent",
       "document.querySelector('.row.current .t-property').textContent",
       "document.querySelector('#detail h3').textContent", "ncvet.path.json.end.kind",
       "document.querySelectorAll('.table-body table').length", "ncvet.pathPane.corners > 20"});
  EXPECT_EQ(seen[0], true);
  EXPECT_EQ(seen[1], "9");
  EXPECT_EQ(seen[2], "X30. Y0. (TO CLAMP)");
  EXPECT_EQ(seen[3], "X");
  EXPECT_THAT(seen[4].get<std::string>(), HasSubstr("drills again"));
  EXPECT_EQ(seen[5], "whole");
  EXPECT_EQ(seen[6], 2);
  EXPECT_EQ(seen[7], true);
}

TEST_F(HtmlReportInChromium, SliderAndTextFollowEachOther) {
  shop_.file("bore.nc", leftOverCycle);
  const Json seen = resultsOf(
      {"--dialect", "fanuc-0m", "bore.nc"},
      {"ncvet.pathPane.goToBlock(3); ncvet.textPane.current",
       "new Promise((done) => setTimeout(done, 200)).then(() => "
       "document.querySelector('.row.current').dataset.line)",
       "document.querySelector('.row[data-line=\"6\"] code').click(); ncvet.path.curve.line["
       "ncvet.pathPane.move]",
       "document.body.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowRight', bubbles: "
       "true})); ncvet.textPane.current",
       "document.body.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowLeft', shiftKey: "
       "true, "
       "bubbles: true})); document.querySelector('#place').textContent"});
  // Blocks with motions: tool, first position, length, first hole.
  EXPECT_EQ(seen[0], 7);
  EXPECT_EQ(seen[1], "7");
  EXPECT_EQ(seen[2], 6);
  EXPECT_EQ(seen[3], 7);
  EXPECT_THAT(seen[4].get<std::string>(), HasSubstr("F 120 mm/min")) << "before the way back";
}

TEST_F(HtmlReportInChromium, FiltersHideFindingsInListTextAndDrawing) {
  shop_.file("a.nc", programWithoutFeed()).file("bore.nc", leftOverCycle);
  const Json seen = resultsOf(
      {"a.nc", "bore.nc", "--dialect", "fanuc-0m"},
      {"ncvet.report.findings.length === document.querySelectorAll('#findings li[data-finding]')"
       ".length",
       "document.querySelector('#search').value = 'bore.nc:9'; "
       "document.querySelector('#search').dispatchEvent(new Event('input')); "
       "[...document.querySelectorAll('#findings li[data-finding] .place')].map((e) => "
       "e.textContent)",
       "document.querySelector('.level.warning').click(); document.querySelectorAll("
       "'#findings li[data-finding]').length"});
  EXPECT_EQ(seen[0], true);
  ASSERT_TRUE(seen[1].is_array());
  ASSERT_FALSE(seen[1].empty());
  for (const Json &place : seen[1])
    EXPECT_THAT(place.get<std::string>(), StartsWith("9:"));
  EXPECT_LT(seen[2].get<size_t>(), seen[1].size());
}

TEST_F(HtmlReportInChromium, TextOfAProgramNeverBecomesMarkup) {
  const std::string evil = "(</script><script>window.evil = 1</script><img src=x onerror=\"window."
                           "evil = 1\">)";
  shop_.file("</script><b>.nc", "%\nO0001 " + evil + "\nG01 X10. " + evil + "\n" + evil +
                                    "\nT1 M6 " + evil + "\nM30\n%\n");
  const Json seen = resultsOf({".", "--dialect", "haas-mill"},
                              {"window.evil ?? 'nothing'", "document.images.length",
                               "document.querySelectorAll('b').length",
                               "document.querySelector('.row[data-line=\"3\"] code').textContent"});
  EXPECT_EQ(seen[0], "nothing");
  EXPECT_EQ(seen[1], 0);
  EXPECT_LE(seen[2], 1) << "the name of the rule";
  EXPECT_EQ(seen[3], "G01 X10. " + evil);
}

TEST_F(HtmlReportInChromium, DrawsWithoutWebGlToo) {
  shop_.file("bore.nc", leftOverCycle);
  const Json seen =
      resultsOf({"--dialect", "fanuc-0m", "bore.nc"},
                {"ncvet.pathPane.isFlat",
                 "ncvet.pathPane.draw(); (() => { const c = ncvet.pathPane.canvas, p = "
                 "c.getContext('2d').getImageData(0, 0, c.width, c.height).data; let n = 0; "
                 "for (let i = 3; i < p.length; i += 4) if (p[i]) ++n; return n > 200; })()"},
                "#2d");
  EXPECT_EQ(seen[0], true);
  EXPECT_EQ(seen[1], true);
}

TEST_F(HtmlReportInChromium, TimesAndExtentsAreThoseOfTheMoves) {
  // 100 mm at 600 mm/min, and back by rapid at 30,000 mm/min.
  shop_.file("line.nc", "%\nO0001\nG21 G17 G40 G49 G80 G90 G94\nT1 M6\n"
                        "G54 G0 X0. Y0. S900 M3\nG43 H1 Z0.\nG1 X100. F600.\nG0 X0.\n"
                        "G4 P2000\nM30\n%\n");
  shop_.file("machine.json", R"({"dialect": "fanuc-0m", "feed": {"rapid": 30000},
                                 "options": {"toolChangeTime": 4}})");
  const Json seen = resultsOf({"--dialect", "fanuc-0m", "--machine", "machine.json", "line.nc"},
                              {"ncvet.measures.sums", "ncvet.measures.extents.feed.max.slice(0, 2)",
                               "ncvet.measures.lengths.feed", "ncvet.measures.basis.rapidAssumed",
                               "ncvet.setBasis({...ncvet.measures.basis, acceleration: 1000}); "
                               "ncvet.measures.total > 16.3"});
  EXPECT_NEAR(seen[0]["feed"].get<double>(), 10, 1e-6);
  EXPECT_NEAR(seen[0]["rapid"].get<double>(), 0.2, 1e-6);
  EXPECT_NEAR(seen[0]["dwell"].get<double>(), 2, 1e-6);
  EXPECT_NEAR(seen[0]["toolChange"].get<double>(), 4, 1e-6);
  EXPECT_THAT(seen[1], ElementsAre(100, 0));
  EXPECT_NEAR(seen[2].get<double>(), 100, 1e-6);
  EXPECT_EQ(seen[3], false);
  EXPECT_EQ(seen[4], true) << "axes that speed up and brake need longer";
}

/// A drawing of a million moves turns: half of the frames come within three hundredths of a second
/// on an idle machine. The bound is one that a busy machine without a graphics unit holds as well.
TEST_F(HtmlReportInChromium, AMillionMovesTurnFluidly) {
  std::string program = "%\nO0001\nG21 G17 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0.\n"
                        "G43 H1 Z5.\nG1 Z0. F2000.\n";
  for (int y = 0; y < 1000; ++y)
    for (int i = 0; i < 1000; ++i) {
      const int x = y % 2 ? 999 - i : i;
      char block[64];
      std::snprintf(block, sizeof block, "X%.2f Y%.2f Z%.3f\n", x * 0.2, y * 0.2,
                    3 * std::sin(x * 0.02) * std::cos(y * 0.015));
      program += block;
    }
  shop_.file("surface.nc", program + "G0 Z50.\nM30\n%\n");
  const Json result = open(
      {"--dialect", "haas-mill", "surface.nc"},
      {"ncvet.path.curve.count",
       "(async () => { const pane = ncvet.pathPane, times = []; let last = 0; "
       "for (let i = 0; i < 90; ++i) { pane.camera.orbit(0.02, 0.002, [0, 0, 1]); "
       "pane.refresh(true); const now = await new Promise(requestAnimationFrame); "
       "if (i > 30) times.push(now - last); last = now; } "
       "return times.sort((a, b) => a - b)[times.length >> 1]; })()",
       "new Promise((done) => setTimeout(done, 1500)).then(() => ncvet.pathPane.corners)",
       // How far corners that a coarse level leaves out are from its lines, in parts of what it
       // allows.
       "(() => { const {drawn, levels} = ncvet.pathPane.curves[0], p = drawn.places; let worst = "
       "0; "
       "for (const {index, away} of levels.levels.slice(1)) for (let k = 1; k < index.length; ++k) "
       "for (let i = index[k - 1] + 1; i < index[k]; ++i) { const a = index[k - 1] * 3, b = "
       "index[k] "
       "* 3, at = (j) => [p[j], p[j + 1], p[j + 2]], line = at(b).map((x, n) => x - at(a)[n]), to "
       "= "
       "at(i * 3).map((x, n) => x - at(a)[n]), square = line[0] ** 2 + line[1] ** 2 + line[2] ** "
       "2, "
       "part = Math.max(0, Math.min(1, (line[0] * to[0] + line[1] * to[1] + line[2] * to[2]) / "
       "square)), off = Math.hypot(...to.map((x, n) => x - part * line[n])); "
       "worst = Math.max(worst, off / away); } return worst; })()",
       // Where pieces are left out, the lines of the others are there as they are, and in one list.
       "(() => { const {levels} = ncvet.pathPane.curves[0], ends = levels.thinned(4, 4), next = "
       "new "
       "Map([...levels.levels[4].index].map((n, i, all) => [n, all[i + 1]])); for (let i = 0; i < "
       "ends.length; i += 2) if (next.get(ends[i]) !== ends[i + 1]) return 0; return ends.length / "
       "2 / levels.levels[4].index.length; })()"});
  const Json &seen = result["results"];
  ASSERT_EQ(seen.size(), 5u);
  EXPECT_GT(seen[0], 1'000'000);
  std::printf("opened in %d ms, a frame in %.1f ms, %d corners at rest\n",
              result["milliseconds"].get<int>(), seen[1].get<double>(), seen[2].get<int>());
  EXPECT_LT(seen[1].get<double>(), 150);
  EXPECT_GT(seen[2], 20'000) << "at rest it is fine again";
  EXPECT_LE(seen[3], 2.001);
  EXPECT_NEAR(seen[4].get<double>(), 0.25, 0.05);
  EXPECT_LT(fs::file_size(shop_.path() / "report.html"), program.size() + 50'000'000);
}

} // namespace
