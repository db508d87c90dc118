// The packed extension in a real VS Code, driven as a user would. Skipped where it is not
// installed:
// `./dev packages vscode` does it.
#include "tests/support/packed_extension.h"
#include "tests/support/run_program.h"

#include "gtest/gtest.h"
#include <nlohmann/json.hpp>

#include <fstream>

namespace ncvet::test {
namespace {

namespace fs = std::filesystem;

const fs::path steps = fs::path(NCVET_SOURCE_DIR) / "tests" / "editors" / "vscode";

/// Where `./dev packages vscode` has installed VS Code for this test; nothing when it has not.
std::optional<fs::path> installed(const fs::path &folder) {
  const fs::path log = folder / "where";
  if (runOuter({"sh", (steps / "install.sh").string(), "--where"}, log, 60) != 0)
    return std::nullopt;
  const fs::path modules = fs::path(llvm::StringRef(contentsOf(log)).trim().str()) / "node_modules";
  return fs::exists(modules) ? std::optional(modules) : std::nullopt;
}

TEST(Vscode, DoesWhatAUserDoes) {
  const TemporaryFolder temporary;
  const auto modules = installed(temporary.path());
  if (!modules || !llvm::sys::findProgramByName("chromium"))
    GTEST_SKIP() << "./dev packages vscode installs VS Code for this test: it is not there";
  fs::path log = temporary.path() / "log";
  const auto packed = packExtension(temporary.path() / "package", log);
  if (!packed)
    GTEST_SKIP() << "npm cannot fetch what the extension is built with: " << contentsOf(log);
  // Pictures of each step are kept for whoever wants to look at them.
  const char *const pictures = std::getenv("NCVET_PICTURES");
  const nlohmann::json plan = {
      {"modules", modules->string()},
      {"ncvet", NCVET_BINARY},
      {"packed", packed->string()},
      {"folder", (temporary.path() / "editor").string()},
      {"pictures", pictures ? pictures : (temporary.path() / "pictures").string()}};
  fs::create_directory(temporary.path() / "editor");
  std::ofstream(temporary.path() / "plan.json") << plan;
  log = temporary.path() / "steps";
  constexpr unsigned seconds =
      300; // one and a half minutes on a machine that has nothing else to do
  const int status =
      runOuter({"node", (steps / "drive.mjs").string(), (temporary.path() / "plan.json").string()},
               log, seconds);
  EXPECT_EQ(status, 0);
  // What went wrong is a line each, before the last one; how long a step took begins with a number.
  llvm::SmallVector<llvm::StringRef, 64> lines;
  const std::string said = contentsOf(log);
  llvm::StringRef(said).split(lines, '\n', -1, /*KeepEmpty=*/false);
  EXPECT_TRUE(llvm::is_contained(lines, "done")) << said;
  for (const llvm::StringRef line : lines)
    if (line != "done" && !line.startswith("took "))
      ADD_FAILURE() << line.str();
}

} // namespace
} // namespace ncvet::test
