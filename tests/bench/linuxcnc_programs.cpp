// Programs of the benchmarks in LinuxCNC's own spelling, which its interpreter runs too.
#include "programs.h"

namespace ncvet::bench {

void writeToolTable(const std::string &path) {
  ProgramFile out(path);
  // The one that goes along contours gets into every corner.
  for (const char *const tool : {"T2 P2 D6.0 Z0", "T4 P4 D0.04 Z0", "T5 P5 D6.0 Z0"})
    out.line(tool);
}

uint64_t writeBracketedMacros(ProgramFile &out, uint64_t blocks) {
  constexpr uint64_t innerRounds = 200;
  // A round of the inner loop: while, 3 assignments, if, endif, call and the 3 blocks of what it
  // calls, G1, increment, endwhile. Where the depth is too small another assignment comes to it.
  constexpr uint64_t inner = 13;
  // A round of the outer loop: while, 2 assignments, G0, G1, the inner loop, its last while, G0,
  // increment, endwhile.
  constexpr uint64_t outer = 9 + inner * innerRounds;
  const uint64_t rows = (blocks + outer - 1) / outer;
  out.block("o1010 sub");
  out.block("#26=[#1-0.1]");
  out.block("#109=[#26+0.05]");
  out.block("o1010 endsub");
  out.block("G21 G17 G40 G49 G80 G90 G94");
  out.block("T2 M6");
  out.block("G54 G0 X0. Y0. S12000 M3");
  out.block("G43 H2 Z50.");
  out.block("#101=0 (ROW)");
  out.block("#102=%llu (ROWS)", static_cast<unsigned long long>(rows));
  out.block("#103=0.15 (STEP OVER)");
  const uint64_t head = out.blocks();
  out.block("o1 while [#101 LT #102]");
  out.block("#104=[#101*#103]");
  out.block("#105=0");
  out.block("G0 X0. Y#104");
  out.block("G1 Z-8. F600.");
  out.block("o2 while [#105 LT %llu]", static_cast<unsigned long long>(innerRounds));
  out.block("#106=[#105*0.5]");
  out.block("#107=[3.*SIN[#106*4.]*COS[#104*3.]]");
  out.block("#108=[ROUND[#107*1000.]/1000.-8.]");
  out.block("o3 if [#108 GT -5.]");
  out.block("#108=-5.");
  out.block("o3 endif");
  out.block("o1010 call [#108] [#105]");
  out.block("G1 X#106 Y#104 Z#108 F2400.");
  out.block("#105=[#105+1]");
  out.block("o2 endwhile");
  out.block("G0 Z5.");
  out.block("#101=[#101+1]");
  out.block("o1 endwhile");
  out.block("G0 Z50. M9");
  out.block("M5");
  out.block("G49");
  out.block("M30");
  constexpr uint64_t tail = 4;
  return head + rows * outer + 1 + tail;
}

} // namespace ncvet::bench
