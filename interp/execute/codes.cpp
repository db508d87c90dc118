// The effect of single G and M codes: modal groups, spindle, coolant, tools, switches.
#include "interp/evaluate/formula.h"
#include "interp/evaluate/tool_data.h"
#include "interp/execute/execution.h"
#include "interp/state/kept_modes.h"

#include <cmath>

namespace ncvet {

/// Makes the code the active member of its group.
void Execution::activate(const CodeInfo &code, const Word *word) {
  state_.state(code.group, uint64_t(1) << code.bit);
  if (word)
    state_.origin.setGroup(code.group, originOf(*word));
  if (code.group == masks_.feedMode) {
    if (state_.must(Fact::FeedSet))
      state_.set(Fact::FeedCarried);
    else if (state_.may(Fact::FeedSet))
      state_.allow(bitOf(Fact::FeedCarried));
  }
  if (dialect_.groups[code.group].forgetsFeed) // the block's own F is still to come
    state_.clear(Fact::FeedSet);
}

void Execution::applyModal(const CodeUse &use) {
  const CodeInfo &code = info(use);
  if (isModal(code) && code.action != Action::Cycle && code.action != Action::CycleCancel)
    activate(code, use.word);
  switch (code.action) {
  case Action::SurfaceSpeed:
  case Action::ConstantSpeed:
    // A program that has stated no mode yet counts in revolutions.
    if (before_.active(dialect_, StandardGroup::SpeedMode) !=
            state_.active(dialect_, StandardGroup::SpeedMode) &&
        (before_.active(dialect_, StandardGroup::SpeedMode) != groupUnset ||
         code.action == Action::SurfaceSpeed))
      state_.clear(Fact::SpeedSinceMode);
    break;
  case Action::CompensationLeft:
  case Action::CompensationRight:
    state_.origin.set(StatePart::Compensation, originOf(*use.word));
    if (cutterOfBlock(dialect_)) // a D of this block is still to come
      state_.radiusOffset = notSet;
    // Switched on from off: the next move in the plane engages it. While it is on, a change of side
    // takes effect along the path, without an engaging move.
    if (!(state_.compensation & phaseOn))
      state_.compensation = phaseStarting;
    break;
  case Action::CompensationOff:
    if (state_.compensation & phaseOn)
      state_.compensation = uint8_t((state_.compensation & phaseOff) | phaseEnding);
    else
      state_.compensation = phaseOff;
    break;
  case Action::WorkOffset:
    state_.set(Fact::WorkOffsetStated);
    workOffset(use);
    break;
  case Action::LengthPositive:
  case Action::LengthNegative:
    state_.set(Fact::LengthSinceTool);
    state_.origin.set(StatePart::LengthOffset, originOf(*use.word));
    [[fallthrough]];
  case Action::LengthOff:
    if (!dialect_.zeros.systems)
      state_.at(toolAxis(dialect_, state_)) = Interval::unknown();
    break;
  case Action::Inch:
  case Action::Metric:
    break; // positions are kept in millimetres
  case Action::MacroModal:
    break;
  case Action::MacroCancel: // the innermost one
    if (state_.modalCalls)
      state_.modalCalls = ModalCalls(state_.modalCalls->outer);
    break;
  case Action::MachineMove:
    machineMove_ = true;
    break;
  case Action::Cycle:
  case Action::CycleCancel:
    break;
  default:
    break;
  }
  if (isMotion(code.action) || (code.action == Action::Cycle && isModal(code)) ||
      code.action == Action::CycleCancel) {
    if (code.action == Action::CycleCancel) {
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
    } else {
      if (!motionCode_.word || code.action == Action::Cycle)
        motionCode_ = use;
      // A motion code ends a drilling cycle, and a turning cycle's code replaces it.
      if (isMotion(code.action) && !dialect_.cycleSurvivesMotion)
        cancelCycle(use.code, use.word);
    }
  } else if (!isModal(code) || code.action == Action::DataInput) {
    switch (code.action) {
    case Action::Dwell:
    case Action::DataInput:
    case Action::ReferenceReturn:
    case Action::ReferenceCheck:
    case Action::ReferenceFrom:
    case Action::SkipMove:
    case Action::LocalShift:
    case Action::PresetPosition:
    case Action::PresetClear:
    case Action::PresetSuspend:
    case Action::PresetRestore:
    case Action::ZeroSet:
    case Action::ZeroHere:
    case Action::StorePlace:
    case Action::SpeedLimit:
    case Action::MacroCall:
    case Action::Cycle:
    case Action::ProfileRun:
    case Action::ZoneOn:
      if (!actionCode_.word)
        actionCode_ = use;
      break;
    default:
      break;
    }
  }
  // Codes whose axis words say something else than a move although they belong to a group.
  switch (code.action) {
  case Action::RotationOn:
  case Action::ScalingOn:
  case Action::MirrorOn:
  case Action::MirrorOff:
  case Action::FrameSet:
  case Action::FrameAdd:
  case Action::FrameClear:
  case Action::Pole:
  case Action::PoleFromPlace:
  case Action::PoleFromPole:
  case Action::LocalShift:
  case Action::PresetPosition:
  case Action::LengthSet:
  case Action::LengthAdd:
  case Action::CurveEnd:
  case Action::MacroModal:
  case Action::PolygonOn:
  case Action::ZoneOn:
  case Action::SpeedLimit:
    if (!actionCode_.word)
      actionCode_ = use;
    break;
  default:
    break;
  }
}

void Execution::setSpindle(uint8_t direction, const CodeUse &use) {
  Event &event = outcome_.emit(EventKind::SpindleChange);
  event.code = use.code;
  event.word = use.word;
  state_.spindle = direction;
  state_.set(Fact::SpindleStated);
  state_.clear(Fact::SpindleStoppedByTap);
  state_.origin.set(StatePart::Spindle, originOf(*use.word));
}

/// Whether a code of the block sets the spindle going, in front of another one or behind it.
bool Execution::startsSpindle() const {
  return llvm::any_of(outcome_.codes, [&](const CodeUse &use) {
    return info(use).action == Action::SpindleCw || info(use).action == Action::SpindleCcw;
  });
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
  const uint16_t were = state_.switches.axesOf(index);
  bool on = code.effect.on;
  if (code.effect.offByZero) {
    // Off when every named axis is zero; a value that is not known may be either.
    bool zero = true, known = true;
    for (const Word &word : block_.words)
      if ((dialect_.axisWords & maskOf(word.address)) || word.address == argumentAddress) {
        const Interval v = value(word);
        known &= v.isConstant();
        zero &= v.isConstant() && v.value() == 0;
      }
    if (!known) {
      state_.switches.put(index, true, state_.switchMustBeOn(index), uint16_t(were | axes));
      state_.origin.setSwitch(index, originOf(*use.word));
      return;
    }
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

/// What the code leaves behind for the formulas of later ones.
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

namespace {
/// Compensation that a recorded profile has switched on is the profile's own.
void leaveProfile(const Dialect &dialect, MachineState &state) {
  const GroupIndex group = dialect.group(StandardGroup::Compensation);
  if (state.profile != 1 || state.compensation == phaseOff || group == noGroup)
    return;
  state.compensation = phaseOff;
  for (const CodeIndex member : dialect.groups[group].members)
    if (dialect.codes[member].action == Action::CompensationOff)
      return state.setGroup(group, uint64_t(1) << dialect.codes[member].bit);
}
} // namespace

/// What takes effect before the block's motion.
void Execution::applyEarly(const CodeUse &use) {
  const CodeInfo &code = info(use);
  if (code.effect.index != 0xFF)
    applySwitch(code, use);
  if (!code.stores.empty())
    applyStores(code);
  switch (code.action) {
  case Action::SpindleCw:
    setSpindle(spindleCw, use);
    break;
  case Action::SpindleCcw:
    setSpindle(spindleCcw, use);
    break;
  case Action::SpindleOrient:
    setSpindle(spindleOriented, use);
    state_.set(Fact::OrientedSinceTool);
    break;
  case Action::LiveToolCw:
    state_.liveTool = spindleCw;
    break;
  case Action::LiveToolCcw:
    state_.liveTool = spindleCcw;
    break;
  case Action::ToolChange:
    if (block_.has(letterAddress('T')) || state_.preselected != notSet) {
      const int32_t tool = state_.preselected.get();
      changeTool(tool != notSet ? tool : notKnown, notSet, *use.word, use.code);
    } else {
      changeTool(state_.tool == notSet ? notKnown : state_.tool.get(), notSet, *use.word, use.code);
    }
    if (code.stopsSpindle && !startsSpindle()) {
      if (state_.spindle & (spindleCw | spindleCcw))
        state_.set(Fact::SpindleStoppedByTap);
      state_.spindle = spindleOff;
      state_.origin.set(StatePart::Spindle, originOf(*use.word));
    }
    break;
  case Action::Reset:
    reset(*use.word);
    break;
  case Action::ProfileBegin:
    leaveProfile(dialect_, state_);
    state_.profile = 1;
    state_.origin.set(StatePart::Roughing, originOf(*use.word));
    break;
  case Action::ProfileRun:
    leaveProfile(dialect_, state_);
    state_.profile = 0;
    for (Interval &position : state_.position)
      position = Interval::unknown();
    break;
  case Action::Clamp:
    state_.set(Fact::SpindleClamped);
    break;
  case Action::Unclamp:
    state_.clear(Fact::SpindleClamped);
    break;
  case Action::ChuckOpen:
    state_.set(Fact::ChuckOpen);
    break;
  case Action::ChuckClose:
    state_.clear(Fact::ChuckOpen);
    break;
  case Action::AxisEngage:
    state_.set(Fact::AxisEngaged);
    break;
  case Action::AxisRelease:
    state_.clear(Fact::AxisEngaged);
    break;
  case Action::ModesKept:
    state_.saved = keepModes(dialect_, state_);
    break;
  case Action::ModesForgotten:
    state_.saved = {};
    state_.restoresModes = false;
    break;
  case Action::ModesRestored:
    bringBack(dialect_, state_, state_.saved);
    break;
  case Action::ModesRestoredAtReturn:
    state_.saved = keepModes(dialect_, state_);
    state_.restoresModes = true;
    break;
  case Action::MachineSpecific:
    state_.spindle = spindleAny;
    state_.liveTool = spindleAny;
    break;
  case Action::RotationOn:
  case Action::ScalingOn:
  case Action::MirrorOn: {
    Event &event = outcome_.emit(EventKind::CoordinateChange);
    event.code = use.code;
    event.word = use.word;
    if (code.effect.index != 0xFF) {
      const auto mark = uint8_t(code.effect.index + 1);
      if (!llvm::is_contained(state_.transforms, mark))
        for (uint8_t &slot : state_.transforms)
          if (slot == 0) {
            slot = mark;
            break;
          }
    }
    applyFrame(use);
    break;
  }
  case Action::PolarOff:
  case Action::PolarOn: {
    Event &event = outcome_.emit(EventKind::CoordinateChange);
    event.code = use.code;
    event.word = use.word;
    state_.polar = {inPlane()[0], Interval::unknown()}; // the last word is the radius
    break;
  }
  case Action::RotationOff:
  case Action::ScalingOff:
  case Action::MirrorOff: {
    Event &event = outcome_.emit(EventKind::CoordinateChange);
    event.code = use.code;
    event.word = use.word;
    applyFrame(use);
    if (code.effect.index != 0xFF && !state_.switchMayBeOn(code.effect.index)) {
      const auto mark = uint8_t(code.effect.index + 1);
      auto &t = state_.transforms;
      const auto end = std::remove(t.begin(), t.end(), mark);
      std::fill(end, t.end(), uint8_t(0));
    }
    break;
  }
  default:
    break;
  }
}

/// The modes of power-on come back; the spindle turns on.
void Execution::reset(const Word &word) {
  stateUse.everything();
  const MachineState fresh = initialState(dialect_);
  for (size_t i = 0; i < dialect_.groups.size(); ++i)
    if (dialect_.groups[i].initial != 0xFF) {
      state_.setGroup(i, fresh.groups[i]);
      state_.origin.setGroup(i, originOf(word));
      state_.statedMay &= ~(uint64_t(1) << i);
      state_.statedMust &= ~(uint64_t(1) << i);
    }
  state_.compensation = phaseOff;
  state_.profile = 0;
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

/// What takes effect behind the block's motion.
void Execution::applyLate(const CodeUse &use) {
  switch (info(use).action) {
  case Action::SpindleStop:
    setSpindle(spindleOff, use);
    break;
  case Action::LiveToolStop:
    state_.liveTool = spindleOff;
    break;
  case Action::ProgramStop:
    break;
  default:
    break;
  }
}

void Execution::changeTool(int32_t tool, int32_t offset, const Word &word, CodeIndex by) {
  outcome_.setupChanged = true;
  Event &event = outcome_.emit(EventKind::ToolChange);
  event.word = &word;
  event.code = by;
  event.number = tool;
  state_.tool = tool;
  if (dialect_.offsetsOfTool)
    state_.lengthOffset = notSet;
  state_.preselected = notSet;
  state_.origin.set(StatePart::Tool, originOf(word));
  state_.set(Fact::ToolCalled);
  state_.clear(Fact::CutSinceTool);
  state_.clear(Fact::MovedSinceTool);
  state_.clear(Fact::LengthSinceTool);
  state_.clear(Fact::OrientedSinceTool);
  state_.clear(Fact::PlungedUncompensated);
  if (dialect_.lengthByTool != noGroup)
    state_.setGroup(dialect_.lengthByTool, groupUnset);
  state_.fedFrom.forget();
  state_.cutArea.clear();
  if (dialect_.isLathe()) {
    // Another offset: the same place has other coordinates.
    if (offset != state_.toolOffset || offset == notKnown)
      for (const Axis axis : {Axis::X, Axis::Z})
        if (!state_.inMachineCoordinates(axis))
          state_.at(axis) = Interval::unknown();
    state_.toolOffset = offset;
  }
}

/// A lathe's T word is station and offset (`T0101`); a mill's is a tool, changed at once or by M06.
void Execution::toolWord(const Word &word) {
  outcome_.setupChanged = true;
  const Interval number = value(word);
  Event &event = outcome_.emit(EventKind::ToolWord);
  event.word = &word;
  event.value = number;
  int32_t tool = notKnown, offset = notKnown;
  if (number.isConstant() && number.value() >= 0 && number.value() < 1e8) {
    const auto whole = int32_t(number.value());
    if (dialect_.isLathe()) {
      tool = whole / 100;
      offset = whole % 100;
      if (whole < 100 && !word.has(wordLeadingZero)) {
        // One or two digits name an offset on some controls and a tool on others.
        tool = notKnown;
        offset = notKnown;
      }
    } else {
      tool = whole;
    }
  }
  if (dialect_.toolChangeByT) {
    if (dialect_.isLathe() && tool == 0) {
      // T0000 and T00 cancel the offset and change nothing.
      state_.toolOffset = 0;
      state_.set(Fact::ToolCalled);
      return;
    }
    if (dialect_.isLathe() && tool == state_.tool && tool != notKnown && offset == 0) {
      state_.toolOffset = 0; // T0100 behind T0101: the offset is cancelled
      return;
    }
    changeTool(tool, offset, word, noCode);
    return;
  }
  state_.preselected = tool;
}

} // namespace ncvet
