// All modes of a state as one number.
#include "interp/state/modes_number.h"

#include "interp/value/sum.h"

#include <bit>

namespace ncvet {

uint64_t modesNumber(const Dialect &dialect, const MachineState &state) {
  Sum sum(1);
  sum.add(state.factsMay);
  sum.add(state.factsMust);
  for (size_t i = 0; i < dialect.groups.size(); ++i)
    sum.add(state.groups[i]);
  sum.add(state.statedMay);
  sum.add(state.statedMust);
  sum.add(state.feed.peek());
  sum.add(state.speed.peek());
  sum.add(state.speedLimit.peek());
  const auto pair = [&](int32_t a, int32_t b) {
    sum.add(uint64_t(uint32_t(a)) << 32 | uint32_t(b));
  };
  pair(state.tool.peek(), state.toolOffset.peek());
  pair(state.preselected.peek(), state.lengthOffset.peek());
  pair(state.radiusOffset.peek(), int32_t(state.pendingCycle));
  sum.add(uint64_t(state.spindle.peek()) | uint64_t(state.liveTool.peek()) << 8 |
          uint64_t(state.compensation) << 16 | uint64_t(state.idleBlocks) << 24 |
          uint64_t(state.profile) << 32 | uint64_t(state.seeksBranch) << 40 |
          uint64_t(state.restoresModes) << 41 | uint64_t(state.frames.empty()) << 42 |
          uint64_t(bool(state.modalCalls)) << 43 |
          uint64_t(state.origin.isOlder(StatePart::Cycle)) << 44 |
          uint64_t(state.origin.isOlder(StatePart::Compensation)) << 45);
  sum.add(uint64_t(state.machineAxes) << 32 | llvm::bit_cast<uint32_t>(state.transforms));
  sum.add(uint64_t(state.switches.may) << 32 | state.switches.must);
  for (uint32_t left = state.switches.may; left; left &= left - 1)
    sum.add(state.switches.axes[size_t(std::countr_zero(left))]);
  sum.add(state.cycle.present);
  return sum.get();
}

} // namespace ncvet
