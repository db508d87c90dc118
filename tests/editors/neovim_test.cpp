// Programs in Neovim with its client as lsp/editors/ sets it up. Skipped where there is no Neovim.
#include "tests/editors/editor_journeys.h"
#include "tests/support/places.h"
#include "tests/support/thorough.h"

#include "gtest/gtest.h"

namespace ncvet::test {
namespace {

/// Does the steps by tests/editors/neovim.lua.
void runNeovim(EditorPlan &plan) {
  if (!llvm::sys::findProgramByName("nvim"))
    GTEST_SKIP() << "nvim is absent: the language server is not tried with Neovim";
  const std::string file = plan.write(places::sourceFolder() + "/lsp/editors/neovim"),
                    home = (plan.folder() / "home").string();
  const int status =
      runOuter({"env", "NCVET_PLAN=" + file, "HOME=" + home, "XDG_CONFIG_HOME=" + home,
                "XDG_DATA_HOME=" + home, "XDG_STATE_HOME=" + home, "XDG_CACHE_HOME=" + home, "nvim",
                "--headless", "-u", "NONE", "-i", "NONE", "-n", "-c",
                "luafile " + places::sourceFolder() + "/tests/editors/neovim.lua"},
               plan.log(), 300);
  plan.expectDone(status);
}

class NeovimWith : public testing::TestWithParam<std::string> {};

/// One session does all steps: what it shows is what the command line says, as a program is opened
/// and after every edit; fixes and comments end their findings; hovers tell the machine's state.
TEST_P(NeovimWith, DoesWhatAUserDoes) {
  EditorPlan plan(GetParam());
  addPrograms(plan, "open", GetParam(), tried(3, 8));
  addPrograms(plan, "edit", GetParam(), 2);
  addPrograms(plan, "fix", GetParam(), 40);
  addPrograms(plan, "allow", GetParam(), 8);
  addPrograms(plan, "hover", GetParam(), 2);
  addJourneys(plan, GetParam());
  runNeovim(plan);
}

INSTANTIATE_TEST_SUITE_P(Controls, NeovimWith, testing::ValuesIn(controls()), controlName);

TEST(EditorJourneys, AreOfControlsThatAreThere) {
  const std::vector<std::string> known = controls();
  for (const Jump &jump : jumps)
    EXPECT_EQ(llvm::count(known, jump.dialect), 1) << jump.dialect;
  for (const Renaming &renaming : renamings)
    EXPECT_EQ(llvm::count(known, renaming.dialect), 1) << renaming.dialect;
}

} // namespace
} // namespace ncvet::test
