// Programs of the benchmarks that turn, that compute, call and comment.
#include "programs.h"

#include <cmath>

namespace ncvet::bench {

/// Five lines: what is left of the time is the start of the process.
uint64_t writeTiny(ProgramFile &out) {
  out.head(1005, "TINY");
  out.block("G21 G17 G40 G49 G80 G90 G94");
  out.block("M30");
  out.line("%");
  return out.blocks();
}

uint64_t writeTinySinumerik(ProgramFile &out) {
  out.block("N10 G17 G54 G71 G90 G94");
  out.block("N20 M30");
  return out.blocks();
}

/// Passes along a shaft with fillets, chamfers and tapers, feed in millimetres per revolution.
uint64_t writeTurning(ProgramFile &out, uint64_t blocks) {
  out.head(1006, "SHAFT");
  out.block("G21 G40 G99");
  out.block("G50 S3000");
  out.block("T0101");
  out.block("G96 S220 M03");
  out.block("G00 X84. Z5. M08");
  constexpr uint64_t tail = 4, passBlocks = 12;
  for (uint64_t pass = 0; out.blocks() + passBlocks + tail <= blocks; ++pass) {
    // Every 30 passes the next shaft begins.
    const double stock = 0.4 * static_cast<double>(29 - pass % 30);
    out.block("G00 X%.3f Z2.", 20 + stock);
    out.block("G01 Z0. F0.25");
    out.block("G03 X%.3f Z-2. R2.", 24 + stock);
    out.block("G01 Z-18.");
    out.block("G02 X%.3f Z-21. R3. F0.15", 30 + stock);
    out.block("G01 X%.3f Z-40. F0.25", 34 + stock);
    out.block("X%.3f Z-41.5", 37 + stock);
    out.block("Z-60.");
    out.block("G02 X%.3f Z-64. I4. K0.", 45 + stock);
    out.block("G01 X%.3f", 60 + stock);
    out.block("G00 X%.3f", 64 + stock);
    out.block("Z2.");
  }
  out.block("G00 X120. Z50. M09");
  out.block("G28 U0. W0.");
  out.block("M05");
  out.block("M30");
  out.line("%");
  return out.blocks();
}

/// Short pieces of work with much said about them.
uint64_t writeCommented(ProgramFile &out, uint64_t lines) {
  out.head(1007, "COMMENTED");
  out.block("G21 G17 G40 G49 G80 G90 G94");
  out.block("T2 M6");
  out.block("G54 G0 X0. Y0. S12000 M3");
  out.block("G43 H2 Z50.");
  out.block("G1 Z-1. F600.");
  uint64_t written = 7;
  constexpr uint64_t tail = 5, piece = 20;
  for (uint64_t i = 0; written + piece + tail <= lines; ++i, written += piece) {
    out.line("(---------------------------------------------------------)");
    out.line("(  OPERATION: FINISH WALL, TOOL 2, STEP DOWN 0.5, STOCK 0. )");
    out.line("(  CHECK THE CLAMPS BEFORE THIS PIECE                      )");
    out.line("(---------------------------------------------------------)");
    for (int move = 0; move < 6; ++move) {
      const double angle = 0.37 * static_cast<double>(i % 1000) + 1.05 * move;
      out.block("X%.3f Y%.3f", 80 * std::cos(angle), 60 * std::sin(angle));
      if (move % 3 == 0) {
        out.line("");
        out.line("  (NEXT CORNER)");
        out.line("");
        out.line("(WALL)");
      } else if (move % 3 == 1) {
        out.line("");
      }
    }
  }
  out.block("G0 Z50. M9");
  out.block("M5");
  out.block("G49");
  out.block("M30");
  out.line("%");
  return out.blocks();
}

/// Blocks of twenty words and a comment: five axes, many codes.
uint64_t writeLongLines(ProgramFile &out, uint64_t blocks) {
  out.head(1008, "LONG LINES");
  out.block("G21 G17 G40 G49 G80 G90 G94");
  out.block("T2 M6");
  out.block("G43 G54 G0 X0. Y0. Z50. H2 S12000 M3");
  constexpr uint64_t tail = 4;
  for (uint64_t i = 0; out.blocks() + tail < blocks; ++i) {
    const double t = 0.01 * static_cast<double>(i % 5000);
    out.block(
        "N%llu G90 G94 G17 G21 G40 G49 G54 G64 G80 G98 G1 X%.4f Y%.4f Z%.4f A%.4f B%.4f F2400. "
        "S12000 M3 D2 (POINT %llu OF THE FINISHING PASS)",
        static_cast<unsigned long long>(out.blocks()) * 10, 50 * std::cos(t), 40 * std::sin(t),
        -2 - 0.5 * std::sin(3 * t), 20 * std::sin(t), 15 * std::cos(t),
        static_cast<unsigned long long>(i));
  }
  out.block("G0 Z50. M9");
  out.block("M5");
  out.block("G49");
  out.block("M30");
  out.line("%");
  return out.blocks();
}

/// A surface by Macro B: two loops, a condition, and a macro that is called in every round.
uint64_t writeMacros(ProgramFile &out, uint64_t blocks) {
  constexpr uint64_t innerRounds = 200;
  // A round of the inner loop: WHILE, 3 assignments, IF, G1, G65 and the 3 blocks of its macro,
  // increment, END.
  constexpr uint64_t inner = 12;
  // A round of the outer loop: WHILE, 2 assignments, G0, G1, the inner loop, its last WHILE, G0,
  // increment, END.
  constexpr uint64_t outer = 9 + inner * innerRounds;
  const uint64_t rows = (blocks + outer - 1) / outer;
  out.head(1009, "WAVE BY MACRO");
  out.block("G21 G17 G40 G49 G80 G90 G94");
  out.block("T2 M6");
  out.block("G54 G0 X0. Y0. S12000 M3");
  out.block("G43 H2 Z50.");
  out.block("#101=0 (ROW)");
  out.block("#102=%llu (ROWS)", static_cast<unsigned long long>(rows));
  out.block("#103=0.15 (STEP OVER)");
  const uint64_t head = out.blocks();
  out.block("WHILE [#101 LT #102] DO 1");
  out.block("#104=#101*#103");
  out.block("#105=0");
  out.block("G0 X0. Y#104");
  out.block("G1 Z-8. F600.");
  out.block("WHILE [#105 LT %llu] DO 2", static_cast<unsigned long long>(innerRounds));
  out.block("#106=#105*0.5");
  out.block("#107=3.*SIN[#106*4.]*COS[#104*3.]");
  out.block("#108=ROUND[#107*1000.]/1000.-8.");
  out.block("IF [#108 GT -5.] THEN #108=-5.");
  out.block("G65 P1010 Z#108 A#105");
  out.block("G1 X#106 Y#104 Z#109 F2400.");
  out.block("#105=#105+1");
  out.block("END 2");
  out.block("G0 Z5.");
  out.block("#101=#101+1");
  out.block("END 1");
  const uint64_t loops = out.blocks();
  out.block("G0 Z50. M9");
  out.block("M5");
  out.block("G49");
  out.block("M30");
  const uint64_t main = out.blocks();
  out.block("O1010 (DEPTH)");
  out.block("#1=#26-0.1");
  out.block("#109=#1+0.05");
  out.block("M99");
  out.line("%");
  return head + rows * outer + 1 + (main - loops);
}

/// A main program that calls subprograms three deep: a fifth of them are of the first level, three
/// tenths of the second.
uint64_t writeSubprograms(ProgramFile &out, uint64_t programs) {
  const uint64_t tops = programs / 5, mids = programs * 3 / 10, leaves = programs - tops - mids;
  constexpr int topBase = 1000, midBase = 3000, leafBase = 5000;
  out.head(1, "PLATE");
  out.block("G21 G17 G40 G49 G80 G90 G94");
  out.block("T2 M6");
  out.block("G54 G0 X0. Y0. S12000 M3");
  out.block("G43 H2 Z50.");
  for (uint64_t i = 0; i < tops; ++i)
    out.block("M98 P%d", topBase + int(i));
  out.block("G0 Z50. M9");
  out.block("M5");
  out.block("G49");
  out.block("M30");
  const uint64_t main = out.blocks();
  constexpr uint64_t called = 3;
  const auto body = [&](int number, int moves, int base, uint64_t first, uint64_t count) {
    out.block("O%04d", number);
    for (int i = 0; i < moves; ++i) {
      if (i % 4 == 0)
        out.block("G90 G0 X%d. Y%d.", number % 37 * 3 + i, number % 29 * 2 + i);
      else if (i % 4 == 1)
        out.block("G1 Z-%d.%d F300.", 1 + i % 3, number % 10);
      else if (i % 4 == 2)
        out.block("G91 G1 X%d. F900.", 1 + i);
      else
        out.block("G90 G0 Z5.");
      // Called above the work.
      if (base && i % 4 == 3 && uint64_t(i / 4) < called)
        out.block("M98 P%d", base + int((first * called + uint64_t(i / 4)) % count));
    }
    out.block("M99");
  };
  constexpr int moves = 20;
  for (uint64_t i = 0; i < tops; ++i)
    body(topBase + int(i), moves, midBase, i, mids);
  for (uint64_t i = 0; i < mids; ++i)
    body(midBase + int(i), moves, leafBase, i, leaves);
  for (uint64_t i = 0; i < leaves; ++i)
    body(leafBase + int(i), moves + 4, 0, 0, 1);
  out.line("%");
  // Its number, the moves and the return; with the calls of the first and second level.
  constexpr uint64_t caller = moves + 2 + called, leaf = moves + 6;
  return main + tops * (caller + called * (caller + called * leaf));
}

} // namespace ncvet::bench
