// Every rule has a wrong and a right program for every dialect that it claims.
#include "tests/support/rule_pages.h"

#include "gtest/gtest.h"

#include <set>

namespace ncvet::test {
namespace {

/// Programs that pages still lack. This list may only shrink.
const std::set<std::string> exempt = {
    "arc-large-arc-selection fanuc-0t right",
    "arc-large-arc-selection nct-104t right",
    "arc-wrong-centre-word fanuc-0t right",
    "arc-wrong-centre-word nct-104t right",
    "compensation-approach-invalid nct-104t right",
    "compensation-plane-change nct-104t right",
    "compensation-radius-allowance fanuc-0t right",
    "compensation-radius-allowance nct-104t right",
    "compensation-with-cycle fanuc-0t right",
    "style-malformed-suppression fanuc-0t right",
    "style-malformed-suppression fanuc-0t wrong",
    "style-malformed-suppression nct-104m right",
    "style-malformed-suppression nct-104t right",
    "style-malformed-suppression nct-104t wrong",
    "style-unused-suppression fanuc-0m right",
    "style-unused-suppression fanuc-0t right",
    "style-unused-suppression fanuc-0t wrong",
    "style-unused-suppression nct-104m right",
    "style-unused-suppression nct-104m wrong",
    "style-unused-suppression nct-104t right",
    "tool-not-in-list fanuc-0m right",
    "tool-not-in-list fanuc-0t right",
    "tool-not-in-list nct-104t right",
};

TEST(Catalogue, EveryRuleHasAWrongAndARightProgramForEveryDialectThatItClaims) {
  std::set<std::string> missing;
  for (const RuleEntry &entry : allRules()) {
    std::set<std::string> shown;
    for (const PageProgram &program : programsOf(entry.info))
      shown.insert(program.dialect + (program.wrong ? " wrong" : " right"));
    const auto dialects = claimedDialects(entry.info.help);
    EXPECT_FALSE(dialects.empty()) << entry.info.id.str() << " claims no dialect";
    for (const std::string &dialect : dialects)
      for (const char *kind : {" wrong", " right"})
        if (!shown.count(dialect + kind))
          missing.insert(entry.info.id.str() + " " + dialect + kind);
  }
  for (const std::string &entry : missing)
    EXPECT_TRUE(exempt.count(entry)) << "no program: " << entry;
  for (const std::string &entry : exempt)
    EXPECT_TRUE(missing.count(entry)) << "has its program now, take it off the list: " << entry;
}

TEST(Catalogue, NoPageShowsAProgramForADialectThatItDoesNotClaim) {
  for (const RuleEntry &entry : allRules()) {
    const auto dialects = claimedDialects(entry.info.help);
    for (const PageProgram &program : programsOf(entry.info))
      EXPECT_TRUE(std::find(dialects.begin(), dialects.end(), program.dialect) != dialects.end())
          << entry.info.id.str() << " shows a program for " << program.dialect;
  }
}

} // namespace
} // namespace ncvet::test
