// The view of the tool path as VS Code has it: what the server tells of an edit, taken into the
// path that is shown, gives the path of the text as it is now. Skipped where there is no Node.
#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/support/run_program.h"

#include "gtest/gtest.h"

namespace ncvet::test {
namespace {

namespace fs = std::filesystem;

std::string surface() {
  std::string text = "%\nO0001 (SURFACE)\nG17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S3000 M3\n"
                     "G43 H1 Z5.\nG1 Z-1. F200.\n";
  for (unsigned i = 0; i < 3000; ++i)
    text += "X" + std::to_string(i % 100) + "." + std::to_string(i % 7) + " Y" +
            std::to_string(i / 100) + ".\n" +
            (i % 40 ? "" : "G2 X5. Y" + std::to_string(i / 100) + ". R500.\nG1\n");
  return text + "G0 Z50.\nM30\n%\n";
}

std::string drilling() {
  std::string text =
      "%\nO0002\nG17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S900 M3\nG43 H1 Z5.\n";
  for (unsigned i = 0; i < 400; ++i) {
    const std::string n = std::to_string(i);
    text += "G83 X" + n + ". Y0. Z-20. R2. Q5. F" + std::to_string(100 + i % 3) + ".\nX" + n +
            ". Y10.\nG80\n" +
            (i % 100 ? ""
                     : "(ROW)\nT" + std::to_string(2 + i / 100) +
                           " M6\nG0 G43 H1 Z5. S1000 M3\nG4 P500\n");
  }
  return text + "M30\n%\n";
}

std::string turning() {
  std::string text = "%\nO0003\nG21 G40 G99 G97 S1000 M3\nT0101\nG0 X60. Z2.\n";
  for (unsigned i = 0; i < 400; ++i) {
    const std::string x = std::to_string(50 - i % 20);
    text += "G0 X" + x + ".\nG1 Z-" + std::to_string(i % 50) + ". F0." + std::to_string(1 + i % 4) +
            "\nG3 X" + std::to_string(52 - i % 20) + ". Z-" + std::to_string(i % 50 + 1) +
            ". R1.\nG0 Z2.\n";
  }
  return text + "G76 P010060 Q100 R0.1\nG76 X40. Z-30. P1000 Q400 F1.5\nM30\n%\n";
}

struct Edited {
  const char *name, *dialect;
  std::string (*text)();
};

class PathView : public testing::TestWithParam<Edited> {};

TEST_P(PathView, FollowsEditsAsIfAllWereDrawnAnew) {
  if (!llvm::sys::findProgramByName("node"))
    GTEST_SKIP() << "there is no Node";
  const TemporaryFolder temporary;
  const fs::path program = temporary.path() / "PART.nc", log = temporary.path() / "log";
  std::ofstream(program) << GetParam().text();
  const fs::path follow =
      fs::path(places::sourceFolder()) / "tests" / "editors" / "path_view" / "follow.mjs";
  const int status = runOuter(
      {"node", follow.string(), places::program(), program.string(), GetParam().dialect, "120"},
      log, 120);
  EXPECT_EQ(status, 0);
  expectDone(log);
}

INSTANTIATE_TEST_SUITE_P(Programs, PathView,
                         testing::Values(Edited{"Surfacing", "haas-mill", surface},
                                         Edited{"Drilling", "fanuc-mill", drilling},
                                         Edited{"Turning", "fanuc-lathe", turning}),
                         [](const auto &info) { return info.param.name; });

} // namespace
} // namespace ncvet::test
