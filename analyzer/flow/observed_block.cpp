// The machine's states on all paths that come by one block.
#include "analyzer/flow/observed_block.h"

namespace ncvet {

void ObservedBlock::executed(const Step &step, bool) {
  if (step.at != offset_ || step.unit().source.id() != file_)
    return;
  const MachineState &before = step.before;
  const Live &live = step.live;
  constexpr size_t mostWays = 8; // more nobody reads
  for (StateOnWay &known : states.ways)
    if (equal(known.before, before))
      return;
  if (states.ways.size() == mostWays) {
    StateOnWay &last = states.ways.back();
    last.before = join(last.before, before);
    last.after = join(last.after, live.state);
    states.joined = true;
    return;
  }
  states.ways.push_back({before, live.state, stepsOf(live.path)});
}

} // namespace ncvet
