// Runs LinuxCNC's arealone interpreter `rs274` and reads the canonical calls that it prints.
#pragma once

#include "interp/geometry/move.h"
#include "tests/support/run_program.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/MemoryBuffer.h"
#include "llvm/Support/Program.h"

#include <cstdlib>
#include <optional>

namespace ncvet::test {

/// A motion that the interpreter asks for, in the unit of the program and in its coordinates.
struct CanonicalMove {
  enum Kind { Rapid, Linear, Arc, Curve, Thread, Probe, Dwell };
  Kind kind = Rapid;
  std::array<double, 6> to{}; ///< X Y Z A B C; of a curve not known
  bool inch = false;
  std::array<Axis, 2> plane{Axis::X, Axis::Y}; ///< of an arc
  std::array<double, 2> centre{};
  int turns = 0; ///< of an arc: begun turns, below zero clockwise
  double seconds = 0;
  std::string text; ///< the call as it was printed
};

struct Rs274Run {
  bool finished = false; ///< in time
  bool accepted = false;
  std::string message; ///< of what it rejects
  std::string line;    ///< the program's line that it rejects, as it is there
  std::vector<CanonicalMove> moves;
};

/// Tools that both interpreters know: number, length and diameter in millimetres.
struct KnownTool {
  int number;
  double length, diameter;
};

/// The interpreter, found as the environment variable NCVET_RS274 says or else on the path.
class Rs274 {
public:
  static std::optional<Rs274> find() {
    if (const char *named = std::getenv("NCVET_RS274"))
      return Rs274(named);
    if (auto program = llvm::sys::findProgramByName("rs274"))
      return Rs274(*program);
    return std::nullopt;
  }

  /// Runs a program of `folder`, with every offset zero. Bounded by ten seconds.
  Rs274Run run(const std::filesystem::path &folder, const std::string &program,
               const std::vector<KnownTool> &tools) const {
    TemporaryFolder files;
    const std::string variables = (files.path() / "rs274.var").string();
    const std::string table = (files.path() / "tools.tbl").string();
    writeVariables(variables);
    writeTools(table, tools);
    const std::string out = (files.path() / "out").string(), err = (files.path() / "err").string();
    const std::string in = folder.string();
    // It keeps its tools in a file of its user's home: one of its own, whatever else runs.
    const std::string home = "HOME=" + files.path().string();
    const llvm::StringRef words[] = {"env", "-C",      in,   home,  program_, "-g",
                                     "-v",  variables, "-t", table, program};
    const llvm::Optional<llvm::StringRef> streams[] = {llvm::StringRef(""), llvm::StringRef(out),
                                                       llvm::StringRef(err)};
    Rs274Run run;
    constexpr unsigned seconds = 10;
    const int code = llvm::sys::ExecuteAndWait(*llvm::sys::findProgramByName("env"), words,
                                               llvm::None, streams, seconds);
    run.finished = code != -2;
    run.accepted = code == 0;
    read(contents(out), run);
    readError(contents(err), run);
    return run;
  }

private:
  explicit Rs274(std::string program) : program_(std::move(program)) {}

  static std::string contents(const std::string &path) {
    auto buffer = llvm::MemoryBuffer::getFile(path);
    return buffer ? (*buffer)->getBuffer().str() : std::string();
  }

  static void writeVariables(const std::string &path) {
    std::ofstream file(path);
    const auto row = [&](int first, int last) {
      for (int i = first; i <= last; ++i)
        file << i << "\t" << (i == 5220 ? 1.0 : 0.0) << "\n";
    };
    row(5161, 5169);
    row(5181, 5189);
    row(5210, 5220);
    for (int system = 0; system < 9; ++system)
      row(5221 + 20 * system, 5230 + 20 * system);
  }

  /// Its lengths are inches where no machine says otherwise.
  static void writeTools(const std::string &path, const std::vector<KnownTool> &tools) {
    std::ofstream file(path);
    file.precision(17);
    for (const KnownTool &tool : tools)
      file << "T" << tool.number << " P" << tool.number << " Z" << tool.length / 25.4 << " D"
           << tool.diameter / 25.4 << "\n";
  }

  static std::vector<double> numbers(llvm::StringRef list) {
    llvm::SmallVector<llvm::StringRef, 10> parts;
    list.split(parts, ',');
    std::vector<double> values;
    for (const llvm::StringRef part : parts)
      values.push_back(std::strtod(part.trim().str().c_str(), nullptr));
    return values;
  }

  static void read(llvm::StringRef output, Rs274Run &run) {
    bool inch = false, synchronous = false;
    std::array<Axis, 3> order{Axis::X, Axis::Y, Axis::Z}; // plane and its normal
    llvm::SmallVector<llvm::StringRef, 0> lines;
    output.split(lines, '\n');
    for (const llvm::StringRef line : lines) {
      // "   17 N..... ARC_FEED(10.0000, …)"
      const size_t open = line.find('(');
      const size_t name = line.rfind(' ', open) + 1;
      if (open == llvm::StringRef::npos || name < 8)
        continue;
      const llvm::StringRef call = line.slice(name, open);
      const llvm::StringRef inside = line.slice(open + 1, line.rfind(')'));
      const std::vector<double> values = numbers(inside);
      const auto add = [&](CanonicalMove::Kind kind) -> CanonicalMove & {
        CanonicalMove &move = run.moves.emplace_back();
        move.kind = kind;
        move.inch = inch;
        move.text = line.substr(name).str();
        return move;
      };
      const auto straight = [&](CanonicalMove::Kind kind) {
        CanonicalMove &move = add(kind);
        for (size_t i = 0; i < move.to.size() && i < values.size(); ++i)
          move.to[i] = values[i];
      };
      if (call == "USE_LENGTH_UNITS") {
        inch = inside.contains("INCHES");
      } else if (call == "SELECT_PLANE") {
        order = inside.endswith("XZ")   ? std::array{Axis::Z, Axis::X, Axis::Y}
                : inside.endswith("YZ") ? std::array{Axis::Y, Axis::Z, Axis::X}
                                        : std::array{Axis::X, Axis::Y, Axis::Z};
      } else if (call == "START_SPEED_FEED_SYNC") {
        synchronous = true;
      } else if (call == "STOP_SPEED_FEED_SYNCH") {
        synchronous = false;
      } else if (call == "STRAIGHT_TRAVERSE") {
        straight(CanonicalMove::Rapid);
      } else if (call == "STRAIGHT_FEED") {
        straight(synchronous ? CanonicalMove::Thread : CanonicalMove::Linear);
      } else if (call == "RIGID_TAP") {
        const std::array<double, 6> start =
            run.moves.empty() ? std::array<double, 6>{} : run.moves.back().to;
        straight(CanonicalMove::Thread); // X, Y and Z are printed
        std::copy(start.begin() + 3, start.end(), run.moves.back().to.begin() + 3);
        const std::string text = run.moves.back().text;
        CanonicalMove &back = add(CanonicalMove::Thread); // and out again
        back.to = start;
        back.text = text;
      } else if (call == "STRAIGHT_PROBE") {
        straight(CanonicalMove::Probe);
      } else if (call == "NURBS_FEED") {
        add(CanonicalMove::Curve);
      } else if (call == "DWELL") {
        add(CanonicalMove::Dwell).seconds = values.empty() ? 0 : values[0];
      } else if (call == "ARC_FEED" && values.size() >= 9) {
        CanonicalMove &move = add(CanonicalMove::Arc);
        move.plane = {order[0], order[1]};
        move.to[size_t(order[0])] = values[0];
        move.to[size_t(order[1])] = values[1];
        move.centre = {values[2], values[3]};
        move.turns = int(values[4]);
        move.to[size_t(order[2])] = values[5];
        for (size_t i = 0; i < 3; ++i)
          move.to[3 + i] = values[6 + i];
      }
    }
  }

  /// The message, and after it the line as it is in the program.
  static void readError(llvm::StringRef output, Rs274Run &run) {
    llvm::SmallVector<llvm::StringRef, 0> lines;
    output.split(lines, '\n', -1, false);
    llvm::erase_if(lines, [](llvm::StringRef line) {
      return line.trim().empty() || line.trim() == "executing";
    });
    if (run.accepted || lines.empty())
      return;
    run.line = lines.size() > 1 ? lines.back().trim().str() : "";
    run.message = lines[lines.size() > 1 ? lines.size() - 2 : 0].trim().str();
  }

  std::string program_;
};

} // namespace ncvet::test
