// References and highlights: every place of a name.
#include "lsp/features/navigation/highlight.h"
#include "lsp/features/navigation/references.h"
#include "tests/support/marked_text.h"
#include "tests/support/run_program.h"

#include "gtest/gtest.h"

#include <fstream>

namespace {

using namespace ncvet;
using namespace ncvet::lsp;

/// "file:line" of each reference to the first mark; the document has no file name.
std::vector<std::string> placesOf(const test::MarkedText &text, bool definitions,
                                  const std::vector<std::string> &paths = {}) {
  std::vector<std::string> places;
  for (const SourceRange &range : references(*text, text.marks[0], definitions, paths)) {
    const SourceFile &file = text->project().sources().get(range.file);
    const std::string name = range.file == text->source().id()
                                 ? ""
                                 : std::filesystem::path(file.path()).filename().string() + ":";
    places.push_back(name + std::to_string(file.position(range.begin).line));
  }
  return places;
}

using Places = std::vector<std::string>;

TEST(References, WithAndWithoutTheDefinition) {
  const auto text = test::markedText("fanuc-0m", "N10 G0\nIF [#1 EQ 2] GOTO 1<|>0\nGOTO 10\n");
  EXPECT_EQ(placesOf(text, true), (Places{"1", "2", "3"}));
  EXPECT_EQ(placesOf(text, false), (Places{"2", "3"}));
}

TEST(References, OfAVariableLeaveItsFirstAssignmentOut) {
  const auto text = test::markedText("fanuc-0m", "#100=1\n#100=2\nX#<|>100\n");
  EXPECT_EQ(placesOf(text, true), (Places{"1", "2", "3"}));
  EXPECT_EQ(placesOf(text, false), (Places{"2", "3"}));
}

TEST(References, OfAProgramInFurtherFiles) {
  const test::TemporaryFolder folder;
  const auto write = [&](const char *name, const char *text) {
    std::ofstream(folder.path() / name, std::ios::binary) << text;
    return (folder.path() / name).string();
  };
  const std::vector<std::string> paths = {
      write("O2000.nc", "O2000\nM99\n"), write("O3.nc", "O3\nM98 P2000\nM30\n"),
      write("O4.nc", "O4\nM98 P2000\nM30\nO2000\nM99\n"), // has one of its own
      (folder.path() / "missing.nc").string()};
  const auto text =
      test::markedText("fanuc-0m", "O1\nM98 P2<|>000\nM30\n", (folder.path() / "O1.nc").string());
  EXPECT_EQ(placesOf(text, true, paths), (Places{"2", "O2000.nc:1", "O3.nc:2"}));
  EXPECT_EQ(placesOf(text, false, paths), (Places{"2", "O3.nc:2"}));
}

TEST(References, AreNoneWhereNoNameIs) {
  EXPECT_EQ(placesOf(test::markedText("mefi", "N10 X1<|>0\n"), true), Places());
  EXPECT_EQ(placesOf(test::markedText("ecs", "<|>"), true), Places());
}

/// "line r" or "line w" of each highlight.
std::vector<std::string> highlightsOf(const char *dialect, llvm::StringRef program) {
  const auto text = test::markedText(dialect, program);
  std::vector<std::string> all;
  for (const Highlight &one : highlights(*text, text.marks[0]))
    all.push_back(std::to_string(text->source().position(one.range.begin).line) +
                  (one.writes ? " w" : " r"));
  return all;
}

TEST(Highlights, TellReadsFromWrites) {
  EXPECT_EQ(highlightsOf("fanuc-0m", "#1=1\n#<|>1=#1+1\nX#1\n"),
            (Places{"1 w", "2 w", "2 r", "3 r"}));
  EXPECT_EQ(highlightsOf("sinumerik", "AA: G0\nGOTOB A<|>A\n"), (Places{"1 w", "2 r"}));
  EXPECT_EQ(highlightsOf("haas-lathe", "T0101\nG0\nT02<|>02\nT0212\n"), (Places{"3 r", "4 r"}));
}

} // namespace
