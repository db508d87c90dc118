// Codes whose axis words are no plain move: machine positions, shifts, offsets, frames, dwells.
#include "interp/execute/execution.h"
#include "interp/state/zero_point.h"

#include <algorithm>

namespace ncvet {

namespace {
constexpr uint16_t bit(Axis axis) { return uint16_t(1u << unsigned(axis)); }
} // namespace

/// G53: this block counts in machine coordinates.
void Execution::machineMove(uint16_t axes) {
  compensationStep(MotionKind::Rapid, axes);
  const CodeInfo *motion = state_.activeCode(dialect_, StandardGroup::Motion);
  const bool feeds = motion && motion->action == Action::Linear;
  emitMotion(feeds ? MotionKind::Feed : MotionKind::Rapid, axes,
             motion ? CodeIndex(motion - dialect_.codes.data()) : noCode)
      .setInMachineCoordinates();
  state_.fedFrom.forget();
  for (const Word &word : block_.words)
    if (dialect_.axisWords & maskOf(word.address))
      storeTarget(word, true);
  arriveOnMachine();
}

Event &Execution::emitMotion(MotionKind kind, uint16_t axes, CodeIndex code) {
  Event &event = outcome_.emit(EventKind::Motion);
  event.motion = kind;
  event.axes = axes;
  event.code = code;
  return event;
}

/// Axis words that have a value lead where they say.
void Execution::storeGivenTargets() {
  for (const Word &word : block_.words)
    if ((dialect_.axisWords & maskOf(word.address)) && !word.has(wordNoValue))
      storeTarget(word, false);
}

/// The axes are at a place of the machine.
void Execution::arriveOnMachine() {
  fromMachine();
  for (const Fact fact : {Fact::Moved, Fact::MovedSinceTool, Fact::MovedSincePreset,
                          Fact::AwayFromPart, Fact::AtMachinePosition})
    state_.set(fact);
}

/// G28, G30 and their like.
bool Execution::referenceReturn(const CodeUse &use, uint16_t axes) {
  compensationStep(MotionKind::Reference, axes);
  emitMotion(MotionKind::Reference, axes, use.code);
  state_.fedFrom.forget();
  storeGivenTargets();
  outcome_.via = state_.position;
  for (unsigned i = 0; i < axisCount; ++i)
    if (axes == 0 || (axes >> i & 1)) {
      const int32_t stored = info(use).storedAt;
      state_.position[i] = stored ? storedPlace(state_, stored)[i] : Interval::unknown();
      state_.machineAxes |= 1u << i;
    }
  arriveOnMachine();
  state_.set(Fact::ReferenceReturned);
  return true;
}

/// G29: from the reference point to the block's end point.
bool Execution::referenceFrom(const CodeUse &use, uint16_t axes) {
  referenceReturn(use, axes);
  storeGivenTargets();
  state_.clear(Fact::AtMachinePosition);
  return true;
}

/// G31: the tool stops where the probe touches.
bool Execution::skipMove(const CodeUse &use, uint16_t axes) {
  compensationStep(MotionKind::Skip, axes);
  emitMotion(MotionKind::Skip, axes, use.code);
  for (unsigned i = 0; i < axisCount; ++i)
    if (axes >> i & 1)
      state_.position[i] = Interval::unknown();
  state_.set(Fact::SkipMoveDone);
  state_.set(Fact::Moved);
  state_.set(Fact::MovedSincePreset);
  return true;
}

/// The tool goes on to the last point of a curve.
void Execution::endCurve(const CodeUse &use) {
  const uint16_t axes = planeAxes(dialect_, state_);
  emitMotion(MotionKind::Feed, axes, use.code);
  moveTo(storedPlace(state_, curvePoint));
  afterMove(false, axes);
}

/// True when the block does not move beside its dwell.
bool Execution::dwell(const CodeUse &use, uint16_t) {
  Event &event = outcome_.emit(EventKind::Dwell);
  event.code = use.code;
  event.word = block_.findAny(info(use).takes);
  if (event.word) {
    const Interval time = value(*event.word);
    const bool milliseconds =
        dialect_.dwellInMilliseconds && event.word->isNumber() && !event.word->has(wordPoint);
    event.setSeconds(milliseconds ? time * 0.001 : time);
  }
  return !dialect_.dwellBesideMove;
}

/// G10: offsets are written.
void Execution::writeOffsets(const CodeUse &) {
  if (dialect_.zeros.systems) // the tools' lengths: a later G43 takes them
    return setToolLength();
  // Offsets may have changed: what was known in work coordinates is no longer.
  for (unsigned i = 0; i < axisCount; ++i)
    if (!(state_.machineAxes >> i & 1))
      state_.position[i] = Interval::unknown();
}

bool Execution::switchPreset(const CodeUse &use, uint16_t) {
  switchPreset(info(use).action);
  return false;
}

bool Execution::storeHere(const CodeUse &use, uint16_t) {
  storePlace(state_, info(use).storedAt, zeroOf(dialect_, state_).toMachine(known()));
  return false;
}

void Execution::setPole(const CodeUse &use) { setPole(info(use).action); }

/// G52, G92 and their like: the place stays, its coordinates change.
void Execution::shiftCoordinates(const CodeUse &use) {
  const CodeInfo &code = info(use);
  outcome_.setupChanged = true;
  state_.fedFrom.forget();
  Event &event = outcome_.emit(EventKind::CoordinateChange);
  event.code = use.code;
  event.word = use.word;
  event.axes = axesOf(dialect_, block_);
  if (code.action == Action::PresetPosition && event.axes) {
    state_.clear(Fact::MovedSincePreset);
    state_.origin.set(StatePart::Preset, originOf(*use.word));
  }
  if (dialect_.zeros.systems)
    return setPreset(code.action == Action::LocalShift);
  for (const Word &word : block_.words) {
    if (!(dialect_.axisWords & maskOf(word.address)))
      continue;
    const AddressInfo &address = dialect_.addresses[word.address];
    const Axis axis = address.axis;
    const Interval v = coordinate(word);
    if (code.action == Action::PresetPosition) {
      // The present place gets this coordinate; an increment shifts by so much.
      state_.at(axis) = address.kind == AddressKind::Increment ? state_.at(axis) + v : v;
      state_.machineAxes &= ~uint32_t(bit(axis));
    } else if (unsigned(axis) >= 3) { // frames know no others
      state_.at(axis) = Interval::unknown();
    }
  }
  if (code.action == Action::LocalShift)
    applyFrame(use);
}

/// TRANS, ROT, SCALE, MIRROR and their like: the place stays, its coordinates are others.
void Execution::changeFrame(const CodeUse &use) {
  outcome_.setupChanged = true;
  state_.fedFrom.forget();
  Event &event = outcome_.emit(EventKind::CoordinateChange);
  event.code = use.code;
  event.word = use.word;
  event.axes = axesOf(dialect_, block_);
  applyFrame(use);
}

void Execution::workOffset(const CodeUse &use) {
  const CodeInfo &code = info(use);
  state_.set(Fact::WorkOffsetStated);
  state_.fedFrom.forget();
  if (dialect_.zeros.systems || code.group == noGroup ||
      before_.group(code.group) == (uint64_t(1) << code.bit))
    return; // the same offset as before
  const CodeInfo *old = before_.activeCode(dialect_, StandardGroup::WorkOffset);
  const auto from = old ? machine_.offsets.find(old->name) : machine_.offsets.end();
  const auto to = machine_.offsets.find(code.name);
  for (unsigned i = 0; i < axisCount; ++i) {
    if (state_.machineAxes >> i & 1)
      continue;
    const bool known = from != machine_.offsets.end() && to != machine_.offsets.end() &&
                       from->second[i] && to->second[i];
    state_.position[i] =
        known ? state_.position[i] + Interval::exactly(*from->second[i] - *to->second[i])
              : Interval::unknown();
  }
}

/// Rotation, scaling or mirroring, which the order of their switches keeps.
void Execution::transformationOn(const CodeUse &use) {
  const uint8_t index = info(use).effect.index;
  if (index != 0xFF) {
    const auto mark = uint8_t(index + 1);
    if (!llvm::is_contained(state_.transforms, mark))
      for (uint8_t &slot : state_.transforms)
        if (slot == 0) {
          slot = mark;
          break;
        }
  }
  applyFrame(use);
}

void Execution::transformationOff(const CodeUse &use) {
  applyFrame(use);
  const uint8_t index = info(use).effect.index;
  if (index != 0xFF && !state_.switchMayBeOn(index)) {
    const auto mark = uint8_t(index + 1);
    auto &t = state_.transforms;
    const auto end = std::remove(t.begin(), t.end(), mark);
    std::fill(end, t.end(), uint8_t(0));
  }
}

void Execution::switchPolar(const CodeUse &) {
  state_.polar = {inPlane()[0], Interval::unknown()}; // the last word is the radius
}

} // namespace ncvet
