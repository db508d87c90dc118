// A check that remembers the one before finds what a fresh one finds, whatever was edited.
#include "analyzer/rule/rule.h"
#include "lsp/features/showing/document_states.h"
#include "lsp/server/checks.h"
#include "tests/support/places.h"
#include "tests/support/random_edits.h"
#include "tests/support/thorough.h"

#include "gtest/gtest.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

namespace {

using namespace ncvet;
using lsp::CheckJob;
using lsp::CheckResult;
using test::RandomEdit;
using test::RandomEdits;

std::string told(const CheckResult &result) {
  std::string all = result.error + (result.complete ? "complete\n" : "cut\n");
  for (const lsp::Problem &problem : result.problems)
    all += problem.path + " " + problem.diagnostic + "\n" + problem.changes + "\n";
  return all;
}

/// A document that is edited; every version is checked with memory and without.
class Edited {
public:
  Edited(const std::string &dialect, const std::string &path) {
    SessionOptions options;
    options.dialect = dialect;
    job_.session = std::make_shared<Session>(std::move(options));
    job_.overlay = std::make_shared<SourceSet::Overlay>();
    job_.document.path = path;
    job_.support.related = true;
  }
  /// What differs between the two; empty: nothing.
  std::string difference(const std::string &text) {
    return difference(SharedText(std::make_shared<const std::string>(text)));
  }
  std::string difference(const SharedText &text) {
    job_.document.text = text;
    const std::string again = told(*lsp::check(job_, nullptr, &memory_));
    const std::string fresh = told(*lsp::check(job_, nullptr));
    return again == fresh ? "" : "with memory:\n" + again + "fresh:\n" + fresh;
  }

  /// What the last comparison did not execute again.
  TakenRuns taken() { return memory_.takeTaken(); }

private:
  CheckJob job_;
  CheckMemory memory_;
};

void editAndCompare(const std::string &dialect, const std::string &path, std::string text,
                    unsigned edits, unsigned seed) {
  Edited edited(dialect, path);
  RandomEdits random(seed, text);
  ASSERT_EQ(edited.difference(text), "") << path;
  for (unsigned i = 0; i < edits; ++i) {
    const RandomEdit edit = random.next(text);
    const std::string before = text;
    text = edit.applied(text);
    ASSERT_EQ(edited.difference(text), "")
        << path << ", edit " << i << ": " << edit.begin << "-" << edit.end << " \"" << edit.text
        << "\" for \"" << before.substr(edit.begin, edit.end - edit.begin) << "\"";
  }
}

/// Tools that mill lines and arcs, drill, and call a subprogram between long runs of plain moves.
std::string machining(unsigned moves) {
  std::string text = "%\nO1 (PART)\nG17 G40 G80 G90\n";
  for (unsigned tool = 1; tool <= 4; ++tool) {
    text += "T" + std::to_string(tool) + " M06\nG54 G00 X0. Y0. S2000 M03\nG43 H" +
            std::to_string(tool) + " Z50.\nG01 Z-1. F" + std::to_string(100 * tool) + ".\n";
    for (unsigned i = 0; i < moves; ++i) {
      text += "X" + std::to_string(i % 90) + "." + std::to_string(i % 7) + " Y" +
              std::to_string((i * 7) % 60) + ".\n";
      if (i % 211 == 210)
        text += "G00 Z5.\nX10. Y10.\nG01 Z-1. F150.\n";
      if (i % 97 == 0)
        text += "N" + std::to_string(10 * i) + " G01 X10. Y10.\nG02 X10. Y10. I5. J0.\nG01\n";
    }
    text += "G00 Z50.\nG83 X5. Y5. Z-9. R2. Q3. F80.\nX15.\nG80\nM98 P2\nG91 G28 Z0.\nG90 G49\n";
  }
  return text + "M30\nO2\nG91 X1.\nX2.\nG90\nM99\n%\n";
}

TEST(Incremental, EditsOfALongProgramGiveWhatAFreshCheckGives) {
  for (unsigned seed = 0; seed < 4; ++seed)
    editAndCompare("haas-mill", "/nowhere/O0001.nc", machining(700), 60, seed);
}

/// Programs that call one another three deep, the lower ones from several of the upper ones and
/// some of them in the same state. `first`: the calls of the main program.
struct Callers {
  const char *dialect, *path, *first, *call, *end, *head;
};

std::string callingOneAnother(const Callers &of, unsigned tops) {
  const unsigned mids = tops * 2 / 3, leaves = tops;
  std::string text = of.first;
  const auto call = [&](unsigned number) {
    std::string line = of.call;
    line.replace(line.find('@'), 1, std::to_string(number));
    text += line + "\n";
  };
  for (unsigned i = 0; i < tops; ++i) {
    if (i % 5 == 4)
      text += "G0 X" + std::to_string(i) + ". Y0.\n";
    call(100 + i);
    if (i % 7 == 6)
      call(100 + i / 2);
  }
  text += "G0 Z50. M9\nM5\nM30\n";
  const auto body = [&](unsigned number, unsigned base, unsigned first, unsigned count) {
    std::string head = of.head;
    for (size_t at = head.find('@'); at != std::string::npos; at = head.find('@'))
      head.replace(at, 1, std::to_string(number));
    text += head + "\n";
    for (unsigned i = 0; i < 12; ++i) {
      const std::string x = std::to_string(number % 37 + i), y = std::to_string(number % 11);
      const char *const kinds[] = {"G90 G0 X", "G1 Z-1. F300.\nX", "G91 G1 F400. X", "G90 X"};
      text += kinds[i % 4] + x + ". Y" + y + ".\n";
      if (i % 4 != 3)
        continue;
      text += "G0 Z5.\n";
      if (base)
        call(base + (first * 3 + i / 4) % count);
    }
    text += std::string(of.end) + "\n";
  };
  for (unsigned i = 0; i < tops; ++i)
    body(100 + i, 300, i, mids);
  for (unsigned i = 0; i < mids; ++i)
    body(300 + i, 500, i, leaves);
  for (unsigned i = 0; i < leaves; ++i)
    body(500 + i, 0, 0, 1);
  return text;
}

const Callers allCallers[] = {
    {"fanuc-mill", "/nowhere/O0001.nc",
     "%\nO1 (CALLS)\nG17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S900 M3\nG43 H1 Z5.\n",
     "M98 P@", "M99", "O@"},
    {"fanuc-0m", "/nowhere/O0001.nc",
     "%\nO1 (MACROS)\nG17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S900 M3\nG43 H1 Z5.\n",
     "G65 P@ A1.", "G83 X1. Y1. Z-3. R2. Q1. F80.\nX5.\nG80\n#100=#1+1.\nM99", "O@"},
    {"haas-mill", "/nowhere/O0001.nc",
     "%\nO1 (HAAS)\nG17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S900 M3\nG43 H1 Z5.\n", "M98 P@",
     "M99", "O@"},
};

TEST(Incremental, EditsOfProgramsThatCallOneAnotherGiveWhatAFreshCheckGives) {
  for (const Callers &callers : allCallers)
    for (unsigned seed = 0; seed < test::tried(1, 3); ++seed)
      editAndCompare(callers.dialect, callers.path, callingOneAnother(callers, 24),
                     test::tried(25, 40), seed);
}

TEST(Incremental, CallsWhoseTextIsTheSameAreNotFollowedAgain) {
  const Callers &callers = allCallers[0];
  std::string text = callingOneAnother(callers, 60);
  Edited edited(callers.dialect, callers.path);
  ASSERT_EQ(edited.difference(text), "");
  static_cast<void>(edited.taken());
  for (const char *const head : {"O510\n", "O310\n", "O110\n", "O510\n"}) {
    const size_t at = text.find(". Y", text.find(head));
    text.replace(at, 1, "1.");
    ASSERT_EQ(edited.difference(text), "") << head;
    EXPECT_GT(edited.taken().blocks, 5000u) << head;
  }
}

TEST(Incremental, SubprogramsBetweenBracketsAreUsedThoughTheirFirstCallIsGone) {
  std::string moves;
  for (unsigned i = 0; i < 40; ++i)
    moves += "G1 X" + std::to_string(i % 9) + " Y" + std::to_string(i % 7) + " F200\n";
  std::string text = "o<hole> sub\n" + moves + "o<hole> endsub\no<row> sub\n" + moves +
                     "o<hole> call\no<row> endsub\nG21 G17 G90 G40 G94\nT1 M6 G43\n"
                     "S1000 M3\nG0 X0 Y0 Z5\no<row> call\nG0 X1 Y1\no<row> call\n"
                     "G0 X2 Y3\no<row> call\nM5\nM2\n";
  Edited edited("linuxcnc", "/nowhere/rows.ngc");
  ASSERT_EQ(edited.difference(text), "");
  for (unsigned i = 0; i < 3; ++i) {
    text.replace(text.find("o<row> call\n"), 12, "");
    EXPECT_EQ(edited.difference(text), "") << text.substr(text.find("G21"));
  }
}

/// Several edits come between two checks, each known for what it is.
void editInBursts(const std::string &dialect, const std::string &path, std::string text,
                  unsigned bursts, unsigned seed) {
  Edited edited(dialect, path);
  RandomEdits random(seed, text);
  SharedText version(std::make_shared<const std::string>(text));
  ASSERT_EQ(edited.difference(version), "") << path;
  for (unsigned i = 0; i < bursts; ++i) {
    for (unsigned edits = 1 + i % 5; edits > 0; --edits) {
      const RandomEdit edit = random.next(text);
      text = edit.applied(text);
      SharedText next(std::make_shared<const std::string>(text));
      next.history = TextHistory::with(
          version, {uint32_t(edit.begin), uint32_t(edit.end), uint32_t(edit.text.size())});
      version = next;
    }
    ASSERT_EQ(edited.difference(version), "") << path << ", burst " << i;
  }
}

TEST(Incremental, SeveralEditsAtATimeGiveWhatAFreshCheckGives) {
  for (unsigned seed = 0; seed < 4; ++seed)
    editInBursts("haas-mill", "/nowhere/O0001.nc", machining(700), 40, seed);
}

/// What leaves the path of the moves after it as it is, or not.
class MovesGoOn : public ::testing::TestWithParam<const char *> {};

TEST_P(MovesGoOn, AfterAnotherToolFeedOrWayHere) {
  const std::string text = machining(test::tried(150, 400));
  const size_t firstCut = text.find("G01 Z-1.");
  Edited edited(GetParam(), "/nowhere/O0001.nc");
  ASSERT_EQ(edited.difference(text), "");
  for (const char *added : {"T9 M06\n",
                            "F77.\n",
                            "S99\n",
                            "M08\n",
                            "H3\n",
                            "G55\n",
                            "G18\n",
                            "G91\n",
                            "G41 D5\n",
                            "G52 X1.\n",
                            "G00\n",
                            "G68 X0. Y0. R30.\n",
                            "#1=4.\n",
                            "R1=4\n",
                            "M97 P970\n",
                            "M98 P2\n",
                            "X300.\n",
                            "Z-9.\n",
                            "X1. Y2.\n",
                            "M30\n",
                            "G20\n",
                            "G\n",
                            "G81 Z-3. R1.\n",
                            "(X)\n",
                            "O9\n",
                            "%\n",
                            "G22 X99. Y99. Z9. I-9. J-9. K-9. P0\n"})
    for (const size_t at : {firstCut, text.find("X10. Y10.\n", text.size() / 3)}) {
      std::string changed = text;
      changed.insert(at, added);
      EXPECT_EQ(edited.difference(changed), "") << added << " at " << at;
      EXPECT_EQ(edited.difference(text), "") << added << " at " << at << ", taken away";
    }
}

INSTANTIATE_TEST_SUITE_P(Incremental, MovesGoOn,
                         ::testing::Values("haas-mill", "haas-lathe", "fanuc-0m", "nct-104m",
                                           "din66025", "sinumerik", "mefi", "ecs", "linuxcnc"),
                         [](const auto &info) {
                           std::string name = info.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// A program of many blocks of one kind, after a proper begin.
std::string manyTimes(const std::string &begin, unsigned blocks,
                      const std::function<std::string(unsigned)> &block) {
  std::string text = "%\nO1 (PART)\nG17 G40 G80 G90 G94\nT1 M06\nG54 G00 X0. Y0. S2000 M03\n"
                     "G43 H1 Z50.\nZ5.\n" +
                     begin;
  for (unsigned i = 0; i < blocks; ++i)
    text += block(i);
  return text + "G80\nG00 Z50.\nM05\nM30\n%\n";
}

std::string at(unsigned i) {
  return "X" + std::to_string(i % 90) + "." + std::to_string(i % 7) + " Y" +
         std::to_string(i / 90) + ".";
}

/// What blocks do not look at may change before them: they are not executed again.
TEST(Incremental, AnEditCostsWhatItChanges) {
  constexpr unsigned blocks = 6000;
  const std::string arcs = manyTimes("G01 Z-1. F200.\n", blocks, [](unsigned i) {
    return i % 2 ? "G02 " + at(i - 1) + " I1. J0.\n" : "G01 " + at(i) + "\n";
  });
  const std::string holes = manyTimes("G98 G81 X0. Y0. Z-3. R2. F100.\n", blocks,
                                      [](unsigned i) { return at(i + 90) + "\n"; });
  struct Case {
    const std::string &text;
    const char *where, *added;
    bool taken;       ///< what comes after it is taken over
    bool back = true; ///< and when the edit is taken back
  };
  const Case cases[] = {
      {arcs, "G02 X44", "F77.\n", true},        {arcs, "G02 X44", "M08\n", true},
      {arcs, "G02 X44", "G99\n", true}, // after an unknown code rules only say less
      {arcs, "G02 X44", "X500.\n", true},       {arcs, "G02 X44", "(X)\n", true},
      {arcs, "G02 X44", "G91\n", false, false}, // other places, of which the rules have much to say
      {arcs, "G02 X44", "G55\n", false},        {holes, "X44", "X1.5\n", true},
      {holes, "X44", "F77.\n", false}, // a word of the cycle
      {holes, "X44", "G80\n", false},
  };
  for (const Case &c : cases) {
    SCOPED_TRACE(c.added);
    Edited edited("haas-mill", "/nowhere/O0001.nc");
    ASSERT_EQ(edited.difference(c.text), "");
    std::string changed = c.text;
    changed.insert(changed.find(c.where), c.added);
    edited.taken();
    EXPECT_EQ(edited.difference(changed), "");
    const uint64_t taken = edited.taken().blocks;
    EXPECT_EQ(taken > blocks * 4 / 5, c.taken) << taken;
    EXPECT_EQ(edited.difference(c.text), "");
    EXPECT_EQ(edited.taken().blocks > blocks * 4 / 5, c.back) << "taken back";
  }
}

/// What rules remember inside of a contour they forget at its end: only the changed one is followed
/// again.
TEST(Incremental, AnEditOfOneContourLeavesTheOthersAsTheyAre) {
  constexpr unsigned contours = 400;
  std::string text = "%\nO1\nG17 G21 G40 G49 G80 G90 G94\nT1 M06\nG54 G00 X0. Y0. S900 M03\nG43 "
                     "H1 Z50.\n";
  for (unsigned i = 0; i < contours; ++i) {
    const auto x = [&](unsigned offset) { return "X" + std::to_string(60 * (i % 10) + offset); };
    text += "G00 " + x(20) + ". Y15.\nZ2.\nG01 G41 D1 " + x(28) + ". Y8. F900.\nZ-3. F300.\nG03 " +
            x(36) + ". Y0. R8. F900.\nG01 " + x(44) + ".\nY30.\n" + x(6) + ".\nY0.\n" + x(36) +
            ".\nG40 " + x(20) + ". Y15.\nG00 Z5.\n";
    for (unsigned k = 0; k < i % 7; ++k) // contours lie otherwise in each run
      text += x(k) + ".5 Y4" + std::to_string(k) + ".\n";
  }
  text += "G00 Z50.\nG49\nM30\n%\n";
  Edited edited("fanuc-0m", "/nowhere/O0001.nc");
  ASSERT_EQ(edited.difference(text), "");
  ASSERT_EQ(edited.difference(text), "");
  std::string changed = text;
  const size_t place = text.find("Y30.", text.size() / 2);
  changed.replace(place, 4, "Y31.");
  for (const std::string &version : {changed, text}) {
    edited.taken();
    EXPECT_EQ(edited.difference(version), "");
    EXPECT_GT(edited.taken().blocks, contours * 12u); // of fifteen each
  }
}

/// Runs that follow each other are taken over as one, and those again: a long text costs little
/// more than a short one.
TEST(Incremental, ALongTextIsTakenOverInFewSteps) {
  constexpr unsigned blocks = 60000;
  const std::string text = manyTimes("G01 Z-1. F200.\n", blocks, [](unsigned i) {
    return (i % 400 ? "" : "G00 Z5.\n" + at(i) + "\nG01 Z-1. F200.\n") + at(i) + "\n";
  });
  Edited edited("haas-mill", "/nowhere/O0001.nc");
  ASSERT_EQ(edited.difference(text), "");
  ASSERT_EQ(edited.difference(text), ""); // what is taken over makes chains
  for (unsigned part = 1; part < 5; ++part) {
    SCOPED_TRACE(part);
    std::string changed = text;
    changed.insert(text.find('\n', text.size() * part / 5) + 1, "(X)\n");
    for (const std::string &version : {changed, text}) {
      edited.taken();
      EXPECT_EQ(edited.difference(version), "");
      const TakenRuns taken = edited.taken();
      EXPECT_GT(taken.blocks, blocks - 2000u);
      EXPECT_LT(taken.runs, 120u); // a rule looks at each rapid move: the steps end there
    }
  }
}

/// What all blocks did before the edit is known still.
TEST(Incremental, AModeThatIsChangedAndChangedBackIsTakenOver) {
  constexpr unsigned blocks = 20000;
  const std::string text =
      manyTimes("G90 G01 Z-1. F200.\n", blocks, [](unsigned i) { return at(i) + "\n"; });
  std::string changed = text;
  changed.replace(text.rfind("G90"), 3, "G91");
  Edited edited("haas-mill", "/nowhere/O0001.nc");
  ASSERT_EQ(edited.difference(text), "");
  ASSERT_EQ(edited.difference(changed), ""); // both are known now
  for (unsigned turn = 0; turn < 4; ++turn) {
    edited.taken();
    EXPECT_EQ(edited.difference(turn % 2 == 0 ? text : changed), "");
    EXPECT_GT(edited.taken().blocks, blocks - 2000u) << turn;
  }
}

TEST(Incremental, EditsOfAVeryLongProgramGiveWhatAFreshCheckGives) {
  editAndCompare("haas-mill", "/nowhere/O0001.nc", machining(6000), 60, 5);
}

/// Holes of runs that are taken over count as well.
TEST(Incremental, AHoleIsMissedNowhere) {
  const std::string text = manyTimes("G98 G81 X0. Y0. Z-3. R2. F100.\n", 2000,
                                     [](unsigned i) { return at(i + 90) + "\n"; });
  Edited edited("haas-mill", "/nowhere/O0001.nc");
  ASSERT_EQ(edited.difference(text), "");
  std::string twice = text; // the place of a hole that lies far after
  twice.insert(twice.find("X1.1 "), "X80.3 Y20.\n");
  EXPECT_EQ(edited.difference(twice), "");
  EXPECT_EQ(edited.difference(text), "");
  std::string last = text; // and of one far before it
  last.insert(last.rfind("G80"), "X1.0 Y1.\n");
  EXPECT_EQ(edited.difference(last), "");
}

/// Runs share the holes with the longer ones that they become: they move once with the text.
TEST(Incremental, HolesMoveOnceWithTheText) {
  std::string text = manyTimes("G98 G81 X0. Y0. Z-3. R2. F100.\n", 2000,
                               [](unsigned i) { return at(i + 90) + "\n"; });
  Edited edited("haas-mill", "/nowhere/O0001.nc");
  for (unsigned check = 0; check < 3; ++check) // what is taken over makes chains
    ASSERT_EQ(edited.difference(text), "");
  for (unsigned edit = 0; edit < 4; ++edit) {
    text.insert(text.find("G98 G81"), "(NOTE)\n");
    ASSERT_EQ(edited.difference(text), "");
  }
  text.insert(text.rfind("G80"), at(95) + "\n" + at(1500) + "\n");
  EXPECT_EQ(edited.difference(text), "");
}

TEST(Incremental, WhatIsAfterTheClosingMarkStaysUnread) {
  std::string text = "%\nO1\nM30\n";
  for (unsigned i = 0; i < 40; ++i)
    text += "G01 X1.\n";
  text += "%\nG01 X\n17.5\n";
  Edited edited("haas-mill", "/nowhere/O0001.nc");
  ASSERT_EQ(edited.difference(text), "");
  EXPECT_EQ(edited.difference(text + "G01 X\n"), "");
}

/// A lathe program that names no plane: an arc with K says whose it is.
std::string turning(const std::string &further) {
  std::string text = "N1 G90 G95 DIAMON\nN2 T1 D1\nN3 G97 S500 M3\nN4 G0 X100 Z5\n";
  for (unsigned i = 0; i < 300; ++i)
    text += "G1 X" + std::to_string(99 - 0.1 * i) + " Z" + std::to_string(-0.05 * i) + " F0.2\n";
  return text + "G2 X80 Z-20 I5 K0\n" + further + "G1 X110\nM30\n";
}

TEST(Incremental, ThePlaneOfALatheFollowsWhatIsWrittenFurtherDown) {
  Edited edited("sinumerik", "/shop/SHAFT.MPF");
  for (const char *further : {"", "G1 Y5\n", "", "G17\n", "G18\n", "G1 X82\n", ""})
    EXPECT_EQ(edited.difference(turning(further)), "") << further;
}

TEST(Incremental, EditsOfALatheProgramTakeOverWhatIsFarFromThem) {
  Edited edited("sinumerik", "/shop/SHAFT.MPF");
  ASSERT_EQ(edited.difference(turning("")), "");
  ASSERT_EQ(edited.difference(turning("G1 X81\n")), "");
  edited.taken();
  ASSERT_EQ(edited.difference(turning("G1 X82\n")), "");
  EXPECT_GT(edited.taken().blocks, 200u);
}

TEST(Incremental, TheSecondCheckTakesOverMostOfTheFirst) {
  SessionOptions options;
  options.dialect = "haas-mill";
  Session session(std::move(options));
  const auto text = std::make_shared<const std::string>(machining(4000));
  CheckMemory memory;
  Recheck again{text, memory};
  SourceSet sources;
  checkFile(session, sources, sources.add("a.nc", text, "/nowhere/a.nc"), nullptr, &again);
  EXPECT_GT(memory.blocks(), 14000u);
}

/// Whoever follows a version of a document first does it for the others.
TEST(Incremental, QuestionsAndChecksFollowAVersionOnce) {
  SessionOptions options;
  options.dialect = "haas-mill";
  CheckJob job;
  job.session = std::make_shared<Session>(std::move(options));
  job.overlay = std::make_shared<SourceSet::Overlay>();
  job.document.path = "/nowhere/a.nc";
  job.document.memory = std::make_shared<lsp::DocumentMemory>();
  CheckMemory &checks = job.document.memory->checks;
  const std::string text = machining(4000);
  job.document.text = std::make_shared<const std::string>(text);
  const uint32_t last = uint32_t(text.rfind("G90 G49"));
  const std::atomic<bool> cancelled = false;
  const lsp::DocumentStates first = lsp::statesOf(job, last, cancelled);
  ASSERT_NE(first.firstBefore(), nullptr);
  checks.takeTaken();
  const std::string found = told(*lsp::check(job, nullptr, &checks));
  EXPECT_GT(checks.takeTaken().blocks, 14000u);
  EXPECT_EQ(found, told(*lsp::check(job, nullptr)));
  const lsp::DocumentStates again = lsp::statesOf(job, last, cancelled);
  EXPECT_GT(checks.takeTaken().blocks, 14000u);
  ASSERT_NE(again.firstBefore(), nullptr);
  EXPECT_TRUE(equal(*first.firstBefore(), *again.firstBefore()));
}

/// After a check the states at a block are found without the rules: they are those of a fresh run,
/// wherever the block lies in what is known.
TEST(Incremental, QuestionsAfterACheckFindTheStatesOfAFreshRun) {
  SessionOptions options;
  options.dialect = "haas-mill";
  CheckJob job;
  job.session = std::make_shared<Session>(std::move(options));
  job.overlay = std::make_shared<SourceSet::Overlay>();
  job.document.path = "/nowhere/a.nc";
  job.document.memory = std::make_shared<lsp::DocumentMemory>();
  CheckMemory &checks = job.document.memory->checks;
  const std::string text = machining(1500);
  job.document.text = std::make_shared<const std::string>(text);
  static_cast<void>(lsp::check(job, nullptr, &checks));
  ASSERT_TRUE(checks.isChecked());
  const std::atomic<bool> cancelled = false;
  unsigned places = 0;
  for (size_t at = 0; at < text.size(); at = text.find('\n', at + 997) + 1, ++places) {
    const lsp::DocumentStates known = lsp::statesOf(job, uint32_t(at), cancelled);
    CheckJob alone = job;
    alone.document.memory = std::make_shared<lsp::DocumentMemory>();
    const lsp::DocumentStates fresh = lsp::statesOf(alone, uint32_t(at), cancelled);
    ASSERT_EQ(known.firstBefore() == nullptr, fresh.firstBefore() == nullptr) << at;
    if (known.firstBefore()) {
      EXPECT_TRUE(equal(*known.firstBefore(), *fresh.firstBefore())) << at;
    }
    if (text.find('\n', at + 997) == std::string::npos)
      break;
  }
  EXPECT_LT(20u, places);
}

TEST(Incremental, WhatARuleRemembersAtTheStartCanBeCompared) {
  for (const DialectSummary &summary : listDialects()) {
    if (summary.abstract)
      continue;
    const auto dialect = llvm::cantFail(loadDialect(summary.id, builtinDialects()));
    const MachineProfile machine;
    const SortedCodes sorted(*dialect);
    for (const RuleEntry &entry : allRules()) {
      const std::unique_ptr<Rule> rule = entry.make();
      Subscriptions subscriptions(*dialect, machine, nullptr, sorted);
      rule->listen(subscriptions);
      RuleMemory memory(0);
      rule->remember(memory);
      EXPECT_TRUE(memory.isComparable()) << summary.id << " " << entry.info.id.str();
    }
  }
}

class RealPrograms : public ::testing::TestWithParam<const char *> {};

TEST_P(RealPrograms, EditsGiveWhatAFreshCheckGives) {
  namespace fs = std::filesystem;
  const fs::path folder =
      fs::path(places::sourceFolder()) / ".." / "shared" / "corpus" / "real" / GetParam();
  if (!fs::exists(folder))
    GTEST_SKIP() << "no programs in " << folder;
  std::vector<fs::path> files;
  for (const auto &entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.file_size() < 300000)
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  const size_t most = test::tried(6, 12);
  const size_t step = std::max<size_t>(1, files.size() / most);
  for (size_t i = 0; i < files.size(); i += step) {
    std::ifstream in(files[i], std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(in), {});
    editAndCompare("auto", files[i].string(), text, 12, unsigned(i));
  }
}

INSTANTIATE_TEST_SUITE_P(All, RealPrograms,
                         ::testing::Values("cam_iso", "fanuc_lathe", "fanuc_mill", "haas_lathe",
                                           "haas_mill", "linuxcnc", "sinumerik", "iso_generic"));

} // namespace
