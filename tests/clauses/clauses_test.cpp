// Every clause of a control's rules is reported where its wrong program says so, and its right
// program is silent under all rules. `./dev clauses` runs this alone and shows the table.
#include "tests/clauses/clause_files.h"
#include "tests/support/run_program.h"

#include "llvm/Support/Format.h"
#include "llvm/Support/raw_ostream.h"

#include <set>

namespace ncvet::test {
namespace {

/// A clause's lines as a program of its control, and the lines that are marked in it.
struct ClauseProgram {
  std::vector<ProgramFile> files;
  std::vector<std::string> marked; ///< "FILE:LINE", sorted
};

ClauseProgram programOf(const Clause &clause, const std::vector<std::string> &lines) {
  Frame frame = frameOf(clause.dialect);
  if (clause.whole)
    frame.before = frame.after = {};
  ClauseProgram program;
  program.files.push_back({frame.file, ""});
  unsigned line = 0;
  const auto add = [&](llvm::StringRef text) {
    if (clause.whole && text.consume_front("=== ")) {
      if (line == 0 && program.files.size() == 1)
        program.files.back().name = text.str();
      else
        program.files.push_back({text.str(), ""});
      line = 0;
      return;
    }
    ++line;
    if (text.consume_front("> "))
      program.marked.push_back(program.files.back().name + ":" + std::to_string(line));
    program.files.back().text += text.str() + "\n";
  };
  using Lines = const std::vector<std::string> *;
  for (const Lines part : {Lines(&frame.before), Lines(&lines), Lines(&frame.after)})
    for (const std::string &text : *part)
      add(text);
  std::sort(program.marked.begin(), program.marked.end());
  return program;
}

std::string textOf(const ClauseProgram &program) {
  std::string text;
  for (const ProgramFile &file : program.files)
    text += (program.files.size() > 1 ? "=== " + file.name + "\n" : "") + file.text;
  return text;
}

/// Where the clause's rule reports in its wrong program.
std::vector<std::string> reportedLines(const Clause &clause, const ClauseProgram &program,
                                       size_t rule) {
  std::set<std::string> lines;
  for (const Seen &seen : analyseProgram(
           clause.dialect, program.files, clause.machine,
           [&](const Dialect &dialect) { return only(dialect, rule); }, /*allFiles=*/true))
    lines.insert((seen.file.empty() ? program.files[0].name : seen.file) + ":" +
                 std::to_string(seen.line));
  return {lines.begin(), lines.end()};
}

void expectReported(const Clause &clause, size_t rule) {
  const ClauseProgram program = programOf(clause, clause.wrong);
  ASSERT_FALSE(program.marked.empty()) << clause.name() << ": no line of `wrong` is marked by '> '";
  const std::vector<std::string> reported = reportedLines(clause, program, rule);
  if (clause.missing.empty())
    EXPECT_EQ(program.marked, reported) << clause.name() << "\n" << textOf(program);
  else
    EXPECT_NE(program.marked, reported)
        << clause.name() << ": it is reported now, take away its `missing`";
}

void expectSilence(const Clause &clause) {
  const ClauseProgram program = programOf(clause, clause.right);
  ASSERT_TRUE(program.marked.empty()) << clause.name() << ": a line of `right` is marked";
  std::string reports;
  for (const Seen &seen : analyseProgram(clause.dialect, program.files, clause.machine,
                                         RuleSelection::defaults, /*allFiles=*/true))
    if (!llvm::is_contained(clause.also, seen.rule))
      reports += seen.describe() + "\n";
  if (clause.falseAlarm.empty())
    EXPECT_EQ("", reports) << clause.name() << ": of the right program\n" << textOf(program);
  else
    EXPECT_NE("", reports) << clause.name() << ": it is silent now, take away its `falseAlarm`";
}

class Clauses : public ::testing::TestWithParam<std::string> {};

TEST_P(Clauses, AreReportedAndTheirRightProgramsAreSilent) {
  auto clauses = readClauses(GetParam());
  ASSERT_TRUE(bool(clauses)) << llvm::toString(clauses.takeError());
  for (const Clause &clause : *clauses) {
    const auto rule = ruleNamed(clause.rule);
    ASSERT_TRUE(rule) << clause.name() << ": no rule " << clause.rule;
    EXPECT_EQ(allRules()[*rule].info.category.str(), clause.category) << clause.name();
    if (!clause.wrong.empty())
      expectReported(clause, *rule);
    else
      EXPECT_FALSE(clause.missing.empty() && clause.right.empty())
          << clause.name() << ": has neither a wrong nor a right program";
    if (!clause.right.empty())
      expectSilence(clause);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Clauses, ::testing::ValuesIn(clauseFiles()), [](const auto &info) {
  const std::filesystem::path path(info.param);
  std::string name =
      path.parent_path().parent_path().filename().string() + "_" + path.stem().string();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(ClauseFrames, AreSilent) {
  for (const char *dialect :
       {"ecs", "haas-lathe", "fanuc-0t", "fanuc-0m", "nct-104t", "nct-104m", "din66025", "mefi",
        "sinumerik", "fanuc-mill", "fanuc-lathe", "haas-mill", "haas-ngc-lathe"}) {
    Clause frame;
    frame.says = "the frame of " + (frame.dialect = dialect);
    expectSilence(frame);
  }
}

/// How many rules and clauses of each reference have a test, and what is missing or false.
TEST(ClauseTable, IsShown) {
  struct Count {
    std::set<std::string> rules;
    unsigned clauses = 0, missing = 0, falseAlarms = 0;
  };
  std::map<std::string, Count> counts;
  std::string missing;
  for (const std::string &path : clauseFiles()) {
    auto clauses = readClauses(path);
    ASSERT_TRUE(bool(clauses)) << llvm::toString(clauses.takeError());
    for (const Clause &clause : *clauses)
      for (Count *count : {&counts[clause.reference], &counts["all"]}) {
        count->rules.insert(clause.reference + clause.local);
        ++count->clauses;
        count->missing += !clause.missing.empty();
        count->falseAlarms += !clause.falseAlarm.empty();
        if (count == &counts["all"])
          continue;
        if (!clause.missing.empty())
          missing += "  " + clause.name() + "\n    " + clause.missing + "\n";
        if (!clause.falseAlarm.empty())
          missing += "  " + clause.name() + "\n    false alarm: " + clause.falseAlarm + "\n";
      }
  }
  llvm::raw_ostream &out = llvm::outs();
  if (!missing.empty())
    out << "not as it should be yet:\n" << missing;
  out << "reference       rules  clauses   tested  missing  false alarms\n";
  const Count all = counts["all"];
  counts.erase("all");
  const auto row = [&](llvm::StringRef name, const Count &count) {
    out << llvm::format("%-14s %6u %8u %8u %8u %13u\n", name.str().c_str(),
                        unsigned(count.rules.size()), count.clauses, count.clauses - count.missing,
                        count.missing, count.falseAlarms);
  };
  for (const auto &[name, count] : counts)
    row(name, count);
  row("all", all);
  out.flush();
}

} // namespace
} // namespace ncvet::test
