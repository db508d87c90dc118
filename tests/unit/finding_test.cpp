// Tests of formats/finding: names and fingerprints.
#include "formats/finding/finding.h"
#include "formats/finding/fingerprint.h"

#include <gtest/gtest.h>

#include <set>

using namespace ncvet;

namespace {

/// Range of `part` in the file's text.
SourceRange rangeOf(const SourceFile &file, llvm::StringRef part) {
  const size_t begin = file.text().find(part);
  EXPECT_TRUE(begin != llvm::StringRef::npos) << part.str();
  return {file.id(), static_cast<uint32_t>(begin), static_cast<uint32_t>(begin + part.size())};
}

} // namespace

TEST(FindingTest, SeveritiesAreReadAsTheyAreWritten) {
  for (const Severity severity : {Severity::Style, Severity::Warning, Severity::Error})
    EXPECT_EQ(parseSeverity(toString(severity)), severity);
  EXPECT_EQ(parseSeverity("Error"), std::nullopt);
  EXPECT_EQ(parseSeverity(""), std::nullopt);
  EXPECT_EQ(toString(Certainty::Definite), "definite");
  EXPECT_EQ(toString(Certainty::Possible), "possible");
  EXPECT_EQ(toString(FixSafety::Safe), "safe");
  EXPECT_EQ(toString(FixSafety::Unsafe), "unsafe");
}

TEST(FindingTest, SeveritiesAreOrderedFromStyleToError) {
  EXPECT_LT(Severity::Style, Severity::Warning);
  EXPECT_LT(Severity::Warning, Severity::Error);
}

TEST(FingerprintTest, ABlocksNumberBlanksAndCommentsDoNotCount) {
  const auto file = SourceFile::fromText(0, "a.nc", "N10 G1  x1.5 (TO CLAMP) F200 (FAST)\n");
  EXPECT_EQ(fingerprintText(
                *file, rangeOf(*file, "N10 G1  x1.5 (TO CLAMP) F200 (FAST)\n"),
                {rangeOf(*file, "N10"), rangeOf(*file, "(TO CLAMP)"), rangeOf(*file, "(FAST)")}),
            "G1X1.5F200");
}

TEST(FingerprintTest, PartsOutsideTheBlockAreIgnored) {
  const auto file = SourceFile::fromText(0, "a.nc", "(A)\nG1 X1\n(B)\n");
  EXPECT_EQ(fingerprintText(*file, rangeOf(*file, "G1 X1"),
                            {rangeOf(*file, "(A)"), rangeOf(*file, "(B)")}),
            "G1X1");
}

TEST(FingerprintTest, ALongBlockIsToldByItsBeginAndAHash) {
  const std::string text = "G1" + std::string(5000, '1');
  const auto textOf = [](const std::string &block) {
    const auto file = SourceFile::fromText(0, "a.nc", block);
    return fingerprintText(*file, {0, 0, uint32_t(block.size())}, {});
  };
  EXPECT_LT(textOf(text).size(), 1100u);
  EXPECT_EQ(textOf(text), textOf(text));
  EXPECT_NE(textOf(text), textOf(text + "2"));
}

TEST(FingerprintTest, EqualFindingsAreNumbered) {
  Fingerprints first;
  Fingerprints second;
  std::set<uint64_t> distinct;
  for (int i = 0; i < 5; ++i) {
    const uint64_t fingerprint = first.next("missing-feed", "O0100", "G1X1");
    EXPECT_EQ(fingerprint, second.next("missing-feed", "O0100", "G1X1"));
    distinct.insert(fingerprint);
    // Another finding between them changes nothing.
    first.next("missing-feed", "O0100", "G1X" + std::to_string(i + 2));
  }
  EXPECT_EQ(distinct.size(), 5u);
}

TEST(FingerprintTest, RuleProgramAndBlockAreTellingApart) {
  std::set<uint64_t> distinct;
  for (const char *rule : {"a", "ab"})
    for (const char *program : {"bc", "c"})
      for (const char *block : {"d", "cd"})
        distinct.insert(Fingerprints().next(rule, program, block));
  EXPECT_EQ(distinct.size(), 8u);
}

TEST(FingerprintTest, AFingerprintIsTheSameInEveryRelease) {
  // Baselines in the shops' repositories hold these values.
  EXPECT_EQ(fingerprintString(Fingerprints().next("missing-feed", "O0100", "G1X1")),
            "104e26a4dbac2b78");
  EXPECT_EQ(fingerprintString(0x1F), "000000000000001f");
}
