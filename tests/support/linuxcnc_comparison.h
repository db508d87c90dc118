// A test that compares what ncvet says of programs with LinuxCNC's own interpreter.
#pragma once

#include "tests/support/motion_comparison.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <iostream>
#include <regex>

namespace ncvet::test {

namespace fs = std::filesystem;

inline std::vector<KnownTool> tools() {
  std::vector<KnownTool> list;
  for (int number = 1; number <= 99; ++number)
    list.push_back({number, number * 2.54, 2 + number * 0.25});
  return list;
}

/// The machine on which rs274 believes to be: every offset zero, its tools.
inline std::string machineText() {
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

inline std::string textOf(const fs::path &path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The program with its start stated, so that both begin at the same place; one more line than
/// before when `line` is 1.
inline std::string withStart(const std::string &text) {
  const std::string start = "G53 G0 X0 Y0 Z0 A0 B0 C0\nG80\n";
  size_t at = text.find_first_not_of(" \t\r\n");
  if (at != std::string::npos && text[at] == '%') {
    at = text.find('\n', at);
    return at == std::string::npos ? text : text.substr(0, at + 1) + start + text.substr(at + 1);
  }
  return start + text;
}

/// rs274 2.9 swaps the axes of G74 and G84 outside the XY plane: nothing to trace, but a warning.
inline bool tapsAside(const std::string &text) {
  static const std::regex tap("[gG] *[78]4([^0-9.]|$)"), plane("[gG] *1[89]([^0-9.]|$)");
  return std::regex_search(text, tap) && std::regex_search(text, plane);
}

class LinuxCncComparison : public testing::Test {
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
    unsigned ofMachine = 0; ///< programs that need an INI file, which rs274 alone does not have
    std::vector<std::string> missed, wrong;
  };

  /// Compares motions and verdict of one program that lies in `folder`: the interpreter, of which
  /// a start costs more than the program does, is started once for both.
  void compareAndJudge(const fs::path &folder, const std::string &program, const std::string &title,
                       Tally &tally, Verdicts &verdicts) {
    const Rs274Run run = interpreter_->run(folder, program, tools());
    compare(run, folder, program, title, tally);
    judge(run, folder, program, title, verdicts);
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
        if (finding.severity != Severity::Error && (run.accepted || !mayBeElsewhere(finding)))
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
    if (!found && hangsOnMachine(run)) {
      --verdicts.rejected;
      ++verdicts.ofMachine;
      return;
    }
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

  /// What rs274 lacks is in a machine's INI file: codes that it remaps, M100 to M199 as files of
  /// the machine, values of its HAL, axes beyond the first three.
  static bool hangsOnMachine(const Rs274Run &run) {
    const llvm::StringRef message = run.message;
    return message.startswith("Unknown g code used") ||
           message.startswith("Unknown m code used: M1") || message.contains("#<_hal[") ||
           message.startswith("Bad character 'u'");
  }

  /// A warning, because a machine's INI file may make the code or name the subprogram's folder.
  static bool mayBeElsewhere(const Finding &finding) {
    const llvm::StringRef rule = allRules()[finding.rule].info.id;
    return rule.startswith("block-unknown") || rule == "flow-undefined-subprogram";
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
              << " places at which the tool runs back unseen); left out: " << verdicts.subprograms
              << " files of subprograms, " << verdicts.ofMachine << " that need an INI file\n";
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

/// On one line, for messages.
inline std::string inOneLine(llvm::StringRef text) {
  std::string line = text.rtrim().str();
  for (size_t at = 0; (at = line.find('\n', at)) != std::string::npos; at += 3)
    line.replace(at, 1, " | ");
  return line;
}

} // namespace ncvet::test
