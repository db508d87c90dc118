// Jumps to a known block: which lead back, how often they are followed, and which never end.
#include "analyzer/flow/loops.h"

#include "analyzer/flow/endings.h"
#include "interp/value/work_meter.h"

namespace ncvet {

namespace {

/// Visits of a loop head with joined states before bounds that still move are given up.
constexpr unsigned visitsBeforeWidening = 8;
/// Passes of a loop in which something unknown decides where to go: as likely as not it decides on
/// the exit, and the loop has no number of passes at all. So many are run, fewer when they are
/// long.
constexpr unsigned maxForkedVisits = 128, minForkedVisits = 4;
constexpr uint64_t maxForkedSteps = 1000; ///< blocks, those of called programs included

/// After so many passes without a choice it is asked whether a loop ends at all.
constexpr unsigned visitsBeforeDoubt = 100;

/// What it costs to see whether joined states bring anything new, in plain moves.
constexpr uint64_t workOfRound = 12;

/// States that may be on the path at one block, at most.
constexpr uint64_t mostStates = 8;

uint64_t variablesOf(const MachineState &state) {
  return llvm::hash_combine(state.locals.hash(), state.commons.hash());
}

/// Where a loop that begins at `target` is seen: at the head of a structure, else at the jump.
SourceRange loopAt(const Activation &activation, uint32_t target) {
  const FileUnit &unit = activation.region.unit;
  Block head;
  unit.reader->read(target, head);
  for (const Item &item : head.items)
    if (item.kind == ItemKind::Structure)
      return {unit.source.id(), item.begin, item.end};
  return activation.lastBlock();
}

} // namespace

void Loops::goTo(const Step &step, uint32_t target, Live live, bool certain) {
  if (target > step.at)
    step.activation.add(target, std::move(live));
  else
    backTo(step, target, std::move(live), certain);
}

/// Whether a loop whose last jump back is certain is followed pass by pass.
bool Loops::runsForReal(const Activation &activation, LoopHead &head) const {
  if (head.visits == 1)
    head.firstStep = run_.steps;
  head.forkedVisits += head.lastForks != activation.forks;
  head.lastForks = activation.forks;
  head.abstract |=
      head.forkedVisits > maxForkedVisits ||
      (head.forkedVisits > minForkedVisits && run_.steps - head.firstStep > maxForkedSteps);
  return !head.abstract && !run_.abstract;
}

/// Another pass is run for real, unless the same state comes round again: then it comes round for
/// ever. Hashing every pass would cost more than running it, so this is looked for at growing
/// distances.
void Loops::runPass(const Step &step, uint32_t target, LoopHead &head, Live live) {
  constexpr unsigned window = 4;
  Activation &activation = step.activation;
  if (run_.listeners.watchArrivals()) {
    // Who looks at each block may change the state, and stops what does not end.
  } else if (head.visits == head.nextSnapshot) {
    head.snapshot = hash(live.state);
    head.variables = variablesOf(live.state);
    head.snapshotForks = activation.forks;
    head.snapshotStops = run_.stops;
    head.windowEnd = head.visits + window;
    head.nextSnapshot *= 4;
  } else if (head.visits <= head.windowEnd && hash(live.state) == head.snapshot) {
    // A way out that depends on something unknown was taken beside this one, or the operator is
    // asked in every pass: who loads the next part leaves the loop by reset.
    if (head.snapshotForks == activation.forks && head.snapshotStops == run_.stops)
      run_.issue(FlowIssue::EndlessLoop, step, live.state, live.state, loopAt(activation, target));
    return;
  } else if (head.visits == head.windowEnd && head.visits > visitsBeforeDoubt &&
             head.snapshotForks == activation.forks && head.snapshotStops == run_.stops &&
             head.variables == variablesOf(live.state)) {
    // Nothing counts, nothing was decided: the tool goes on and on. Joined states show whether
    // there is a way out.
    head.abstract = true;
  }
  activation.pending.wait(target, std::move(live));
}

/// A pass that brings nothing new is run once more where no pass before had a choice: when it has
/// none either, nothing leaves the loop.
bool Loops::runsOnceMore(const Step &step, uint32_t target, LoopHead &head, const Live &live) {
  const bool undecided = head.joinedForks == run_.forks && head.joinedStops == run_.stops &&
                         llvm::all_of(live.skip, [](SkipSwitch skip) {
                           return skip == SkipSwitch::Unknown; // else the operator may leave it
                         });
  // Of a repeat without a count another finding speaks.
  if (!undecided || step.outcome.flow.kind == FlowKind::Repeat)
    return false;
  if (!std::exchange(head.isAsked, true)) {
    head.askedAt = run_.steps;
    return true;
  }
  // Other states of the same block come here without having made a pass.
  if (run_.steps - head.askedAt <= mostStates)
    return true;
  head.joinedForks = ~0u; // told once
  run_.issue(FlowIssue::EndlessLoop, step, live.state, live.state, loopAt(step.activation, target));
  return false;
}

void Loops::backTo(const Step &step, uint32_t target, Live live, bool certain) {
  Activation &activation = step.activation;
  LoopHead &head = activation.heads[target];
  live.decided = nullptr; // what another pass decides may be something else
  ++head.visits;
  if (certain && runsForReal(activation, head))
    return runPass(step, target, head, std::move(live));
  workDone += workOfRound;
  if (head.hasSeen) {
    if (covers(head.seen, live.state)) {
      if (!runsOnceMore(step, target, head, live))
        return;
      live.state = head.seen;
      return activation.pending.wait(target, std::move(live));
    }
    head.seen = head.visits < visitsBeforeWidening ? join(head.seen, live.state)
                                                   : widen(head.seen, live.state);
  } else {
    head.seen = live.state;
    head.hasSeen = true;
    head.joinedForks = run_.forks;
    head.joinedStops = run_.stops;
  }
  live.state = head.seen;
  live.path = run_.lengthen(live.path, PathNode::Kind::LoopPass, activation.lastBlock());
  activation.pending.startRound();
  activation.pending.wait(target, std::move(live));
}

bool Loops::isNeverLeft(const Step &step, FileUnit &unit, uint32_t target) {
  if (run_.listeners.watchArrivals() || target > step.at || step.block.skip >= 0 ||
      llvm::any_of(step.block.items, [](const Item &i) { return i.kind == ItemKind::If; }))
    return false;
  const auto [known, fresh] = closed_.try_emplace({unit.source.id(), step.at}, false);
  if (fresh)
    known->second = !holdsWayOut(unit, target, step.at);
  return known->second;
}

void Loops::loop(Step &step) {
  Activation &activation = step.activation;
  const Flow &flow = step.outcome.flow;
  const FlowShape &shape = run_.shape(step.unit(), step.region().program);
  if (shape.isMismatched(step.at))
    run_.issue(FlowIssue::StructureMismatch, step, step.flowRange());
  if (flow.kind == FlowKind::LoopEnd) {
    const auto head = shape.back.find(step.at);
    if (head == shape.back.end())
      step.goOn();
    else
      backTo(step, head->second, std::move(step.live), !activation.heads[head->second].abstract);
    return;
  }
  const auto past = shape.past.find(step.at);
  if (flow.condition == Truth::Yes || past == shape.past.end()) {
    if (flow.condition != Truth::No)
      step.goOn();
    return;
  }
  if (flow.condition == Truth::Unknown) {
    // From now on this head is a place where states are joined.
    run_.fork(activation, step.flowRange());
    activation.heads[step.at].abstract = true;
    Live body = step.live;
    body.path = run_.lengthen(body.path, PathNode::Kind::Holds, step.flowRange());
    activation.add(step.block.next, std::move(body));
  }
  activation.add(past->second, std::move(step.live));
}

} // namespace ncvet
