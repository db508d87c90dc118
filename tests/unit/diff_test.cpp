// Unified diffs: exact hunks, and a law: what the diff says is what changed.
#include "formats/text/diff.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace ncvet {
namespace {

std::string diffOf(llvm::StringRef before, llvm::StringRef after) {
  std::string out;
  llvm::raw_string_ostream stream(out);
  writeUnifiedDiff(before, after, "a.nc", stream);
  return stream.str();
}

/// Applies a diff as `patch` would; empty and false when it does not fit.
bool patched(llvm::StringRef before, llvm::StringRef diff, std::string &out) {
  std::vector<std::string> lines;
  for (llvm::StringRef rest = before; !rest.empty();) {
    const size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
    lines.push_back(rest.take_front(end).str());
    rest = rest.drop_front(end);
  }
  size_t at = 0;
  std::string last;
  while (!diff.empty()) {
    const size_t end = std::min(diff.find('\n'), diff.size() - 1) + 1;
    const llvm::StringRef line = diff.take_front(end);
    diff = diff.drop_front(end);
    if (line.startswith("---") || line.startswith("+++"))
      continue;
    if (line.startswith("@@ -")) {
      size_t begin = 0;
      llvm::StringRef numbers = line.drop_front(4);
      numbers.consumeInteger(10, begin);
      size_t count = 1;
      if (numbers.consume_front(","))
        numbers.consumeInteger(10, count);
      begin -= count ? 1 : 0;
      for (; at < begin; ++at)
        out += lines[at];
      continue;
    }
    if (line.startswith("\\")) {
      if (last != "-")
        out.pop_back(); // the line that was added last has no end
      else
        lines[at - 1].pop_back();
      continue;
    }
    std::string text = line.drop_front().str();
    last = line.take_front().str();
    if (diff.startswith("\\") && last != "+")
      text.pop_back();
    if (last != "+") {
      if (at >= lines.size() || lines[at] != text)
        return false;
      if (diff.startswith("\\"))
        lines[at] += "\n";
      ++at;
    }
    if (last != "-")
      out += diff.startswith("\\") && last == " " ? text + "\n" : text;
  }
  for (; at < lines.size(); ++at)
    out += lines[at];
  return true;
}

TEST(UnifiedDiff, EqualTextsHaveNone) { EXPECT_EQ("", diffOf("M30\n", "M30\n")); }

TEST(UnifiedDiff, ShowsThreeLinesAroundAChange) {
  EXPECT_EQ("--- a.nc\n+++ a.nc\n@@ -2,7 +2,8 @@\n N2\n N3\n N4\n-N5\n+N5 G80\n+N5 M9\n N6\n N7\n"
            " N8\n",
            diffOf("N1\nN2\nN3\nN4\nN5\nN6\nN7\nN8\nN9\n",
                   "N1\nN2\nN3\nN4\nN5 G80\nN5 M9\nN6\nN7\nN8\nN9\n"));
}

TEST(UnifiedDiff, SaysWhereTheLastLineHasNoEnd) {
  EXPECT_EQ("--- a.nc\n+++ a.nc\n@@ -1 +1,2 @@\n-M5\n\\ No newline at end of file\n+M5\n+M30\n",
            diffOf("M5", "M5\nM30\n"));
}

TEST(UnifiedDiff, FromNothingAndToNothing) {
  EXPECT_EQ("--- a.nc\n+++ a.nc\n@@ -0,0 +1 @@\n+M30\n", diffOf("", "M30\n"));
  EXPECT_EQ("--- a.nc\n+++ a.nc\n@@ -1 +0,0 @@\n-M30\n", diffOf("M30\n", ""));
}

TEST(UnifiedDiff, PatchingWithItGivesTheNewText) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    std::string before, after;
    const int lines = int(random() % 60);
    for (int i = 0; i < lines; ++i) {
      const std::string line = "X" + std::to_string(random() % 5) + "\n";
      const unsigned change = random() % 12;
      if (change != 0)
        before += line;
      if (change != 1)
        after += line;
      if (change == 2)
        after += "M8\n";
    }
    std::string result;
    const std::string diff = diffOf(before, after);
    ASSERT_TRUE(patched(before, diff, result)) << before << "\n=>\n" << after << "\n" << diff;
    ASSERT_EQ(after, result) << diff;
  }
}

TEST(UnifiedDiff, LongStretchesThatDifferAreReplaced) {
  std::string before, after;
  for (int i = 0; i < 3000; ++i) {
    before += "X" + std::to_string(i) + "\n";
    after += "Y" + std::to_string(i) + "\n";
  }
  std::string result;
  ASSERT_TRUE(patched(before, diffOf(before, after), result));
  EXPECT_EQ(after, result);
}

} // namespace
} // namespace ncvet
