// Jumps, renamings and single places that every editor of the tests tries, by control.
#pragma once

#include "tests/editors/editor_programs.h"

#include "gtest/gtest.h"

namespace ncvet::test {

/// Marks the place in a program where the cursor is; not part of the program.
inline constexpr const char *cursorMark = "<|>";

/// Adds the program with the cursor's mark and puts line (from 1) and column (bytes, from 0) of
/// the mark into the plan; its path.
inline std::string addWithCursor(EditorPlan &plan, const std::string &name, std::string text) {
  const size_t at = text.find(cursorMark);
  EXPECT_NE(at, std::string::npos);
  text.erase(at, std::string(cursorMark).size());
  const size_t line = text.rfind('\n', at) + 1; // 0 in the first line
  plan.set("line", 1 + std::count(text.begin(), text.begin() + long(at), '\n'));
  plan.set("column", at - line);
  return plan.add(name, text);
}

/// From a name to where it is defined.
struct Jump {
  const char *dialect;
  ProgramFile program; ///< with the cursor's mark
  ProgramFile other;   ///< beside it; without a name: none
  unsigned line;       ///< of the definition, in the other program if there is one
};

inline const std::vector<Jump> jumps = {
    // a subprogram by its number
    {"haas-lathe",
     {"O00001.nc", "O1 (MAIN)\nT101\n(Gehäuse 𝄞) M98 P2<|>000\nM30\n"},
     {"O2000.nc", "%\nO2000 (OTHER)\nG00 X1.\nM99\n%\n"},
     2},
    // by its name
    {"sinumerik",
     {"MAIN.MPF", "N10 G54 G17 G90\nN20 HO<|>LE\nN30 M30\n"},
     {"HOLE.SPF", "PROC HOLE\nG0 X1\nM17\n"},
     1},
    // one without a head
    {"ecs", {"MAIN.ecs", "N10 G54.01\nN20 L<HO<|>LES>\nN30 M30\n"}, {"HOLES", "N50 X1\nM17\n"}, 1},
    // one of O words
    {"linuxcnc",
     {"main.ngc", "G21 G90\no<ho<|>le> call\nM2\n"},
     {"hole.ngc", "(a hole)\no<hole> sub\nG0 X1\no<hole> endsub\nM2\n"},
     2},
    // a block number
    {"fanuc-0m",
     {"O0001.nc", "O1\nN10 G0 X1.\nN20 G0 X2.\nIF [#1 EQ 2] GOTO 2<|>0\nM30\n"},
     {"", ""},
     3},
    // a label
    {"sinumerik",
     {"PART.MPF", "G90\nSTART: G0 X1\nR1=R1+1\nIF R1<3 GOTOB STA<|>RT\nM30\n"},
     {"", ""},
     2},
};

inline void addStep(EditorPlan &plan, const Jump &jump) {
  plan.begin("definition");
  std::string target = addWithCursor(plan, jump.program.name, jump.program.text);
  if (!jump.other.name.empty())
    target = plan.beside(jump.other.name, jump.other.text);
  plan.set("target", nlohmann::json{{"path", target}, {"line", jump.line}});
}

/// A name that gets another spelling.
struct Renaming {
  const char *dialect;
  ProgramFile program; ///< with the cursor's mark
  const char *to;
  const char *after;
};

inline const std::vector<Renaming> renamings = {
    // the blocks of a profile
    {"haas-lathe",
     {"O0001.nc", "O1\nT101\nG71 P1<|>0 Q20 D1. F0.2\nN10 G0 X1.\nN20 G1 X2.\nG70 P10 Q20\nM30\n"},
     "115",
     "O1\nT101\nG71 P115 Q20 D1. F0.2\nN115 G0 X1.\nN20 G1 X2.\nG70 P115 Q20\nM30\n"},
    // a label
    {"sinumerik",
     {"PART.MPF", "G90\nSTART: G0 X1\nR1=R1+1\nIF R1<3 GOTOB STA<|>RT\nM30\n"},
     "AGAIN",
     "G90\nAGAIN: G0 X1\nR1=R1+1\nIF R1<3 GOTOB AGAIN\nM30\n"},
    // a label in brackets
    {"ecs",
     {"PART.ecs", "[BE<|>GIN] G0 X1\n<IFF<R1-3>: [END]; [BEGIN]; [END]>\n[END] M17\n"},
     "TOP",
     "[TOP] G0 X1\n<IFF<R1-3>: [END]; [TOP]; [END]>\n[END] M17\n"},
    // a block number
    {"mefi",
     {"PART.NCP", "N10 G0 X1\nN2<|>0 G0 X2\nN30 M30\n"},
     "25",
     "N10 G0 X1\nN25 G0 X2\nN30 M30\n"},
    // a variable
    {"linuxcnc",
     {"part.ngc", "#<depth> = 5\n(Gehäuse 𝄞) G90 G0 X#<de<|>pth>\nM2\n"},
     "deep",
     "#<deep> = 5\n(Gehäuse 𝄞) G90 G0 X#<deep>\nM2\n"},
};

inline void addStep(EditorPlan &plan, const Renaming &renaming) {
  plan.begin("rename");
  addWithCursor(plan, renaming.program.name, renaming.program.text);
  plan.set("name", renaming.to);
  plan.set("after", renaming.after);
}

/// A finding after a comment in which bytes, characters and units of UTF-16 differ.
inline void addColumns(EditorPlan &plan) {
  plan.begin("columns");
  plan.add("a.nc", "O1\n(Gehäuse 𝄞) G00 G99999 X1.\nM30\n");
  plan.set("rule", "block-unknown-g-code");
  plan.set("text", "G99999");
}

/// The machine's state before a hole.
inline void addState(EditorPlan &plan) {
  plan.begin("hoverAt");
  addWithCursor(plan, "bore.nc",
                "%\nO1 (BORE)\nT1 M06\nG90 G54 G00 X0. Y0. S1000 M03\nG43 Z50. H01\n"
                "G83 X10. Y10. Z-10. R2. Q2. F100.\nX<|>30. Y0.\nG80\nM30\n%\n");
  plan.set("expect", std::vector<std::string>{"G83", "X 10, Y 10", "T1"});
}

/// The steps above whose programs are of the control.
inline void addJourneys(EditorPlan &plan, const std::string &dialect) {
  for (const Jump &jump : jumps)
    if (jump.dialect == dialect)
      addStep(plan, jump);
  for (const Renaming &renaming : renamings)
    if (renaming.dialect == dialect)
      addStep(plan, renaming);
  if (dialect == "haas-mill") {
    addColumns(plan);
    addState(plan);
  }
}

} // namespace ncvet::test
