// Holds the traces and errors of the dialect `linuxcnc` to LinuxCNC's own interpreter, the program
// `rs274` of the Debian package linuxcnc-uspace. The environment variable NCVET_RS274 names it
// where it is not on the path; where it is not there at all, the tests are skipped.
#include "tests/support/linuxcnc_generator.h"
#include "tests/support/motion_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <iostream>
#include <regex>

using namespace ncvet;
using namespace ncvet::test;

namespace {

namespace fs = std::filesystem;

std::vector<KnownTool> tools() {
  std::vector<KnownTool> list;
  for (int number = 1; number <= 99; ++number)
    list.push_back({number, number * 2.54, 2 + number * 0.25});
  return list;
}

/// The machine on which rs274 believes to be: every offset zero, its tools.
std::string machineText() {
  nlohmann::json machine = {{"dialect", "linuxcnc"}};
  for (const char *name :
       {"G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3", "G28", "G30", "G92"})
    for (const char *axis : {"X", "Y", "Z", "A", "B", "C"})
      machine["offsets"][name][axis] = 0;
  for (const KnownTool &tool : tools())
    machine["tools"][std::to_string(tool.number)] = {{"length", tool.length},
                                                     {"radius", tool.diameter / 2}};
  return machine.dump();
}

std::string textOf(const fs::path &path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The program with its start stated, so that both begin at the same place; one more line than
/// before when `line` is 1.
std::string withStart(const std::string &text) {
  const std::string start = "G53 G0 X0 Y0 Z0 A0 B0 C0\nG80\n";
  size_t at = text.find_first_not_of(" \t\r\n");
  if (at != std::string::npos && text[at] == '%') {
    at = text.find('\n', at);
    return at == std::string::npos ? text : text.substr(0, at + 1) + start + text.substr(at + 1);
  }
  return start + text;
}

/// rs274 2.9 swaps the axes of G74 and G84 outside the XY plane: nothing to trace, but a warning.
bool tapsAside(const std::string &text) {
  static const std::regex tap("[gG] *[78]4([^0-9.]|$)"), plane("[gG] *1[89]([^0-9.]|$)");
  return std::regex_search(text, tap) && std::regex_search(text, plane);
}

class LinuxCncInterpreter : public testing::Test {
protected:
  void SetUp() override {
    interpreter_ = Rs274::find();
    if (!interpreter_)
      GTEST_SKIP() << "rs274 (Debian: linuxcnc-uspace) is not installed, and NCVET_RS274 does not "
                      "name it: nothing to compare with";
  }

  struct Tally {
    unsigned programs = 0, agreeing = 0, aside = 0, motions = 0;
    std::vector<std::string> differences;
  };

  /// Compares one program that lies in `folder`.
  void compare(const fs::path &folder, const std::string &program, const std::string &title,
               Tally &tally) {
    compare(interpreter_->run(folder, program, tools()), folder, program, title, tally);
  }

  static void compare(const Rs274Run &run, const fs::path &folder, const std::string &program,
                      const std::string &title, Tally &tally) {
    if (!run.accepted)
      return;
    if (tapsAside(textOf(folder / program))) {
      ++tally.aside;
      return;
    }
    ++tally.programs;
    tally.motions += unsigned(run.moves.size());
    const std::vector<std::string> differences =
        MotionComparison::differences(traced(folder / program), run);
    if (differences.empty())
      ++tally.agreeing;
    for (const std::string &difference : differences)
      tally.differences.push_back(title + ": " + difference);
  }

  /// The machine of `machineText`, read once.
  struct Machine {
    std::shared_ptr<const Dialect> dialect;
    MachineProfile profile;
  };
  static const Machine &machine() {
    static const Machine known = [] {
      const std::string text = machineText();
      return Machine{llvm::cantFail(overlay(dialectNamed("linuxcnc"), "machine.json", text)),
                     llvm::cantFail(parseMachineProfile("machine.json", text))};
    }();
    return known;
  }

  /// Does `what` with a program on that machine.
  static void withFile(const fs::path &path, llvm::function_ref<void(Project &, FileUnit &)> what) {
    SourceSet sources;
    auto source = sources.open(path.string(), path.filename().string());
    if (!source) {
      ADD_FAILURE() << llvm::toString(source.takeError());
      return;
    }
    Project project(sources, machine().dialect, machine().profile);
    what(project, project.unit(**source));
  }

  static TracedMoves traced(const fs::path &path) {
    TracedMoves moves;
    withFile(path, [&](Project &project, FileUnit &unit) { trace(project, unit, {}, moves); });
    return moves;
  }

  struct Verdicts {
    unsigned accepted = 0, rejected = 0, reported = 0, subprograms = 0;
    unsigned unseen = 0; ///< errors of elements along which the tool runs back, of which rs274 is
                         ///< silent
    std::vector<std::string> missed, wrong;
  };

  /// Compares what is said of one program.
  void judge(const fs::path &folder, const std::string &program, const std::string &title,
             Verdicts &verdicts) {
    judge(interpreter_->run(folder, program, tools()), folder, program, title, verdicts);
  }

  static void judge(const Rs274Run &run, const fs::path &folder, const std::string &program,
                    const std::string &title, Verdicts &verdicts) {
    if (!run.finished)
      return;
    const std::string text = textOf(folder / program);
    const std::vector<std::string> lines = linesOf(text);
    const bool ends = llvm::StringRef(run.message).contains("File ended") ||
                      llvm::StringRef(run.message).contains("EOF in file");
    if (!run.accepted && ends && isSubprogramFile(text)) {
      ++verdicts.subprograms; // it is no program of its own
      return;
    }
    ++(run.accepted ? verdicts.accepted : verdicts.rejected);
    bool found = false;
    withFile(folder / program, [&](Project &project, FileUnit &unit) {
      const AnalysisResult result = analyze(project, unit, RuleSelection::defaults(*unit.dialect));
      for (const Finding &finding : result.findings) {
        if (finding.severity != Severity::Error)
          continue;
        const SourceFile &file = project.sources().get(finding.range.file);
        const uint32_t line = file.position(finding.range.begin).line;
        const uint32_t begin = file.lines().lineBegin(finding.range.begin);
        const llvm::StringRef there = file.text().slice(begin, file.lines().lineEnd(begin)).trim();
        if (run.accepted && runsBack(finding))
          ++verdicts.unseen;
        else if (run.accepted)
          verdicts.wrong.push_back(title + ":" + std::to_string(line) + ": " +
                                   allRules()[finding.rule].info.id.str() + ": " + finding.message);
        found |= ends || run.line.empty() || there == run.line;
      }
    });
    if (run.accepted)
      return;
    verdicts.reported += found;
    if (!found)
      verdicts.missed.push_back(title + ": " + run.message + ": " + run.line);
  }

  /// The tool runs back along an element that is too short for the inside corner before it,
  /// into what it has cut before. rs274 looks for that at the next inside corner and at an outside
  /// one of two lines; round others and straight on it lets the tool run back.
  static bool runsBack(const Finding &finding) {
    return llvm::any_of(finding.notes, [](const Note &note) {
      return llvm::StringRef(note.message) == "the element before it is too short";
    });
  }

  /// It holds a subprogram and is named after it, or holds nothing at all.
  static bool isSubprogramFile(const std::string &text) {
    static const std::regex head("(^|\n)[ \t]*[oO] *<[^>]*> *[sS][uU][bB]");
    return text.find_first_not_of(" \t\r\n") == std::string::npos || std::regex_search(text, head);
  }

  static void report(const char *what, const Verdicts &verdicts) {
    for (const std::string &line : verdicts.wrong)
      std::cout << "false error: " << line << "\n";
    for (const std::string &line : verdicts.missed)
      std::cout << "not reported: " << line << "\n";
    std::cout << what << ": " << verdicts.reported << " of " << verdicts.rejected
              << " rejected programs reported, " << verdicts.wrong.size() << " false errors on "
              << verdicts.accepted << " accepted ones (and " << verdicts.unseen
              << " places at which the tool runs back unseen); " << verdicts.subprograms
              << " files of subprograms left out\n";
  }

  static void report(const char *what, const Tally &tally) {
    for (const std::string &difference : tally.differences)
      std::cout << difference << "\n";
    std::cout << what << ": " << tally.agreeing << " of " << tally.programs
              << " programs agree in every motion (" << tally.motions << " motions); "
              << "left out: " << tally.aside << " with taps outside the XY plane\n";
  }

  std::optional<Rs274> interpreter_;
};

std::vector<fs::path> realPrograms() {
  std::vector<fs::path> list;
  const fs::path corpus = fs::path(NCVET_SOURCE_DIR) / ".." / "shared" / "corpus" / "real";
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

/// A folder in which a real program finds its subprograms.
class Workshop {
public:
  Workshop(const fs::path &program, const std::string &text) : name_(program.filename()) {
    for (const auto &other : fs::directory_iterator(program.parent_path()))
      if (other.is_regular_file() && other.path() != program)
        fs::copy_file(other.path(), folder_.path() / other.path().filename());
    std::ofstream(folder_.path() / name_, std::ios::binary) << text;
  }
  const fs::path &path() const { return folder_.path(); }
  const std::string &name() const { return name_; }

private:
  TemporaryFolder folder_;
  std::string name_;
};

std::string titleOf(const fs::path &program) {
  return fs::relative(program, program.parent_path().parent_path()).string();
}

/// The small programs beside this file.
std::vector<std::string> smallPrograms() {
  std::vector<std::string> list;
  for (const std::string &line :
       linesOf(textOf(fs::path(NCVET_SOURCE_DIR) / "tests/tools/linuxcnc_small_programs.txt"))) {
    if (line.empty() || line[0] == '#')
      continue;
    llvm::SmallVector<llvm::StringRef, 8> parts;
    llvm::StringRef(line).split(parts, " | ");
    list.push_back(llvm::join(parts, "\n") + "\n");
  }
  return list;
}

/// On one line, for messages.
std::string inOneLine(llvm::StringRef text) {
  std::string line = text.rtrim().str();
  for (size_t at = 0; (at = line.find('\n', at)) != std::string::npos; at += 3)
    line.replace(at, 1, " | ");
  return line;
}

/// Not reported, as far as it is known, is what a program tells itself, as `(abort,...)`, what only
/// the call of the moment shows (a probe that begins where it ends, `##1`), and M72 without M70.
constexpr double wanted = 0.98;

TEST_F(LinuxCncInterpreter, RealProgramsMoveAsTraced) {
  const std::vector<fs::path> programs = realPrograms();
  if (programs.empty())
    GTEST_SKIP() << "the corpus of real programs is not beside the project";
  Tally tally;
  for (const fs::path &program : programs) {
    const Workshop shop(program, withStart(textOf(program)));
    compare(shop.path(), shop.name(), titleOf(program), tally);
  }
  report("real programs", tally);
  EXPECT_GE(tally.agreeing, wanted * tally.programs);
}

TEST_F(LinuxCncInterpreter, SmallProgramsMoveAsTraced) {
  Tally tally;
  const TemporaryFolder folder;
  for (const std::string &text : smallPrograms()) {
    std::ofstream(folder.path() / "small.ngc") << withStart(text);
    compare(folder.path(), "small.ngc", "`" + inOneLine(text) + "`", tally);
  }
  report("small programs", tally);
  EXPECT_GE(tally.agreeing, wanted * tally.programs);
}

/// A line of figures for each theme; the program of a seed whose motions differ can be printed by
/// setting NCVET_RS274_SEED.
TEST_F(LinuxCncInterpreter, GeneratedProgramsMoveAsTraced) {
  constexpr unsigned programsOfTheme = 20, mixedPrograms = 60;
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
  constexpr unsigned programs = 400;
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
    const Rs274Run run = interpreter_->run(folder.path(), "made.ngc", tools());
    compare(run, folder.path(), "made.ngc", "seed " + std::to_string(seed), tally);
    judge(run, folder.path(), "made.ngc", "seed " + std::to_string(seed), verdicts);
  }
  report("compensated programs", tally);
  report("compensated programs", verdicts);
  EXPECT_GE(tally.agreeing, wanted * tally.programs);
  EXPECT_GE(verdicts.reported, 0.9 * verdicts.rejected);
  EXPECT_THAT(verdicts.wrong, testing::IsEmpty());
  EXPECT_LE(verdicts.unseen, 0.05 * verdicts.accepted);
}

TEST_F(LinuxCncInterpreter, SmallProgramsAreJudgedAlike) {
  Verdicts verdicts;
  const TemporaryFolder folder;
  for (const std::string &text : smallPrograms()) {
    std::ofstream(folder.path() / "small.ngc") << text;
    judge(folder.path(), "small.ngc", "`" + inOneLine(text) + "`", verdicts);
  }
  report("small programs", verdicts);
  EXPECT_GE(verdicts.reported, 0.9 * verdicts.rejected);
  EXPECT_THAT(verdicts.wrong, testing::IsEmpty());
}

TEST_F(LinuxCncInterpreter, RealProgramsAreJudgedAlike) {
  const std::vector<fs::path> programs = realPrograms();
  if (programs.empty())
    GTEST_SKIP() << "the corpus of real programs is not beside the project";
  Verdicts verdicts;
  for (const fs::path &program : programs) {
    const Workshop shop(program, textOf(program));
    judge(shop.path(), shop.name(), titleOf(program), verdicts);
  }
  report("real programs", verdicts);
  EXPECT_GE(verdicts.reported, 0.9 * verdicts.rejected);
  EXPECT_THAT(verdicts.wrong, testing::IsEmpty());
}

} // namespace
