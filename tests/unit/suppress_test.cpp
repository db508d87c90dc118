// Suppression comments: what each covers.
#include "analyzer/rule/rule_settings.h"
#include "tests/support/run_program.h"

#include <gtest/gtest.h>

namespace ncvet::test {
namespace {

/// Lines on which a finding of feed-missing would be suppressed.
std::vector<unsigned> suppressedLines(const std::string &text,
                                      const std::string &dialect = "haas-lathe") {
  SourceSet sources;
  const SourceFile &source = sources.add("a.nc", text);
  const auto reader = makeReader(*dialectNamed(dialect), source.text());
  std::vector<Suppression> suppressions = findSuppressions(
      source, *reader, [&](auto visit) { source.eachPlaceOf(':', visit); }, rulesCalled);
  std::vector<Finding> findings;
  for (uint32_t offset = 0; offset < text.size(); offset = uint32_t(text.find('\n', offset)) + 1) {
    Finding &finding = findings.emplace_back();
    finding.rule = RuleId(*ruleNamed("feed-missing"));
    finding.range = {source.id(), offset, offset + 1};
    if (text.find('\n', offset) == std::string::npos)
      break;
  }
  applySuppressions(suppressions, source, findings);
  std::vector<unsigned> lines;
  for (const Finding &finding : findings)
    if (finding.suppressed)
      lines.push_back(source.position(finding.range.begin).line);
  return lines;
}

using Lines = std::vector<unsigned>;

TEST(Suppression, OnABlockCoversThatBlock) {
  EXPECT_EQ(Lines{2}, suppressedLines("G01 X1.\nG01 X2. (ncvet: allow feed-missing)\nG01 X3.\n"));
}

TEST(Suppression, AloneCoversItsLineAndTheNextBlock) {
  EXPECT_EQ((Lines{1, 2, 3, 4}),
            suppressedLines("(ncvet: allow feed-missing)\n\n(FINISH)\nG01 X2.\nG01 X3.\n"));
}

TEST(Suppression, OffLastsUntilOnOrTheEnd) {
  EXPECT_EQ((Lines{2, 3}), suppressedLines("G01 X1.\n(ncvet: off feed-missing)\nG01 X2.\n"
                                           "(ncvet: on feed-missing)\nG01 X3.\n"));
  EXPECT_EQ((Lines{2, 3}), suppressedLines("G01 X1.\n(ncvet: off)\nG01 X2.\n"));
}

TEST(Suppression, OnOfOneRuleLeavesTheOthersOff) {
  EXPECT_EQ((Lines{1}), suppressedLines("(ncvet: off all)\n(ncvet: on feed-missing)\nG01 X2.\n"));
  EXPECT_EQ((Lines{1, 2, 3}), suppressedLines("(ncvet: off all)\n(ncvet: on "
                                              "style-unused-suppression)\nG01 X2.\n"));
}

TEST(Suppression, AllowFileCoversAll) {
  EXPECT_EQ((Lines{1, 2, 3}), suppressedLines("G01 X1.\nG01 X2.\nM30 (ncvet: allow-file feed)\n"));
}

TEST(Suppression, UpperCaseSemicolonAndListsAreRead) {
  EXPECT_EQ(Lines{1}, suppressedLines("G01 X1. (NCVET: ALLOW STYLE, FEED-MISSING -- KNOWN)\n"));
  EXPECT_EQ(Lines{1}, suppressedLines("G01 X1. ; ncvet: allow feed-missing\nG01 X2.\n"));
}

TEST(Suppression, OutsideOfCommentsAndOfOtherRulesCoversNothing) {
  EXPECT_EQ(Lines{}, suppressedLines("G01 X1. ncvet: allow feed-missing\n"));
  EXPECT_EQ(Lines{}, suppressedLines("G01 X1. (ncvet: allow style-unused-suppression)\n"));
  EXPECT_EQ(Lines{}, suppressedLines("G01 X1. (ncvet: allow no-such-rule)\n"));
  EXPECT_EQ(Lines{}, suppressedLines("G01 X1. (ncvet: permit feed-missing)\n"));
  EXPECT_EQ(Lines{}, suppressedLines("G01 X1. (ncvet:)\n"));
}

TEST(Suppression, AnyBytesAreRead) {
  for (const char *text : {"ncvet:", "(ncvet:", "(ncvet: allow", "(ncvet: off", ":", "ncvet::",
                           "(ncvet: on)", "(ncvet: allow feed-missing)", "(ncvet: off,,)"})
    suppressedLines(text);
}

} // namespace
} // namespace ncvet::test
