// A rule that remembers something beside its memory does not compile: the marked ones of
// support/forgetful_rules.cpp do not, for the reason that is named; the others do.
#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/support/run_program.h"

#include <gmock/gmock.h>

#include <regex>

using namespace ncvet;
using namespace ncvet::test;

namespace {

struct Mark {
  std::string name, words;   ///< of a class, and of what the compiler says of it
  size_t first = 0, end = 0; ///< lines of the class
};

std::vector<Mark> marksOf(const std::string &source) {
  static const std::regex mark("^(?:class|struct) (\\w+).*// error: (.+)");
  std::vector<Mark> marks;
  const std::vector<std::string> lines = linesOf(source);
  for (size_t i = 0; i < lines.size(); ++i) {
    if (std::smatch found; std::regex_search(lines[i], found, mark))
      marks.push_back({found[1], found[2], i + 1, lines.size()});
    else if (lines[i] == "};" && !marks.empty())
      marks.back().end = std::min(marks.back().end, i + 1);
  }
  return marks;
}

/// g++ names the class of which it speaks, Clang only its line in some messages.
bool isAbout(const std::string &error, const Mark &mark) {
  static const std::regex place("forgetful_rules.cpp:(\\d+):");
  std::smatch line;
  if (error.find("::" + mark.name) != std::string::npos)
    return true;
  return std::regex_search(error, line, place) && std::stoul(line[1]) >= mark.first &&
         std::stoul(line[1]) <= mark.end;
}

/// The compiler's messages: each error with the lines before it, which say on whose behalf a header
/// is read, and those after it.
std::vector<std::string> errorsOf(const std::string &log) {
  std::vector<std::string> errors;
  std::string around;
  bool found = false;
  const auto flush = [&] {
    if (found)
      errors.push_back(around);
  };
  for (const std::string &line : linesOf(log)) {
    const bool error = line.find(": error: ") != std::string::npos,
               begin = line.find(": In ") != std::string::npos;
    if (found && (error || begin)) {
      flush();
      around.clear();
      found = false;
    }
    found |= error;
    around += line + "\n";
  }
  flush();
  return errors;
}

TEST(RulesThatForget, DoNotCompile) {
  const std::filesystem::path file =
      std::filesystem::path(places::sourceFolder()) / "tests/support/forgetful_rules.cpp";
  const std::vector<Mark> marks = marksOf(contentsOf(file));
  ASSERT_EQ(marks.size(), 7U);
  const TemporaryFolder folder;
  std::vector<std::string> command = places::compiler();
  command.insert(command.end(), {"-fsyntax-only", file.string()});
  EXPECT_GT(runOuter(command, folder.path() / "log", 300), 0);
  const std::vector<std::string> errors = errorsOf(contentsOf(folder.path() / "log"));
  for (const Mark &mark : marks)
    EXPECT_TRUE(llvm::any_of(errors,
                             [&](const std::string &error) {
                               return isAbout(error, mark) &&
                                      std::regex_search(error, std::regex(mark.words));
                             }))
        << mark.name << " wants: " << mark.words;
  for (const std::string &error : errors)
    EXPECT_TRUE(llvm::any_of(marks, [&](const Mark &mark) { return isAbout(error, mark); }))
        << error;
}

} // namespace
