// Sections that are repeated: one inside the other, with the same start, with the same end.
#include "tests/support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncvet {
namespace {

/// Rules of flow that report something of `program`.
std::vector<std::string> flowFindings(const std::string &program) {
  std::vector<std::string> rules;
  for (const test::Seen &seen :
       test::analyseProgram("sinumerik", {{"PART.mpf", program}}, "", [](const Dialect &dialect) {
         return RuleSelection::defaults(dialect);
       }))
    if (llvm::StringRef(seen.rule).startswith("flow-"))
      rules.push_back(std::to_string(seen.line) + " " + seen.rule);
  return rules;
}

TEST(Sections, OneMayBeginWhereTheOneAroundItBegins) {
  EXPECT_THAT(flowFindings("N10 G90 G54 G17 G94 G71\n"
                           "N20 T1 M6\n"
                           "N30 S800 M3\n"
                           "N40 G0 X0 Y0 Z5\n"
                           "N50 AAA: G91 G0 X5\n"
                           "N60 REPEATB AAA P=2\n"
                           "N70 CCC: G0 Y5\n"
                           "N80 REPEAT AAA CCC P=2\n"
                           "N90 G90 G0 Z50\n"
                           "N100 M5\n"
                           "N110 M30\n"),
              testing::IsEmpty());
}

TEST(Sections, OneMayEndWithARepeat) {
  EXPECT_THAT(flowFindings("N10 G90 G54 G17 G94 G71\n"
                           "N20 T1 M6\n"
                           "N30 S800 M3\n"
                           "N40 G0 X0 Y0 Z5\n"
                           "N50 AAA: G91 G0 X5\n"
                           "N60 CCC: REPEATB AAA P=2\n"
                           "N70 REPEAT AAA CCC P=2\n"
                           "N80 G90 G0 Z50\n"
                           "N90 M5\n"
                           "N100 M30\n"),
              testing::IsEmpty());
}

} // namespace
} // namespace ncvet
