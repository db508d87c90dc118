// The packed extension in a real VS Code, driven as a user would. Skipped where it is not
// installed:
// `./dev packages vscode` does it.
#include "tests/support/packed_extension.h"
#include "tests/support/places.h"
#include "tests/support/run_program.h"

#include "gtest/gtest.h"
#include <nlohmann/json.hpp>

#include <fstream>

namespace ncvet::test {
namespace {

namespace fs = std::filesystem;

const fs::path steps = fs::path(places::sourceFolder()) / "tests" / "editors" / "vscode";

/// Where `./dev packages vscode` has installed VS Code for this test; nothing when it has not.
std::optional<fs::path> installed(const fs::path &folder) {
  const fs::path log = folder / "where";
  if (runOuter({"sh", (steps / "install.sh").string(), "--where"}, log, 60) != 0)
    return std::nullopt;
  const fs::path modules = fs::path(llvm::StringRef(contentsOf(log)).trim().str()) / "node_modules";
  return fs::exists(modules) ? std::optional(modules) : std::nullopt;
}

/// Runs a driver of VS Code with the extension; fails with each line that it says but for times.
void drive(const fs::path &modules, const char *driver, const fs::path &packed,
           const fs::path &folder) {
  // Pictures of each step are kept for whoever wants to look at them.
  const char *const pictures = std::getenv("NCVET_PICTURES");
  nlohmann::json plan = {{"modules", modules.string()},
                         {"ncvet", places::program()},
                         {"packed", packed.string()},
                         {"folder", (folder / "editor").string()}};
  if (pictures)
    plan["pictures"] = pictures;
  fs::create_directory(folder / "editor");
  std::ofstream(folder / "plan.json") << plan;
  const fs::path log = folder / "steps";
  constexpr unsigned seconds = 300; // one minute on a machine that has nothing else to do
  EXPECT_EQ(
      runOuter({"node", (steps / driver).string(), (folder / "plan.json").string()}, log, seconds),
      0);
  expectDone(log);
}

/// Packs the extension, and drives VS Code with it.
void driveWith(const char *driver, PackedServer server) {
  const TemporaryFolder temporary;
  const auto modules = installed(temporary.path());
  if (!modules || !llvm::sys::findProgramByName("chromium"))
    GTEST_SKIP() << "./dev packages vscode installs VS Code for this test: it is not there";
  const fs::path log = temporary.path() / "log";
  const auto packed = packExtension(temporary.path() / "package", log, server);
  if (!packed)
    GTEST_SKIP() << "npm cannot fetch what the extension is built with: " << contentsOf(log);
  drive(*modules, driver, *packed, temporary.path());
}

TEST(Vscode, DoesWhatAUserDoes) { driveWith("drive.mjs", PackedServer::Program); }

TEST(Vscode, ChecksProgramsInABrowser) {
  if (!fs::exists(fs::path(places::sourceFolder()) / "build/package/npm/package/lib/ncvet.wasm"))
    GTEST_SKIP() << "./dev package npm makes the module that runs in a browser: it is not there";
  driveWith("web.mjs", PackedServer::InBrowser);
}

} // namespace
} // namespace ncvet::test
