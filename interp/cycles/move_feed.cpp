// The feed of a motion, from the state in which it is made.
#include "interp/cycles/move_feed.h"

#include "interp/value/units.h"

namespace ncvet {

void setFeed(const Dialect &dialect, const MachineState &state, Move &move) {
  move.feedMode = state.activeAction(dialect, StandardGroup::FeedMode);
  move.feed = state.may(Fact::FeedSet) ? state.feed.get() : Interval::unknown();
  if (state.activeAction(dialect, StandardGroup::Units) == Action::Inch &&
      move.feedMode != Action::FeedInverseTime)
    move.feed = move.feed * millimetresPerInch;
}

} // namespace ncvet
