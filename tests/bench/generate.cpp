// Writes the programs that the benchmarks run on: the same bytes every time, on every machine.
//
//   ncvet_bench_programs FOLDER [--big]
//
// `programs.tsv` in the folder lists them: file, blocks that the control executes.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>

namespace {

/// A file that is written block by block. Any failure ends the process: there is nothing to
/// measure.
class ProgramFile {
public:
  explicit ProgramFile(const std::string &path) : file_(std::fopen(path.c_str(), "wb")) {
    if (!file_) {
      std::perror(path.c_str());
      std::exit(2);
    }
    std::setvbuf(file_, nullptr, _IOFBF, size_t{1} << 20);
  }
  ProgramFile(const ProgramFile &) = delete;
  ProgramFile &operator=(const ProgramFile &) = delete;
  ~ProgramFile() {
    if (std::fclose(file_) != 0) {
      std::perror("close");
      std::exit(2);
    }
  }

  /// One line that is a block, its end included.
  void block(const char *text) {
    ++blocks_;
    line(text);
  }
  /// One line that is no block of its own (`%`).
  void line(const char *text) {
    std::fputs(text, file_);
    std::fputc('\n', file_);
  }
  /// Blocks so far.
  uint64_t blocks() const { return blocks_; }

private:
  std::FILE *file_;
  uint64_t blocks_ = 0;
};

void toolHeader(ProgramFile &out, const char *name, int number) {
  char text[96];
  out.line("%");
  std::snprintf(text, sizeof text, "O%04d (%s)", number, name);
  out.block(text);
  out.block("(T2 BALL MILL 6)");
  out.block("G21 G17 G40 G49 G80 G90 G94");
  out.block("T2 M6");
  out.block("G54 G0 X0. Y0. S12000 M3");
  out.block("G43 H2 Z50.");
  out.block("M8");
}

void programEnd(ProgramFile &out) {
  out.block("G0 Z50. M9");
  out.block("M5");
  out.block("G49");
  out.block("M30");
  out.line("%");
}

/// Height of the wavy surface that is milled, mm; x and y in mm.
double surface(double x, double y) {
  return -8.0 + 3.0 * std::sin(x * 0.071) * std::cos(y * 0.053) +
         0.7 * std::sin(x * 0.31 + y * 0.17);
}

/// A 3D finishing pass: parallel lines over a wavy surface, short linear moves, a retract after
/// every line. `blocks` is met exactly.
uint64_t writeSurfacing(ProgramFile &out, uint64_t blocks) {
  toolHeader(out, "FINISH 3D", 1001);
  constexpr uint64_t tail = 4; // blocks of programEnd
  constexpr int pointsPerLine = 400;
  char text[96];
  for (uint64_t row = 0; out.blocks() + tail < blocks; ++row) {
    const double y = 0.15 * static_cast<double>(row % 2000) - 150.0;
    const bool forward = row % 2 == 0;
    for (int i = 0; i < pointsPerLine && out.blocks() + tail < blocks; ++i) {
      const double x = (forward ? i : pointsPerLine - 1 - i) * 0.4873 - 97.25;
      const double z = surface(x, y);
      if (i == 0) {
        std::snprintf(text, sizeof text, "G0 X%.3f Y%.3f", x, y);
        out.block(text);
        if (out.blocks() + tail >= blocks)
          break;
        std::snprintf(text, sizeof text, "G1 Z%.4f F600.", z);
      } else if (i == 1) {
        std::snprintf(text, sizeof text, "G1 X%.3f Y%.3f Z%.4f F2400.", x, y, z);
      } else {
        std::snprintf(text, sizeof text, "X%.3f Y%.3f Z%.4f", x, y + 0.02 * std::sin(x), z);
      }
      out.block(text);
    }
    if (out.blocks() + tail < blocks)
      out.block("G0 Z5.");
  }
  programEnd(out);
  return out.blocks();
}

/// Drilling of a grid: now G81, now G83, a new cycle block every 5000 holes.
uint64_t writeDrilling(ProgramFile &out, uint64_t blocks) {
  toolHeader(out, "DRILL", 1002);
  constexpr uint64_t tail = 5; // G80 and the blocks of programEnd
  char text[96];
  for (uint64_t hole = 0; out.blocks() + tail < blocks; ++hole) {
    const uint64_t row = hole / 1000;
    const double x = 0.5 * static_cast<double>(hole % 1000);
    const double y = 0.5 * static_cast<double>(row);
    if (hole % 10000 == 0)
      std::snprintf(text, sizeof text, "G98 G81 X%.3f Y%.3f Z-6.5 R2. F180.", x, y);
    else if (hole % 10000 == 5000)
      std::snprintf(text, sizeof text, "G99 G83 X%.3f Y%.3f Z-18. R2. Q4.5 F140.", x, y);
    else
      std::snprintf(text, sizeof text, "X%.3f Y%.3f", x, y);
    out.block(text);
  }
  out.block("G80");
  programEnd(out);
  return out.blocks();
}

/// Arcs in a chain, by radius and by centre, with a line between them.
uint64_t writeArcs(ProgramFile &out, uint64_t blocks) {
  toolHeader(out, "ARCS", 1003);
  constexpr uint64_t tail = 4; // blocks of programEnd
  out.block("G0 Z2.");
  out.block("G1 Z-1. F300.");
  out.block("F1200.");
  char text[96];
  double x = 0;
  for (uint64_t i = 0; out.blocks() + tail < blocks; ++i) {
    const double step = (i / 2000) % 2 == 0 ? 2.5 : -2.5; // the chain runs to and fro
    switch (i % 4) {
    case 0:
      x += step;
      std::snprintf(text, sizeof text, "G2 X%.4f Y0. I%.4f J0.", x, step / 2);
      break;
    case 1:
      x += step;
      std::snprintf(text, sizeof text, "G3 X%.4f Y0. R1.5", x);
      break;
    case 2:
      x += step;
      std::snprintf(text, sizeof text, "G3 X%.4f Y0. I%.4f J0.", x, step / 2);
      break;
    default:
      x += step;
      std::snprintf(text, sizeof text, "G1 X%.4f Y0.", x);
      break;
    }
    out.block(text);
  }
  programEnd(out);
  return out.blocks();
}

/// One contour with radius compensation: wavy rows of short lines, half circles between them.
uint64_t writeContour(ProgramFile &out, uint64_t blocks) {
  toolHeader(out, "CONTOUR", 1006);
  constexpr uint64_t tail = 5; // the move off, and the blocks of programEnd
  constexpr int linesPerRow = 500;
  constexpr double step = 0.5, pitch = 10;
  char text[96];
  out.block("G10 L12 P1 R1. (RADIUS)");
  out.block("G0 X-20. Y0. Z2.");
  out.block("G1 Z-1. F300.");
  out.block("G41 X0. D1 F1200.");
  const auto wave = [](double x) { return 0.3 * std::sin(0.4 * x); };
  for (uint64_t row = 0; out.blocks() + tail < blocks; ++row) {
    const double y = pitch * static_cast<double>(row % 5000);
    const bool forward = row % 2 == 0;
    for (int i = 1; i <= linesPerRow && out.blocks() + tail < blocks; ++i) {
      const double x = step * (forward ? i : linesPerRow - i);
      std::snprintf(text, sizeof text, i == 1 ? "G1 X%.3f Y%.4f" : "X%.3f Y%.4f", x, y + wave(x));
      out.block(text);
    }
    if (out.blocks() + tail >= blocks)
      break;
    const double x = forward ? step * linesPerRow : 0;
    std::snprintf(text, sizeof text, "%s X%.3f Y%.4f I0. J%.1f", forward ? "G3" : "G2", x,
                  y + pitch + wave(x), pitch / 2);
    out.block(text);
  }
  out.block("G40 G1 X-20.");
  programEnd(out);
  return out.blocks();
}

/// Macro B: a short program whose loops execute `blocks` blocks (to within one round of a loop).
/// Returns the blocks that the control executes, which are far more than the file has.
uint64_t writeMacro(ProgramFile &out, uint64_t blocks) {
  toolHeader(out, "WAVE BY MACRO", 1004);
  // A round of the inner loop: WHILE, 3 assignments, G1, increment, END.
  constexpr uint64_t inner = 7;
  constexpr uint64_t innerRounds = 200;
  // A round of the outer loop: WHILE, 2 assignments, G0, G1, the inner loop, its last WHILE, G0,
  // increment, END.
  constexpr uint64_t outer = 9 + inner * innerRounds;
  const uint64_t rows = (blocks + outer - 1) / outer;
  char text[96];
  out.block("#101=0 (ROW)");
  std::snprintf(text, sizeof text, "#102=%llu (ROWS)", static_cast<unsigned long long>(rows));
  out.block(text);
  out.block("#103=0.15 (STEP OVER)");
  const uint64_t head = out.blocks();
  out.block("WHILE [#101 LT #102] DO 1");
  out.block("#104=#101*#103");
  out.block("#105=0");
  out.block("G0 X0. Y#104");
  out.block("G1 Z-8. F600.");
  std::snprintf(text, sizeof text, "WHILE [#105 LT %llu] DO 2",
                static_cast<unsigned long long>(innerRounds));
  out.block(text);
  out.block("#106=#105*0.5");
  out.block("#107=3.*SIN[#106*4.]*COS[#104*3.]");
  out.block("#108=ROUND[#107*1000.]/1000.-8.");
  out.block("G1 X#106 Y#104 Z#108 F2400.");
  out.block("#105=#105+1");
  out.block("END 2");
  out.block("G0 Z5.");
  out.block("#101=#101+1");
  out.block("END 1");
  const uint64_t loops = out.blocks();
  programEnd(out);
  return head + rows * outer + 1 + (out.blocks() - loops);
}

/// Five lines: what is left of the time is the start of the process.
uint64_t writeTiny(ProgramFile &out) {
  out.line("%");
  out.block("O1005 (TINY)");
  out.block("G21 G17 G40 G49 G80 G90 G94");
  out.block("M30");
  out.line("%");
  return out.blocks();
}

} // namespace

int main(int argc, char **argv) {
  if (argc < 2 || (argc == 3 && std::strcmp(argv[2], "--big") != 0) || argc > 3) {
    std::fputs("usage: ncvet_bench_programs FOLDER [--big]\n", stderr);
    return 2;
  }
  const std::string folder = argv[1];
  const std::string tablePath = folder + "/programs.tsv";
  std::FILE *table = std::fopen(tablePath.c_str(), "wb");
  if (!table) {
    std::perror(tablePath.c_str());
    return 2;
  }
  auto write = [&](const char *name, const std::function<uint64_t(ProgramFile &)> &writer) {
    ProgramFile file(folder + "/" + name);
    const uint64_t blocks = writer(file);
    std::fprintf(table, "%s\t%llu\n", name, static_cast<unsigned long long>(blocks));
  };
  constexpr uint64_t million = 1'000'000;
  write("tiny.nc", writeTiny);
  write("surfacing-1m.nc", [](ProgramFile &file) { return writeSurfacing(file, million); });
  if (argc == 3)
    write("surfacing-10m.nc", [](ProgramFile &file) { return writeSurfacing(file, 10 * million); });
  write("drilling-1m.nc", [](ProgramFile &file) { return writeDrilling(file, million); });
  write("arcs-1m.nc", [](ProgramFile &file) { return writeArcs(file, million); });
  write("contour-1m.nc", [](ProgramFile &file) { return writeContour(file, million); });
  write("macro-1m.nc", [](ProgramFile &file) { return writeMacro(file, million); });
  return std::fclose(table) == 0 ? 0 : 2;
}
