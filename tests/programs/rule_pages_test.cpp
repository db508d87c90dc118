// Every program of every rule's page: wrong ones are reported where they are marked, right ones
// not.
#include "tests/support/rule_pages.h"

#include "gtest/gtest.h"

namespace ncvet::test {
namespace {

class RulePage : public ::testing::TestWithParam<PageProgram> {};

TEST_P(RulePage, ProgramIsReportedExactlyWhereItIsMarked) {
  const PageProgram &program = GetParam();
  ASSERT_TRUE(program.problem.empty()) << program.problem;
  const auto rule = ruleNamed(program.rule);
  ASSERT_TRUE(rule);
  std::vector<Seen> due = marksOf(program.files[0].text, program.rule);
  for (size_t i = 1; i < program.files.size(); ++i)
    for (Seen mark : marksOf(program.files[i].text, program.rule)) {
      mark.file = program.files[i].name;
      due.push_back(mark);
    }
  if (program.wrong)
    ASSERT_FALSE(due.empty()) << "a wrong program marks what is reported";
  else
    ASSERT_TRUE(due.empty()) << "a right program has no marks";
  const auto found = analyseProgram(
      program.dialect, program.files, program.machine,
      [&](const Dialect &dialect) { return only(dialect, *rule); },
      /*allFiles=*/true);
  expectSame(due, found, program.files[0].text);
}

INSTANTIATE_TEST_SUITE_P(Pages, RulePage, ::testing::ValuesIn(allPagePrograms()),
                         [](const auto &info) { return info.param.name(); });

} // namespace
} // namespace ncvet::test
