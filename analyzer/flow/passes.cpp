// How often a body runs, and where control goes on after it.
#include "analyzer/flow/passes.h"

#include "analyzer/program/references.h"
#include "interp/evaluate/expression.h"
#include "interp/state/kept_modes.h"

#include <algorithm>

namespace ncvet {

namespace {

/// Passes of one call's repeat count that are run for real.
constexpr double maxRepeats = 10000;

/// The modal codes and frames of the caller come back.
void restoreModes(MachineState &state, const MachineState &caller) {
  state.groups = caller.groups;
  state.statedMay = caller.statedMay;
  state.statedMust = caller.statedMust;
  for (size_t i = 0; i < maxGroups; ++i)
    state.origin.all()[i] = caller.origin.all()[i];
  state.switches = caller.switches;
  if (state.frames == caller.frames)
    return;
  // The tool stays, and its coordinates are others.
  state.frames = caller.frames;
  for (Interval &position : state.position)
    position = Interval::unknown();
}

/// After the run of a modal call it is in force again. The variables of a macro stay from one run
/// to the next; they are set once, by the call.
void restoreModalCall(MachineState &state, const Passes &passes) {
  if (!passes.modal)
    return;
  const ModalCall &made = *passes.modal;
  auto *call = new ModalCall(made);
  call->users = 0;
  call->outer = state.modalCalls;
  if (made.program >= 0)
    call->arguments = state.locals;
  else if (!ncvet::equal(state.modalCalls, made.outer)) // the program has made one of its own
    call->known = false;
  state.modalCalls = call;
}

} // namespace

void Passes::setCount(const Value &repeat) {
  if (repeat.isConstant())
    count = repeat.number.value();
  if (!(count >= 1)) // a bad count is the rules' business; the body is looked at once
    count = 1;
  known = repeat.isConstant() && count <= maxRepeats;
  if (!known)
    count = std::min(count, 2.0);
}

/// The body ends with a return to a block of the caller, `M99 P`.
void PassRunner::jumpBack(const Step &step, const Passes &passes, Returned exit) {
  exit.live.path = passes.path;
  restoreModalCall(exit.live.state, passes);
  if (passes.locals)
    exit.live.state->locals = *passes.locals;
  const auto offset = resolveBlock(step.unit().index, step.region().program,
                                   Reference::toBlock(exit.target), step.at);
  if (!offset)
    return run_.issue(FlowIssue::UnknownBlock, step, step.before, exit.live.state,
                      step.flowRange());
  run_.used.numbers.insert(exit.target);
  loops_.goTo(step, *offset, std::move(exit.live), true);
}

/// One pass for each of `entries`; `changed`: one of them leaves in another state. It is not asked
/// where no further pass depends on it.
Lives PassRunner::runOnce(const Step &step, const Region &body, const Passes &passes,
                          Lives &entries, bool &changed) {
  Lives left;
  const bool asks = passes.count > 1 || body.kind == RegionKind::Section;
  std::optional<MachineState> entry;
  for (Live &one : entries) {
    if (asks)
      entry = one.state;
    for (Returned &exit : bodies_.run(body, std::move(one))) {
      if (exit.target != notSet) {
        jumpBack(step, passes, std::move(exit));
        continue;
      }
      changed |= asks && !equal(*entry, exit.live.state);
      mergeInto(left, std::move(exit.live));
    }
  }
  return left;
}

void PassRunner::run(Step &step, const Region &body, const Passes &passes) {
  if (!passes.known)
    run_.lose(step.flowRange(), "how often it runs is not known");
  Lives current;
  current.push_back(std::move(step.live));
  for (double pass = 0; pass < passes.count && !current.empty() && !run_.stopped; ++pass) {
    bool changed = false;
    current = runOnce(step, body, passes, current, changed);
    // The budget is spent: what the passes that are left may do is not known.
    if (run_.abstract && pass + 1 < passes.count && pass > 0 && changed) {
      for (Live &one : current)
        forget(one.state, *step.unit().dialect);
      break;
    }
    if (!changed && !run_.listeners.followOnePath()) { // every further pass is the same
      // A section that its repeat follows has run once already.
      const bool ran = pass > 0 || (body.kind == RegionKind::Section && body.start < step.at);
      if (ran && passes.known && body.kind != RegionKind::Profile && !current.empty())
        run_.issue(FlowIssue::RepeatSame, step, step.before, current.front().state,
                   step.flowRange());
      break;
    }
  }
  step.activation.forks += current.size() > 1;
  for (Live &one : current)
    comeBack(step, body, passes, one);
}

/// A state that has made all passes goes on after the call.
void PassRunner::comeBack(const Step &step, const Region &body, const Passes &passes, Live &live) {
  MachineState &state = live.state;
  live.path = passes.path;
  restoreModalCall(state, passes);
  if (passes.locals)
    state.locals = *passes.locals;
  for (const uint64_t key : passes.written)
    writeVariable(state, int64_t(key), Value::unknown());
  const bool ofCaller = body.kind == RegionKind::Section || body.kind == RegionKind::Profile;
  if (passes.modes)
    restoreModes(state, *passes.modes);
  else if (!ofCaller && state.restoresModes)
    bringBack(*step.unit().dialect, step.unit().machine, state, state.saved);
  if (!ofCaller) {
    state.restoresModes = step.before.restoresModes;
    state.saved = step.before.saved;
  }
  if (!passes.known)
    for (Interval &position : state.position)
      position = Interval::unknown();
  run_.noteFollowed(step, body.unit, &state);
  if (run_.listeners.want(EventKind::CallReturned))
    run_.listeners.tell([&](FlowListener &listener) { listener.callReturned(step, state); });
  step.activation.add(passes.next, std::move(live));
}

} // namespace ncvet
