// The motions of the programs that the manuals print lead through the points that the corpus beside
// the project gives for them, when it is there.
#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/support/process.h"

#include "gtest/gtest.h"

#include <cmath>

namespace ncvet {
namespace {

/// Points of a path, in their order; between them others may lie. Two numbers are the axes of the
/// plane (X and Y of a mill, X and Z of a lathe), a third one is Z.
struct Way {
  const char *file;
  const char *dialect;
  const char *points; ///< "(10,0) (10,20)", the last one being where the program ends if `ends`
  bool ends = true;
  /// Programs that it calls, by the name that it calls them, with their files beside `file`.
  std::vector<std::pair<const char *, const char *>> called = {};
  std::vector<std::string> axes = {}; ///< when they are others
};

void PrintTo(const Way &way, std::ostream *out) { *out << way.file; }

std::string pathOf(const Way &way) {
  return places::sourceFolder() + "/../shared/corpus/" + way.file;
}

std::vector<Way> ways() {
  std::vector<Way> list = {
      // Haas lathe: corners and lines by angle have no start of their own, so that only their ends
      // are known.
      {"haas-lathe/g71-type1-outside-o1234.nc", "haas-lathe",
       "(70,3) (54.3,3.1) (38.3,3.1) (22.3,3.1) (17.3,3.1) (70,3) (17,3) (17,0) (28,-15) (28,-23) "
       "(44,-31) (44,-39) (60,-47) (60,-60) (70,-65) (74,-65) (74,3) (70,3)",
       false},
      {"haas-lathe/o1-uebung.nc", "haas-lathe",
       "(70,0) (5,0) (-1.6,0) (70,2) (16,2) (16,0) (20,-2) (20,-18) (37,-18) (37,-65) (62,-65) "
       "(68,-68) (70,-68) (70,2)",
       false},
      {"haas-lathe/g90-turning-passes.nc", "haas-lathe",
       "(52,3) (45,3) (45,-30) (52,-30) (52,3) (40,-30) (35,-30) (30,-30) (25,-30) (52,3)", false},
      {"haas-lathe/g92-thread-m30x3-5.nc", "haas-lathe",
       "(40,3) (30,-43) (40,3) (29,-43) (28.2,-43) (27.6,-43) (27,-43) (27,-43) (26.5,-43) "
       "(25.8,-43) (25.71,-43) (40,3)",
       false},
      {"haas-lathe/g32-straight-thread-passes.nc", "haas-lathe",
       "(19,3) (19,-20) (30,-20) (30,3) (18.4,3) (18.4,-20)"},
      {"haas-lathe/g32-chained-thread.nc", "haas-lathe",
       "(16.93,3) (16.93,-20) (25,-35) (25,-50) (35,-60)", false},
      // FANUC and NCT
      {"fanuc-nct/nct104m-O9888-rotation-main.nc", "nct-104m",
       "(60.017,-5.971) (92.517,50.321) (49.215,75.321) (19.215,23.359) (71.177,-6.641) "
       "(71.177,-6.641,30)"},
      {"fanuc-nct/nct104m-O9889-rotation-sub.nc", "nct-104m",
       "(15,20) (80,20) (80,70) (20,70) (20,10) (20,10,30)", false},
      {"fanuc-nct/nct104m-O9887-mirror-main.nc", "nct-104m",
       "(-15,10) (-60,10) (-80,70) (-25,70) (-25,5) (-25,5,30)"},
      {"fanuc-nct/nct104m-O9000-scaling-half-main.nc", "nct-104m",
       "(15,0) (7.5,12.990) (-7.5,12.990) (-15,0) (-7.5,-12.990) (7.5,-12.990) (15,0) (0,0)"},
      {"fanuc-nct/nct104m-O9001-scaling-up-main.nc", "nct-104m",
       "(45,0) (22.5,38.971) (-22.5,38.971) (-45,0) (-22.5,-38.971) (22.5,-38.971) (45,0) (0,0)"},
      {"fanuc-nct/fanuc0t-g77-stepped-shaft.nc", "fanuc-0t",
       "(46,20) (50,60) (42,20) (50,60) (40,20) (50,60) (60,80)"},
      {"fanuc-nct/nct104t-g77-stepped-shaft.nc", "nct-104t",
       "(46,20) (50,60) (42,20) (50,60) (40,20) (50,60) (60,80)"},
      {"fanuc-nct/fanuc0t-g77-taper.nc", "fanuc-0t", "(43,20) (36,20) (28,60) (36,20) (60,80)"},
      {"fanuc-nct/nct104t-g77-taper.nc", "nct-104t", "(43,20) (36,20) (25.4,60) (36,20) (60,80)"},
      {"fanuc-nct/nct104t-g79-facing-disc.nc", "nct-104t",
       "(32,28) (86,32) (32,25) (86,32) (32,22) (32,19) (32,16) (32,13) (32,10) (86,32) (90,60)"},
      {"fanuc-nct/nct104t-g79-facing-taper.nc", "nct-104t",
       "(54,46) (84,52) (54,42) (54,38) (54,34) (54,30) (84,25) (84,52) (90,60)"},
      {"fanuc-nct/nct104t-O500-g73-pattern-repeat.nc", "nct-104t",
       "(40,64) (40,50) (50,45) (60,30) (70,25) (200,130)"},
      {"fanuc-nct/nct104t-O502-g74-face-groove.nc", "nct-104t", "(50,5) (100,80)"},
      {"fanuc-nct/nct104t-O503-g75-radial-groove.nc", "nct-104t", "(100,60)"},
      {"fanuc-nct/nct104t-O504-g76-multi-thread.nc", "nct-104t", "(52,80)"},
      {"fanuc-nct/nct104m-O003-hole-patterns.nc", "nct-104m",
       "(36,0) (25.456,25.456) (0,36) (20,36) (40,36) (60,36) (56,0) (76,0) (0,0,50)"},
      {"fanuc-nct/nct104m-O0007-hole-patterns.nc", "nct-104m",
       "(15,15) (25,25) (35,35) (65,35) (75,25) (85,15) (35.858,84.142) (35.858,55.858) "
       "(64.142,55.858) (64.142,84.142) (0,0,100)"},
      {"fanuc-nct/nct104t-O8071-L807-1-inner.nc", "nct-104t",
       "(32,0.5) (31,0) (29,-1) (27,-20) (20,-23.5) (15,-26) (16,28)"},
      {"fanuc-nct/nct104t-O5004-L5004E.nc", "nct-104t",
       "(16,1) (16,0) (20,-2) (20,-10) (16,-12) (24,-20) (38,-40) (41,-41.5) (50,100)"},
      {"fanuc-nct/nct104t-O5001-L5001E.nc", "nct-104t",
       "(12,1) (16,-1) (16,-12) (13,-14.598) (20,-28) (38,-44) (41,-45) (50,100)"},
      {"fanuc-nct/nct104t-O5002-L5002E.nc", "nct-104t",
       "(0,1) (0,0) (18,-12) (30,-25) (30,-45) "
       "(41,-50) (50,80)"},
      {"fanuc-nct/nct104t-O5008-L5008E.nc", "nct-104t",
       "(8,1) (12,-1) (12,-8) (18,-9.732) (18,-20) (14,-23.464) (26,-30) (30,-32) (32,-46) "
       "(32,-50) (52,-58) (56,-60) (56,100) (50,80)"},
      {"fanuc-nct/fanuc0t-g73-rough-g70-finish.nc", "fanuc-0t",
       "(100,65) (186.603,40) (140,30) (142,142)"},
      {"fanuc-nct/nct104t-g71-rough.nc", "nct-104t", "(100,65) (186.603,40) (140,30) (150,30)"},
      {"fanuc-nct/nct104t-O5001-g78-thread.nc", "nct-104t",
       "(47.2,-55) (46.5,-55) (46,-55) (45.5,-55) (41.185,-55) (52,100)"},
      {"fanuc-nct/nct104t-O807-2-L807-2-outer.nc", "nct-104t",
       "(7,1) (7,0.5) (11.5,-1.75) (16,-9.5) (38,-45) (41,-46.5) (50,100)"},
      {"fanuc-nct/nct104m-O0002-M0002.nc", "nct-104m", "(45,10) (60,-5) (75,10) (0,0,60)"},
      {"fanuc-nct/nct104m-O0001-M0001.nc", "nct-104m",
       "(0,5) (0,25) (-10,25) (-10,55) (0,55) (0,65) (-23.958,82.857) (-33.541,90) (-80,90) "
       "(-100,70) (-100,25) (-90,0) (-10,0) (1,11) (-75,-5) (-75,15) (-55,-5) (-55,15) "
       "(-50.858,74.142) (-65,80) (-79.142,74.142) (-85,60) (-79.142,45.858)",
       false},
      // MEFI
      {"mefi/10-three-holes-params-only.ncp", "mefi",
       "(150,20,2) (150,20,-10) (150,20,20) (210,60,-10) (250,80,-10) (250,80,20)"},
      {"mefi/11-three-holes-with-drilling.ncp", "mefi",
       "(150,20,-10) (210,60,-10) (250,80,-10) (250,80,20)"},
      {"mefi/d1-three-holes-extra-hole.ncp", "mefi",
       "(50,0,-10) (150,20,-10) (210,60,-10) (250,80,-10) (250,80,20)"},
      {"mefi/21-drill-test-g81-g87.ncp", "mefi",
       "(0,0,2) (0,0,-15) (0,0,10) (100,0,-15) (200,0,-15) (0,0,-4) (0,0,-10) (0,0,-16) (0,0,-20) "
       "(0,0,10) (0,0,-40) (0,0,2) (0,0,10) (0,0,-13) (0,0,2) (0,0,-23) (0,0,-50) (0,0,20)"},
      // Sinumerik
      {"sinumerik/SKOLA01.MPF", "sinumerik",
       "(10,10,0) (10,10,-1) (50,10,-1) (50,30,-1) (10,30,-1) (10,10,-1) (10,10,-2) (10,10,-3) "
       "(10,10,50)"},
      {"sinumerik/KOREKCE1.MPF", "sinumerik", "(0,-20) (0,60) (80,60) (80,0) (-20,0) (-30,-20,50)"},
      {"sinumerik/NAJEZD1.MPF", "sinumerik", "(0,60,-5) (80,60,-5) (80,0,-5) (40,-40) (40,-40,50)"},
      {"sinumerik/KAPSA1.MPF", "sinumerik", "(75,50,50) (75,50,100)"},
      {"sinumerik/KAPSA2.MPF", "sinumerik", "(40,40,50) (40,40,100)"},
      {"sinumerik/OBRYS72.MPF", "sinumerik",
       "(-40,-40,50) (0,0,-6) (0,60,-6) (60,60,-6) (80,40,-6) (80,0,-6) (0,0,-6)", false},
      {"sinumerik/SOUCAST.MPF", "sinumerik", "(10,10) (10,50) (70,10) (70,10,100)"},
      {"sinumerik/ARCHIV1.MPF", "sinumerik", "(30,0,-1) (0,12) (30,12,-1) (0,24,50)"},
      {"sinumerik/STRUKT.MPF", "sinumerik", "(20,0,-2) (40,0,-2) (60,0,-2) (60,10) (60,20)", false},
      {"sinumerik/SKOKY.MPF", "sinumerik", "(15,0,-3) (30,0,-3) (45,0,-3) (60,0,-3)", false},
      {"sinumerik/OPAK.MPF", "sinumerik",
       "(0,0,-5) (20,0,-5) (40,0,-5) (60,0,-5) (80,0) (80,10) (80,20) (80,30) (80,30,50)"},
      {"sinumerik/RMRIZ.MPF", "sinumerik",
       "(10,10) (35,10) (60,10) (10,25) (35,25) (60,25) (60,25,50)"},
      {"sinumerik/POSUNY.MPF", "sinumerik",
       "(20,15) (40,15) (40,25) (20,25) (60,15) (80,15) (80,25) (60,25) (60,15) (60,35) (50,35) "
       "(50,15) (0,0) (-20,0) (-20,10) (0,10) (40,0) (40,20) (0,20) (0,0,50)"},
      {"sinumerik/VRTANI.MPF", "sinumerik",
       "(10,10,-15) (40,10,-15) (40,40,-15) (10,60,-40) (30,60,-40) (50,60,-40) (70,60,-40) "
       "(95,20,-40) (87.5,32.990) (72.5,32.990) (65,20) (72.5,7.010) (87.5,7.010,-40)",
       false},
      {"sinumerik/PROCHL.MPF", "sinumerik",
       "(10,20) (40,20) (40,35) (10,35) (60,20) (90,20) (90,40) (60,40) (60,20,50)"},
      {"sinumerik/OBLOUKY.MPF", "sinumerik",
       "(20,0) (40,20) (60,40) (80,40) (80,40) (100,60) (120,80) (120,100,-6) (120,100,50)"},
      {"sinumerik/POLAR.MPF", "sinumerik", "(80,50) (50,80) (20,50) (20,20) (40,30) (40,30,50)"},
      {"sinumerik/ZAOBL.MPF", "sinumerik",
       "(57.172,0) (60,2.828) (60,32) (52,40) (3,40) (0,37) (0,0,50)"},
      {"sinumerik/JEDNOTKY.MPF", "sinumerik", "(25.4,50.8,5) (50,50,50)"},
      // ECS
      {"ecs/a-d01-g42-contour-filled.ecs", "ecs",
       "(90,240) (50,350) (225,200) (341.66,100) (550,343) (610,260)", false},
      {"ecs/a-d03-iff-three-way.ecs", "ecs", "(0,0) (10,0) (20,0) (20,10) (20,10,100)"},
      {"ecs/a-d07-g81-g83.ecs", "ecs",
       "(20,20,-10) (50,20,-10) (50,50,-10) (20,20,-10) (20,20,-18) (20,20,-22) (20,20,-26) "
       "(20,20,-30) (20,20,100)"},
      {"ecs/a-d10-g184-wrong-cancel.ecs", "ecs", "(20,20) (60,60)", false},
      {"ecs/a-d02-g48-tangent-filled.ecs", "ecs",
       "(30,80) (60,110) (156.57,70) (156.57,0) (0,0) (0,50) (30,80) (80,30,100)"},
      {"ecs/a-d06-MAIN.ecs", "ecs", "(0,0) (10,0) (10,10)", false, {{"SUBA", "a-d06-SUBA"}}},
      {"ecs/a-d11-indirect-and-computed.ecs",
       "ecs",
       "(0,0) (25,-1) (20,-1)",
       false,
       {{"100", "a-d11-100"}}},
      {"ecs/b-derived-mat-static.ecs", "ecs", "(230,150) (250,150) (250,150,100)", false},
      {"ecs/b-derived-trans-grid.ecs", "ecs",
       "(0,0) (20,0) (180,120) (200,120) (360,240) (380,240) (540,360) (560,360)", false},
      {"ecs/b-rotras.ecs", "ecs",
       "(198.600,235.594) (157.642,206.915) (215,125) (378.830,239.715) (321.473,321.630) "
       "(239.558,264.273) (182.200,346.188) (100.285,288.830) (157.642,206.915) "
       "(198.600,235.594,100)"},
      {"ecs/b-tracyl.ecs",
       "ecs",
       "(0,110) (0,120) (1200.09,120) (1200.09,110)",
       false,
       {},
       {"B", "Y"}},
      {"ecs/b-g728-main.ecs",
       "ecs",
       "(0,0,13) (0,0,10) (0,0,50)",
       true,
       {{"BOUNDARY", "b-g728-sub-BOUNDARY"}, {"HOLE", "b-g728-sub-HOLE"}}},
      {"ecs/b-g722-spiral.ecs", "ecs", "(0) (-10) (50)", true, {}, {"Z"}},
      {"ecs/b-derived-g778-main-fixed.ecs",
       "ecs",
       "(32) (24) (20) (100)",
       true,
       {{"CIRCLE", "b-derived-g778-sub-CIRCLE-fixed"},
        {"ISLAND", "b-derived-g778-sub-ISLAND-fixed"}},
       {"Z"}},
  };
  llvm::erase_if(list, [](const Way &w) { return !std::filesystem::exists(pathOf(w)); });
  return list;
}

/// The numbers of "(10,0) (10,20,5)".
std::vector<std::vector<double>> pointsOf(const std::string &text) {
  std::vector<std::vector<double>> points;
  const char *at = text.c_str();
  while ((at = std::strchr(at, '(')) != nullptr) {
    auto &point = points.emplace_back();
    do {
      char *end = nullptr;
      point.push_back(std::strtod(at + 1, &end));
      at = end;
    } while (*at == ',');
  }
  return points;
}

class ManualTraces : public testing::TestWithParam<Way> {};

TEST_P(ManualTraces, LeadThroughTheirPoints) {
  const Way &way = GetParam();
  const std::string dialect = way.dialect;
  const bool lathe = dialect.back() == 't' || dialect == "haas-lathe";
  const std::vector<std::string> axes = !way.axes.empty() ? way.axes
                                        : lathe           ? std::vector<std::string>{"X", "Z"}
                                                          : std::vector<std::string>{"X", "Y", "Z"};
  std::filesystem::path file = pathOf(way);
  test::Shop shop;
  if (!way.called.empty()) { // called by other names than the files have
    const std::filesystem::path folder = file.parent_path();
    const std::string ending = file.extension().string();
    for (const auto &[name, called] : way.called)
      shop.file(name + ending, test::contentsOf(folder / (called + ending)));
    shop.file("main" + ending, test::contentsOf(file));
    file = "main" + ending;
  }
  const test::ProcessResult result = shop.run({"trace", "--dialect", dialect, file.string()});
  EXPECT_EQ(result.err, "");
  std::vector<std::vector<double>> path; // NaN: not known
  for (const std::string &line : test::linesOf(result.out)) {
    const auto json = nlohmann::json::parse(line, nullptr, false);
    ASSERT_TRUE(json.is_object()) << line;
    if (!json.contains("to"))
      continue;
    auto &point = path.emplace_back();
    for (const std::string &axis : axes) {
      const auto to = json["to"].find(axis); // an axis of which nothing is known may be absent
      point.push_back(to != json["to"].end() && to->is_number() ? to->get<double>() : NAN);
    }
  }
  const auto meets = [](const std::vector<double> &place, const std::vector<double> &point) {
    for (size_t i = 0; i < point.size(); ++i)
      if (!(std::fabs(place[i] - point[i]) <= 0.001 + 1e-9))
        return false;
    return true;
  };
  const auto points = pointsOf(way.points);
  size_t at = 0;
  for (const auto &point : points) {
    while (at < path.size() && !meets(path[at], point))
      ++at;
    ASSERT_LT(at, path.size()) << "not reached in its turn: " << testing::PrintToString(point)
                               << '\n'
                               << result.out;
  }
  if (way.ends) {
    EXPECT_TRUE(meets(path.back(), points.back())) << result.out;
  }
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ManualTraces);
INSTANTIATE_TEST_SUITE_P(Corpus, ManualTraces, testing::ValuesIn(ways()), [](const auto &info) {
  std::string name = info.param.file;
  for (char &c : name)
    c = llvm::isAlnum(c) ? c : '_';
  return name;
});

} // namespace
} // namespace ncvet
