// Shapes of blocks: what is known of one block holds for all that differ from it in coordinates.
#include "analyzer/rule/block_shape.h"

#include "analyzer/program/call_site.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "interp/value/sum.h"

#include <bit>

namespace ncvet {

namespace {

/// The words of the block whose numbers are coordinates.
AddressMask coordinatesOf(const Dialect &dialect, const Outcome &outcome) {
  constexpr AddressMask arcs = maskOf('I') | maskOf('J') | maskOf('K') | maskOf('R');
  const bool leadsRound = llvm::any_of(outcome.events, [](const Event &event) {
    return event.kind == EventKind::Motion && isArc(event.motion);
  });
  return dialect.axisWords | (leadsRound ? arcs : 0);
}

void addParts(Sum &sum, const StateUse &use, const MachineState &state) {
  const auto part = [&](StatePart which, const auto &value) {
    if (!use.has(which))
      return;
    if constexpr (std::is_same_v<std::decay_t<decltype(value.peek())>, Interval>)
      sum.add(value.peek());
    else
      sum.add(uint64_t(value.peek()));
  };
  part(StatePart::Tool, state.tool);
  part(StatePart::ToolOffset, state.toolOffset);
  part(StatePart::Preselected, state.preselected);
  part(StatePart::LengthOffset, state.lengthOffset);
  part(StatePart::RadiusOffset, state.radiusOffset);
  part(StatePart::Spindle, state.spindle);
  part(StatePart::LiveTool, state.liveTool);
  part(StatePart::Speed, state.speed);
  part(StatePart::SpeedLimit, state.speedLimit);
  part(StatePart::Feed, state.feed);
}

/// By value: a sum that might be a part of the state would be written back at each step.
Sum withState(Sum sum, const StateUse &use, const MachineState &state) {
  for (uint64_t left = use.groups; left; left &= left - 1)
    sum.add(state.groups[size_t(std::countr_zero(left))]);
  sum.add(state.statedMay & use.groups);
  sum.add(state.statedMust & use.groups);
  sum.add(state.factsMay & use.facts);
  sum.add(state.factsMust & use.facts);
  if (const auto switches = uint32_t(use.others)) {
    sum.add(uint64_t(state.switches.may & switches) << 32 | (state.switches.must & switches));
    for (uint32_t left = switches; left; left &= left - 1)
      sum.add(state.switches.axes[size_t(std::countr_zero(left))]);
  }
  if (use.others >> maxSwitches)
    addParts(sum, use, state);
  sum.add(uint64_t(state.compensation) | uint64_t(state.profile) << 8 |
          uint64_t(state.seeksBranch) << 16 | uint64_t(state.frames.empty()) << 17 |
          uint64_t(bool(state.modalCalls)) << 18 | uint64_t(state.idleBlocks != 0) << 19 |
          uint64_t(state.pendingCycle) << 32);
  sum.add(uint64_t(state.machineAxes) << 32 | llvm::bit_cast<uint32_t>(state.transforms));
  sum.add(state.cycle.present);
  if (use.ages)
    for (const StatePart part : OriginState::aging)
      sum.add(uint64_t(state.origin.isOlder(part)));
  return sum;
}

} // namespace

bool asksNumbers(const CodeInfo &code, llvm::StringRef id) {
  return llvm::any_of(code.notices, [&](const Notice &notice) {
    return id == notice.rule && asksNumber(notice.when);
  });
}

namespace {

/// What of an event the block's text does not decide.
void addNumbers(Sum &sum, const Event &event) {
  switch (event.kind) {
  case EventKind::Statement:
    return sum.add(event.item());
  case EventKind::Assignment:
    return sum.add(uint64_t(event.variable()));
  case EventKind::UnsetRead:
  case EventKind::DomainError:
    return sum.add(event.place());
  case EventKind::ToolWord:
  case EventKind::FeedWord:
  case EventKind::SpeedWord:
  case EventKind::OffsetWord:
    return sum.add(event.wordValue());
  case EventKind::Dwell:
    return sum.add(event.seconds());
  default:
    return;
  }
}

/// How a block's event is told from others of its kind.
void addEvent(Sum &sum, const Event &event) {
  sum.add(uint64_t(event.kind) | uint64_t(event.motion) << 8 | uint64_t(event.axes) << 16 |
          uint64_t(event.code) << 32 | uint64_t(event.by) << 48);
  if (event.kind == EventKind::Motion)
    sum.add(uint64_t(event.certain) << 1 | uint64_t(event.inMachineCoordinates()));
  else if (!event.certain)
    sum.add(0);
}

void addValue(Sum &sum, const Value &value) {
  sum.add(uint64_t(value.kind));
  if (value.kind == Value::Kind::Number)
    sum.add(value.number);
}

} // namespace

uint64_t shapeAt(uint64_t place, const CallSite *caller, const Block &block,
                 const Outcome &outcome) {
  constexpr uint32_t others = bitOf(EventKind::ToolChange) | bitOf(EventKind::Syntax);
  if (!block.issues.empty() || block.skip >= 0 || block.kind != BlockKind::Normal ||
      outcome.foreign || (outcome.kinds & others))
    return 0;
  Sum sum(place);
  for (const CallSite *call = caller; call; call = call->before)
    sum.add(uint64_t(reinterpret_cast<uintptr_t>(call->program)) ^ uint64_t(call->next) << 32 ^
            uint64_t(call->once) << 1 ^ uint64_t(call->macro) << 2);
  for (const Event &event : outcome.events) {
    addEvent(sum, event);
    addNumbers(sum, event);
  }
  for (const CodeUse &use : outcome.codes)
    sum.add(use.code);
  const Flow &flow = outcome.flow;
  sum.add(uint64_t(flow.kind) | uint64_t(outcome.callsModally) << 8 |
          uint64_t(flow.condition) << 16 | uint64_t(outcome.holes.size()) << 32);
  if (flow.kind != FlowKind::Next) {
    addValue(sum, flow.target);
    addValue(sum, flow.repeat);
    sum.add(flow.choice);
  }
  return sum.get();
}

uint64_t shapeOf(const Dialect &dialect, const Block &block, const Outcome &outcome,
                 const CallSite *caller) {
  constexpr uint32_t others =
      bitOf(EventKind::ToolChange) | bitOf(EventKind::Syntax) | bitOf(EventKind::Statement);
  if (!block.items.empty() || !block.expressions.empty() || !block.issues.empty() ||
      block.skip >= 0 || block.has(variableAddress) || block.kind != BlockKind::Normal ||
      outcome.foreign || (outcome.kinds & others))
    return 0;
  const AddressMask coordinates = coordinatesOf(dialect, outcome);
  Sum sum(outcome.kinds);
  if (caller)
    sum.add(uint64_t(caller->depth) << 1 | uint64_t(caller->macro));
  // Of a zero it is no matter whether it has a point.
  sum.add(block.pointed);
  sum.add(block.pointless);
  for (const Word &word : block.words) {
    if (coordinates & maskOf(word.address)) {
      sum.add(uint64_t(word.address) << 8 | (word.flags & ~wordMinus));
    } else {
      sum.add(uint64_t(word.address) << 8 | word.flags);
      sum.add(uint64_t(word.mantissa) << 8 | word.decimals);
    }
  }
  for (const Event &event : outcome.events)
    addEvent(sum, event);
  for (const CodeUse &use : outcome.codes)
    sum.add(use.code);
  sum.add(uint64_t(outcome.flow.kind) | uint64_t(outcome.callsModally) << 8 |
          uint64_t(block.lowerCase) << 16 | uint64_t(outcome.holes.size()) << 32);
  return sum.get();
}

uint64_t modesOf(const StateUse &use, const MachineState &before, const MachineState &after) {
  return withState(withState(Sum(1), use, before), use, after).get();
}

bool isSame(const StateUse &a, const StateUse &b) {
  return a.groups == b.groups && a.facts == b.facts && a.others == b.others &&
         a.groupOrigins == b.groupOrigins && a.otherOrigins == b.otherOrigins && a.ages == b.ages &&
         a.aside == b.aside;
}

bool coversModes(const StateUse &use) {
  constexpr uint64_t numbers =
      bitOf(StatePart::CutArea) | bitOf(StatePart::FeedLevel) | bitOf(StatePart::Variables);
  return !use.groupOrigins && !use.otherOrigins && !(use.others & numbers) && !use.aside;
}

} // namespace ncvet
