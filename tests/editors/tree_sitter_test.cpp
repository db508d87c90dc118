// The grammars of tree-sitter, run by tree-sitter: its generator makes parsers of them, and these
// the words of programs. Skipped where it is not installed: `./dev packages tree-sitter` does it.
#include "tests/support/places.h"
#include "tests/support/run_program.h"

#include "gtest/gtest.h"

#include <algorithm>

namespace ncvet::test {
namespace {

namespace fs = std::filesystem;

const fs::path tests = fs::path(places::sourceFolder()) / "tests" / "editors" / "tree_sitter";
const fs::path grammars = fs::path(places::sourceFolder()) / "lsp" / "editors" / "tree-sitter";
constexpr unsigned seconds = 120;

/// The generator that `./dev packages tree-sitter` has built; empty when it has not.
std::string generator(const fs::path &folder) {
  const fs::path log = folder / "where";
  if (runOuter({"sh", (tests / "install.sh").string(), "--where"}, log, seconds) != 0)
    return {};
  const fs::path binary = fs::path(llvm::StringRef(contentsOf(log)).trim().str()) / "generate";
  return fs::exists(binary) ? binary.string() : std::string();
}

/// A program that prints the words of files by this grammar; a failure of the test where there is
/// none.
fs::path wordsProgram(const std::string &generate, const fs::path &grammar,
                      const fs::path &folder) {
  const fs::path copy = folder / grammar.filename(), log = folder / "log", binary = copy / "words";
  fs::create_directory(copy);
  fs::copy(grammar / "grammar.js", copy / "grammar.js");
  EXPECT_EQ(runOuter({generate, copy.string()}, log, seconds), 0) << contentsOf(log);
  std::string name = grammar.filename().string();
  std::replace(name.begin(), name.end(), '-', '_');
  EXPECT_EQ(runOuter({"cc", "-DLANGUAGE=tree_sitter_" + name, "-I" + (copy / "src").string(),
                      (tests / "words.c").string(), (copy / "src" / "parser.c").string(),
                      "-ltree-sitter", "-o", binary.string()},
                     log, seconds),
            0)
      << contentsOf(log);
  return binary;
}

TEST(TreeSitter, FindsInThePagesProgramsTheWordsOfTheGrammarsAndNothingWrong) {
  const TemporaryFolder temporary;
  const std::string generate = generator(temporary.path());
  if (generate.empty())
    GTEST_SKIP() << "./dev packages tree-sitter builds its generator: it is not there";
  const fs::path log = temporary.path() / "parsed";
  for (const auto &entry : fs::directory_iterator(grammars)) {
    const fs::path words = wordsProgram(generate, entry.path(), temporary.path());
    EXPECT_EQ(runOuter({"node", (tests / "parse.mjs").string(), entry.path().string(),
                        words.string(), places::sourceFolder() + "/rules"},
                       log, seconds),
              0);
    expectDone(log);
  }
}

} // namespace
} // namespace ncvet::test
