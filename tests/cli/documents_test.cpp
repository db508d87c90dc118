// README.md and docs/: their commands print what they show, their JSON files are accepted, their
// links lead to files.
#include "tests/support/places.h"
#include "tests/support/plain_words.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

namespace ncvet {
namespace {

constexpr llvm::StringLiteral indent = "    ";
constexpr llvm::StringLiteral prompt = "    $ ncvet ";

struct Document {
  std::string path; ///< from the project's folder
  std::string text;
};

std::vector<Document> documents() {
  const std::filesystem::path root = places::sourceFolder();
  std::vector<std::filesystem::path> paths = {root / "README.md", root / "CONTRIBUTING.md",
                                              root / "rulesets/README.md"};
  for (const auto &entry : std::filesystem::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md")
      paths.push_back(entry.path());
  std::vector<Document> all;
  for (const std::filesystem::path &path : paths)
    if (const auto buffer = llvm::MemoryBuffer::getFile(path.string()))
      all.push_back({path.lexically_relative(root).string(), (*buffer)->getBuffer().str()});
  return all;
}

struct Shown {
  std::string arguments;
  std::string output;
};

/// Indented blocks that begin with a command after a `$`.
std::vector<Shown> shownCommands(llvm::StringRef rest) {
  std::vector<Shown> shown;
  bool inside = false;
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

TEST(Documents, ShowWhatTheirCommandsPrint) {
  test::Shop shop;
  std::filesystem::create_directory_symlink(places::sourceFolder() + "/tests",
                                            shop.path() / "tests");
  size_t count = 0;
  for (const Document &document : documents())
    for (const Shown &command : shownCommands(document.text)) {
      llvm::SmallVector<llvm::StringRef, 4> words;
      llvm::StringRef(command.arguments).split(words, ' ');
      const test::ProcessResult result = shop.run({words.begin(), words.end()});
      EXPECT_EQ(result.out + result.err, command.output)
          << document.path << ": " << command.arguments;
      ++count;
    }
  EXPECT_GE(count, 3u);
}

/// Files that a document gives in full: fences of the form ```json NAME.
std::vector<std::pair<std::string, std::string>> givenFiles(llvm::StringRef text) {
  std::vector<std::pair<std::string, std::string>> files;
  while (!text.empty()) {
    text = text.split("\n```json ").second;
    const auto [name, rest] = text.split('\n');
    const auto [content, after] = rest.split("\n```");
    if (!name.empty())
      files.emplace_back(name.str(), content.str());
    text = after;
  }
  return files;
}

TEST(Documents, GiveConfigurationsAndMachineProfilesThatAreAccepted) {
  size_t count = 0;
  for (const Document &document : documents()) {
    test::Shop shop;
    const auto files = givenFiles(document.text);
    for (const auto &[name, content] : files)
      shop.file(name, content);
    if (files.empty())
      continue;
    shop.file("a.nc", test::programWithoutFeed());
    const test::ProcessResult result = shop.run({"check", "a.nc"});
    EXPECT_EQ(1, result.exitCode) << document.path << ": " << result.err;
    EXPECT_THAT(result.out, ::testing::HasSubstr("[feed-missing]")) << document.path;
    count += files.size();
  }
  EXPECT_GE(count, 2u);
}

TEST(Documents, AreWrittenInPlainWords) {
  for (const Document &document : documents())
    EXPECT_EQ(std::vector<std::string>(), test::hardWords(document.text)) << document.path;
}

TEST(Documents, LinkToFilesThatExist) {
  for (const Document &document : documents()) {
    const auto folder =
        (std::filesystem::path(places::sourceFolder()) / document.path).parent_path();
    llvm::StringRef text = document.text;
    while (!text.empty()) {
      text = text.split("](").second;
      const llvm::StringRef target = text.take_until([](char c) { return c == ')' || c == '#'; });
      if (target.empty() || target.contains("://"))
        continue;
      EXPECT_TRUE(std::filesystem::exists(folder / target.str()))
          << document.path << ": " << target.str();
    }
  }
}

} // namespace
} // namespace ncvet
