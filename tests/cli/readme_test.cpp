// The commands that README.md shows print what it shows.
#include "tests/support/process.h"

namespace ncvet {
namespace {

constexpr llvm::StringLiteral indent = "    ";
constexpr llvm::StringLiteral prompt = "    $ ncvet ";

struct Shown {
  std::string arguments;
  std::string output;
};

/// Indented blocks of README.md that begin with a command behind a `$`.
std::vector<Shown> shownCommands() {
  const auto readme = llvm::MemoryBuffer::getFile(std::string(NCVET_SOURCE_DIR) + "/README.md");
  EXPECT_TRUE(readme);
  std::vector<Shown> shown;
  bool inside = false;
  llvm::StringRef rest = (*readme)->getBuffer();
  while (!rest.empty()) {
    llvm::StringRef line;
    std::tie(line, rest) = rest.split('\n');
    if (line.startswith(prompt)) {
      shown.push_back({line.drop_front(prompt.size()).str(), {}});
      inside = true;
    } else if (inside && line.startswith(indent)) {
      shown.back().output += (line.drop_front(indent.size()) + "\n").str();
    } else {
      inside = false;
    }
  }
  return shown;
}

TEST(Readme, ShowsWhatItsCommandsPrint) {
  const std::vector<Shown> shown = shownCommands();
  EXPECT_GE(shown.size(), 3u);
  test::Shop shop;
  std::filesystem::create_directory_symlink(std::string(NCVET_SOURCE_DIR) + "/tests",
                                            shop.path() / "tests");
  for (const Shown &command : shown) {
    llvm::SmallVector<llvm::StringRef, 4> words;
    llvm::StringRef(command.arguments).split(words, ' ');
    EXPECT_EQ(shop.run({words.begin(), words.end()}).out, command.output) << command.arguments;
  }
}

} // namespace
} // namespace ncvet
