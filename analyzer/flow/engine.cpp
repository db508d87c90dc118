// Runs all programs of a file: the main program, then those that nobody calls.
#include "analyzer/flow/engine.h"

#include "analyzer/flow/endings.h"
#include "analyzer/flow/region_run.h"
#include "analyzer/flow/unreached.h"
#include "interp/state/zero_point.h"

#include <algorithm>

namespace ncvet {

namespace {

/// Calls the programs that nothing known calls.
constexpr CallSite somewhere;

} // namespace

Engine::Engine(Project &programs, FileUnit &entry, const AnalysisLimits &bounds,
               const std::atomic<bool> *cancel)
    : FlowRun(programs, entry, bounds), cancel_(cancel), flow_(*this) {}

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

/// Runs a program that no other calls.
void Engine::enter(const Region &region, EntryState entry) {
  listeners.tell([&](FlowListener &listener) { listener.entered(entry); });
  execute(region, startOf(entry != EntryState::Known));
}

/// A state with which a program begins; that of a subprogram's caller is not known.
Lives Engine::startOf(bool subprogram) const {
  Lives lives(1);
  lives[0].state = subprogram ? calledState(*unit.dialect) : startOn(*unit.dialect, unit.machine);
  return lives;
}

void Engine::runMainProgram() {
  const llvm::ArrayRef<ProgramInfo> programs = unit.index.programs();
  const ProgramInfo &main = programs.front();
  // A file whose only end is a return is a subprogram: its caller, and with it the state on entry,
  // is not known.
  const llvm::StringRef tail = unit.source.text().take_back(4096);
  Endings endings;
  if (programs.size() == 1) {
    const uint32_t from =
        unit.source.lines().lineBegin(uint32_t(unit.source.text().size() - tail.size()));
    endings = endingsOf(unit, std::max(from, main.body), main.end, runs_);
  }
  const bool subprogram = main.kind == ProgramKind::Unknown ? endings.returns && !endings.ends
                                                            : main.kind == ProgramKind::Subprogram;
  enter({unit, main, main.body, RegionKind::Main},
        subprogram ? EntryState::CallerUnknown : EntryState::Known);
}

/// Programs that the first one did not call: main programs of their own when they end as such,
/// else subprograms whose caller is not known, of which only what is wrong for every caller counts.
void Engine::runOtherPrograms() {
  const llvm::ArrayRef<ProgramInfo> programs = unit.index.programs();
  for (size_t i = 1; i < programs.size() && !stopped; ++i) {
    const ProgramInfo &program = programs[i];
    if ((used.programs.count(program.number) && unit.index.find(program.number) == &program) ||
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
  const ProgramInfo &main = unit.index.programs().front();
  Lives lives = startOf(false);
  lives[0].skip = skip;
  execute({unit, main, main.body, RegionKind::Main}, std::move(lives));
}

void Engine::followFrom(uint32_t from, const MachineState &state) {
  Lives lives(1);
  lives[0].state = state;
  lives[0].skip.fill(SkipSwitch::Off);
  execute({unit, unit.index.programs().front(), from, RegionKind::Main}, std::move(lives));
}

/// Tells what was seen of the file as a whole.
void Engine::finish() {
  const std::vector<SourceRange> reached = covered.ranges(unit.source.id());
  const std::vector<int64_t> numbers(used.numbers.begin(), used.numbers.end());
  const std::vector<int64_t> called(used.programs.begin(), used.programs.end());
  const std::vector<std::string> labels(used.labels.begin(), used.labels.end());
  const std::vector<std::string> names(used.names.begin(), used.names.end());
  const FileSummary summary{unit.index, unit.source, *unit.reader, reached,  numbers,
                            called,     labels,      names,        complete, used.anyNumber};
  visits.begin();
  visits.visit(nullptr);
  listeners.tell([&](FlowListener &listener) { listener.finished(summary); });
  endStop();
}

void Engine::run() {
  runMainProgram();
  runOtherPrograms();
  runOtherSubprograms();
  listeners.tell([](FlowListener &listener) { listener.entered(EntryState::Known); });
  inspectUnreached(*this, runs_);
  finish();
}

} // namespace ncvet
