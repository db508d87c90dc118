// Where states wait for each other, and how they are joined.
#include "analyzer/flow/pending.h"

#include "analyzer/flow/decided_conditions.h"
#include "interp/value/work_meter.h"

namespace ncvet {

namespace {

/// States kept apart at one place; beyond that the two closest are joined.
constexpr size_t maxLives = 4;

/// What it costs to copy or compare a state, and to join two, in plain moves.
constexpr uint64_t workOfLook = 1, workOfJoin = 6;

/// What two paths have decided differently is not decided: levels of block skip, and conditions.
void joinDecisions(Live &to, const Live &from) {
  to.decided = decidedByBoth(to.decided, from.decided);
  for (size_t i = 0; i < from.skip.size(); ++i)
    if (to.skip[i] != from.skip[i])
      to.skip[i] = SkipSwitch::Unknown;
}

} // namespace

void mergeInto(Lives &lives, Live live) {
  workDone += workOfLook * (1 + lives.size());
  for (Live &other : lives)
    if (equal(other.state, live.state)) {
      joinDecisions(other, live);
      if (live.path == nullptr || (other.path && live.path->length < other.path->length))
        other.path = live.path;
      return;
    }
  Live *closest = nullptr;
  unsigned fewest = ~0u;
  for (Live &other : lives) {
    const unsigned differences = modeDifferences(other.state, live.state);
    if (differences == 0 && other.skip == live.skip) {
      other.state = join(other.state, live.state);
      joinDecisions(other, live);
      workDone += workOfJoin;
      return;
    }
    if (differences < fewest) {
      fewest = differences;
      closest = &other;
    }
  }
  if (lives.size() < maxLives) {
    lives.push_back(std::move(live));
    return;
  }
  closest->state = join(closest->state, live.state);
  workDone += workOfJoin;
  joinDecisions(*closest, live);
}

/// Whether a path that comes to a block executed before brings nothing new there. With many jumps
/// back, most rounds differ in a trifle, and each would run on to the program's end: a block that
/// many of them come by takes their states as a loop head does.
bool Pending::bringsNothing(uint32_t offset, HeldState &state, uint32_t executed) {
  constexpr unsigned roundsBeforeJoining = 8, roundsBeforeWidening = 16;
  if (!rounds_ || offset >= executed)
    return false;
  Meeting &meeting = meetings_[offset];
  if (meeting.lastRound != rounds_) {
    meeting.lastRound = rounds_;
    ++meeting.rounds;
  }
  if (meeting.rounds <= roundsBeforeJoining)
    return false;
  if (!meeting.seen) {
    meeting.seen = std::make_unique<MachineState>(state);
    return false;
  }
  workDone += 2 * workOfJoin;
  if (covers(*meeting.seen, state))
    return true;
  *meeting.seen = meeting.rounds <= roundsBeforeWidening ? join(*meeting.seen, state)
                                                         : widen(*meeting.seen, state);
  state = *meeting.seen;
  return false;
}

void Pending::add(uint32_t offset, Live live, uint32_t executed) {
  if (!bringsNothing(offset, live.state, executed))
    wait(offset, std::move(live));
}

void Pending::wait(uint32_t offset, Live live) {
  if (offset > next_)
    return mergeInto(later_[offset], std::move(live));
  if (offset < next_) {
    if (!isEmpty())
      later_[next_] = std::move(first_);
    first_.clear();
    next_ = offset;
  }
  mergeInto(first_, std::move(live));
}

Lives Pending::take(uint32_t &offset) {
  offset = next_;
  Lives lives = std::move(first_);
  first_.clear();
  next_ = ~0u;
  if (const auto first = later_.begin(); first != later_.end()) {
    next_ = first->first;
    first_ = std::move(first->second);
    later_.erase(first);
  }
  return lives;
}

} // namespace ncvet
