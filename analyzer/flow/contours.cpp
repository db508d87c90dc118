// Contours and profiles that cycles read, or run.
#include "analyzer/flow/contours.h"

#include "analyzer/flow/end_of_passes.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/references.h"

namespace ncvet {

namespace {

/// Cycles whose passes along a turned contour are made, to see where they end.
constexpr unsigned mostPassesFollowed = 20;
/// `MachineState::profile` of blocks that a cycle reads as data, and of those that it runs.

/// The state in which rules of contours that are milled look at the blocks of one.
void enterContour(MachineState &state) {
  state.set(Fact::InContour);
  state.clear(Fact::ContourBegun);
}

} // namespace

void Contours::contour(Step &step) {
  const CodeInfo &cycle = step.unit().dialect->codes[step.outcome.flow.code];
  if (has(cycle, CycleTrait::Turned))
    turnedContour(step, cycle);
  else if (step.outcome.flow.item < 0)
    numberedContour(step, cycle);
  else
    namedContour(step, cycle);
}

/// The contour is a subprogram between brackets, by its number.
void Contours::turnedContour(Step &step, const CodeInfo &cycle) {
  FileUnit &unit = step.unit();
  const Flow &flow = step.outcome.flow;
  const ExecutedBlock executed{*unit.dialect, unit.machine, step.block,
                               step.outcome,  step.before,  step.live.state};
  std::optional<ContourCycle> works = contourCycle(executed);
  if (works && passesFollowed_++ >= mostPassesFollowed)
    works.reset();
  if (!flow.target.isConstant()) {
    for (const Axis axis : {Axis::X, Axis::Z})
      step.live.state->at(axis) = Interval::unknown();
    return step.goOn();
  }
  const std::string name = std::to_string(std::llround(flow.target.number.value()));
  run_.used.names.insert(name);
  Callee callee{&unit, &step.region().program, 0};
  if (callees_.findBracketed(callee, name))
    return read(step, cycle, callee, std::move(works));
  for (const Axis axis : {Axis::X, Axis::Z})
    step.live.state->at(axis) = Interval::unknown();
  if (!run_.callerUnknown)
    run_.issue(FlowIssue::UnknownProgram, step, step.flowRange());
  step.goOn();
}

/// The contour is a program, by its name, or a section between two labels.
void Contours::namedContour(Step &step, const CodeInfo &cycle) {
  FileUnit &unit = step.unit();
  const SourceRange where = step.flowRange();
  const llvm::StringRef name = unit.source.text(where.begin, where.end);
  if (name.contains(':')) {
    section(step, name);
    return step.goOn();
  }
  if (name.empty()) // the contour that another block has called
    return step.goOn();
  run_.used.names.insert(name.upper());
  const auto [other, program] = run_.project.findProgram(unit, name);
  if (program)
    return read(step, cycle, {other, program, program->body}, std::nullopt);
  run_.issue(FlowIssue::UnknownProgram, step, where);
  step.goOn();
}

/// The contour is a program, by its number, or the blocks of this program from that number on.
void Contours::numberedContour(Step &step, const CodeInfo &cycle) {
  const Value &target = step.outcome.flow.target;
  if (!target.isConstant())
    return step.goOn();
  FileUnit &unit = step.unit();
  const ProgramInfo &here = step.region().program;
  Reference reference = Reference::toBlock(std::llround(target.number.value()));
  run_.used.programs.insert(reference.number);
  run_.used.numbers.insert(reference.number);
  const auto block = resolveBlock(unit.index, here, reference, step.at);
  reference.to = ReferredKind::Program;
  if (const auto place = resolveProgram(run_.project, unit, reference))
    return read(step, cycle, {place->unit, place->program, place->begin}, std::nullopt);
  if (block)
    return read(step, cycle, {&unit, &here, *block, RegionKind::LocalSubprogram}, std::nullopt);
  if (!run_.callerUnknown)
    run_.issue(FlowIssue::UnknownProgram, step, step.flowRange());
  step.goOn();
}

/// A cycle reads the section between two labels of the program, `BEGIN1:END1`, as a contour.
void Contours::section(const Step &step, llvm::StringRef labels) {
  const Region &region = step.region();
  FileUnit &unit = step.unit();
  const uint32_t from = step.block.begin;
  const SourceRange where = step.flowRange();
  const llvm::StringRef head = labels.split(':').first.trim();
  const llvm::StringRef tail = labels.split(':').second.trim();
  run_.used.labels.insert(unit.reader->labelKey(head));
  run_.used.labels.insert(unit.reader->labelKey(tail));
  const auto [first, last] = resolveProfile(unit.index, region.program, Reference::toLabel(head),
                                            Reference::toLabel(tail), from);
  if (!first || !last)
    return run_.issue(FlowIssue::UnknownBlock, step, where);
  Block end;
  unit.reader->read(*last, end);
  const bool holdsCycle = *first <= from && from < end.next;
  if (*last < *first || holdsCycle ||
      bodies_.isRunning(unit, *first, RegionKind::Section, end.next) || bodies_.isDeep())
    return;
  Live read = step.live;
  read.state->profile = ProfileMode::Recorded;
  read.state->clear(Fact::Cut);
  enterContour(read.state);
  read.path = run_.lengthen(read.path, PathNode::Kind::Call, where);
  Region body{unit, region.program, *first, RegionKind::Section, region.caller};
  body.stopAt = end.next;
  bodies_.run(body, std::move(read));
}

/// Runs the blocks of a contour as data; `works`: the cycle makes passes along it.
void Contours::read(Step &step, const CodeInfo &cycle, const Callee &callee,
                    std::optional<ContourCycle> works) {
  MachineState &state = step.live.state;
  Live read = step.live;
  std::optional<PassesEnd> passes;
  if (works) {
    passes.emplace(step.executed(), std::move(*works));
  }
  if (has(cycle, CycleTrait::Turned))
    for (const Axis axis : {Axis::X, Axis::Z})
      state.at(axis) = Interval::unknown();
  read.state->profile = ProfileMode::Recorded;
  read.state->clear(Fact::Cut);
  if (!has(cycle, CycleTrait::Turned) && !has(cycle, CycleTrait::TurnsContour))
    enterContour(read.state);
  read.path = run_.lengthen(read.path, PathNode::Kind::Call, step.flowRange());
  const CallSite site{&step.unit(), &step.region().program, step.block.next, true,
                      step.region().caller};
  const Region region{*callee.unit, *callee.program, callee.start, callee.kind, &site};
  if (const unsigned levels = step.unit().dialect->limits.callDepth;
      levels && region.depth() > levels)
    run_.issue(FlowIssue::TooDeep, step, step.flowRange());
  if (!bodies_.isRunning(region.unit, region.start, region.kind) &&
      region.depth() < run_.limits.callDepth) {
    const bool stopped = run_.stopped;
    if (passes)
      run_.listeners.add(*passes);
    bodies_.run(region, std::move(read));
    if (passes)
      run_.listeners.removeLast();
    // The contour alone was lost.
    if (!run_.listeners.followOnePath())
      run_.stopped = stopped;
    if (const auto last = passes ? passes->last() : std::nullopt)
      for (const Axis axis : {Axis::X, Axis::Z})
        state.at(axis) = last->to[size_t(axis)];
  }
  run_.listeners.tell([](FlowListener &listener) { listener.contourEnded(); });
  step.goOn();
}

/// The blocks between which the profile lies; none, with an issue, when there is no such profile.
std::optional<Contours::Bounds> Contours::boundsOf(const Step &step) {
  const Flow &flow = step.outcome.flow;
  const FileIndex &index = step.unit().index;
  const ProgramInfo &program = step.region().program;
  if (flow.first < 0 || flow.last < 0) // missing or not known: the word rules speak of it
    return std::nullopt;
  run_.used.numbers.insert(flow.first);
  run_.used.numbers.insert(flow.last);
  const ReferredBlocks blocks = resolveProfile(index, program, Reference::toBlock(flow.first),
                                               Reference::toBlock(flow.last), step.at);
  if (blocks.areInOrder())
    return Bounds{*blocks.first, *blocks.last};
  run_.issue(blocks.first && blocks.last ? FlowIssue::ProfileReversed : FlowIssue::ProfileMissing,
             step, step.flowRange());
  return std::nullopt;
}

/// Whether plain flow has run, or will run, the blocks of a profile that is not meant to be run.
void Contours::notePlace(const Step &step, const Bounds &bounds, bool finishing) {
  const Activation &activation = step.activation;
  const uint32_t first = bounds.first;
  const bool isMain = &step.unit() == &run_.unit;
  // Blocks that plain flow has run already, and that this cycle runs again.
  const bool reached = (first >= activation.runBegin && first < activation.runEnd) ||
                       (isMain && first < step.at && run_.covered.holds(first));
  const bool runsThrough = step.unit().dialect->profileRunsThrough;
  if ((finishing || !runsThrough) && reached && first < step.at && !run_.used.profiles.count(first))
    run_.issue(FlowIssue::ProfileReached, step, step.flowRange(),
               {step.unit().source.id(), first, first + 1});
  if (!isMain)
    return;
  // After its own block the control goes on: it must not come to the profile.
  if (finishing && !runsThrough && first > step.at)
    run_.used.finishedAhead.try_emplace(first, step.outcome.flow, step.flowRange());
  if (finishing || !runsThrough)
    run_.used.profiles.insert(first);
}

/// Whether nothing but empty blocks lies between the cycle and its profile.
bool Contours::isAdjacent(const Step &step, uint32_t first) {
  if (first < step.block.next)
    return false;
  for (const Block &between : blocks(*step.unit().reader, step.block.next, first)) {
    if (!between.isEmpty())
      return false;
  }
  return true;
}

/// Modes that the contour set stay; the tool returns to where the cycle began.
void Contours::goOnFinished(Step &step, Exits exits) {
  Lives left;
  for (Returned &exit : exits) {
    exit.live.state->profile = step.before.profile;
    exit.live.state->position = step.live.state->position;
    exit.live.state->machineAxes = step.live.state->machineAxes;
    exit.live.path = step.live.path;
    mergeInto(left, std::move(exit.live));
  }
  for (Live &one : left)
    step.activation.add(step.block.next, std::move(one));
}

void Contours::profile(Step &step) {
  const Region &region = step.region();
  FileUnit &unit = step.unit();
  const Dialect &dialect = *unit.dialect;
  const Flow &flow = step.outcome.flow;
  const auto bounds = boundsOf(step);
  if (!bounds)
    return step.goOn();
  const bool finishing = dialect.codes[flow.code].cycle == CycleKind::Finish;
  notePlace(step, *bounds, finishing);
  const bool adjacent = isAdjacent(step, bounds->first);
  Live contour = step.live;
  contour.state->profile = finishing ? ProfileMode::Executed : ProfileMode::Recorded;
  contour.path = run_.lengthen(contour.path, PathNode::Kind::Call, step.flowRange(), flow.first);
  const Region body{unit,          region.program, bounds->first, RegionKind::Profile,
                    region.caller, bounds->last};
  Exits exits = bodies_.run(body, std::move(contour));
  run_.listeners.tell([](FlowListener &listener) { listener.contourEnded(); });
  if (finishing)
    return goOnFinished(step, std::move(exits));
  // After roughing the control goes on after the profile, or runs it.
  uint32_t onward = step.block.next;
  if (adjacent && !dialect.profileRunsThrough) {
    Block lastBlock;
    unit.reader->read(bounds->last, lastBlock);
    onward = lastBlock.next;
  }
  step.activation.add(onward, std::move(step.live));
}

} // namespace ncvet
