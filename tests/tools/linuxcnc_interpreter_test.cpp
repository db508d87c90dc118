// Holds the traces and errors of the dialect `linuxcnc` to LinuxCNC's own interpreter, the program
// `rs274` of the Debian package linuxcnc-uspace. The environment variable NCVET_RS274 names it
// where it is not on the path; where it is not there at all, the tests are skipped.
#include "tests/support/linuxcnc_comparison.h"
#include "tests/support/linuxcnc_generator.h"
#include "tests/support/places.h"
#include "tests/support/thorough.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace ncvet;
using namespace ncvet::test;

namespace {

class LinuxCncInterpreter : public LinuxCncComparison {};

std::vector<fs::path> realPrograms() {
  std::vector<fs::path> list;
  const fs::path corpus = fs::path(places::sourceFolder()) / ".." / "shared" / "corpus" / "real";
  for (const char *folder : {"linuxcnc", "linuxcnc-tests"}) {
    std::error_code none;
    for (const auto &entry : fs::recursive_directory_iterator(corpus / folder, none)) {
      const std::string end = entry.path().extension();
      if (entry.is_regular_file() && (end == ".ngc" || end == ".nc" || end == ".tap"))
        list.push_back(entry.path());
    }
  }
  std::sort(list.begin(), list.end());
  return list;
}

/// A copy of a folder, in which a real program finds its subprograms.
class Workshop {
public:
  explicit Workshop(const fs::path &original) : original_(original) {
    for (const auto &file : fs::directory_iterator(original))
      if (file.is_regular_file())
        fs::copy_file(file.path(), folder_.path() / file.path().filename());
  }
  const fs::path &path() const { return folder_.path(); }
  const fs::path &original() const { return original_; }

  /// Does `what` while the program of that name has the text.
  void with(const std::string &program, const std::string &text, llvm::function_ref<void()> what) {
    std::ofstream(folder_.path() / program, std::ios::binary) << text;
    what();
    fs::copy_file(original_ / program, folder_.path() / program,
                  fs::copy_options::overwrite_existing);
  }

private:
  fs::path original_;
  TemporaryFolder folder_;
};

std::string titleOf(const fs::path &program) {
  return fs::relative(program, program.parent_path().parent_path()).string();
}

/// The small programs beside this file.
std::vector<std::string> smallPrograms() {
  std::vector<std::string> list;
  for (const std::string &line : linesOf(
           textOf(fs::path(places::sourceFolder()) / "tests/tools/linuxcnc_small_programs.txt"))) {
    if (line.empty() || line[0] == '#')
      continue;
    llvm::SmallVector<llvm::StringRef, 8> parts;
    llvm::StringRef(line).split(parts, " | ");
    list.push_back(llvm::join(parts, "\n") + "\n");
  }
  return list;
}

/// Not reported, as far as it is known, is what a program tells itself, as `(abort,...)`, what only
/// the call of the moment shows (a probe that begins where it ends, `##1`), and M72 without M70.
/// Programs for which the interpreter gets no answer in its time are left out, which moves the
/// share.
constexpr double wanted = 0.975;

TEST_F(LinuxCncInterpreter, RealProgramsMoveAsTracedAndAreJudgedAlike) {
  const std::vector<fs::path> programs = realPrograms();
  if (programs.empty())
    GTEST_SKIP() << "the corpus of real programs is not beside the project";
  Tally tally;
  Verdicts verdicts;
  std::optional<Workshop> shop;
  const size_t step = tried(4, 1);
  for (size_t i = 0; i < programs.size(); i += step) {
    const fs::path &program = programs[i];
    if (!shop || shop->original() != program.parent_path())
      shop.emplace(program.parent_path());
    shop->with(program.filename(), withStart(textOf(program)), [&] {
      compareAndJudge(shop->path(), program.filename(), titleOf(program), tally, verdicts);
    });
  }
  report("real programs", tally);
  report("real programs", verdicts);
  EXPECT_GE(tally.agreeing, wanted * tally.programs);
  EXPECT_GE(verdicts.reported, 0.9 * verdicts.rejected);
  EXPECT_THAT(verdicts.wrong, testing::IsEmpty());
}

TEST_F(LinuxCncInterpreter, SmallProgramsMoveAsTracedAndAreJudgedAlike) {
  Tally tally;
  Verdicts verdicts;
  const TemporaryFolder folder;
  for (const std::string &text : smallPrograms()) {
    std::ofstream(folder.path() / "small.ngc") << withStart(text);
    compareAndJudge(folder.path(), "small.ngc", "`" + inOneLine(text) + "`", tally, verdicts);
  }
  report("small programs", tally);
  report("small programs", verdicts);
  EXPECT_GE(tally.agreeing, wanted * tally.programs);
  EXPECT_GE(verdicts.reported, 0.9 * verdicts.rejected);
  EXPECT_THAT(verdicts.wrong, testing::IsEmpty());
}

/// A line of figures for each theme; the program of a seed whose motions differ can be printed by
/// setting NCVET_RS274_SEED.
TEST_F(LinuxCncInterpreter, GeneratedProgramsMoveAsTraced) {
  const unsigned programsOfTheme = tried(6, 20), mixedPrograms = tried(20, 60);
  const char *only = std::getenv("NCVET_RS274_SEED");
  Tally all;
  const TemporaryFolder folder;
  for (size_t theme = 0; theme <= LinuxCncGenerator::themeCount; ++theme) {
    const bool mixed = theme == LinuxCncGenerator::themeCount;
    Tally tally;
    unsigned rejected = 0;
    for (unsigned i = 0; i < (mixed ? mixedPrograms : programsOfTheme); ++i) {
      const auto seed = uint32_t(theme * 1000 + i);
      if (only && std::to_string(seed) != only)
        continue;
      const std::string text = LinuxCncGenerator(seed).program(theme);
      if (only)
        std::cout << text;
      std::ofstream(folder.path() / "made.ngc") << withStart(text);
      const unsigned before = tally.programs;
      compare(folder.path(), "made.ngc", "seed " + std::to_string(seed), tally);
      rejected += before == tally.programs;
    }
    report(mixed ? "mixed" : LinuxCncGenerator::themes[theme], tally);
    if (rejected)
      std::cout << "  " << rejected << " rejected by rs274\n";
    all.programs += tally.programs;
    all.agreeing += tally.agreeing;
    all.motions += tally.motions;
  }
  report("generated programs", all);
  EXPECT_GE(all.agreeing, wanted * all.programs);
}

/// Contours under compensation: where the tool's centre goes, and into which corners the
/// interpreter does not let it.
TEST_F(LinuxCncInterpreter, CompensatedContoursAreFollowedAndJudgedAlike) {
  constexpr size_t compensation = LinuxCncGenerator::themeCount - 1;
  static_assert(std::string_view(LinuxCncGenerator::themes[compensation]) == "compensation");
  const unsigned programs = tried(150, 400);
  const char *only = std::getenv("NCVET_RS274_SEED");
  Tally tally;
  Verdicts verdicts;
  const TemporaryFolder folder;
  for (unsigned i = 0; i < programs; ++i) {
    const auto seed = uint32_t(100000 + i);
    if (only && std::to_string(seed) != only)
      continue;
    const std::string text = withStart(LinuxCncGenerator(seed).program(compensation));
    if (only)
      std::cout << text;
    std::ofstream(folder.path() / "made.ngc") << text;
    compareAndJudge(folder.path(), "made.ngc", "seed " + std::to_string(seed), tally, verdicts);
  }
  report("compensated programs", tally);
  report("compensated programs", verdicts);
  EXPECT_GE(tally.agreeing, wanted * tally.programs);
  EXPECT_GE(verdicts.reported, 0.9 * verdicts.rejected);
  EXPECT_THAT(verdicts.wrong, testing::IsEmpty());
  EXPECT_LE(verdicts.unseen, 0.05 * verdicts.accepted);
}

} // namespace
