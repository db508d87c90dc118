// The effect of single codes on modes: modal groups, compensation, cycles, switches, reset.
#include "interp/evaluate/formula.h"
#include "interp/evaluate/tool_data.h"
#include "interp/execute/execution.h"
#include "interp/state/kept_modes.h"
#include "interp/state/zero_point.h"

#include <cmath>

namespace ncvet {

/// Makes the code the active member of its group.
void Execution::activate(const CodeInfo &code, const Word *word) {
  state_.state(code.group, uint64_t(1) << code.bit);
  if (word)
    state_.origin.setGroup(code.group, originOf(*word));
  if (code.group == masks_.feedMode) {
    if (code.action == Action::FeedInverseTime && dialect_.zeros.systems &&
        before_.group(code.group) != uint64_t(1) << code.bit)
      state_.commons.set(feedAside, Value::of(state_.must(Fact::FeedSet) ? state_.feed.get()
                                                                         : Interval::unknown()));
    if (state_.must(Fact::FeedSet))
      state_.set(Fact::FeedCarried);
    else if (state_.may(Fact::FeedSet))
      state_.allow(bitOf(Fact::FeedCarried));
  }
  if (dialect_.groups[code.group].forgetsFeed) // the block's own F is still to come
    state_.clear(Fact::FeedSet);
}

/// G96 or G97.
void Execution::speedMode(const CodeUse &use) {
  const uint64_t before = before_.active(dialect_, StandardGroup::SpeedMode);
  // A program that has stated no mode yet counts in revolutions.
  if (before != state_.active(dialect_, StandardGroup::SpeedMode) &&
      (before != groupUnset || info(use).action == Action::SurfaceSpeed))
    state_.clear(Fact::SpeedSinceMode);
}

void Execution::compensationOn(const CodeUse &use) {
  state_.origin.set(StatePart::Compensation, originOf(*use.word));
  if (cutterOfBlock(dialect_)) // a D of this block is still to come
    state_.radiusOffset = notSet;
  // Switched on from off: the next move in the plane engages it. While it is on, a change of side
  // takes effect along the path, without an engaging move.
  if (!(state_.compensation & phaseOn))
    state_.compensation = phaseStarting;
}

void Execution::compensationOff(const CodeUse &) {
  if (state_.compensation & phaseOn)
    state_.compensation = uint8_t((state_.compensation & phaseOff) | phaseEnding);
  else
    state_.compensation = phaseOff;
}

void Execution::lengthOn(const CodeUse &use) {
  // `G43 H0` takes none.
  const Word *const number = block_.find('H');
  const Interval offset = number ? value(*number) : Interval::unknown();
  if (!offset.isConstant() || offset.value() != 0 || dialect_.isLathe())
    state_.set(Fact::LengthSinceTool);
  state_.origin.set(StatePart::LengthOffset, originOf(*use.word));
  lengthOff(use);
}

void Execution::lengthOff(const CodeUse &) {
  if (!dialect_.zeros.systems)
    state_.at(toolAxis(dialect_, state_)) = Interval::unknown();
}

/// Ends the innermost modal call.
void Execution::cancelModalCall(const CodeUse &) {
  if (state_.modalCalls)
    state_.modalCalls = ModalCalls(state_.modalCalls->outer);
}

/// The block counts in machine coordinates.
void Execution::countFromMachine(const CodeUse &) { machineMove_ = true; }

/// The block moves by this code. It ends a drilling cycle, and a turning cycle's code replaces it.
void Execution::takeMotion(const CodeUse &use) {
  if (!motionCode_.word)
    motionCode_ = use;
  if (!dialect_.cycleSurvivesMotion)
    cancelCycle(use.code, use.word);
}

void Execution::takeCycle(const CodeUse &use) {
  if (isModal(info(use)))
    motionCode_ = use;
}

/// G80 and its like.
void Execution::endCycle(const CodeUse &use) {
  const CodeInfo &code = info(use);
  const CodeIndex running = before_.cycleActive(dialect_) == Truth::No ? noCode : activeCycle();
  if (running != noCode && dialect_.codes[running].family != code.family)
    return; // each family has a cancel of its own
  cancelCycle(use.code, use.word);
  if (code.cancelsCalls && !callsModally_)
    state_.modalCalls = nullptr;
  cancelled_ = true;
  if (code.group != noGroup)
    activate(code, use.word);
  if (code.endsMotion && masks_.motion != noGroup &&
      llvm::none_of(outcome_.codes,
                    [&](const CodeUse &other) { return info(other).group == masks_.motion; }))
    state_.setGroup(masks_.motion, groupUnset);
}

void Execution::applySwitch(const CodeInfo &code, const CodeUse &use) {
  const unsigned index = code.effect.index;
  if (index >= maxSwitches)
    return;
  uint16_t axes = axesOf(dialect_, block_);
  if (code.frame == FrameKind::MirrorAxes) // `<MIR:OFF;Y>` names its axes by arguments
    if (const std::optional<FrameWords> words = frameWords(code.frame, false))
      for (unsigned i = 0; i < words->given.size(); ++i)
        axes |= uint16_t(words->given[i] ? 1u << i : 0);
  uint16_t were = state_.switches.axesOf(index);
  bool on = code.effect.on;
  if (code.effect.offByZero) {
    // Off when every axis that it was on for is back at zero; a value that is not known may be
    // either.
    bool zero = true, known = true;
    uint16_t zeros = 0;
    for (const Word &word : block_.words)
      if ((dialect_.axisWords & maskOf(word.address)) || word.address == argumentAddress) {
        const Interval v = value(word);
        known &= v.isConstant();
        const bool isZero = v.isConstant() && v.value() == 0;
        zero &= isZero;
        if (const AddressInfo &address = dialect_.addresses[word.address];
            isZero && address.kind == AddressKind::Axis)
          zeros |= uint16_t(1u << unsigned(address.axis));
      }
    if (!known) {
      state_.switches.put(index, true, state_.switchMustBeOn(index), uint16_t(were | axes));
      state_.origin.setSwitch(index, originOf(*use.word));
      return;
    }
    if (zero && axes && !zeros)
      return; // increments of zero
    axes = zero ? zeros : uint16_t(axes & ~zeros);
    if (!zero) // `G52 X0 Z-5.` takes X back and moves Z
      were &= uint16_t(~zeros);
    on = !zero;
  }
  if (on) {
    state_.switches.put(index, true, true, uint16_t(were | axes));
    state_.origin.setSwitch(index, originOf(*use.word));
  } else {
    // A code that names axes switches off those only.
    if (axes && were & ~axes &&
        (code.effect.offByZero || code.action == Action::MirrorOff ||
         code.frame == FrameKind::MirrorAxes)) {
      state_.switches.put(index, state_.switchMayBeOn(index), state_.switchMustBeOn(index),
                          uint16_t(were & ~axes));
      return;
    }
    state_.switches.put(index, false, false, 0);
  }
}

/// What the code leaves for the formulas of later ones.
void Execution::applyStores(const CodeInfo &code) {
  for (const Store &store : code.stores) {
    uint64_t variable = store.variable;
    if (!store.list.empty()) {
      const auto index = valueOf(store.index, code, context_);
      if (!index)
        continue;
      if (!index->isConstant()) {
        state_.commons.forget(); // any of them
        continue;
      }
      variable = elementOf(store.list, index->value());
    }
    if (!store.when.empty() && truthOf(store.when, code, context_) == Truth::No)
      continue;
    if (store.forgets)
      state_.commons.erase(variable);
    else if (store.value.empty() ||
             (!store.when.empty() && truthOf(store.when, code, context_) == Truth::Unknown))
      state_.commons.set(variable, Value::unknown());
    else if (const auto value = valueOf(store.value, code, context_))
      state_.commons.set(variable, Value::of(*value));
  }
}

void Execution::keepModes(const CodeUse &) { state_.saved = ncvet::keepModes(dialect_, state_); }

void Execution::keepModesOverReturn(const CodeUse &use) {
  keepModes(use);
  state_.restoresModes = true;
}

void Execution::forgetModes(const CodeUse &) {
  state_.saved = {};
  state_.restoresModes = false;
}

void Execution::restoreModes(const CodeUse &) {
  bringBack(dialect_, machine_, state_, state_.saved);
}

namespace {
/// Compensation that a recorded profile has switched on is the profile's own.
void leaveProfile(const Dialect &dialect, MachineState &state) {
  const GroupIndex group = dialect.group(StandardGroup::Compensation);
  if (state.profile != ProfileMode::Recorded || state.compensation == phaseOff || group == noGroup)
    return;
  state.compensation = phaseOff;
  for (const CodeIndex member : dialect.groups[group].members)
    if (dialect.codes[member].action == Action::CompensationOff)
      return state.setGroup(group, uint64_t(1) << dialect.codes[member].bit);
}
} // namespace

/// The blocks from here on are a profile, which a cycle reads as data.
void Execution::beginProfile(const CodeUse &use) {
  leaveProfile(dialect_, state_);
  state_.profile = ProfileMode::Recorded;
  state_.origin.set(StatePart::Roughing, originOf(*use.word));
}

void Execution::endProfile(const CodeUse &) {
  leaveProfile(dialect_, state_);
  state_.profile = ProfileMode::Off;
  for (Interval &position : state_.position)
    position = Interval::unknown();
}

/// The modes of power-on come back; the spindle turns on.
void Execution::reset(const CodeUse &use) {
  const Word &word = *use.word;
  stateUse.everything();
  const MachineState fresh = initialState(dialect_);
  // The plane that no code has stated is that of the first axes.
  const GroupIndex plane = dialect_.group(StandardGroup::Plane);
  for (size_t i = 0; i < dialect_.groups.size(); ++i)
    if (dialect_.groups[i].initial != 0xFF || i == plane) {
      state_.setGroup(i, fresh.groups[i]);
      state_.origin.setGroup(i, originOf(word));
      state_.statedMay &= ~(uint64_t(1) << i);
      state_.statedMust &= ~(uint64_t(1) << i);
    }
  state_.compensation = phaseOff;
  state_.profile = ProfileMode::Off;
  uint32_t stays = 0;
  for (size_t i = 0; i < dialect_.switches.size(); ++i)
    if (dialect_.switches[i].survivesReset)
      stays |= 1u << i;
  state_.switches.may &= stays;
  state_.switches.must &= stays;
  state_.cycle.present = 0;
  state_.modalCalls = nullptr;
  state_.fedFrom.forget();
  state_.frames.clear();
  for (Interval &position : state_.position)
    position = Interval::unknown();
  for (const Fact fact :
       {Fact::FeedSet, Fact::SpeedSet, Fact::WorkOffsetStated, Fact::CycleRan, Fact::SpeedLimitSet})
    state_.clear(fact);
}

} // namespace ncvet
