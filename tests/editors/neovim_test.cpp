// Programs in Neovim with its client as lsp/editors/ sets it up. Skipped where there is no Neovim.
#include "tests/editors/editor_journeys.h"

#include "gtest/gtest.h"

namespace ncvet::test {
namespace {

/// Runs one step of tests/editors/neovim.lua.
void runNeovim(EditorPlan &plan) {
  if (!llvm::sys::findProgramByName("nvim"))
    GTEST_SKIP() << "nvim is absent: the language server is not tried with Neovim";
  plan.set("plugin", NCVET_SOURCE_DIR "/lsp/editors/neovim");
  const std::string file = plan.write(), home = (plan.folder() / "home").string();
  const int status =
      runOuter({"env", "NCVET_PLAN=" + file, "HOME=" + home, "XDG_CONFIG_HOME=" + home,
                "XDG_DATA_HOME=" + home, "XDG_STATE_HOME=" + home, "XDG_CACHE_HOME=" + home, "nvim",
                "--headless", "-u", "NONE", "-i", "NONE", "-n", "-c",
                "luafile " NCVET_SOURCE_DIR "/tests/editors/neovim.lua"},
               plan.log(), 300);
  plan.expectDone(status);
}

class NeovimWith : public testing::TestWithParam<std::string> {};

TEST_P(NeovimWith, ShowsWhatTheCommandLineSays) {
  EditorPlan plan("open", GetParam());
  addPrograms(plan, GetParam(), 8);
  runNeovim(plan);
}

TEST_P(NeovimWith, ShowsItAfterEveryEdit) {
  EditorPlan plan("edit", GetParam());
  addPrograms(plan, GetParam(), 3);
  runNeovim(plan);
}

TEST_P(NeovimWith, MendsFindings) {
  EditorPlan plan("fix", GetParam());
  addPrograms(plan, GetParam(), 40);
  runNeovim(plan);
}

TEST_P(NeovimWith, SilencesFindings) {
  EditorPlan plan("allow", GetParam());
  addPrograms(plan, GetParam(), 8);
  runNeovim(plan);
}

TEST_P(NeovimWith, TellsTheMachinesState) {
  EditorPlan plan("hover", GetParam());
  addPrograms(plan, GetParam(), 2);
  runNeovim(plan);
}

INSTANTIATE_TEST_SUITE_P(Controls, NeovimWith, testing::ValuesIn(controls()), controlName);

class NeovimJump : public testing::TestWithParam<Jump> {};
TEST_P(NeovimJump, LeadsToTheDefinition) {
  EditorPlan plan = planOf(GetParam());
  runNeovim(plan);
}
INSTANTIATE_TEST_SUITE_P(All, NeovimJump, testing::ValuesIn(jumps),
                         [](const auto &jump) { return std::string(jump.param.name); });

class NeovimRenaming : public testing::TestWithParam<Renaming> {};
TEST_P(NeovimRenaming, ChangesEveryPlace) {
  EditorPlan plan = planOf(GetParam());
  runNeovim(plan);
}
INSTANTIATE_TEST_SUITE_P(All, NeovimRenaming, testing::ValuesIn(renamings),
                         [](const auto &renaming) { return std::string(renaming.param.name); });

TEST(Neovim, ShowsTheStateInAWindow) {
  EditorPlan plan = planOfState();
  runNeovim(plan);
}

TEST(Neovim, CountsColumnsBehindCommentsInAnyScript) {
  EditorPlan plan = planOfColumns();
  runNeovim(plan);
}

} // namespace
} // namespace ncvet::test
