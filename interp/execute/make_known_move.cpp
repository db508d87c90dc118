// Makes of a block that has been executed a move that is known in these modes.
#include "interp/execute/make_known_move.h"

#include "formats/dialect/control_facts.h"
#include "interp/execute/execution.h"

#include <bit>

namespace ncvet {

namespace {

constexpr AddressMask arcWords = lettersMask("IJKR");

/// What such a block may tell.
constexpr uint32_t knownEvents = bitOf(EventKind::Block) | bitOf(EventKind::Code) |
                                 bitOf(EventKind::FeedWord) | bitOf(EventKind::SpeedWord) |
                                 bitOf(EventKind::OffsetWord) | bitOf(EventKind::Motion) |
                                 bitOf(EventKind::CycleRun) | bitOf(EventKind::CoordinateChange) |
                                 bitOf(EventKind::CompensationMove) |
                                 bitOf(EventKind::SpindleChange) | bitOf(EventKind::WordIssue);

/// The one event of this kind; null: there is none, or several.
const Event *onlyEvent(const Outcome &outcome, EventKind kind) {
  const Event *found = nullptr;
  for (const Event &event : outcome.events)
    if (event.kind == kind) {
      if (found)
        return nullptr;
      found = &event;
    }
  return found;
}

/// Whether an action does the same with any numbers, as long as no part of the set-up changes.
bool isNumberless(Action action) {
  switch (action) {
  case Action::None:
  case Action::Rapid:
  case Action::Linear:
  case Action::ArcCw:
  case Action::ArcCcw:
  case Action::ExactStop:
  case Action::PathMode:
  case Action::PlaneXY:
  case Action::PlaneZX:
  case Action::PlaneYZ:
  case Action::Inch:
  case Action::Metric:
  case Action::Absolute:
  case Action::Incremental:
  case Action::ArcAbsolute:
  case Action::ArcIncremental:
  case Action::FeedPerMinute:
  case Action::FeedPerRevolution:
  case Action::SurfaceSpeed:
  case Action::ConstantSpeed:
  case Action::ReturnInitial:
  case Action::ReturnR:
  case Action::CompensationOff:
  case Action::CompensationLeft:
  case Action::CompensationRight:
  case Action::SpindleCw:
  case Action::SpindleCcw:
  case Action::CoolantOn:
  case Action::CoolantOff:
  case Action::Switch:
    return true;
  default:
    return false;
  }
}

bool changesGroup(GroupIndex group, const MachineState &before, const MachineState &after) {
  return group != noGroup && before.groups[group] != after.groups[group];
}

} // namespace

/// Whether the code does the same with any coordinates.
bool Execution::isKnownCode(const CodeUse &use) const {
  const CodeInfo &code = info(use);
  const CodeInfo &base = dialect_.codes[code.base];
  if (llvm::any_of(base.variants, [](const Variant &variant) { return asksNumber(variant.when); }))
    return false;
  if (!code.stores.empty() || !code.losesPlace.empty() || code.frame != FrameKind::None ||
      code.ownMove || code.returns || code.leavesNoSpeed || !code.places[0].empty() ||
      (code.effect.index != 0xFF && code.effect.offByZero))
    return false;
  switch (code.action) {
  case Action::CycleCancel:
    return before_.cycleActive(dialect_) == Truth::No;
  case Action::LengthOff:
    return !dialect_.zeros.systems &&
           !changesGroup(dialect_.group(StandardGroup::Plane), before_, state_);
  case Action::WorkOffset:
    return !dialect_.zeros.systems && !changesGroup(code.group, before_, state_);
  default:
    return isNumberless(code.action);
  }
}

/// Whether no number of the block decides how compensation goes on, but the way along X where it is
/// engaged or taken off.
bool Execution::isKnownCompensation() const {
  if (before_.compensation == phaseOff && state_.compensation == phaseOff)
    return true;
  if (!std::has_single_bit(before_.compensation) || !std::has_single_bit(state_.compensation))
    return false;
  const bool atX = !before_.inMachineCoordinates(Axis::X) && !state_.inMachineCoordinates(Axis::X);
  if (outcome_.kinds & bitOf(EventKind::CompensationMove))
    return atX;
  // Whether a line in the plane is a slanted one its numbers decide.
  return state_.compensation != phaseOn || (before_.factsMust & bitOf(Fact::ContourCompensated)) ||
         block_.hasAny(arcWords) || !(axesOf(dialect_, block_) & planeAxes(dialect_, state_));
}

/// Whether the word is a coordinate that is computed of variables of programs.
bool Execution::isKnownExpression(const Word &word) const {
  const auto ofPrograms = [&](const ExpressionOp &op) {
    return op.op != Op::Variable || !showsMachine(state_, op.value);
  };
  return word.flags == wordExpression && word.reading() == WordReading::Modal &&
         (dialect_.axisWords & maskOf(word.address)) &&
         llvm::all_of(operationsOf(block_, block_.expressions[size_t(word.mantissa)]), ofPrograms);
}

/// Whether the block is of a kind whose numbers decide nothing but where it leads.
bool Execution::isKnownKind() const {
  constexpr uint8_t usual = wordPoint | wordMinus | wordLeadingZero;
  constexpr size_t most = 200; // words: the index of one is a byte
  if ((outcome_.kinds & ~knownEvents) || outcome_.flow.kind != FlowKind::Next ||
      outcome_.callsModally != Truth::No || outcome_.foreign || block_.words.size() > most ||
      !block_.items.empty() || llvm::any_of(block_.words, [&](const Word &word) {
        return (word.flags & ~usual) && !isKnownExpression(word);
      }))
    return false;
  if (before_.modalCalls || before_.pendingCycle != noCode || before_.seeksBranch ||
      before_.profile != ProfileMode::Off || polarMayBeOn() || hasAngleWord() ||
      block_.hasAny(dialect_.polarWords) || !isKnownCompensation() ||
      (diameterMayBeOn() && (state_.groups[masks_.diameter] & ~masks_.diameterOn)))
    return false;
  return lengthFactor().isConstant() && incremental() != Truth::Unknown &&
         llvm::all_of(outcome_.codes, [&](const CodeUse &use) { return isKnownCode(use); });
}

/// Whether the block is one move by a motion code, with no cycle about.
bool Execution::isKnownMotion(KnownMove &move) const {
  const Event *const motion = onlyEvent(outcome_, EventKind::Motion);
  if (!motion || motion->code == noCode || !motion->certain || motion->inMachineCoordinates() ||
      before_.cycleActive(dialect_) != Truth::No || state_.cycleActive(dialect_) != Truth::No)
    return false;
  const CodeInfo &code = dialect_.codes[motion->code];
  const bool arc = isArc(code.action);
  if ((!arc && code.action != Action::Linear && code.action != Action::Rapid) ||
      !code.places[0].empty() || code.returns || code.leavesNoSpeed || code.ownMove)
    return false;
  // Other words of an arc are no coordinates elsewhere.
  if (!arc && block_.hasAny(arcWords & ~dialect_.axisWords))
    return false;
  const bool inPlane = axesOf(dialect_, block_) & planeAxes(dialect_, state_);
  if (arc && ((dialect_.arcAngle != noAddress && block_.has(dialect_.arcAngle)) ||
              (dialect_.facts->arcs.centreAndEnd && !inPlane)))
    return false;
  move.isRapid = motion->motion == MotionKind::Rapid;
  move.losesTool = llvm::any_of(
      outcome_.codes, [&](const CodeUse &use) { return info(use).action == Action::LengthOff; });
  move.forgetsLevel = llvm::any_of(
      outcome_.codes, [&](const CodeUse &use) { return info(use).action == Action::WorkOffset; });
  return true;
}

/// Whether the block is one hole of the active drilling cycle, of which it only gives the place.
bool Execution::isKnownHole(KnownMove &move) const {
  const Event *const run = onlyEvent(outcome_, EventKind::CycleRun);
  if (!run || run->code == noCode || !run->certain || !outcome_.codes.empty() ||
      outcome_.holes.size() != 1 || (block_.addresses & ~dialect_.axisWords))
    return false;
  const CodeInfo &code = dialect_.codes[run->code];
  if (code.action != Action::Cycle || code.cycle == CycleKind::TurnPass ||
      code.cycle == CycleKind::FacePass || code.cycle == CycleKind::ThreadPass)
    return false;
  for (const WordSpec &spec : code.words)
    if (spec.role == Role::Height && (spec.position || spec.variable))
      return false;
  for (const Word &word : block_.words)
    if (dialect_.addresses[word.address].axis == move.tool ||
        word.address >= std::tuple_size_v<decltype(CycleWords::value)>)
      return false;
  const Truth toInitial =
      dialect_.group(StandardGroup::ReturnLevel) == noGroup
          ? Truth::No
          : state_.isActive(dialect_, StandardGroup::ReturnLevel, {Action::ReturnInitial});
  if (toInitial == Truth::Unknown || ((toInitial == Truth::No || dialect_.drilling.risesFirst) &&
                                      (incremental() != Truth::No || !state_.cycle.has('R'))))
    return false;
  move.hole = toInitial == Truth::No         ? HoleEnd::Approach
              : dialect_.drilling.risesFirst ? HoleEnd::Higher
                                             : HoleEnd::Initial;
  move.forgetsLevel = true;
  return true;
}

/// The words that say where parts of the state were set; false when something else does.
bool Execution::knownPlaces(KnownMove &move, const StateUse &use) const {
  const auto &places = state_.origin.all();
  for (size_t part = 0; part < places.size(); ++part) {
    const uint64_t looked = part < maxGroups ? use.groupOrigins >> part & 1
                                             : use.otherOrigins >> (part - maxGroups) & 1;
    const Origin &place = places[part];
    if (!looked || place.file != file_ || place.begin < block_.begin || place.begin >= block_.next)
      continue;
    const auto *const word = llvm::find_if(block_.words, [&](const Word &candidate) {
      return candidate.offset == place.begin && block_.endOf(candidate) == place.end;
    });
    if (word == block_.words.end())
      return false;
    move.places.push_back({uint8_t(part), uint8_t(word - block_.words.begin())});
    move.renews |= OriginState::ages(part);
  }
  return true;
}

std::optional<KnownMove> Execution::asKnownMove(const StateUse &use) const {
  KnownMove move;
  move.tool = toolAxis(dialect_, state_);
  move.tracksDepth = !dialect_.isLathe();
  if (!isKnownKind() || (!isKnownMotion(move) && !isKnownHole(move)) || !knownPlaces(move, use))
    return std::nullopt;
  const Truth relative = incremental();
  move.unit = lengthFactor().lo;
  for (uint8_t i = 0; i < block_.words.size(); ++i)
    if (const AddressInfo &address = dialect_.addresses[block_.words[i].address];
        address.kind == AddressKind::Axis || address.kind == AddressKind::Increment) {
      move.steps.push_back({i, plainTarget(address, relative)});
      if (move.hole != HoleEnd::None)
        move.letters.push_back(block_.words[i].address);
      move.computes |= block_.words[i].has(wordExpression);
    }
  for (uint8_t i = 0; i < dialect_.groups.size(); ++i)
    if (changesGroup(i, before_, state_))
      move.codes.push_back({i, state_.groups[i]});
  move.statedMay = state_.statedMay;
  move.statedMust = state_.statedMust;
  move.factsMay = state_.factsMay;
  move.factsMust = state_.factsMust;
  move.machineAxes = state_.machineAxes;
  move.cycleWords = state_.cycle.present;
  move.idleBlocks = state_.idleBlocks;
  move.compensation = state_.compensation;
  move.radiusOffset = state_.radiusOffset.peek();
  move.engages = outcome_.kinds & bitOf(EventKind::CompensationMove);
  move.feed = state_.feed.peek();
  move.isSimple = simpleAxes(move.steps, block_, move.unit) != 0;
  return move;
}

namespace {
bool isSame(const MachineState &a, const MachineState &b) {
  return equal(a, b) && a.origin.all() == b.origin.all();
}
} // namespace

std::optional<KnownMove> makeKnownMove(const Dialect &dialect, const MachineProfile &machine,
                                       const ModeMasks &masks, FileId file, const Block &block,
                                       const MachineState &before, MachineState &after,
                                       Outcome &outcome, const StateUse &use) {
  const StateUse used = stateUse;
  auto move =
      Execution(dialect, machine, masks, file, block, before, after, outcome).asKnownMove(use);
  if (move) { // what it does is what was done, and nothing else
    MachineState made = before, caughtUp = before;
    Outcome told = outcome;
    KnownMove::Numbers numbers;
    const bool computed = move->compute(block, before, numbers);
    if (computed)
      move->make(block, file, before, made, told, numbers);
    move->catchUp(after, caughtUp);
    if (!computed || !isSame(made, after) || !isSame(caughtUp, after) ||
        told.holes != outcome.holes)
      move.reset();
  }
  stateUse = used;
  return move;
}

AddressMask knownCoordinates(const Dialect &dialect) {
  return (dialect.axisWords | arcWords) & dialect.known;
}

} // namespace ncvet
