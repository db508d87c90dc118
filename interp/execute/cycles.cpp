// Canned cycles: when they start, run and end, and where they leave the tool.
#include "formats/dialect/measure.h"
#include "interp/evaluate/cycle_words.h"
#include "interp/evaluate/formula.h"
#include "interp/execute/execution.h"
#include "interp/value/work_meter.h"

#include <cmath>

namespace ncvet {

namespace {
/// A cycle's count of repeats beyond this is an error that rules report.
constexpr double mostHoles = 1000;

const WordSpec *wordWithRole(const CodeInfo &code, Role role) {
  const auto at = llvm::find_if(code.words, [&](const WordSpec &w) { return w.role == role; });
  return at == code.words.end() ? nullptr : &*at;
}

/// The last argument of a call that is the level to which it withdraws; null when it has none.
const WordSpec *heightArgument(const CodeInfo &code) {
  const WordSpec *height = nullptr;
  for (const WordSpec &spec : code.words)
    if (spec.role == Role::Height && spec.position)
      height = &spec;
  return height;
}

/// An end that is given in another way than before, U for X, takes the place of the former one.
void keepLastWay(CycleWords &cycle, const Block &block, const Dialect &dialect) {
  for (const Word &word : block.words) {
    if (!(dialect.axisWords & maskOf(word.address)))
      continue;
    for (char letter = 'A'; letter <= 'Z'; ++letter) {
      const unsigned other = letterAddress(letter);
      if (other != word.address && (dialect.axisWords & maskOf(letter)) &&
          dialect.addresses[other].axis == dialect.addresses[word.address].axis)
        cycle.present &= ~(1u << other);
    }
  }
}
} // namespace

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
  if (block_.has(argumentAddress)) { // the words of a call, by their places
    unsigned place = 0;
    for (const Word &word : block_.words) {
      if (word.address != argumentAddress || place >= cycle.value.size())
        continue;
      const Interval v = value(word);
      if (!word.has(wordNoValue)) {
        cycle.present |= 1u << place;
        cycle.value[place] = v.isConstant() ? v.value() : std::numeric_limits<double>::quiet_NaN();
      }
      ++place;
    }
    return;
  }
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

/// The cycle is active from now on; what it runs at is another matter.
void Execution::beginCycle(const CodeUse &use) {
  const CodeInfo &code = info(use);
  const bool same = before_.group(code.group) == (uint64_t(1) << code.bit);
  storeCycleWords(!same && !takesOverWords(code, dialect_, before_));
  if (!same) {
    if (!dialect_.drilling.levelOfRow || before_.cycleActive(dialect_) != Truth::Yes)
      state_.initialLevel = state_.at(toolAxis(dialect_, state_));
    for (unsigned i = 0; i < 3; ++i)
      state_.cycleStart[i] = state_.position[i];
    state_.clear(Fact::CycleRan);
  }
  activate(code, use.word);
  state_.origin.set(StatePart::Cycle, originOf(*use.word));
  Event &event = outcome_.emit(EventKind::CycleStart);
  event.code = use.code;
  event.word = use.word;
  event.axes = axesOf(dialect_, block_);
}

void Execution::startCycle(const CodeUse &use) {
  beginCycle(use);
  const CodeInfo &code = info(use);
  // L0 (K0 on newer controls) stores the data and makes no hole.
  for (const WordSpec &spec : code.words)
    if (spec.role == Role::Repeat)
      if (const Word *count = wordFor(block_, spec)) {
        const Interval n = value(*count);
        if (n.isConstant() && n.value() == 0)
          return;
      }
  if (code.firesInPlane ? (axesOf(dialect_, block_) & planeAxes(dialect_, state_)) != 0
                        : !code.waits)
    runCycle(use.code, axesOf(dialect_, block_));
}

void Execution::runCycle(CodeIndex index, uint16_t axes) {
  Event &event = outcome_.emit(EventKind::CycleRun);
  event.code = index;
  event.axes = axes;
  event.certain = index != noCode;
  state_.fedFrom.forget();
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
  const WordSpec *height = heightArgument(code);
  if (!height) // a call keeps its words
    storeCycleWords(false);
  if (code.cycle == CycleKind::TurnPass || code.cycle == CycleKind::FacePass ||
      code.cycle == CycleKind::ThreadPass) {
    keepLastWay(state_.cycle, block_, dialect_);
    // Every pass returns to the point where the cycle began.
    if (state_.compensation == phaseStarting)
      state_.compensation = phaseOn;
    return;
  }
  drillHoles(code, axes);
  state_.at(tool) = levelAfterCycle(code, height);
  state_.machineAxes &= ~(1u << unsigned(tool));
  state_.set(Fact::AwayFromPart);
  if (tapsRigidly(code.cycle)) {
    state_.spindle = spindleAny;
    state_.set(Fact::SpindleStoppedByTap);
  } else if (code.spindle == SpindleNeed::StartsItself) {
    state_.spindle = spindleAny;
  }
}

/// The places at which a drilling cycle runs in this block; the tool is at the last one.
void Execution::drillHoles(const CodeInfo &code, uint16_t axes) {
  const Axis tool = toolAxis(dialect_, state_);
  double runs = 1;
  if (const WordSpec *count = wordWithRole(code, Role::Repeat))
    if (const Word *word = wordFor(block_, *count))
      if (const Interval n = value(*word); n.isConstant())
        runs = std::max(1.0, std::floor(n.value()));
  for (double run = 0; run < std::min(runs, mostHoles); ++run) {
    std::array<Interval, 2> from;
    if (polarMayBeOn())
      from = inPlane();
    for (const Word &word : block_.words)
      if ((dialect_.axisWords & maskOf(word.address)) && !word.has(wordNoValue) &&
          dialect_.addresses[word.address].axis != tool)
        storeTarget(word, false);
    if (const Truth polar = polarMayBeOn() ? polarOn() : Truth::No; polar == Truth::Yes)
      polarInput(from);
    else if (polar == Truth::Unknown)
      setInPlane({});
    if (block_.hasAny(dialect_.polarWords))
      polarTarget();
    outcome_.holes.push_back(state_.position);
  }
  if (runs > mostHoles) // no further than that it is followed
    setInPlane({});
  if (polarMayBeOn() && (axes & planeAxes(dialect_, state_)))
    state_.set(Fact::PolarRadiusSet);
  if (!dialect_.isLathe())
    for (const auto &hole : outcome_.holes)
      for (unsigned i = 0; i < 2; ++i)
        state_.cutArea.add(i, hole[i]);
}

/// Where along the tool axis the cycle ends: at its argument for that, at R, or at the level where
/// it began.
Interval Execution::levelAfterCycle(const CodeInfo &code, const WordSpec *height) const {
  const Truth toInitial =
      dialect_.group(StandardGroup::ReturnLevel) == noGroup
          ? Truth::No
          : state_.isActive(dialect_, StandardGroup::ReturnLevel, {Action::ReturnInitial});
  Interval level = Interval::unknown();
  const std::optional<Interval> ofVariable = heightOfVariable(code);
  if (height) {
    const auto place = height->position - 1;
    const double back = state_.cycle.present >> place & 1
                            ? state_.cycle.value[place]
                            : std::numeric_limits<double>::quiet_NaN();
    const Interval factor = lengthFactor();
    if (!std::isnan(back) && factor.isConstant())
      level = Interval::exactly(back * factor.value());
  } else if (ofVariable) {
    level = *ofVariable;
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
  return toInitial == Truth::Yes && dialect_.drilling.risesFirst ? noLowerThanApproach(level)
                                                                 : level;
}

/// The level to which a cycle withdraws, where a variable of the program holds it.
std::optional<Interval> Execution::heightOfVariable(const CodeInfo &code) const {
  std::optional<Interval> level;
  for (const WordSpec &spec : code.words)
    if (spec.role == Role::Height && spec.variable)
      level = readVariable(state_, int64_t(givenVariable(spec, state_))).asNumber();
  return level;
}

/// The level to which a cycle withdraws, raised to that of its approach (R).
Interval Execution::noLowerThanApproach(const Interval &level) const {
  const Interval factor = lengthFactor();
  const Truth relative = incremental();
  if (!state_.cycle.has('R') || std::isnan(state_.cycle.get('R')) || !factor.isConstant() ||
      relative == Truth::Unknown)
    return Interval::unknown();
  Interval approach = Interval::exactly(state_.cycle.get('R') * factor.value());
  if (relative == Truth::Yes)
    approach = state_.initialLevel + approach;
  if (!level.isConstant() || !approach.isConstant())
    return Interval::unknown();
  return Interval::exactly(std::max(level.value(), approach.value()));
}

void Execution::cancelCycle(CodeIndex by, const Word *word) {
  const Truth active = before_.cycleActive(dialect_);
  if (active == Truth::No)
    return;
  if (const CodeIndex running = activeCycle();
      running != noCode && dialect_.codes[running].family != dialect_.codes[by].family &&
      dialect_.codes[by].action == Action::CycleCancel)
    return; // each family has a cancel of its own
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
      state_.setGroup(group, uint64_t(1) << dialect_.codes[member].bit);
}

/// The cycle works along the contour of a program that its call names.
void Execution::contourProgram(const CodeUse &use, const WordSpec &spec) {
  Flow &flow = outcome_.flow;
  if (const Word *word = spec.text ? nullptr : wordFor(block_, spec)) {
    flow.kind = FlowKind::Contour;
    flow.target = Value::of(value(*word));
    flow.code = use.code;
    flow.word = use.word;
    flow.begin = word->offset;
    flow.end = block_.endOf(*word);
    return;
  }
  for (size_t i = 0; i < block_.items.size(); ++i) {
    const Item &item = block_.items[i];
    if (item.kind != ItemKind::Instruction || item.arguments < spec.position ||
        item.begin != use.word->offset)
      continue;
    const Argument &name = block_.argumentsOf(item)[spec.position - 1];
    if (name.kind != ArgumentKind::Text)
      continue;
    go(FlowKind::Contour, i);
    outcome_.flow.code = use.code;
    outcome_.flow.word = use.word;
    outcome_.flow.begin = name.begin;
    outcome_.flow.end = name.end;
  }
}

/// The places of a pattern, of which the last one is where it leaves the tool; false when they are
/// not known.
bool Execution::patternPlaces(const CodeInfo &code) {
  if (code.count.empty() || code.cycle == CycleKind::ThreadChain)
    return false;
  ConditionContext context{dialect_, machine_, block_, {}, before_};
  const Interval count = levelOf(code.count, code, context);
  const Interval factor = lengthFactor();
  constexpr double workOfPlace = 4; // in plain moves: two formulas
  if (!count.isConstant() || !factor.isConstant() || count.value() < 1 || count.value() > mostHoles)
    return false;
  workDone += uint64_t(count.value() * workOfPlace);
  for (; context.index < count.value(); ++context.index) {
    std::array<Interval, 2> place;
    for (size_t i = 0; i < 2; ++i)
      place[i] = levelOf(code.places[i], code, context) * factor.value();
    setInPlane(place);
    outcome_.holes.push_back(state_.position);
  }
  return true;
}

/// Where a cycle leaves the tool that works where it is: at the place of its axis words, at its
/// depth. A depth that is a distance counts for each of its repeats.
void Execution::endDownHere(const CodeInfo &code) {
  const Axis tool = toolAxis(dialect_, state_);
  const Truth relative = incremental();
  for (const WordSpec &spec : code.words) {
    const Word *word = wordFor(block_, spec);
    if (!word)
      continue;
    if (spec.role == Role::Centre) {
      storeTarget(*word, false);
    } else if (spec.role == Role::Depth) {
      const WordSpec *repeat = wordWithRole(code, Role::Repeat);
      const Word *count = repeat ? wordFor(block_, *repeat) : nullptr;
      const Interval times = count ? value(*count) : Interval::exactly(1);
      const Interval way = coordinate(*word);
      state_.machineAxes &= ~(1u << unsigned(tool));
      state_.at(tool) =
          relative == Truth::No ? way
          : relative == Truth::Yes && times.isConstant() && !before_.inMachineCoordinates(tool)
              ? before_.at(tool) + way * times.value()
              : Interval::unknown();
    }
  }
}

/// Where a cycle that is called with arguments leaves the tool, or one that mills an area.
void Execution::endOfCall(const CodeInfo &code) {
  const bool called = block_.has(argumentAddress);
  if (!called && ((code.cycle < CycleKind::Face && code.count.empty()) ||
                  code.cycle == CycleKind::Measure || code.cycle == CycleKind::ThreadInfeed))
    return;
  state_.fedFrom.forget();
  if (has(code, CycleTrait::StartsHere))
    return endDownHere(code);
  const Interval factor = lengthFactor();
  const auto place = [&](const Word &word) {
    return factor.isConstant() ? value(word) * factor.value() : Interval::unknown();
  };
  const uint16_t plane = planeAxes(dialect_, state_);
  const Axis tool = toolAxis(dialect_, state_);
  const bool stays = code.cycle != CycleKind::None && code.cycle < CycleKind::TurnPass;
  if (code.cycle == CycleKind::Pattern && activeCycle() != noCode)
    if (const auto level = heightOfVariable(dialect_.codes[activeCycle()])) {
      state_.at(tool) = *level;
      state_.machineAxes &= ~(1u << unsigned(tool));
    }
  if (patternPlaces(code) && code.cycle == CycleKind::Pattern)
    return;
  if (!stays)
    for (unsigned i = 0; i < axisCount; ++i)
      if (plane >> i & 1)
        state_.position[i] = Interval::unknown();
  if (code.cycle == CycleKind::Pattern) { // somewhere, but not where the tool is
    outcome_.holes.push_back(state_.position);
    return;
  }
  state_.at(tool) = Interval::unknown();
  state_.machineAxes &= ~(1u << unsigned(tool) | plane);
  // Round what it threads a tool ends beside it.
  const Formula *inside = formulaOf(code, Measure::Inside);
  const bool beside = inside && !(levelOf(*inside, code, context_) == Interval::exactly(1));
  unsigned axis = 0; // the centre is given by the first and the second axis of the plane
  constexpr Axis order[][2] = {{Axis::X, Axis::Y}, {Axis::Z, Axis::X}, {Axis::Y, Axis::Z}};
  const auto &axes = tool == Axis::Z ? order[0] : tool == Axis::Y ? order[1] : order[2];
  for (const CycleMeasure &measure : code.measures)
    if (measure.what == Measure::Back)
      state_.at(tool) = factor.isConstant()
                            ? levelOf(measure.formula, code, context_) * factor.value()
                            : Interval::unknown();
  for (const WordSpec &spec : code.words) {
    const Word *word = wordFor(block_, spec);
    if (spec.role == Role::Height && word)
      state_.at(tool) = place(*word);
    else if (spec.role == Role::Centre && axis < 2)
      state_.at(axes[axis++]) = word && !beside ? place(*word) : Interval::unknown();
  }
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
  if (code.cycle != CycleKind::Pattern) // the active cycle keeps its own
    storeCycleWords(before_.pendingCycle == noCode);
  const bool executes = block_.hasAny(first | targets) || (!first && !targets);
  if (code.twoBlock && !executes) {
    Event &event = outcome_.emit(EventKind::CycleStart);
    event.code = use.code;
    event.word = use.word;
    state_.pendingCycle = use.code;
    state_.origin.set(StatePart::PendingCycle, originOf(*use.word));
    return;
  }
  Event &event = outcome_.emit(EventKind::CycleRun);
  event.code = use.code;
  event.word = use.word;
  event.axes = axesOf(dialect_, block_);
  state_.set(Fact::Moved);
  state_.set(Fact::MovedSinceTool);
  state_.set(Fact::MovedSincePreset);
  if (code.cycle != CycleKind::Pattern || state_.cycleActive(dialect_) != Truth::No) {
    if (code.cycle == CycleKind::Pattern)
      state_.set(Fact::CycleRan);
    state_.set(Fact::Cut);
    state_.set(Fact::CutSinceTool);
  }
  state_.set(Fact::AwayFromPart);
  endOfCall(code);
  if (code.cycle == CycleKind::ThreadInfeed)
    for (const Word &word : block_.words)
      if (dialect_.axisWords & maskOf(word.address) && !word.has(wordNoValue))
        storeTarget(word, false);
  for (const WordSpec &spec : code.words)
    if (spec.role == Role::Program)
      contourProgram(use, spec);
  if (first)
    readProfile(use, first, last);
}

/// The cycle works along the blocks that two of its words name.
void Execution::readProfile(const CodeUse &use, AddressMask first, AddressMask last) {
  go(FlowKind::Profile, use);
  Flow &flow = outcome_.flow;
  const auto number = [&](AddressMask mask) -> int64_t {
    const Word *word = block_.findAny(mask);
    if (!word)
      return notSet;
    const Interval v = value(*word);
    return v.isConstant() && v.value() >= 0 && v.value() < 1e9 ? int64_t(v.value()) : notKnown;
  };
  flow.first = number(first);
  flow.last = number(last);
  const bool finishing = info(use).cycle == CycleKind::Finish;
  if (finishing) {
    if (state_.roughFirst == flow.first)
      state_.roughFirst = state_.roughLast = notSet;
  } else {
    state_.roughFirst = flow.first;
    for (const Axis axis : {Axis::X, Axis::Z})
      state_.roughStart[axis == Axis::X ? 0 : 1] =
          state_.inMachineCoordinates(axis) ? Interval::unknown() : state_.at(axis);
    state_.roughLast = flow.last;
    state_.origin.set(StatePart::Roughing, originOf(*use.word));
  }
}

} // namespace ncvet
