// Calls of programs: by number, by name, and by the modal call in force.
#include "analyzer/flow/calls.h"

#include "analyzer/flow/call_arguments.h"
#include "interp/state/zero_point.h"

namespace ncvet {

/// Whether the call comes back to a program that is being executed.
bool Calls::recurs(const Region &region, const Callee &callee) const {
  if (bodies_.isRunning(*callee.unit, callee.start, callee.kind))
    return true;
  if (callee.kind != RegionKind::Subprogram)
    return false;
  return (callee.unit == &region.unit && callee.program == &region.program) ||
         (callee.unit == &run_.unit && callee.program == run_.mainProgram);
}

/// What programs that are not known leave as it is, by custom.
static void keepCommonModes(const MachineState &before, MachineState &after,
                            const Dialect &dialect) {
  for (const StandardGroup which :
       {StandardGroup::Plane, StandardGroup::Distance, StandardGroup::Compensation,
        StandardGroup::Cycle, StandardGroup::Units, StandardGroup::ReturnLevel})
    if (const GroupIndex group = dialect.group(which); group != noGroup)
      after.setGroup(group, before.group(group));
  after.compensation = before.compensation;
  after.cycle = before.cycle;
  after.initialLevel = before.initialLevel;
}

/// Compensation that is off stays off: what is called ends what it begins itself.
static void keepCompensationOff(const MachineState &before, MachineState &after,
                                const Dialect &dialect) {
  if (before.isActive(dialect, StandardGroup::Compensation, {Action::CompensationOff}) !=
      Truth::Yes)
    return;
  const GroupIndex group = dialect.group(StandardGroup::Compensation);
  after.setGroup(group, before.group(group));
  after.compensation = before.compensation;
}

/// Programs that are not known leave what is seldom on as it was, like those of which no caller is
/// known expect it; on some controls the common modes too.
static void keepModes(const MachineState &before, MachineState &after, const Dialect &dialect) {
  copyRareModes(after, before, dialect);
  if (dialect.callsKeepModes)
    keepCommonModes(before, after, dialect);
  else
    keepCompensationOff(before, after, dialect);
}

/// Modal groups that nobody has seen changed by such a call.
static void keepUnchanged(const FollowedCall &call, const MachineState &before, MachineState &after,
                          const Dialect &dialect) {
  for (GroupIndex i = 0; i < GroupIndex(dialect.groups.size()); ++i)
    if (!(call.groups >> i & 1))
      after.setGroup(i, before.group(i));
  const auto keeps = [&](StandardGroup which) {
    const GroupIndex group = dialect.group(which);
    return group != noGroup && !(call.groups >> group & 1);
  };
  if (keeps(StandardGroup::Compensation))
    after.compensation = before.compensation;
  if (keeps(StandardGroup::Cycle)) {
    after.cycle = before.cycle;
    after.initialLevel = before.initialLevel;
  }
}

/// After a call of which nothing is known but, perhaps, what callers of this program know of it.
void Calls::goOnUnknown(Step &step, const FollowedCall *known) {
  const Dialect &dialect = *step.unit().dialect;
  run_.lose(step.flowRange(), "what is called here is not known");
  run_.opaque = true;
  const Variables locals = step.live.state->locals;
  const MachineState before = step.live.state;
  forget(step.live.state, dialect);
  if (known)
    keepUnchanged(*known, before, step.live.state, dialect);
  else
    keepModes(before, step.live.state, dialect);
  step.live.state->modalCalls = before.modalCalls; // nobody leaves one on for a caller
  if (dialect.variableRanges.namedLocal)           // no call changes those of its caller
    step.live.state->locals = locals;
  step.goOn();
}

/// Of a program of which no caller is known: whether its call never ends is known beforehand, and
/// need not be found out by following it.
void Calls::tellCircle(const Step &step, const Callee &callee) {
  const CallSite *const caller = step.region().caller;
  if (run_.outer && run_.entryUnknown && !run_.postponed && !(caller && caller->unit) &&
      callee.unit != &run_.unit && run_.outer->isInCircle(callee.unit->source.path()) &&
      !run_.shape(*callee.unit, *callee.program).branches)
    run_.issue(FlowIssue::Recursion, step, step.flowRange(),
               {callee.unit->source.id(), callee.start, callee.start + 1});
}

/// Whether a call is followed into its program.
bool Calls::mayEnter(const Step &step, const Callee &callee) {
  const Region &region = step.region();
  const SourceRange where = step.flowRange();
  run_.deepest = std::max(run_.deepest, region.depth() + 1);
  if (recurs(region, callee)) {
    // Without a condition nothing ends it; with one it is followed until the control's levels end.
    const bool conditional = run_.shape(*callee.unit, *callee.program).branches;
    if (!conditional || region.depth() + 1 >= run_.limits.callDepth) {
      run_.issue(FlowIssue::Recursion, step, where,
                 {callee.unit->source.id(), callee.start, callee.start + 1});
      run_.noteFollowed(step, *callee.unit, nullptr);
      return false;
    }
  }
  const unsigned allowed = region.unit.dialect->limits.callDepth;
  if (allowed && region.depth() + 1 > allowed)
    run_.issue(FlowIssue::TooDeep, step, where);
  return region.depth() + 1 < run_.limits.callDepth;
}

void Calls::enter(Step &step, const Callee &callee, const Passes &passes) {
  const CallSite site{&step.unit(),         &step.region().program,
                      passes.next,          passes.known && passes.count <= 1,
                      step.region().caller, step.outcome.flow.macro};
  passes_.run(step, {*callee.unit, *callee.program, callee.start, callee.kind, &site}, passes);
}

void Calls::call(Step &step) {
  const Flow &flow = step.outcome.flow;
  MachineState &state = step.live.state;
  const std::optional<Callee> callee = callees_.find(step);
  const FollowedCall *const left = callee ? run_.leftToCallers(step, *callee->unit) : nullptr;
  if (callee)
    tellCircle(step, *callee);
  if (left)
    return goOnUnknown(step, left);
  if (!callee || !mayEnter(step, *callee))
    return goOnUnknown(step);
  Passes passes(step);
  passes.setCount(callee->repeat.value_or(flow.repeat));
  step.live.path =
      run_.lengthen(step.live.path, PathNode::Kind::Call, step.flowRange(), callee->number);
  state.restoresModes = false;
  state.saved = {};
  if (flow.macro) {
    passes.locals = state.locals;
    state.locals = flow.arguments;
  }
  if (flow.kind == FlowKind::CallNamed) {
    const MachineState caller = state;
    passes.locals = caller.locals;
    state.locals = Variables();
    const Item &item = step.block.items[size_t(flow.item)];
    if (item.positional) {
      bindPositions(step.block, item, caller, state);
    } else {
      checkArguments(run_, step, *callee, item);
      bindArguments(*callee, givenTo(step.block, item, caller), caller, state, passes);
    }
  }
  enter(step, *callee, passes);
}

void Calls::beginModalCall(Step &step) {
  const std::optional<Callee> callee = callees_.find(step);
  const int16_t item = step.outcome.flow.item;
  if (callee && item >= 0)
    checkArguments(run_, step, *callee, step.block.items[size_t(item)]);
  step.goOn();
}

void Calls::callModally(Step &step) {
  MachineState &state = step.live.state;
  const ModalCalls call = state.modalCalls;
  Flow &flow = step.outcome.flow;
  flow = Flow();
  flow.kind = FlowKind::CallModal;
  flow.begin = step.block.begin;
  flow.end = step.block.end;
  Block own;
  const Block *made = &own;
  const Item *item = nullptr;
  std::optional<Callee> callee;
  if (step.outcome.callsModally == Truth::Yes && call && call->known) {
    const SourceFile &maker = run_.project.sources().get(call->file);
    made = &run_.readBlocks.at(run_.project.unit(maker), call->at, own);
    callee = callees_.findModal(step.unit(), *call, *made, item);
  }
  if (!callee || !mayEnter(step, *callee)) {
    const MachineState before = state;
    forget(state, *step.unit().dialect);
    keepModes(before, state, *step.unit().dialect);
    run_.opaque = true;
    state.modalCalls = call;
    run_.lose(step.blockRange(), "what runs after this block is not known");
    return step.goOn();
  }
  Passes passes(step);
  passes.setCount(call->repeat);
  passes.modal = call;
  passes.locals = state.locals;
  step.live.path =
      run_.lengthen(step.live.path, PathNode::Kind::ModalCall, step.blockRange(), callee->number);
  state.restoresModes = false;
  state.saved = {};
  state.modalCalls = call->outer; // runs after the moves of this one's program
  if (item) {
    const MachineState caller = state;
    state.locals = Variables();
    bindArguments(*callee, givenModally(*call, *made, *item), caller, state, passes);
  } else {
    state.locals = call->arguments;
  }
  enter(step, *callee, passes);
}

} // namespace ncvet
