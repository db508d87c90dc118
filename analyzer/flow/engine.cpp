// Runs all programs of a file: the main program, then those that nobody calls.
#include "analyzer/flow/engine.h"

#include "analyzer/flow/endings.h"
#include "analyzer/flow/region_run.h"
#include "analyzer/flow/unreached.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/turning_text.h"
#include "interp/state/zero_point.h"

#include <algorithm>

namespace ncvet {

namespace {

/// Calls the programs that nothing known calls.
constexpr CallSite somewhere;

} // namespace

Engine::Engine(Project &programs, FileUnit &entry, const AnalysisLimits &bounds,
               const std::atomic<bool> *cancel)
    : FlowRun(programs, entry, bounds), cancel_(cancel), flow_(*this) {
  // Many write the subprograms of a file before the program that calls them.
  const llvm::ArrayRef<ProgramInfo> all = unit.index.programs();
  mainProgram = &all.front();
  if (all.size() > 1 && all.front().hasHeader() && onlyReturns(all.front()))
    mainProgram = llvm::find_if(all, [&](const ProgramInfo &one) { return !onlyReturns(one); });
  if (mainProgram == all.end())
    mainProgram = &all.front();
}

/// Whether the program is a subprogram, by its kind or by how its text ends.
bool Engine::onlyReturns(const ProgramInfo &program) const {
  if (program.kind != ProgramKind::Unknown)
    return program.kind == ProgramKind::Subprogram;
  return endsByReturn(program);
}

bool Engine::endsByReturn(const ProgramInfo &program) const {
  constexpr uint32_t tail = 4096; // bytes: an end is among the last blocks
  const uint32_t near = program.end > tail ? unit.source.lines().lineBegin(program.end - tail) : 0;
  const Endings endings =
      endingsOf(unit, std::max(near, program.body), program.end, /*runs=*/nullptr);
  return endings.returns && !endings.ends;
}

Exits Engine::execute(const Region &region, Lives entry) {
  const bool straightOn = &region.unit == &unit && region.kind == RegionKind::Main &&
                          region.depth() == 0 && callStack.empty();
  if (!runs_ || !straightOn)
    return RegionRun(*this, flow_, region, std::move(entry), {}, cancel_).execute();
  if (!rules_) {
    RunReplay replay(*runs_);
    return RegionRun(*this, flow_, region, std::move(entry), {nullptr, &replay}, cancel_).execute();
  }
  RunRecorder recorder(*runs_, unit, rules_->dispatcher(), rules_->collector());
  return RegionRun(*this, flow_, region, std::move(entry), {&recorder}, cancel_).execute();
}

/// The plane that the machine's data choose, where no program has stated one.
static void startInPlane(Action plane, const Dialect &dialect, MachineState &state) {
  const GroupIndex group = dialect.group(StandardGroup::Plane);
  const std::vector<CodeIndex> &members = dialect.groups[group].members;
  for (size_t i = 0; i < members.size(); ++i)
    if (dialect.codes[members[i]].action == plane) {
      state.groups[group] = uint64_t(1) << i;
      return;
    }
}

/// Runs a program that no other calls.
void Engine::enter(const Region &region, EntryState entry) {
  listeners.tell([&](FlowListener &listener) { listener.entered(entry); });
  entryUnknown = entry != EntryState::Known;
  Lives lives = startOf(entry != EntryState::Known);
  if (readsAsTurning(region.unit, region.program))
    startInPlane(Action::PlaneZX, *unit.dialect, lives[0].state);
  execute(region, std::move(lives));
}

/// A state with which a program begins; that of a subprogram's caller is not known.
Lives Engine::startOf(bool subprogram) const {
  Lives lives(1);
  lives[0].state = subprogram ? calledState(*unit.dialect) : startOn(*unit.dialect, unit.machine);
  return lives;
}

void Engine::runMainProgram() {
  // A file whose only end is a return is a subprogram: its caller, and with it the state on entry,
  // is not known.
  const bool several = unit.index.programs().size() > 1;
  const bool subprogram = several ? mainProgram->kind == ProgramKind::Subprogram
                                  : onlyReturns(*mainProgram) || isContour(*mainProgram);
  enter({unit, *mainProgram, mainProgram->body, RegionKind::Main},
        subprogram ? EntryState::CallerUnknown : EntryState::Known);
}

/// Whether a program that only the ending of its file calls a main one is a piece of contour that
/// others call: it ends with a return and names neither feed, tool nor speed.
bool Engine::isContour(const ProgramInfo &program) const {
  if (program.kind != ProgramKind::Main || program.hasHeader() || !endsByReturn(program))
    return false;
  const AddressMask words = maskOf(letterAddress('F')) | maskOf(letterAddress('S')) |
                            maskOf(letterAddress('T')) | unit.dialect->feedWords;
  for (const Block &block : ncvet::blocks(unit.index.reader(), program.body, program.end))
    if (block.hasAny(words))
      return false;
  return !endingsOf(unit, program.body, program.end, /*runs=*/nullptr).ends;
}

/// Programs that the main program did not call: main programs of their own when they end as such,
/// else subprograms whose caller is not known, of which only what is wrong for every caller counts.
void Engine::runOtherPrograms() {
  const llvm::ArrayRef<ProgramInfo> programs = unit.index.programs();
  for (const ProgramInfo &program : programs) {
    if (stopped)
      return;
    if (&program == mainProgram ||
        (used.programs.count(program.number) && unit.index.find(program.number) == &program) ||
        (!program.name.empty() && used.names.count(program.name)))
      continue;
    const Endings endings = endingsOf(unit, program.body, program.end, runs_);
    const bool subprogram =
        program.kind == ProgramKind::Subprogram || (endings.returns && !endings.ends);
    if (subprogram)
      enter({unit, program, program.body, RegionKind::Subprogram, &somewhere},
            EntryState::CallerUnknown);
    else
      enter({unit, program, program.body, RegionKind::Main}, EntryState::Known);
  }
}

/// Subprograms between brackets that nothing called: of them, too, only what is wrong for every
/// caller counts.
void Engine::runOtherSubprograms() {
  for (const uint32_t head : unit.index.subprograms()) {
    Block block;
    unit.reader->read(head, block);
    if (stopped || used.bracketed.count(block.next))
      continue;
    callerUnknown = true;
    enter({unit, unit.index.programAt(head), block.next, RegionKind::LocalSubprogram, &somewhere},
          EntryState::Uncalled);
    callerUnknown = false;
  }
}

void Engine::follow() {
  SkipSwitches off;
  off.fill(SkipSwitch::Off);
  follow(off);
}

void Engine::follow(const SkipSwitches &skip) {
  Lives lives = startOf(false);
  lives[0].skip = skip;
  execute({unit, *mainProgram, mainProgram->body, RegionKind::Main}, std::move(lives));
}

void Engine::followFrom(uint32_t from, const MachineState &state) {
  Lives lives(1);
  lives[0].state = state;
  lives[0].skip.fill(SkipSwitch::Off);
  execute({unit, *mainProgram, from, RegionKind::Main}, std::move(lives));
}

/// Tells what was seen of the file as a whole.
void Engine::finish() {
  const std::vector<SourceRange> reached = covered.ranges(unit.source.id());
  const std::vector<int64_t> numbers(used.numbers.begin(), used.numbers.end());
  const std::vector<int64_t> called(used.programs.begin(), used.programs.end());
  const std::vector<std::string> labels(used.labels.begin(), used.labels.end());
  const FileSummary summary{unit.index, unit.source, *unit.reader, reached,       numbers,
                            called,     labels,      complete,     used.anyNumber};
  visits.begin();
  visits.visit(nullptr);
  listeners.tell([&](FlowListener &listener) { listener.finished(summary); });
  endStop();
}

FollowedCallsOfFiles Engine::followedCalls() const {
  FollowedCallsOfFiles files;
  for (const auto &[file, blocks] : followed) {
    const std::string &path = project.sources().get(file).path();
    if (path.empty())
      continue;
    std::vector<FollowedCall> &calls = files.emplace_back().second;
    files.back().first = path;
    for (const auto &[block, groups] : blocks)
      calls.push_back({block, groups});
  }
  return files;
}

void Engine::run() {
  runMainProgram();
  runOtherPrograms();
  runOtherSubprograms();
  if (postponed)
    return;
  listeners.tell([](FlowListener &listener) { listener.entered(EntryState::Known); });
  inspectUnreached(*this, runs_);
  finish();
}

} // namespace ncvet
