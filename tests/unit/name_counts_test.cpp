// How often names are in a text.
#include "analyzer/facts/name_counts.h"

#include <gtest/gtest.h>

namespace ncvet {
namespace {

TEST(NameCounts, CountNamesInLongerOnesTooAndWhereTheyDoNotOverlap) {
  NameCounts counts;
  for (const char *name : {"DEPTH", "DEP", "R", "AA", "_X", "NEVER"})
    counts.add(name);
  counts.countIn("DEF REAL DEPTH,DEPTH2\nDEP=R+_X AAAAA");
  EXPECT_EQ(2u, counts.of("DEPTH"));
  EXPECT_EQ(3u, counts.of("DEP"));
  EXPECT_EQ(2u, counts.of("R"));
  EXPECT_EQ(2u, counts.of("AA"));
  EXPECT_EQ(1u, counts.of("_X"));
  EXPECT_EQ(0u, counts.of("NEVER"));
  EXPECT_EQ(0u, counts.of("DEF"));
}

TEST(NameCounts, CountAsSearchingForEachNameDoes) {
  std::string text;
  for (unsigned i = 0; i < 2000; ++i)
    text += "DEF INT V" + std::to_string(i % 700) + "\nR1=V" + std::to_string(i * 7 % 900) + "\n";
  NameCounts counts;
  for (unsigned i = 0; i < 900; ++i)
    counts.add("V" + std::to_string(i));
  counts.countIn(text);
  for (unsigned i = 0; i < 900; ++i) {
    const std::string name = "V" + std::to_string(i);
    EXPECT_EQ(llvm::StringRef(text).count(name), counts.of(name)) << name;
  }
}

} // namespace
} // namespace ncvet
