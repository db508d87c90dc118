// Programs in Emacs with Eglot as lsp/editors/ sets it up: the second opinion. Skipped where there
// is no Emacs, or no Eglot.
#include "tests/editors/editor_journeys.h"

#include "gtest/gtest.h"

namespace ncvet::test {
namespace {

/// Whether Emacs has Eglot, of its own or as a package.
bool haveEglot() {
  static const bool have = [] {
    const TemporaryFolder folder;
    return runOuter({"emacs", "--batch", "-q", "--eval",
                     "(progn (require 'package) (package-initialize)"
                     " (kill-emacs (if (locate-library \"eglot\") 0 1)))"},
                    folder.path() / "log", 60) == 0;
  }();
  return have;
}

/// Runs one step of tests/editors/eglot.el.
void runEglot(EditorPlan &plan) {
  if (!haveEglot())
    GTEST_SKIP() << "Emacs or Eglot is absent: the language server is not tried with them";
  plan.set("plugin", NCVET_SOURCE_DIR "/lsp/editors/emacs/ncvet.el");
  const std::string file = plan.write(), home = (plan.folder() / "home").string();
  std::filesystem::create_directories(home);
  const int status =
      runOuter({"env", "NCVET_PLAN=" + file, "HOME=" + home, "XDG_CACHE_HOME=" + home, "emacs",
                "--batch", "-q", "-l", NCVET_SOURCE_DIR "/tests/editors/eglot.el"},
               plan.log(), 300);
  plan.expectDone(status);
}

class EglotWith : public testing::TestWithParam<std::string> {};

TEST_P(EglotWith, ShowsWhatTheCommandLineSays) {
  EditorPlan plan("open", GetParam());
  addPrograms(plan, GetParam(), 4);
  runEglot(plan);
}

TEST_P(EglotWith, ShowsItAfterEveryEdit) {
  EditorPlan plan("edit", GetParam());
  addPrograms(plan, GetParam(), 2);
  runEglot(plan);
}

TEST_P(EglotWith, MendsFindings) {
  EditorPlan plan("fix", GetParam());
  addPrograms(plan, GetParam(), 40);
  runEglot(plan);
}

INSTANTIATE_TEST_SUITE_P(Controls, EglotWith, testing::ValuesIn(controls()), controlName);

class EglotJump : public testing::TestWithParam<Jump> {};
TEST_P(EglotJump, LeadsToTheDefinition) {
  EditorPlan plan = planOf(GetParam());
  runEglot(plan);
}
INSTANTIATE_TEST_SUITE_P(All, EglotJump, testing::ValuesIn(jumps),
                         [](const auto &jump) { return std::string(jump.param.name); });

class EglotRenaming : public testing::TestWithParam<Renaming> {};
TEST_P(EglotRenaming, ChangesEveryPlace) {
  EditorPlan plan = planOf(GetParam());
  runEglot(plan);
}
INSTANTIATE_TEST_SUITE_P(All, EglotRenaming, testing::ValuesIn(renamings),
                         [](const auto &renaming) { return std::string(renaming.param.name); });

TEST(Eglot, TellsTheState) {
  EditorPlan plan = planOfState();
  runEglot(plan);
}

TEST(Eglot, CountsColumnsBehindCommentsInAnyScript) {
  EditorPlan plan = planOfColumns();
  runEglot(plan);
}

} // namespace
} // namespace ncvet::test
