// Canned cycles: when they start, run and end, and where they leave the tool.
#include "interp/execution.h"

#include <cmath>

namespace ncvet {

/// The active modal cycle; `noCode` when there is none or it is not certain which.
CodeIndex Execution::activeCycle() const {
  for (const StandardGroup which : {StandardGroup::Cycle, StandardGroup::Motion}) {
    const CodeInfo *code = state_.activeCode(dialect_, which);
    if (code && code->action == Action::Cycle)
      return CodeIndex(code - dialect_.codes.data());
  }
  return noCode;
}

/// Takes the block's words into the cycle's; `fresh` forgets what an earlier cycle had.
void Execution::storeCycleWords(bool fresh) {
  CycleWords &cycle = state_.cycle;
  if (fresh)
    cycle.present = 0;
  for (const Word &word : block_.words) {
    if (word.address >= 26 || word.address == letterAddress('G') ||
        word.address == letterAddress('M') || word.address == letterAddress('N'))
      continue;
    const Interval v = value(word);
    cycle.present |= 1u << word.address;
    cycle.value[word.address] =
        v.isConstant() ? v.value() : std::numeric_limits<double>::quiet_NaN();
  }
}

void Execution::startCycle(const CodeUse &use) {
  const CodeInfo &code = info(use);
  const bool same = before_.group[code.group] == (uint64_t(1) << code.bit);
  storeCycleWords(!same);
  if (!same) {
    state_.initialLevel = state_.at(toolAxis(dialect_, state_));
    for (unsigned i = 0; i < 3; ++i)
      state_.cycleStart[i] = state_.position[i];
    state_.clear(Fact::CycleRan);
  }
  activate(code, use.word);
  state_.origin.cycle = originOf(*use.word);
  Event &event = outcome_.emit(EventKind::CycleStart);
  event.code = use.code;
  event.word = use.word;
  event.axes = axesOf(dialect_, block_);
  // L0 (K0 on newer controls) stores the data and makes no hole.
  for (const WordSpec &spec : code.words)
    if (spec.role == Role::Repeat)
      if (const Word *count = wordFor(block_, spec)) {
        const Interval n = value(*count);
        if (n.isConstant() && n.value() == 0)
          return;
      }
  runCycle(use.code, axesOf(dialect_, block_));
}

void Execution::runCycle(CodeIndex index, uint16_t axes) {
  Event &event = outcome_.emit(EventKind::CycleRun);
  event.code = index;
  event.axes = axes;
  event.certain = index != noCode;
  state_.fedFrom = Interval::unknown();
  state_.set(Fact::Moved);
  state_.set(Fact::MovedSinceTool);
  state_.set(Fact::MovedSincePreset);
  state_.set(Fact::Cut);
  state_.set(Fact::CutSinceTool);
  state_.set(Fact::CycleRan);
  state_.clear(Fact::AtMachinePosition);
  const Axis tool = toolAxis(dialect_, state_);
  if (index == noCode) {
    for (const Word &word : block_.words)
      if (dialect_.axisWords & maskOf(word.address))
        state_.at(dialect_.addresses[word.address].axis) = Interval::unknown();
    state_.at(tool) = Interval::unknown();
    return;
  }
  const CodeInfo &code = dialect_.codes[index];
  event.word = block_.findAny(dialect_.axisWords);
  storeCycleWords(false);
  const bool turning = code.cycle == CycleKind::TurnPass || code.cycle == CycleKind::FacePass ||
                       code.cycle == CycleKind::ThreadPass;
  if (turning) {
    // Every pass returns to the point where the cycle began.
    if (state_.compensation == phaseStarting)
      state_.compensation = phaseOn;
    return;
  }
  for (const Word &word : block_.words)
    if ((dialect_.axisWords & maskOf(word.address)) && !word.has(wordNoValue)) {
      const AddressInfo &address = dialect_.addresses[word.address];
      if (address.axis != tool)
        storeTarget(word, false);
    }
  if (dialect_.group(StandardGroup::Polar) != noGroup &&
      state_.isActive(dialect_, StandardGroup::Polar, {Action::PolarOn}) == Truth::Yes) {
    for (unsigned i = 0; i < axisCount; ++i)
      if (planeAxes(dialect_, state_) >> i & 1)
        state_.position[i] = Interval::unknown();
    if (axes & planeAxes(dialect_, state_))
      state_.set(Fact::PolarRadiusSet);
  }
  // Where along the tool axis the cycle ends: at R, or at the level where it began.
  const Truth toInitial =
      dialect_.group(StandardGroup::ReturnLevel) == noGroup
          ? Truth::No
          : state_.isActive(dialect_, StandardGroup::ReturnLevel, {Action::ReturnInitial});
  Interval level = Interval::unknown();
  const WordSpec *plane = nullptr;
  for (const WordSpec &spec : code.words)
    if (spec.role == Role::Height && spec.variable)
      plane = &spec;
  if (plane) {
    level = readVariable(state_, int64_t(plane->variable)).asNumber();
  } else if (toInitial == Truth::Yes) {
    level = state_.initialLevel;
  } else if (toInitial == Truth::No && state_.cycle.has('R')) {
    const Interval factor = lengthFactor();
    const double r = state_.cycle.get('R');
    const Truth incremental =
        dialect_.group(StandardGroup::Distance) == noGroup ||
                state_.active(dialect_, StandardGroup::Distance) == groupUnset
            ? Truth::No
            : state_.isActive(dialect_, StandardGroup::Distance, {Action::Incremental});
    if (!std::isnan(r) && factor.isConstant() && incremental == Truth::No)
      level = Interval::exactly(r * factor.value());
    else if (!std::isnan(r) && factor.isConstant() && incremental == Truth::Yes)
      level = state_.initialLevel + Interval::exactly(r * factor.value());
  }
  state_.at(tool) = level;
  state_.machineAxes &= ~(1u << unsigned(tool));
  state_.set(Fact::AwayFromPart);
  if (code.cycle == CycleKind::RigidTap || code.cycle == CycleKind::RigidTapLeft) {
    state_.spindle = spindleAny;
    state_.set(Fact::SpindleStoppedByTap);
  } else if (code.spindle == SpindleNeed::StartsItself) {
    state_.spindle = spindleAny;
  }
}

void Execution::cancelCycle(CodeIndex by, const Word *word) {
  const Truth active = before_.cycleActive(dialect_);
  if (active == Truth::No)
    return;
  Event &event = outcome_.emit(EventKind::CycleCancel);
  event.code = activeCycle();
  event.by = by;
  event.word = word;
  event.certain = active == Truth::Yes;
  state_.cycle.present = 0;
  state_.clear(Fact::CycleRan);
  const GroupIndex group = dialect_.group(StandardGroup::Cycle);
  if (group == noGroup)
    return;
  for (const CodeIndex member : dialect_.groups[group].members)
    if (dialect_.codes[member].action == Action::CycleCancel)
      state_.group[group] = uint64_t(1) << dialect_.codes[member].bit;
}

/// One-shot cycles of lathes: roughing, finishing, grooving, threading.
void Execution::runCompound(const CodeUse &use) {
  const CodeInfo &code = info(use);
  AddressMask first = 0, last = 0, targets = 0;
  for (const WordSpec &spec : code.words) {
    if (spec.role == Role::ProfileFirst)
      first |= spec.any;
    else if (spec.role == Role::ProfileLast)
      last |= spec.any;
    else if (spec.role == Role::Target || spec.role == Role::Depth)
      targets |= spec.any;
  }
  storeCycleWords(!(before_.pendingCycle != noCode));
  const bool executes = block_.hasAny(first | targets) || (!first && !targets);
  if (code.twoBlock && !executes) {
    Event &event = outcome_.emit(EventKind::CycleStart);
    event.code = use.code;
    event.word = use.word;
    state_.pendingCycle = use.code;
    state_.origin.pending = originOf(*use.word);
    return;
  }
  Event &event = outcome_.emit(EventKind::CycleRun);
  event.code = use.code;
  event.word = use.word;
  event.axes = axesOf(dialect_, block_);
  state_.set(Fact::Moved);
  state_.set(Fact::MovedSinceTool);
  state_.set(Fact::MovedSincePreset);
  state_.set(Fact::Cut);
  state_.set(Fact::CutSinceTool);
  state_.set(Fact::AwayFromPart);
  if (!first)
    return;
  Flow &flow = outcome_.flow;
  flow.kind = FlowKind::Profile;
  flow.code = use.code;
  flow.word = use.word;
  flow.begin = use.word->offset;
  flow.end = block_.endOf(*use.word);
  const auto number = [&](AddressMask mask) -> int64_t {
    const Word *word = block_.findAny(mask);
    if (!word)
      return notSet;
    const Interval v = value(*word);
    return v.isConstant() && v.value() >= 0 && v.value() < 1e9 ? int64_t(v.value()) : notKnown;
  };
  flow.first = number(first);
  flow.last = number(last);
  const bool finishing = code.cycle == CycleKind::Finish;
  if (finishing) {
    if (state_.roughFirst == flow.first)
      state_.roughFirst = state_.roughLast = notSet;
  } else {
    state_.roughFirst = flow.first;
    for (const Axis axis : {Axis::X, Axis::Z})
      state_.roughStart[axis == Axis::X ? 0 : 1] =
          state_.inMachineCoordinates(axis) ? Interval::unknown() : state_.at(axis);
    state_.roughLast = flow.last;
    state_.origin.rough = originOf(*use.word);
  }
}

} // namespace ncvet
