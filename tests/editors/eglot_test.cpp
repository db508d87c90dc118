// Programs in Emacs with Eglot as lsp/editors/ sets it up: the second opinion. Skipped where there
// is no Emacs, or no Eglot.
#include "tests/editors/editor_journeys.h"
#include "tests/support/places.h"
#include "tests/support/thorough.h"

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

/// Does the steps by tests/editors/eglot.el.
void runEglot(EditorPlan &plan) {
  if (!haveEglot())
    GTEST_SKIP() << "Emacs or Eglot is absent: the language server is not tried with them";
  const std::string file = plan.write(places::sourceFolder() + "/lsp/editors/emacs/ncvet.el"),
                    home = (plan.folder() / "home").string();
  std::filesystem::create_directories(home);
  const int status =
      runOuter({"env", "NCVET_PLAN=" + file, "HOME=" + home, "XDG_CACHE_HOME=" + home, "emacs",
                "--batch", "-q", "-l", places::sourceFolder() + "/tests/editors/eglot.el"},
               plan.log(), 300);
  plan.expectDone(status);
}

class EglotWith : public testing::TestWithParam<std::string> {};

/// One session does all steps: what it shows is what the command line says, as a program is opened
/// and after every edit; fixes end their findings.
TEST_P(EglotWith, DoesWhatAUserDoes) {
  EditorPlan plan(GetParam());
  addPrograms(plan, "open", GetParam(), tried(2, 4));
  addPrograms(plan, "edit", GetParam(), 2);
  addPrograms(plan, "fix", GetParam(), 40);
  addJourneys(plan, GetParam());
  runEglot(plan);
}

INSTANTIATE_TEST_SUITE_P(Controls, EglotWith, testing::ValuesIn(controls()), controlName);

} // namespace
} // namespace ncvet::test
