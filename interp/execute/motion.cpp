// Axis words: where the block's motion leads, and what it does to compensation.
#include "formats/dialect/control_facts.h"
#include "interp/evaluate/formula.h"
#include "interp/execute/execution.h"
#include "interp/state/zero_point.h"
#include "interp/value/units.h"

#include <bit>
#include <cmath>

namespace ncvet {

namespace {
/// What any move of an axis makes true.
constexpr uint64_t movedFacts =
    bitOf(Fact::Moved) | bitOf(Fact::MovedSinceTool) | bitOf(Fact::MovedSincePreset);
constexpr uint16_t bit(Axis axis) { return uint16_t(1u << unsigned(axis)); }
} // namespace

Interval Execution::lengthFactor() const {
  if (masks_.units == noGroup)
    return Interval::exactly(1);
  const uint64_t set = state_.groups[masks_.units];
  // Not stated: the program's own unit, whatever it is.
  if (set == groupUnset || !(set & ~masks_.metric))
    return Interval::exactly(1);
  if (!(set & ~masks_.inch))
    return Interval::exactly(millimetresPerInch);
  return Interval::unknown();
}

Truth Execution::incremental() const {
  if (masks_.distance == noGroup)
    return Truth::No;
  const uint64_t set = state_.groups[masks_.distance];
  if (!(set & masks_.incremental)) // not stated counts as absolute
    return Truth::No;
  return set & ~masks_.incremental ? Truth::Unknown : Truth::Yes;
}

Interval Execution::coordinate(const Word &word) const {
  const Interval given = lengthOfWord(word);
  const AddressInfo &address = dialect_.addresses[word.address];
  if (address.axis != Axis::X || address.unit != AddressUnit::Length || !diameterMayBeOn())
    return given;
  const Interval share = shareOfDiameter(dialect_, state_, address.axis, countsFromBefore(word));
  return share.isConstant() ? given * share.value() : Interval::unknown();
}

Interval Execution::lengthOfWord(const Word &word) const {
  Interval result = value(word);
  if (result.isUnknown())
    return result;
  const AddressInfo &address = dialect_.addresses[word.address];
  if (address.unit != AddressUnit::Length)
    return result;
  const Interval factor = lengthFactor();
  if (!factor.isConstant())
    return Interval::unknown();
  if (word.isNumber() && !word.has(wordPoint) && masks_.pointlessIsIncrement)
    result = result * leastIncrement;
  return factor.value() == 1 ? result : result * factor.value();
}

/// Stores the end point that an axis word gives.
void Execution::storeTarget(const Word &word, bool machineCoordinates) {
  const AddressInfo &address = dialect_.addresses[word.address];
  Interval &position = state_.at(address.axis);
  const Interval target = coordinate(word);
  const uint32_t axis = bit(address.axis);
  if (machineCoordinates) {
    state_.machineAxes |= axis;
    position = address.kind == AddressKind::Increment ? Interval::unknown() : target;
    return;
  }
  const Truth relative = countsFromBefore(word);
  if (relative == Truth::Yes) {
    position = position + target; // stays in the coordinates in which it was known
    return;
  }
  state_.machineAxes &= ~axis;
  position = relative == Truth::No ? target : Interval::unknown();
}

/// Stores the end points that the axis words of the block give.
void Execution::storeTargets() {
  // A word may read where the tool is: all are read before it moves.
  const bool readsPlace = dialect_.variableRanges.place && !block_.expressions.empty();
  const auto start = state_.position;
  auto end = start;
  for (const Word &word : block_.words)
    if (dialect_.axisWords & maskOf(word.address)) {
      const auto axis = size_t(dialect_.addresses[word.address].axis);
      if (word.has(wordNoValue))
        state_.position[axis] = Interval::unknown();
      else
        storeTarget(word, false);
      if (readsPlace) {
        end[axis] = state_.position[axis];
        state_.position = start;
      }
    }
  if (readsPlace)
    state_.position = end;
}

/// Where a motion leads whose words are a pole, an angle and a radius: the table says how. A word
/// of the tool axis is a coordinate as everywhere.
void Execution::storePolarEnd(const CodeInfo &code) {
  const Axis tool = toolAxis(dialect_, state_);
  bool inPlane = false;
  for (const Word &word : block_.words) {
    if (!(dialect_.axisWords & maskOf(word.address)))
      continue;
    if (dialect_.addresses[word.address].axis == tool && !word.has(wordNoValue))
      storeTarget(word, false);
    else
      inPlane = true;
  }
  if (!inPlane)
    return;
  const Interval unit = lengthFactor();
  std::array<Interval, 2> place;
  for (size_t i = 0; i < 2; ++i)
    if (unit.isConstant() && incremental() == Truth::No)
      place[i] = levelOf(code.places[i], code, context_) * unit.value();
  setInPlane(place);
}

void Execution::compensationStep(MotionKind kind, uint16_t axes) {
  if (state_.compensation == phaseOff || state_.compensation == phaseOn ||
      !(axes & planeAxes(dialect_, state_)))
    return;
  const GroupIndex group = dialect_.group(StandardGroup::Compensation);
  const bool starting = state_.compensation & phaseStarting;
  const bool ending = state_.compensation & phaseEnding;
  if (!starting && !ending)
    return;
  Event &event = outcome_.emit(EventKind::CompensationMove);
  event.axes = axes;
  event.certain = state_.compensation == phaseStarting || state_.compensation == phaseEnding;
  if (group != noGroup && std::has_single_bit(state_.group(group)) &&
      state_.group(group) != groupUnset)
    event.code = dialect_.groups[group].members[size_t(std::countr_zero(state_.group(group)))];
  const CodeInfo *motion = state_.activeCode(dialect_, StandardGroup::Motion);
  if (motion && isArc(motion->action) == isArc(kind))
    event.by = CodeIndex(motion - dialect_.codes.data());
  uint8_t phase = state_.compensation;
  if (starting)
    phase = uint8_t((phase & ~phaseStarting) | phaseOn);
  if (ending)
    phase = uint8_t((phase & ~phaseEnding) | phaseOff);
  state_.compensation = phase;
  outcome_.setupChanged = true;
}

bool Execution::hasAngleWord() const {
  return block_.has(commaA) || llvm::any_of(block_.words, [&](const Word &word) {
           const AddressInfo &address = dialect_.addresses[word.address];
           return address.kind == AddressKind::Parameter && address.unit == AddressUnit::Angle &&
                  !(maskOf(word.address) & dialect_.orientWords); // the spindle's, no line's
         });
}

/// `,A` (or A on lathes) gives the direction of a line: the coordinate that is not written comes
/// from it, or from the next block.
void Execution::angleWords() {
  if (!hasAngleWord())
    return;
  const uint16_t plane = planeAxes(dialect_, state_);
  uint16_t written = uint16_t(axesOf(dialect_, block_) & plane);
  // Under compensation a line by angle and end point may be one of two whose intersection counts.
  if (written == plane && state_.compensation != phaseOff)
    written = 0;
  outcome_.via = state_.position;
  for (unsigned i = 0; i < axisCount; ++i)
    if ((plane & ~written) >> i & 1)
      state_.position[i] = Interval::unknown();
  if (state_.compensation == phaseOff)
    alongAngle(uint16_t(written & plane));
}

/// The coordinate of a line's end that its angle and the other one in the plane give.
void Execution::alongAngle(uint16_t written) {
  const Word *word = block_.find(commaA);
  for (const Word &other : block_.words) {
    const AddressInfo &address = dialect_.addresses[other.address];
    if (address.kind == AddressKind::Parameter && address.unit == AddressUnit::Angle)
      word = &other;
  }
  const auto [first, second] = planeOrder(dialect_, state_);
  if (!word || (written != bit(first) && written != bit(second)))
    return;
  const Interval angle = value(*word);
  for (const Axis axis : {first, second})
    if (!before_.at(axis).isConstant() || before_.inMachineCoordinates(axis))
      return;
  const Axis given = written == bit(first) ? first : second;
  const Axis wanted = given == first ? second : first;
  if (!angle.isConstant() || !state_.at(given).isConstant())
    return;
  const double ratio = slopeOf(angle.value(), wanted == first);
  constexpr double steepest = 1e6;
  if (!(std::fabs(ratio) < steepest))
    return;
  const double way =
      (state_.at(given).value() - before_.at(given).value()) / dialect_.lengthsPerUnit(given);
  state_.at(wanted) =
      Interval::exactly(before_.at(wanted).value() + way * ratio * dialect_.lengthsPerUnit(wanted));
}

/// What the contour under compensation looks like so far.
void Execution::contourFacts(MotionKind kind, uint16_t axes) {
  const uint16_t plane = planeAxes(dialect_, state_);
  const bool engages = llvm::any_of(outcome_.events, [](const Event &event) {
    return event.kind == EventKind::CompensationMove;
  });
  if ((state_.compensation == phaseOff && !engages) || !(axes & plane))
    return;
  const auto change = [&](Axis axis) {
    if (!(axes & bit(axis)))
      return Interval::exactly(0);
    if (before_.inMachineCoordinates(axis) || state_.inMachineCoordinates(axis))
      return Interval::unknown();
    return state_.at(axis) - before_.at(axis);
  };
  if (engages) {
    for (const Fact fact : {Fact::CompensatedCut, Fact::ContourCompensated, Fact::EnteredInward,
                            Fact::EnteredOutward})
      state_.clear(fact);
    const Interval x = change(Axis::X);
    if (x.hi < 0)
      state_.set(Fact::EnteredInward);
    else if (x.lo > 0)
      state_.set(Fact::EnteredOutward);
    return;
  }
  state_.set(Fact::CompensatedCut);
  if (isArc(kind) ||
      block_.hasAny(lettersMask("IJKRA") | maskOf(commaA) | maskOf(commaC) | maskOf(commaR))) {
    state_.set(Fact::ContourCompensated);
    return;
  }
  bool slanted = true, maySlant = true;
  for (unsigned i = 0; i < axisCount; ++i)
    if (plane >> i & 1) {
      const Interval d = change(Axis(i));
      slanted &= d.lo > 0 || d.hi < 0;
      maySlant &= !(d.lo == 0 && d.hi == 0);
    }
  if (slanted)
    state_.set(Fact::ContourCompensated);
  else if (maySlant)
    state_.allow(bitOf(Fact::ContourCompensated));
}

void Execution::moveBy(const CodeInfo *code, CodeIndex index, MotionKind kind, uint16_t axes) {
  compensationStep(kind, axes);
  Event &event = outcome_.emit(EventKind::Motion);
  event.code = code ? index : noCode;
  event.motion = kind;
  event.axes = axes;
  event.certain = code != nullptr;
  const Truth polar = polarMayBeOn() ? polarOn() : Truth::No;
  std::array<Interval, 2> from;
  if (polar == Truth::Yes)
    from = inPlane();
  if (code && !code->places[0].empty())
    storePolarEnd(*code);
  else
    storeTargets();
  if (block_.hasAny(dialect_.polarWords))
    polarTarget();
  if (polar == Truth::Yes)
    polarInput(from);
  else if (polar == Truth::Unknown)
    setInPlane({});
  if (code && code->action == Action::CurvePoint) { // the tool goes to the last one at the end
    storePlace(state_, curvePoint, state_.position);
    state_.position = before_.position;
    return;
  }
  if (!code) {
    state_.fedFrom.forget();
    state_.put(movedFacts, 0);
    state_.allow(bitOf(Fact::Cut) | bitOf(Fact::CutSinceTool));
    state_.clear(Fact::AtMachinePosition);
    return;
  }
  if (code->returns) {
    outcome_.via = state_.position;
    state_.position = before_.position;
  }
  if (code->leavesNoSpeed)
    state_.clear(Fact::SpeedSet);
  if (code->action == Action::Linear)
    angleWords();
  // An arc by its centre and opening angle ends where that leads.
  if (isArc(code->action) && dialect_.arcAngle != noAddress && block_.has(dialect_.arcAngle) &&
      block_.hasAny(lettersMask("IJK")))
    setInPlane({});
  // Without an end it ends where the next element begins.
  if (isArc(code->action) && dialect_.facts->arcs.centreAndEnd &&
      !(axesOf(dialect_, block_) & planeAxes(dialect_, state_)))
    setInPlane({});
  contourFacts(kind, axes);
  afterMove(kind == MotionKind::Rapid, axes);
}

/// The facts that a move leaves.
void Execution::afterMove(bool rapid, uint16_t axes) {
  constexpr uint64_t asked =
      bitOf(Fact::InContour) | bitOf(Fact::PolarRadiusSet) | bitOf(Fact::PlungedUncompensated);
  stateUse.facts |= asked;
  // A rotary axis, or the slide of a second spindle, that moves alone leaves the tool where it is.
  constexpr uint16_t others = bit(Axis::A) | bit(Axis::B) | bit(Axis::C);
  const bool toolMoves = axes & ~others;
  const bool cuts = toolMoves && !rapid;
  const uint64_t on = movedFacts |
                      (state_.factsMust & bitOf(Fact::InContour) ? bitOf(Fact::ContourBegun) : 0) |
                      (rapid ? bitOf(Fact::AwayFromPart) : 0) |
                      (cuts ? bitOf(Fact::Cut) | bitOf(Fact::CutSinceTool) : 0);
  const uint64_t off = (toolMoves || rapid ? bitOf(Fact::AtMachinePosition) : 0) |
                       (cuts ? bitOf(Fact::AwayFromPart) : 0);
  state_.put(on, off);
  // The word of the first plane axis is the radius, from the block on that begins polar input.
  if (masks_.polar != noGroup && !(state_.factsMust & bitOf(Fact::PolarRadiusSet)) &&
      axes & bit(planeOrder(dialect_, state_)[0]) && polarMayBeOn())
    state_.set(Fact::PolarRadiusSet);
  if (!dialect_.isLathe())
    trackDepth(before_, state_, rapid);
  if (rapid) {
    state_.clear(Fact::PlungedUncompensated);
    return;
  }
  const uint16_t tool = bit(toolAxis(dialect_, state_));
  if (axes == tool && state_.compensation == phaseOff)
    state_.set(Fact::PlungedUncompensated);
  else if (axes & ~tool)
    state_.clear(Fact::PlungedUncompensated);
}

namespace {
MotionKind kindOf(Action action) {
  switch (action) {
  case Action::Rapid:
    return MotionKind::Rapid;
  case Action::ArcCw:
    return MotionKind::ArcCw;
  case Action::ArcCcw:
    return MotionKind::ArcCcw;
  case Action::Thread:
    return MotionKind::Thread;
  default:
    return MotionKind::Feed;
  }
}
} // namespace

/// Where the block's axis words lead.
void Execution::moveAxes() {
  // To bring modes back the interpreter of LinuxCNC runs blocks of its own in place of this one.
  if (llvm::any_of(outcome_.codes,
                   [&](const CodeUse &use) { return info(use).action == Action::ModesRestored; }))
    return;
  uint16_t axes = axesOf(dialect_, block_);
  if (block_.hasAny(dialect_.polarWords)) {
    if (block_.hasAny(dialect_.elementWords) && llvm::any_of(outcome_.codes, [&](const CodeUse &u) {
          return info(u).action == Action::DefineElement;
        }))
      return; // the element is named, not run
    axes |= planeAxes(dialect_, state_);
  }
  // A pattern beside the code of a cycle: the cycle runs at the places of the pattern.
  if (actionCode_.word && motionCode_.word && info(motionCode_).action == Action::Cycle &&
      info(actionCode_).cycle == CycleKind::Pattern)
    beginCycle(motionCode_);
  if (actionCode_.word && axisWordsTaken(axes))
    return;
  if (machineMove_) {
    if (axes)
      machineMove(axes);
    return;
  }
  if (motionCode_.word && info(motionCode_).action == Action::Cycle)
    return startCycle(motionCode_);
  if ((!motionCode_.word || dialect_.cycleSurvivesMotion) && !cancelled_ && cycleGoesOn(axes))
    return;
  moveByModes(axes);
}

/// The active cycle runs once more, or takes the block's words; false when the block is a plain
/// move.
bool Execution::cycleGoesOn(uint16_t axes) {
  if (state_.cycleActive(dialect_) == Truth::No)
    return false;
  const CodeIndex cycle = activeCycle();
  const CodeInfo *code = cycle == noCode ? nullptr : &dialect_.codes[cycle];
  const bool fires = code && (code->firesOnEveryBlock || (block_.addresses & code->fires) ||
                              (code->firesByMotionCode && motionCodeAlone()) ||
                              (code->firesInPlane && (axes & planeAxes(dialect_, state_))));
  if (fires || (!code && axes)) {
    runCycle(cycle, axes);
    return true;
  }
  if (!code)
    return false;
  storeCycleWords(false);
  // Where the holes lie in the plane, a block of the tool axis alone is a plain move.
  return !code->firesInPlane || !axes || (axes & planeAxes(dialect_, state_));
}

/// The axes that the motion code moves, whether the block names them or not.
uint16_t Execution::axesMovedBy(const CodeInfo &motion, uint16_t axes) const {
  // An arc by its centre alone is a full circle: it ends where it starts.
  if (!axes && isArc(motion.action) &&
      (block_.hasAny(lettersMask("IJK")) || (motionCode_.word && block_.has(dialect_.arcRadius))))
    axes = planeAxes(dialect_, state_);
  // A line by its angle alone ends where the next element begins.
  if (!axes && motion.action == Action::Linear && !block_.words.empty() && hasAngleWord())
    axes = planeAxes(dialect_, state_);
  if (!axes || !isMotion(motion.action) || motion.places[0].empty())
    return axes;
  // Angle and radius may be letters of further axes, which do not move.
  const uint16_t tool = bit(toolAxis(dialect_, state_));
  return uint16_t((axes & tool) | (axes & ~tool ? planeAxes(dialect_, state_) : 0));
}

/// A motion by the motion code in force.
void Execution::moveByModes(uint16_t axes) {
  const CodeInfo *motion = state_.activeCode(dialect_, StandardGroup::Motion);
  if (motion)
    axes = axesMovedBy(*motion, axes);
  if (!axes)
    return;
  if (!motion || !isMotion(motion->action)) {
    moveBy(nullptr, noCode, MotionKind::Rapid, axes);
    return;
  }
  const GroupIndex group = dialect_.group(StandardGroup::Motion);
  const CodeIndex index =
      dialect_.groups[group].members[size_t(std::countr_zero(state_.group(group)))];
  for (const CodeUse &use : outcome_.codes) {
    // An approach or a departure between two elements; a tap, which never goes at rapid.
    const bool feeds = info(use).action == Action::None;
    if (info(use).ownMove && (feeds || (isArc(motion->action) && !motionCode_.word)))
      return moveBy(&info(use), use.code, MotionKind::Feed, axes);
  }
  moveBy(motion, motionCode_.word ? motionCode_.code : index, kindOf(motion->action), axes);
}

/// The axes of the block's moves. A full circle leads round the plane whether or not its end is
/// written.
uint16_t Execution::axesMoved() const {
  uint16_t moved = 0;
  for (const Event &event : outcome_.events)
    if (event.kind == EventKind::Motion)
      moved |= isArc(event.motion) ? planeAxes(dialect_, state_) : event.axes;
  return moved;
}

} // namespace ncvet
