// Milling programs of the benchmarks.
#include "programs.h"

#include <cmath>

namespace ncvet::bench {

namespace {

/// What is written before a milling program of a word-address control; `numbered`: each block has
/// its number.
void writeHead(ProgramFile &out, const char *name, int number, int tool, Frame frame,
               bool numbered = false) {
  if (frame == Frame::Tape)
    out.head(number, name);
  const auto prefix = [&](unsigned block) {
    return numbered ? "N" + std::to_string(block * 10) + " " : std::string();
  };
  out.block("%s(T%d MILL)", prefix(1).c_str(), tool);
  out.block("%sG21 G17 G40 G49 G80 G90 G94", prefix(2).c_str());
  out.block("%sT%d M6", prefix(3).c_str(), tool);
  out.block("%sG54 G0 X0. Y0. S12000 M3", prefix(4).c_str());
  out.block("%sG43 H%d Z50.", prefix(5).c_str(), tool);
  out.block("%sM8", prefix(6).c_str());
}

void writeEnd(ProgramFile &out, Frame frame) {
  out.block("G0 Z50. M9");
  out.block("M5");
  out.block("G49");
  out.block("M30");
  if (frame == Frame::Tape)
    out.line("%");
}
constexpr uint64_t endBlocks = 4;

/// Height of the wavy surface that is milled, mm; x and y in mm.
double surface(double x, double y) {
  return -8.0 + 3.0 * std::sin(x * 0.071) * std::cos(y * 0.053) +
         0.7 * std::sin(x * 0.31 + y * 0.17);
}

/// Point number `i` of a line of the finishing pass.
struct SurfacePoint {
  double x, y, z;
};
constexpr int pointsPerLine = 400;
SurfacePoint surfacePoint(uint64_t row, int i) {
  const double y = 0.15 * static_cast<double>(row % 2000) - 150.0;
  const double x = (row % 2 == 0 ? i : pointsPerLine - 1 - i) * 0.4873 - 97.25;
  return {x, i > 1 ? y + 0.02 * std::sin(x) : y, surface(x, y)};
}

} // namespace

/// A 3D finishing pass: parallel lines over a wavy surface, short linear moves, a retract after
/// every line. `blocks` is met exactly.
uint64_t writeSurfacing(ProgramFile &out, uint64_t blocks, Spelling spelling, Frame frame) {
  const bool numbered = spelling == Spelling::Numbered;
  writeHead(out, "FINISH 3D", 1001, 2, frame, numbered);
  const auto full = [&] { return out.blocks() + endBlocks >= blocks; };
  // The number of the next block: those of a long program have up to eight digits.
  const auto n = [&] {
    return numbered ? "N" + std::to_string(out.blocks() * 10) + " " : std::string();
  };
  const char *const feed = numbered ? "G1 " : "";
  for (uint64_t row = 0; !full(); ++row) {
    for (int i = 0; i < pointsPerLine && !full(); ++i) {
      const SurfacePoint at = surfacePoint(row, i);
      if (i == 0) {
        out.block("%sG0 X%.3f Y%.3f", n().c_str(), at.x, at.y);
        if (!full())
          out.block("%sG1 Z%.4f F600.", n().c_str(), at.z);
      } else if (i == 1) {
        out.block("%sG1 X%.3f Y%.3f Z%.4f F2400.", n().c_str(), at.x, at.y, at.z);
      } else {
        out.block("%s%sX%.3f Y%.3f Z%.4f", n().c_str(), feed, at.x, at.y, at.z);
      }
    }
    if (!full())
      out.block("%sG0 Z5.", n().c_str());
  }
  writeEnd(out, frame);
  return out.blocks();
}

/// The same pass for a SINUMERIK, as its post-processors write it.
uint64_t writeSinumerikSurfacing(ProgramFile &out, uint64_t blocks) {
  out.line("; FINISH 3D");
  out.block("N10 G17 G40 G54 G71 G90 G94");
  out.block("N20 T2 M6");
  out.block("N30 D1");
  out.block("N40 S12000 M3 M8");
  out.block("N50 G0 X0 Y0");
  out.block("N60 Z50");
  constexpr uint64_t tail = 3;
  const auto full = [&] { return out.blocks() + tail >= blocks; };
  for (uint64_t row = 0; !full(); ++row) {
    for (int i = 0; i < pointsPerLine && !full(); ++i) {
      const SurfacePoint at = surfacePoint(row, i);
      if (i == 0) {
        out.block("G0 X%.3f Y%.3f", at.x, at.y);
        if (!full())
          out.block("G1 Z%.4f F600", at.z);
      } else if (i == 1) {
        out.block("X%.3f Y%.3f Z%.4f F2400", at.x, at.y, at.z);
      } else {
        out.block("X%.3f Y%.3f Z%.4f", at.x, at.y, at.z);
      }
    }
    if (!full())
      out.block("G0 Z5");
  }
  out.block("G0 Z50 M9");
  out.block("M5");
  out.block("M30");
  return out.blocks();
}

/// Pockets with rounded corners and slots of half circles under radius compensation, and chains of
/// arcs by radius and by centre without it.
uint64_t writeContours(ProgramFile &out, uint64_t blocks, Frame frame) {
  writeHead(out, "CONTOURS", 1002, 4, frame);
  constexpr uint64_t pocketBlocks = 15, arcBlocks = 12;
  for (uint64_t part = 0; out.blocks() + pocketBlocks + arcBlocks + endBlocks <= blocks; ++part) {
    const double x = 60. * static_cast<double>(part % 10);
    const double y = 80. * static_cast<double>(part / 10 % 10);
    out.block("G0 X%.3f Y%.3f", x + 20, y + 15);
    out.block("Z2.");
    out.block("G1 G41 D4 X%.3f Y%.3f F1200.", x + 28, y + 8);
    out.block("Z-3. F300.");
    out.block("G3 X%.3f Y%.3f R8. F1200.", x + 36, y);
    out.block("G1 X%.3f", x + 44);
    out.block("G3 X%.3f Y%.3f I0. J6.", x + 50, y + 6);
    out.block("G1 Y%.3f", y + 24);
    out.block("G3 X%.3f Y%.3f I-6. J0.", x + 44, y + 30);
    out.block("G1 X%.3f", x + 6);
    out.block("G3 X%.3f Y%.3f R6.", x, y + 24);
    out.block("G1 Y%.3f", y + 8);
    out.block("G3 X%.3f Y%.3f I8. J0.", x + 8, y);
    out.block("G1 X%.3f", x + 36);
    out.block("G40 X%.3f Y%.3f", x + 20, y + 15);
    double along = x;
    out.block("G0 Z2.");
    out.block("X%.3f Y%.3f", along, y + 40);
    out.block("G1 Z-1. F300.");
    for (int arc = 0; arc < 8; ++arc) {
      along += 5;
      if (arc % 4 == 3)
        out.block("G1 X%.4f F1200.", along);
      else if (arc % 4 == 1)
        out.block("G3 X%.4f Y%.4f R3.1", along, y + 40);
      else
        out.block("G%d X%.4f Y%.4f I2.5 J0.", arc % 2 ? 3 : 2, along, y + 40);
    }
    out.block("G0 Z2.");
  }
  writeEnd(out, frame);
  return out.blocks();
}

/// Holes of plates: G81, G83, G73 and G82 with a new cycle every 40 holes.
uint64_t writeDrilling(ProgramFile &out, uint64_t blocks, Frame frame) {
  writeHead(out, "DRILL", 1003, 5, frame);
  constexpr int holes = 40;
  for (uint64_t pattern = 0; out.blocks() + holes + 2 + endBlocks <= blocks; ++pattern)
    for (int hole = 0; hole < holes; ++hole) {
      const double x = 9.5 * (hole % 8) + 80. * static_cast<double>(pattern % 6);
      const double y = 8.25 * (hole / 8) + 45. * static_cast<double>(pattern / 6 % 10);
      if (hole > 0) {
        if (hole % 8 == 0)
          out.block("X%.3f Y%.3f", x, y);
        else
          out.block("X%.3f", x);
        continue;
      }
      switch (pattern % 4) {
      case 0:
        out.block("G98 G81 X%.3f Y%.3f Z-6.5 R2. F180.", x, y);
        break;
      case 1:
        out.block("G99 G83 X%.3f Y%.3f Z-18. R2. Q4.5 F140.", x, y);
        break;
      case 2:
        out.block("G98 G73 X%.3f Y%.3f Z-12. R2. Q3. F160.", x, y);
        break;
      default:
        out.block("G99 G82 X%.3f Y%.3f Z-4. R2. P250 F120.", x, y);
      }
    }
  out.block("G80");
  writeEnd(out, frame);
  return out.blocks();
}

} // namespace ncvet::bench
