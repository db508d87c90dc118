// Runs all programs of a file: the main program, those that nobody calls, and what is never
// reached.
#include "analyzer/flow/engine.h"
#include "interp/state/zero_point.h"

#include <algorithm>

namespace ncvet {

std::vector<SourceRange> Engine::reachedRanges() const {
  std::vector<SourceRange> ranges;
  for (const auto &[begin, end] : covered_)
    ranges.push_back({unit_.source.id(), begin, end});
  llvm::sort(ranges, [](const SourceRange &a, const SourceRange &b) { return a.begin < b.begin; });
  std::vector<SourceRange> joined;
  for (const SourceRange &range : ranges) {
    if (!joined.empty() && range.begin <= joined.back().end)
      joined.back().end = std::max(joined.back().end, range.end);
    else
      joined.push_back(range);
  }
  return joined;
}

/// Whether the block holds a code that ends a main program, or a subprogram.
void Engine::ending(const Block &block, bool &ends, bool &returns) const {
  constexpr AddressMask codes = maskOf('M') | maskOf(keywordAddress);
  if (!block.hasAny(codes))
    return;
  for (const Word &word : block.words) {
    if (!(codes & maskOf(word.address)))
      continue;
    const CodeIndex code = codeOf(*unit_.dialect, word);
    const Action action = code == noCode ? Action::None : unit_.dialect->codes[code].action;
    ends |= action == Action::ProgramEnd || action == Action::ProgramEndRewind;
    returns |= action == Action::Return;
  }
}

/// The same for all blocks of [begin, end).
void Engine::endings(uint32_t begin, uint32_t end, bool &ends, bool &returns) {
  Block block;
  for (uint32_t at = begin; at < end;) {
    const EndingRun *known = runs_ ? runs_->endings.find(at) : nullptr;
    EndingRun run;
    if (known && known->end <= end) {
      run = *known;
    } else {
      run.begin = run.end = at;
      const uint32_t stop = runs_ ? std::min(end, runs_->endings.next(at + 1)) : end;
      for (; run.end < stop && run.blocks < longestRun; ++run.blocks) {
        unit_.reader->read(run.end, block);
        ending(block, run.ends, run.returns);
        run.end = block.next;
      }
      if (runs_)
        runs_->endings.insert(run);
    }
    ends |= run.ends;
    returns |= run.returns;
    at = run.end;
  }
}

/// Programs that the first one did not call: main programs of their own when they end as such,
/// else subprograms whose caller is not known, of which only what is wrong for every caller counts.
void Engine::runOtherPrograms() {
  const llvm::ArrayRef<ProgramInfo> programs = unit_.index.programs();
  for (size_t i = 1; i < programs.size() && !stopped_; ++i) {
    const ProgramInfo &program = programs[i];
    if ((calledPrograms_.count(program.number) && unit_.index.find(program.number) == &program) ||
        (!program.name.empty() && calledNames_.count(program.name)))
      continue;
    bool ends = false, returns = false;
    endings(program.body, program.end, ends, returns);
    const bool subprogram = program.kind == ProgramKind::Subprogram || (returns && !ends);
    Lives lives(1);
    lives[0].state =
        subprogram ? unknownState(*unit_.dialect) : startOn(*unit_.dialect, unit_.machine);
    collector_.setDefiniteOnly(subprogram);
    const Region region{unit_, program, program.body, subprogram ? Kind::Subprogram : Kind::Main,
                        subprogram ? 1u : 0u};
    execute(region, std::move(lives));
    collector_.setDefiniteOnly(false);
  }
}

/// Subprograms between brackets that nothing called: of them, too, only what is wrong for every
/// caller counts.
void Engine::runOtherSubprograms() {
  for (const uint32_t head : unit_.index.subprograms()) {
    Block block;
    unit_.reader->read(head, block);
    if (stopped_ || calledBodies_.count(block.next))
      continue;
    Lives lives(1);
    lives[0].state = unknownState(*unit_.dialect);
    collector_.setDefiniteOnly(true);
    collector_.setUncalled(true);
    callerUnknown_ = true;
    execute({unit_, unit_.index.programAt(head), block.next, Kind::LocalSubprogram, 1},
            std::move(lives));
    callerUnknown_ = false;
    collector_.setUncalled(false);
    collector_.setDefiniteOnly(false);
  }
}

/// Blocks that no path reaches are read all the same: what the control cannot read stops it when
/// the program is loaded. Only what the text alone decides is told to the rules.
void Engine::inspectUnreached() {
  constexpr uint32_t wanted = bitOf(EventKind::Syntax) | bitOf(EventKind::WordIssue);
  if (!(dispatcher_.kinds() & wanted) || stopped_ || !unit_.dialect->loadsWhole)
    return;
  const Dialect &dialect = *unit_.dialect;
  const std::vector<SourceRange> reached = reachedRanges();
  const auto size = uint32_t(unit_.source.text().size());
  const MachineState unknown = unknownState(dialect);
  MachineState state;
  size_t range = 0;
  RunPlace quiet;
  const auto keep = [&](uint32_t next) {
    if (runs_ && quiet.blocks >= shortestRun)
      runs_->quiet.insert(quiet);
    quiet = RunPlace();
    quiet.begin = next;
  };
  for (uint32_t at = unit_.reader->first(); at < size;) {
    while (range < reached.size() && reached[range].end <= at)
      ++range;
    if (range < reached.size() && reached[range].begin <= at) {
      keep(reached[range].end);
      at = reached[range].end;
      continue;
    }
    const RunPlace *known = runs_ ? runs_->quiet.find(at) : nullptr;
    if (const StraightRun *run = known || !runs_ ? nullptr : runs_->straight.find(at);
        run && run->isClean)
      known = run; // once it was reached
    if (known && (range == reached.size() || known->end <= reached[range].begin)) {
      at = known->end;
      keep(at);
      continue;
    }
    unit_.reader->read(at, block_);
    const ProgramInfo &program = unit_.index.programAt(at);
    // Behind the closing mark of the tape stands no program.
    const bool closes = block_.kind == BlockKind::Tape && at > program.begin;
    at = closes ? std::max(program.end, block_.next) : block_.next;
    if (isClean(block_, dialect)) {
      if (closes) { // and what stands behind it is left out
        keep(at);
        continue;
      }
      quiet.end = block_.next;
      if (++quiet.blocks == longestRun)
        keep(at);
      continue;
    }
    keep(at);
    state = unknown;
    unit_.executor.execute(block_, unknown, state, outcome_);
    llvm::erase_if(outcome_.events,
                   [](const Event &event) { return !(bitOf(event.kind) & wanted); });
    outcome_.kinds &= wanted;
    collector_.beginStop();
    collector_.beginVisit(nullptr);
    dispatcher_.dispatch(unit_, block_, outcome_, unknown, state, 0);
    collector_.endStop();
  }
  keep(size);
}

void Engine::follow(BlockWatcher &watcher) {
  watcher_ = &watcher;
  constexpr uint8_t skipOff = 1;
  const ProgramInfo &main = unit_.index.programs().front();
  Lives lives(1);
  lives[0].state = startOn(*unit_.dialect, unit_.machine);
  lives[0].skip.fill(skipOff);
  execute({unit_, main, main.body, Kind::Main, 0}, std::move(lives));
}

/// Keeps a state that came by the observed block.
void Engine::note(const MachineState &before, const Live &live) {
  constexpr size_t mostWays = 8; // more nobody reads
  for (StateOnWay &known : observed_.ways)
    if (equal(known.before, before))
      return;
  if (observed_.ways.size() == mostWays) {
    StateOnWay &last = observed_.ways.back();
    last.before = join(last.before, before);
    last.after = join(last.after, live.state);
    observed_.joined = true;
    return;
  }
  observed_.ways.push_back({before, live.state, stepsOf(live.path)});
}

StatesAt Engine::observe(FileId file, uint32_t offset) {
  observedFile_ = file;
  observedAt_ = offset;
  observed_.complete = run().complete;
  return std::move(observed_);
}

AnalysisResult Engine::run() {
  const llvm::ArrayRef<ProgramInfo> programs = unit_.index.programs();
  const ProgramInfo &main = programs.front();
  // A file whose only end is a return is a subprogram: its caller, and with it the state on entry,
  // is not known.
  const llvm::StringRef tail = unit_.source.text().take_back(4096);
  bool returns = false, ends = false;
  if (programs.size() == 1) {
    const uint32_t from =
        unit_.source.lines().lineBegin(uint32_t(unit_.source.text().size() - tail.size()));
    endings(std::max(from, main.body), main.end, ends, returns);
  }
  Lives lives(1);
  const bool subprogram =
      main.kind == ProgramKind::Unknown ? returns && !ends : main.kind == ProgramKind::Subprogram;
  lives[0].state =
      subprogram ? unknownState(*unit_.dialect) : startOn(*unit_.dialect, unit_.machine);
  collector_.setDefiniteOnly(subprogram);
  execute({unit_, main, main.body, Kind::Main, 0}, std::move(lives));
  collector_.setDefiniteOnly(false);
  runOtherPrograms();
  runOtherSubprograms();
  inspectUnreached();

  const std::vector<SourceRange> reached = reachedRanges();
  const std::vector<int64_t> numbers(usedNumbers_.begin(), usedNumbers_.end());
  const std::vector<int64_t> called(calledPrograms_.begin(), calledPrograms_.end());
  const std::vector<std::string> labels(usedLabels_.begin(), usedLabels_.end());
  const std::vector<std::string> names(calledNames_.begin(), calledNames_.end());
  const FileSummary summary{unit_.index, unit_.source, *unit_.reader, reached,  numbers,
                            called,      labels,       names,         complete_};
  collector_.beginStop();
  collector_.beginVisit(nullptr);
  dispatcher_.finish(summary, unit_);
  collector_.endStop();

  AnalysisResult result;
  result.findings = collector_.take(project_.sources());
  result.blocks = blocks_;
  result.complete = complete_;
  result.cuts = cuts_;
  return result;
}

} // namespace ncvet
