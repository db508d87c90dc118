// The path of a program that is being edited: the same as if all of it were followed anew, and what
// is told to have changed is what has.
#include "analyzer/trace/tool_path_memory.h"
#include "analyzer/trace/tool_path_trace.h"
#include "tests/support/random_edits.h"
#include "tests/support/run_program.h"

#include <gmock/gmock.h>

namespace ncvet {
namespace {

/// All of a path as text, so that a failure shows where two differ. Sections are told with their
/// modes: after edits these have other numbers.
std::vector<std::string> linesOf(const ToolPath &path) {
  std::vector<std::string> lines;
  const auto add = [&](auto &&...parts) {
    std::string line;
    llvm::raw_string_ostream out(line);
    ((out << parts << ' '), ...);
    lines.push_back(std::move(line));
  };
  const auto curve = [&](const char *name, const PathCurve &of) {
    for (const PathMove &move : of.moves)
      add(name, int(move.motion), move.machine, move.file, move.line, move.to[0], move.to[1],
          move.to[2]);
    for (const PathArc &arc : of.arcs)
      add(name, "arc", arc.move, int(arc.first), int(arc.second), arc.centre[0], arc.centre[1],
          arc.turns);
  };
  const auto changes = [&](const char *name, const std::vector<PathChange> &list) {
    for (const PathChange &change : list)
      add(name, change.move, change.value, int(change.kind));
  };
  curve("programmed", path.programmed);
  curve("centre", path.centre);
  changes("feed", path.feeds);
  changes("dwell", path.dwells);
  changes("other", path.others);
  for (const PathSection &section : path.sections) {
    const PathSetting &setting = path.settings[section.setting];
    add("section", section.move, section.operation, setting.tool, setting.lengthOffset,
        setting.radiusOffset, setting.workOffset, setting.cycle, setting.side, int(setting.spindle),
        setting.speed.value_or(-1), setting.surfaceSpeed, setting.speedLimit.value_or(-1));
  }
  for (const PathOperation &operation : path.operations)
    add("operation", operation.comment, operation.cycle, operation.tool, operation.file,
        operation.line);
  add("end", int(path.end.kind), path.end.file, path.end.line, path.end.why);
  return lines;
}

/// The first line in which two lists differ; empty: there is none.
std::string difference(const std::vector<std::string> &is, const std::vector<std::string> &due) {
  for (size_t i = 0; i < std::max(is.size(), due.size()); ++i)
    if (i >= is.size() || i >= due.size() || is[i] != due[i])
      return "line " + std::to_string(i) + ": " + (i < is.size() ? is[i] : "none") + ", not " +
             (i < due.size() ? due[i] : "none");
  return {};
}

uint32_t movedLine(uint16_t file, uint32_t line, const ToolPathChange &change) {
  return file == 0 && line >= change.line ? uint32_t(line + change.lines) : line;
}

/// `list` with the elements that `now` has in the place of those that have changed.
template <typename T>
void splice(std::vector<T> &list, const std::vector<T> &now, const ListChange &change) {
  const auto first = list.begin() + change.first;
  const auto at = list.erase(first, first + change.removed);
  list.insert(at, now.begin() + change.first, now.begin() + change.first + change.added);
}

template <typename List>
void moveAfter(List &list, const ListChange &change, const ListChange &moves) {
  for (size_t i = change.first + change.added; i < list.size(); ++i)
    list[i].move = uint32_t(list[i].move + moves.by());
}

void spliceCurve(PathCurve &curve, const PathCurve &now, const ListChange &change,
                 const ToolPathChange &all) {
  for (PathMove &move : curve.moves)
    move.line = movedLine(move.file, move.line, all);
  splice(curve.moves, now.moves, change);
  llvm::erase_if(curve.arcs, [&](const PathArc &arc) {
    return arc.move >= change.first && arc.move < change.first + change.removed;
  });
  for (PathArc &arc : curve.arcs)
    if (arc.move >= change.first)
      arc.move = uint32_t(arc.move + change.by());
  for (const PathArc &arc : now.arcs)
    if (arc.move >= change.first && arc.move < change.first + change.added)
      curve.arcs.push_back(arc);
  llvm::sort(curve.arcs, [](const PathArc &a, const PathArc &b) { return a.move < b.move; });
}

/// Moves that only end elsewhere.
void moveEnds(PathCurve &curve, const PathCurve &now, const ToolPathChange &change) {
  for (PathMove &move : curve.moves)
    move.line = movedLine(move.file, move.line, change);
  for (const uint32_t move : change.moved)
    curve.moves[move].to = now.moves[move].to;
}

/// What somebody who has the path as it was makes of it when told of a change.
void apply(ToolPath &path, const ToolPathChange &change, const ToolPath &now) {
  if (change.whole) {
    path = now;
    return;
  }
  if (change.moved.empty())
    spliceCurve(path.programmed, now.programmed, change.moves, change);
  else
    moveEnds(path.programmed, now.programmed, change);
  spliceCurve(path.centre, now.centre, change.centre, change);
  splice(path.feeds, now.feeds, change.feeds);
  moveAfter(path.feeds, change.feeds, change.moves);
  splice(path.dwells, now.dwells, change.dwells);
  moveAfter(path.dwells, change.dwells, change.moves);
  splice(path.others, now.others, change.others);
  moveAfter(path.others, change.others, change.moves);
  splice(path.sections, now.sections, change.sections);
  moveAfter(path.sections, change.sections, change.moves);
  for (size_t i = change.sections.first + change.sections.added; i < path.sections.size(); ++i)
    path.sections[i].operation = uint32_t(path.sections[i].operation + change.operations.by());
  path.settings = now.settings;
  for (PathOperation &operation : path.operations)
    operation.line = movedLine(operation.file, operation.line, change);
  splice(path.operations, now.operations, change.operations);
  path.end = now.end;
}

/// A program that is edited: its path is kept, told on, and compared with one that is made anew.
class Edited {
public:
  Edited(const std::string &dialect, std::string machine = "")
      : dialect_(test::dialectNamed(dialect)) {
    if (!machine.empty()) {
      auto profile = parseMachineProfile("machine.json", machine);
      EXPECT_TRUE(bool(profile)) << llvm::toString(profile.takeError());
      machine_ = std::move(*profile);
    }
  }

  /// Follows the text, which is the one before but for `change`; null: it is another one.
  void follow(const std::string &text, const TextChange *change) {
    SourceSet sources;
    const SourceFile &file = sources.add("PART.nc", text, "/parts/PART.nc");
    Project project(sources, dialect_, machine_);
    FileUnit &unit = project.unit(file);
    std::optional<PathEdit> edit;
    const std::string programs = programsOf(unit.index);
    if (change && programs == std::exchange(programs_, programs))
      edit = editOf(*change, text);
    programs_ = programs;
    const auto told = memory_.follow(project, unit, {}, edit ? &*edit : nullptr, nullptr, piece_);
    ASSERT_TRUE(told);
    change_ = *told;
    apply(client_, *told, memory_.path());
    text_ = text;
    ASSERT_EQ(difference(linesOf(client_), linesOf(memory_.path())), "") << "as told:\n" << text;
    pieces_ = 1;
    const auto size = uint32_t(text.size());
    const PathEdit none = editOf({size, size, 0}, text);
    for (; memory_.isPartial() && pieces_ < mostPieces_; ++pieces_) {
      const auto more = memory_.follow(project, unit, {}, &none, nullptr, piece_);
      ASSERT_TRUE(more);
      apply(client_, *more, memory_.path());
      ASSERT_EQ(difference(linesOf(client_), linesOf(memory_.path())), "") << "as told:\n" << text;
    }
    if (memory_.isPartial())
      return;
    const std::vector<std::string> due = linesOf(traceToolPath(project, unit, {}, most));
    ASSERT_EQ(difference(linesOf(memory_.path()), due), "") << text;
    ASSERT_EQ(difference(linesOf(client_), due), "") << "as told:\n" << text;
  }

  /// Puts `now` where `before` is first found.
  void replace(const std::string &before, const std::string &now) {
    const size_t at = text_.find(before);
    ASSERT_NE(at, std::string::npos) << before;
    edit({at, at + before.size(), now});
  }
  void edit(const test::RandomEdit &edit) {
    const TextChange change{uint32_t(edit.begin), uint32_t(edit.end), uint32_t(edit.text.size())};
    follow(edit.applied(text_), &change);
  }

  /// From now on the path is asked for in pieces of so many blocks, `most` of them after an edit.
  void askInPieces(uint64_t blocks, unsigned most = ~0u) {
    piece_ = blocks;
    mostPieces_ = most;
  }

  const std::string &text() const { return text_; }
  unsigned pieces() const { return pieces_; }
  const ToolPathChange &change() const { return change_; }
  const ToolPathMemory &memory() const { return memory_; }

private:
  static constexpr size_t most = 200'000;

  /// Of another text than that of the same programs all is followed anew.
  static std::string programsOf(const FileIndex &index) {
    std::string programs;
    for (const ProgramInfo &program : index.programs())
      programs += std::to_string(program.number) + program.name +
                  std::to_string(int(program.kind)) + (program.hasHeader() ? "\n" : "?\n");
    return programs;
  }

  PathEdit editOf(const TextChange &change, const std::string &text) const {
    const LineIndex before(text_), after(text);
    PathEdit edit{change, before.lineBegin(change.end), before.lineOf(change.end), 0};
    if (edit.tail < change.end)
      edit.tail = before.beginOfLine(++edit.line);
    edit.lines =
        int64_t(after.lineOf(uint32_t(text.size()))) - before.lineOf(uint32_t(text_.size()));
    return edit;
  }

  std::shared_ptr<const Dialect> dialect_;
  MachineProfile machine_;
  ToolPathMemory memory_{most};
  ToolPath client_;
  ToolPathChange change_;
  std::string text_, programs_;
  uint64_t piece_ = 0;
  unsigned pieces_ = 0, mostPieces_ = ~0u; ///< of the last edit
};

std::string surface(unsigned rows) {
  std::string text = "%\nO0001 (SURFACE)\nG17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S3000 M3\n"
                     "G43 H1 Z5.\nG1 Z-1. F200.\n";
  for (unsigned i = 0; i < rows; ++i)
    text += "X" + std::to_string(i % 100) + "." + std::to_string(i % 7) + " Y" +
            std::to_string(i / 100) + ". Z-" + std::to_string(i % 9) + ".\n";
  return text + "G0 Z50.\nM30\n%\n";
}

TEST(ToolPathMemory, AnEditedCoordinateIsOneMove) {
  Edited part("haas-mill");
  part.follow(surface(20'000), nullptr);
  part.replace("Y100.", "Y100.5");
  EXPECT_FALSE(part.change().whole);
  EXPECT_EQ(part.change().moves.removed, 1u);
  EXPECT_EQ(part.change().moves.added, 1u);
  EXPECT_LT(part.memory().executed(), 4000u) << "only blocks near the edit are executed again";
}

TEST(ToolPathMemory, ABlockThatIsPutInMovesTheLinesOfTheOthers) {
  Edited part("haas-mill");
  part.follow(surface(20'000), nullptr);
  part.replace("Y100. Z", "Y100.\nZ");
  EXPECT_EQ(part.change().moves.by(), 1);
  EXPECT_EQ(part.change().lines, 1);
  EXPECT_LT(part.change().moves.added, 4u);
}

TEST(ToolPathMemory, AModeThatChangesAllThatFollowsIsFollowedToTheEnd) {
  Edited part("haas-mill");
  part.follow(surface(5'000), nullptr);
  part.replace("G90", "G91");
  EXPECT_GT(part.memory().executed(), 5'000u);
  part.replace("G91", "G90");
}

TEST(ToolPathMemory, AModeThatChangesAllThatFollowsIsToldInPieces) {
  Edited part("haas-mill");
  part.follow(surface(20'000), nullptr);
  part.askInPieces(3'000);
  part.replace("G90", "G91");
  EXPECT_GT(part.pieces(), 4u);
  EXPECT_LT(part.change().moves.removed, 5'000u) << "of the first piece";
  part.replace("Y100.", "Y100.5");
  EXPECT_EQ(part.pieces(), 1u);
  part.replace("G91", "G90");
}

TEST(ToolPathMemory, AnEditComesBeforeTheLastPiece) {
  Edited part("haas-mill");
  part.follow(surface(20'000), nullptr);
  part.askInPieces(3'000, 2);
  part.replace("G90", "G91");
  part.replace("Y10.", "Y10.5");        // before the pieces that have come
  part.replace("Y150.", "Y150.5\nX7."); // after them
  part.replace("G91", "G90");
  part.replace("Y50.", "");
  part.askInPieces(0);
  part.replace("Y60.", "Y61.");
}

TEST(ToolPathMemory, ALoopBeforeTheEditIsNotRunAgain) {
  Edited part("fanuc-mill");
  std::string text = surface(6'000);
  text.insert(text.find("X0.0"), "#1=0\nWHILE[#1LT2000]DO1\nX#1 Y0.\n#1=#1+1\nEND1\nX0. Y0.\n");
  part.follow(text, nullptr);
  part.replace("Y50.", "Y50.9");
  EXPECT_LT(part.memory().executed(), 4'000u);
  EXPECT_EQ(part.change().moves.added, 1u);
}

TEST(ToolPathMemory, APathThatIsCutIsComparedWithTheOneBefore) {
  Edited part("fanuc-mill");
  std::string text = surface(3'000);
  text.insert(text.find("X0.0"), "#1=0\nWHILE[#1LT9000000]DO1\n#1=#1+1\nEND1\n");
  part.follow(text, nullptr);
  ASSERT_EQ(part.memory().path().end.kind, PathEnd::Unknown) << "the loop is too long";
  part.replace("Z-1.", "Z-1.5");
  EXPECT_FALSE(part.change().whole);
  EXPECT_LT(part.change().moves.added, 3u);
}

TEST(ToolPathMemory, AnEditBeforeTheCutIsFollowedUpToWhereNothingElseIsAnother) {
  Edited part("fanuc-mill");
  part.follow(surface(210'000), nullptr);
  ASSERT_EQ(part.memory().path().end.kind, PathEnd::Cut);
  part.replace("X7.0", "X7.9");
  EXPECT_LT(part.memory().executed(), 4'000u);
  part.replace("X8.1", "X8.2\nX8.3");
  EXPECT_GT(part.memory().executed(), 100'000u) << "it is cut one move before";
  part.replace("Z-1.", "Z-1.5");
  part.askInPieces(10'000);
  part.replace("G90", "G91");
}

TEST(ToolPathMemory, ASubprogramThatIsEditedChangesEachCall) {
  Edited part("fanuc-mill");
  std::string text = surface(3'000);
  text.replace(text.find("M30"), 3, "M98 P200\nX5.\nM98 P200\nM30\nO0200\nG91 X1.\nG90\nM99");
  part.follow(text, nullptr);
  part.replace("G91 X1.", "G91 X2.");
}

TEST(ToolPathMemory, OfACoordinateInASubprogramOnlyThePlacesAreTold) {
  Edited part("fanuc-mill");
  std::string text = surface(100), calls;
  for (int i = 0; i < 50; ++i)
    calls += "G0 X" + std::to_string(i) + ".\nM98 P200\n";
  text.replace(text.find("M30"), 3, calls + "M30\nO0200\nG1 Y1.\nY2.\nY3.\nY4.\nY5.\nM99");
  part.follow(text, nullptr);
  part.replace("Y2.\nY3.", "Y2.\nY3.5");
  EXPECT_EQ(part.change().moved.size(), 50u);
  part.replace("Y3.5", "\nY3.5");
  EXPECT_TRUE(part.change().moved.empty());
  part.replace("Y3.5", "F300. Y3.6");
}

/// A main program that calls subprograms, the first of which calls the last.
std::string calling(unsigned programs, unsigned blocks, bool alone = false) {
  std::string text = "O0001\nG17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S900 M3\nG43 H1 Z5.\n"
                     "G1 Z-1. F200.\n",
              bodies;
  for (unsigned i = 0; i < programs; ++i) {
    const std::string call = "M98 P" + std::to_string(1000 + i) + "\n";
    text += alone ? call : "G0 X" + std::to_string(i) + ". Y0.\n" + call + "G0 Z5.\n";
    bodies += "O" + std::to_string(1000 + i) + "\nG1 Z-1. F200.\n";
    for (unsigned block = 0; block < blocks; ++block)
      bodies += "X" + std::to_string(block % 90) + ".1 Y" + std::to_string(i) + ".\n";
    bodies += i % 7 ? "M99\n" : "M98 P" + std::to_string(1000 + programs - 1) + "\nM99\n";
  }
  return text + "M30\n" + bodies;
}

TEST(ToolPathMemory, AnEditInASubprogramIsFollowedInItsCallsAlone) {
  Edited part("fanuc-mill");
  part.follow(calling(20, 600), nullptr);
  part.replace("X7.1 Y10.", "X7.2 Y10.");
  EXPECT_EQ(part.change().moves.added, 1u);
  EXPECT_LT(part.memory().executed(), 4'000u);
  part.replace("X8.1 Y10.", "X8.2\nY10.");
  EXPECT_LT(part.memory().executed(), 4'000u);
  part.replace("G0 X12. Y0.", "G0 X12.5\nY0.");
  EXPECT_LT(part.memory().executed(), 4'000u);
  part.replace("X9.1 Y19.", "X9.3 Y19.");
  EXPECT_GT(part.memory().executed(), 10'000u) << "it is called from the first call on";
}

TEST(ToolPathMemory, CallsThatFollowOneAnotherAreLeftOutAsWell) {
  Edited part("fanuc-mill");
  part.follow(calling(20, 600, /*alone=*/true), nullptr);
  part.replace("X7.1 Y10.", "X7.2 Y10.");
  EXPECT_LT(part.memory().executed(), 4'000u);
  part.replace("M98 P1012\n", "(ROW)\nM98 P1012\n");
  EXPECT_LT(part.memory().executed(), 4'000u);
  part.replace("(ROW)", "(A ROW)");
  EXPECT_LT(part.memory().executed(), 4'000u);
  part.replace("(A ROW)\n", "G0 Z6.\n");
}

TEST(ToolPathMemory, AModeBeforeCallsIsToldInPieces) {
  Edited part("fanuc-mill");
  part.follow(calling(20, 600), nullptr);
  part.askInPieces(2'000);
  part.replace("G90", "G91");
  EXPECT_GT(part.pieces(), 3u);
}

TEST(ToolPathMemory, AToolWithItsRadiusHasBothPaths) {
  Edited part("fanuc-mill", R"({"tools": {"1": {"radius": 5, "length": 100}}})");
  std::string text = "%\nO0001\nG17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X-20. Y0. S3000 M3\n"
                     "G43 H1 Z5.\nG1 Z-1. F200.\n";
  for (int i = 0; i < 900; ++i) {
    const std::string y = std::to_string(i) + ".";
    text += "G41 D1 X0. Y" + y + "\nX50.\nG2 X60. Y" + std::to_string(i + 10) + ". R10.\nG1 Y" +
            std::to_string(i + 40) + ".\nG40 X-20.\n";
  }
  part.follow(text + "G0 Z50.\nM30\n%\n", nullptr);
  ASSERT_FALSE(part.memory().path().centre.moves.empty());
  part.replace("X50.\nG2 X60. Y510. R10.", "X49.\nG2 X60. Y510. R11.");
  EXPECT_LT(part.memory().executed(), 4'000u);
}

struct Case {
  const char *dialect;
  const char *name;
  std::string text;
};

/// Programs of which each kind of block is a few hundred times in them.
std::vector<Case> cases() {
  const auto times = [](unsigned count, const auto &make) {
    std::string text;
    for (unsigned i = 0; i < count; ++i)
      text += make(i);
    return text;
  };
  const auto n = [](unsigned i) { return std::to_string(i); };
  std::vector<Case> all;
  all.push_back({"haas-mill", "surfacing", surface(4'000)});
  all.push_back({"fanuc-mill", "drilling",
                 "O0001\nG17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S900 M3\nG43 H1 Z5.\n" +
                     times(900,
                           [&](unsigned i) {
                             return "G81 X" + n(i) + ". Y0. Z-5. R2. F" + n(100 + i % 3) + ".\nX" +
                                    n(i) + ". Y10.\nG80\nG4 P" + n(100 + i % 2) + "\n" +
                                    (i % 300 ? ""
                                             : "(HOLES " + n(i) + ")\nT" + n(2 + i / 300) +
                                                   " M6\nG0 G43 H1 Z5. S1000 M3\n");
                           }) +
                     "M30\n"});
  all.push_back(
      {"fanuc-lathe", "turning",
       "O0001\nG21 G40 G99 G97 S1000 M3\nT0101\nG0 X60. Z2.\n" + times(900, [&](unsigned i) {
         return "G0 X" + n(50 - i % 20) + ".\nG1 Z-" + n(i % 50) + ". F0." + n(1 + i % 4) +
                "\nG3 X" + n(52 - i % 20) + ". Z-" + n(i % 50 + 1) + ". R1.\nG0 Z2.\n";
       }) + "M30\n"});
  all.push_back({"sinumerik", "sinumerik",
                 "G17 G71 G90 G94\nT1 M6\nG54 G0 X0 Y0 S3000 M3\nG0 Z5\nG1 Z-1 F200\n" +
                     times(1'500,
                           [&](unsigned i) {
                             return "N" + n(10 * i) + " G1 X" + n(i % 90) + " Y" + n(i / 90) +
                                    "\nG2 X=IC(10) Y0 I5 J0\n";
                           }) +
                     "M30\n"});
  all.push_back({"linuxcnc", "loops",
                 "G17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0 Y0 S900 M3\nG43 H1 Z5\nG1 Z-1 F100\n" +
                     times(700,
                           [&](unsigned i) {
                             return "G1 X" + n(i % 80) + " Y" + n(i / 80) + "\nY" + n(i % 9) +
                                    " A" + n(i % 5) + "\n";
                           }) +
                     "#1=0\no100 while [#1 lt 30]\nG1 X#1\n#1=[#1+1]\no100 endwhile\n" +
                     times(900, [&](unsigned i) { return "G1 X" + n(i % 70) + " Z-1\n"; }) +
                     "M2\n"});
  all.push_back({"fanuc-mill", "calls", calling(12, 400)});
  all.push_back({"fanuc-mill", "calls alone", calling(14, 400, /*alone=*/true)});
  all.push_back(
      {"linuxcnc", "subs",
       times(6,
             [&](unsigned i) {
               return "o<s" + n(i) + "> sub\n" +
                      times(300,
                            [&](unsigned k) { return "G1 X" + n(k % 50) + " Y" + n(i) + "\n"; }) +
                      "o<s" + n(i) + "> endsub\n";
             }) +
           "G17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0 Y0 S900 M3\nG43 H1 Z5\n"
           "G1 Z-1 F100\n" +
           times(18,
                 [&](unsigned i) {
                   return "G0 X" + n(i) + "\no<s" + n(i % 6) + "> call\nG0 Z5\nG1 Z-1\n";
                 }) +
           "M2\n"});
  return all;
}

class RandomEditsOf : public testing::TestWithParam<size_t> {};

TEST_P(RandomEditsOf, ThePathIsThatOfTheTextAsItIsNow) {
  const Case which = cases()[GetParam()];
  SCOPED_TRACE(which.name);
  Edited part(which.dialect);
  ASSERT_NO_FATAL_FAILURE(part.follow(which.text, nullptr));
  test::RandomEdits random(unsigned(GetParam()) + 1, which.text);
  unsigned taken = 0;
  for (int i = 0; i < 60; ++i) {
    if (i % 20 == 10)
      part.askInPieces(1'100, unsigned(i) % 3 + 1);
    if (i % 20 == 19)
      part.askInPieces(0);
    ASSERT_NO_FATAL_FAILURE(part.edit(random.next(part.text())));
    taken += !part.change().whole;
  }
  EXPECT_GT(taken, 20u) << "most edits change a part of the path";
}

INSTANTIATE_TEST_SUITE_P(Programs, RandomEditsOf, testing::Range<size_t>(0, 8));

} // namespace
} // namespace ncvet
