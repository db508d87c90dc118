// The motions of a program as lines of text, for tests.
#pragma once

#include "analyzer/trace/trace.h"
#include "tests/support/run_program.h"

namespace ncvet::test {

/// Moves in a short form: "1 rapid X52 Z3", arcs with their centre and turns.
class Written : public TraceSink {
public:
  std::vector<std::string> lines;

  void moved(const TracedMove &traced) override {
    const Move &move = traced.move;
    static constexpr const char *kinds[] = {"rapid", "linear", "arc",     "thread",
                                            "dwell", "tool",   "spindle", "end"};
    std::string line = std::to_string(traced.unit->source.lines().lineOf(traced.begin)) + " " +
                       kinds[size_t(move.kind)];
    if (move.kind == MoveKind::Dwell || move.kind == MoveKind::Tool)
      line += " " + number(move.value);
    if (move.kind <= MoveKind::Thread)
      line += place(move);
    if (move.kind == MoveKind::Arc)
      line += std::string(move.clockwise ? " cw " : " ccw ") + number(move.centre[0]) + "/" +
              number(move.centre[1]) + " " + number(move.turns);
    if (move.kind != MoveKind::Spindle)
      lines.push_back(line);
  }
  void lost(const FileUnit &unit, SourceRange where, llvm::StringRef why) override {
    lines.push_back(std::to_string(unit.source.lines().lineOf(where.begin)) +
                    " lost: " + why.str());
  }

private:
  static std::string number(const Interval &value) {
    if (!value.isConstant())
      return "?";
    std::string text;
    llvm::raw_string_ostream(text) << llvm::format("%.3f", value.value());
    while (text.back() == '0')
      text.pop_back();
    if (text.back() == '.')
      text.pop_back();
    return text == "-0" ? "0" : text;
  }
  static std::string place(const Move &move) {
    std::string text;
    for (size_t i = 0; i < 3; ++i)
      if (!move.to[i].isUnknown())
        text += std::string(" ") + (move.machineAxes >> i & 1 ? "m" : "") + "XYZ"[i] +
                number(move.to[i]);
    return text;
  }
};

/// `machine` is the text of a machine profile, or empty.
inline std::vector<std::string> traceOf(const char *dialect, const std::string &program,
                                        const std::string &machine = "") {
  Written written;
  withProgram(dialect, {{"PART.nc", program}}, machine,
              [&](Project &project, FileUnit &unit) { trace(project, unit, {}, written); });
  return written.lines;
}

} // namespace ncvet::test
