// Follows a program block by block; where states wait for each other, and how they are joined.
#include "analyzer/flow/engine.h"

#include "analyzer/reuse/run_recorder.h"

#include <algorithm>
#include <new>

namespace ncvet {

namespace {

/// States kept apart at one place; beyond that the two closest are joined.
constexpr size_t maxLives = 4;
/// The cancel flag is looked at once in so many blocks (a power of two).
constexpr uint64_t cancelInterval = 256;

/// What executing a block costs, in plain moves.
uint64_t workOf(const Block &block) {
  constexpr uint64_t statement = 4; // expressions
  constexpr uint64_t turn = 8;      // states that wait and meet
  const auto turns = [](const Item &item) {
    return item.kind == ItemKind::Structure || item.kind == ItemKind::Jump ||
           item.kind == ItemKind::End;
  };
  return block.items.empty() ? 1 : llvm::any_of(block.items, turns) ? turn : statement;
}

/// Issues behind which the control stops, or goes where the text does not say.
bool endsTheWay(FlowIssue kind) {
  switch (kind) {
  case FlowIssue::NoTarget:
  case FlowIssue::UnknownProgram:
  case FlowIssue::UnknownBlock:
  case FlowIssue::Recursion:
  case FlowIssue::ProfileMissing:
  case FlowIssue::ProfileReversed:
  case FlowIssue::ComputedTarget:
  case FlowIssue::StructureMismatch:
  case FlowIssue::EndlessLoop:
    return true;
  default:
    return false;
  }
}

} // namespace

Engine::Engine(Project &project, FileUnit &unit, const RuleSelection &rules,
               const AnalysisLimits &limits, const std::atomic<bool> *cancel, StraightRuns *runs)
    : project_(project), unit_(unit), limits_(limits), cancel_(cancel), runs_(runs),
      collector_(rules, *unit.dialect, limits),
      dispatcher_(*unit.dialect, unit.machine, rules, collector_) {}

void Engine::cut(std::string why) {
  complete_ = false;
  lose({unit_.source.id(), block_.begin, block_.end}, why);
  if (!llvm::is_contained(cuts_, why))
    cuts_.push_back(std::move(why));
}

void Engine::lose(SourceRange where, llvm::StringRef why) {
  if (!watcher_ || stopped_)
    return;
  stopped_ = true;
  watcher_->lost(where, why);
}

void Engine::fork(Activation &activation, SourceRange where) {
  ++activation.forks;
  lose(where, "what decides here is not known");
}

const PathNode *Engine::step(const PathNode *before, PathNode::Kind kind, SourceRange range,
                             int64_t number) {
  // A path that is longer than anybody reads is not continued.
  constexpr unsigned longestPath = 24;
  if (before && before->length >= longestPath)
    return before;
  auto *node = new (paths_.Allocate<PathNode>()) PathNode{kind, range, number};
  node->before = before;
  node->length = before ? before->length + 1 : 1;
  return node;
}

void Engine::cover(const FileUnit &unit, uint32_t begin, uint32_t end) {
  if (&unit != &unit_ || begin >= end)
    return;
  uint32_t &known = covered_[begin];
  known = std::max(known, end);
}

void Engine::forget(Live &live, const Dialect &dialect) {
  const OriginState origin = live.state.origin;
  const uint8_t profile = live.state.profile;
  live.state = unknownState(dialect);
  live.state.origin = origin;
  live.state.profile = profile;
}

void Engine::issue(FlowIssue kind, Activation &activation, const Live &live,
                   const MachineState &before, SourceRange where, SourceRange related) {
  const Region &region = activation.region;
  if (watcher_ && endsTheWay(kind))
    lose(where, "control cannot go where the block says");
  if (!(dispatcher_.kinds() & bitOf(EventKind::FlowIssue)))
    return;
  dispatcher_.flowIssue(kind, region.unit, block_, outcome_, before, live.state, region.depth,
                        where, related);
}

// ---------------------------------------------------------------------------------------------
// Waiting states

void Engine::mergeInto(const FileUnit &unit, Lives &lives, Live live) {
  const Dialect &dialect = *unit.dialect;
  for (Live &other : lives)
    if (equal(other.state, live.state)) {
      if (other.skip != live.skip)
        for (size_t i = 0; i < live.skip.size(); ++i)
          if (other.skip[i] != live.skip[i])
            other.skip[i] = 0;
      if (live.path == nullptr || (other.path && live.path->length < other.path->length))
        other.path = live.path;
      return;
    }
  const uint64_t print = controlFingerprint(dialect, live.state);
  for (Live &other : lives)
    if (other.skip == live.skip && controlFingerprint(dialect, other.state) == print) {
      other.state = join(other.state, live.state);
      return;
    }
  if (lives.size() < maxLives) {
    lives.push_back(std::move(live));
    return;
  }
  // Too many: join with one in the same modes if there is any, else with the last.
  Live *target = &lives.back();
  for (Live &other : lives)
    if (controlFingerprint(dialect, other.state) == print)
      target = &other;
  target->state = join(target->state, live.state);
  for (size_t i = 0; i < live.skip.size(); ++i)
    if (target->skip[i] != live.skip[i])
      target->skip[i] = 0;
}

/// Whether a way that comes to a place executed before brings nothing new there. With many jumps
/// back, most rounds differ in a trifle, and each would run on to the program's end: a place that
/// many of them come by takes their states as a loop head does.
bool Engine::bringsNothing(Activation &activation, uint32_t offset, MachineState &state) {
  constexpr unsigned roundsBeforeJoining = 8, roundsBeforeWidening = 16;
  if (!activation.rounds || offset >= activation.high)
    return false;
  Meeting &meeting = activation.meetings[offset];
  if (meeting.lastRound != activation.rounds) {
    meeting.lastRound = activation.rounds;
    ++meeting.rounds;
  }
  if (meeting.rounds <= roundsBeforeJoining)
    return false;
  if (!meeting.seen) {
    meeting.seen = std::make_unique<MachineState>(state);
    return false;
  }
  if (covers(*meeting.seen, state))
    return true;
  *meeting.seen = meeting.rounds <= roundsBeforeWidening ? join(*meeting.seen, state)
                                                         : widen(*meeting.seen, state);
  state = *meeting.seen;
  return false;
}

void Engine::add(Activation &activation, uint32_t offset, Live live) {
  if (!bringsNothing(activation, offset, live.state))
    wait(activation, offset, std::move(live));
}

void Engine::wait(Activation &activation, uint32_t offset, Live live) {
  mergeInto(activation.region.unit, activation.pending[offset], std::move(live));
  activation.nextPending = activation.pending.begin()->first;
}

Engine::Lives Engine::takePending(Activation &activation, uint32_t &offset) {
  const auto first = activation.pending.begin();
  offset = first->first;
  Lives lives = std::move(first->second);
  activation.pending.erase(first);
  activation.nextPending = activation.pending.empty() ? ~0u : activation.pending.begin()->first;
  return lives;
}

// ---------------------------------------------------------------------------------------------
// Running a region

Engine::Exits Engine::execute(const Region &region, Lives lives) {
  Activation activation{region, {}, ~0u, {}, {}, 0, 0, 0, 0, 0, false};
  activation.runBegin = activation.runEnd = region.start;
  FileUnit &unit = region.unit;
  const uint32_t end = region.program.end;
  uint32_t at = region.start;
  const CrashPlace place(unit.source, at);
  MachineState before;
  const MachineState *synced = nullptr; // the state of which `before` is a copy, set-up part too
  PlainRun plainRun;
  const bool recorded = runs_ && &unit == &unit_ && region.kind == Kind::Main &&
                        region.depth == 0 && callStack_.empty();
  RunRecorder recorder(recorded ? runs_ : nullptr, unit, dispatcher_, collector_);

  while (!stopped_) {
    if (lives.empty()) {
      if (activation.pending.empty())
        break;
      lives = takePending(activation, at);
      synced = nullptr;
    } else if (activation.nextPending <= at) {
      uint32_t offset = at;
      if (activation.nextPending == at) {
        for (Live &live : takePending(activation, offset))
          mergeInto(unit, lives, std::move(live));
      } else {
        // A backward jump: those states go first, these wait.
        for (Live &live : lives)
          wait(activation, at, std::move(live));
        lives = takePending(activation, at);
      }
      synced = nullptr;
    }
    if (at == region.stopAt) { // a section ends here, however it was reached
      for (Live &live : lives)
        activation.exits.push_back({std::move(live), notSet});
      lives.clear();
      continue;
    }
    if (at >= end) {
      runOut(activation, lives);
      lives.clear();
      continue;
    }

    if (recorder.isOn()) {
      const bool straight =
          lives.size() == 1 && activation.pending.empty() && at >= activation.high;
      // What is not in step with the state begins anew with the next block.
      PlainRun present = synced ? plainRun : PlainRun();
      std::optional<RunPlace> known;
      if (straight)
        known = recorder.takeOver(at, lives[0].state, present,
                                  [&](const RunPlace &run) { return mayTakeOver(run, unit); });
      else
        recorder.interrupt();
      if (known) {
        follow(*known, activation);
        before = lives[0].state;
        synced = &lives[0].state;
        plainRun = present;
        at = known->end;
        continue;
      }
    }
    unit.reader->read(at, block_);
    if ((++steps_ & (cancelInterval - 1)) == 0) {
      if (cancel_ && cancel_->load(std::memory_order_relaxed)) {
        stopped_ = true;
        cut("cancelled");
        break;
      }
      if (&unit == &unit_)
        unit.source.forget(at > (1u << 16) ? at - (1u << 16) : 0);
    }
    if (at != activation.runEnd) {
      cover(unit, activation.runBegin, activation.runEnd);
      activation.runBegin = at;
    }
    activation.runEnd = block_.next;
    const bool firstTime = at >= activation.high;
    if (firstTime)
      activation.high = block_.next;

    if (block_.kind == BlockKind::Empty ||
        ((block_.kind == BlockKind::Tape || block_.kind == BlockKind::ProgramHeader) &&
         block_.isEmpty() && block_.issues.empty())) {
      const bool tape = block_.kind == BlockKind::Tape;
      if (block_.kind != BlockKind::Empty || !block_.issues.empty())
        recorder.interrupt();
      if (tape && activation.executedAny) {
        // The closing mark of the tape: what stands behind it is no program.
        at = end;
        continue;
      }
      at = block_.next;
      continue;
    }
    if (firstTime && region.depth == 0 && region.kind == Kind::Main)
      ++blocks_;
    else if ((repeated_ += workOf(block_) * lives.size()) > limits_.repeatedBlocks) {
      if (!abstract_)
        cut("loops and calls were too long to be run to the end");
      abstract_ = true;
      if (repeated_ > 2 * limits_.repeatedBlocks) {
        stopped_ = true;
        break;
      }
    }
    // A file that only defines subprograms is no main program.
    activation.executedAny |= block_.items.empty() || block_.items[0].kind != ItemKind::Structure ||
                              block_.items[0].structure != Structure::Sub;
    activation.lastBegin = block_.begin;
    activation.lastEnd = block_.end;
    const uint32_t next = block_.tapeInside ? end : block_.next;
    const bool lastOfProfile = at == region.lastBlock;

    // Block skip: the operator's switch decides, once for all blocks of a level.
    if (block_.skip >= 0) {
      // A level that no control has shares the last switch.
      constexpr size_t last = std::tuple_size_v<decltype(Live::skip)> - 1;
      const auto level = std::min(size_t(block_.skip <= 1 ? 0 : block_.skip), last);
      Lives executing;
      for (Live &live : lives) {
        if (live.skip[level] != 1) {
          if (live.skip[level] == 0)
            fork(activation, blockRange(unit));
          Live skipped = live;
          skipped.skip[level] = 2;
          if (live.skip[level] == 0)
            skipped.path =
                step(live.path, PathNode::Kind::Skip, {unit.source.id(), block_.begin, block_.end});
          if (lastOfProfile)
            activation.exits.push_back({std::move(skipped), notSet});
          else
            add(activation, next, std::move(skipped));
        }
        if (live.skip[level] != 2) {
          live.skip[level] = 1;
          executing.push_back(std::move(live));
        }
      }
      lives = std::move(executing);
      synced = nullptr;
      if (lives.empty())
        continue;
    }

    // Conditions in front of statements: on a way where it is not known, both happen.
    if (!block_.items.empty()) {
      Lives forked;
      for (Live &live : lives)
        if (unit.executor.guard(block_, live.state) == Truth::Unknown) {
          fork(activation, blockRange(unit));
          Live other = live;
          other.path = step(live.path, PathNode::Kind::NoJump,
                            {unit.source.id(), block_.items[0].begin, block_.items[0].end});
          forked.push_back(std::move(other));
        }
      for (Live &live : forked)
        add(activation, next, std::move(live));
    }

    collector_.beginStop();
    Lives onward;
    const bool single = lives.size() == 1;
    bool stays = false, goesOn = false;
    for (Live &live : lives) {
      if (synced == &live.state) {
        static_cast<MotionState &>(before) = live.state;
        if (!outcome_.plainMove) // what the block before did
          static_cast<ModeState &>(before) = live.state;
      } else {
        before = live.state;
        plainRun = {};
      }
      synced = nullptr;
      const bool guardHolds =
          block_.items.empty() || unit.executor.guard(block_, live.state) != Truth::No;
      unit.executor.execute(block_, before, live.state, outcome_, guardHolds);
      if (!activation.heads.empty() || !callStack_.empty())
        stops_ += llvm::any_of(outcome_.codes, [&](const CodeUse &use) {
          const Action action = unit.dialect->codes[use.code].action;
          return action == Action::ProgramStop || action == Action::OptionalStop;
        });
      // A cycle among the blocks of a contour reads none of its own.
      if (region.kind == Kind::Profile && outcome_.flow.kind == FlowKind::Profile)
        outcome_.flow = Flow();
      if (watcher_ && !stopped_)
        watcher_->executed(unit, block_, outcome_, before, live.state);
      if (at == observedAt_ && unit.source.id() == observedFile_)
        note(before, live);
      collector_.beginVisit(live.path);
      if (region.kind == Kind::Main && block_.number >= 0 && &unit == &unit_ &&
          localTargets_.count(at))
        issue(FlowIssue::RunsIntoSubprogram, activation, live, before,
              {unit.source.id(), block_.begin, block_.end});
      if (region.kind == Kind::Main && block_.number >= 0 && &unit == &unit_)
        runsIntoProfile(activation, live, before, at);
      goesOn = plainRun.goesOn(block_, outcome_, before);
      if (!goesOn)
        recorder.goesOnNoMore(before);
      if (goesOn)
        dispatcher_.dispatchMove(unit, block_, outcome_, before, live.state, region.depth);
      else if (outcome_.kinds & dispatcher_.kinds())
        dispatcher_.dispatch(unit, block_, outcome_, before, live.state, region.depth);
      const Truth modal = outcome_.callsModally;
      if (lastOfProfile) {
        activation.exits.push_back({std::move(live), notSet});
        continue;
      }
      if (region.kind == Kind::Profile && outcome_.flow.kind != FlowKind::Next &&
          outcome_.flow.kind != FlowKind::End && outcome_.flow.kind != FlowKind::Return)
        outcome_.flow = Flow(); // a profile is contour data: nothing is called or jumped to from it
      if (outcome_.flow.kind == FlowKind::Next && modal == Truth::No) {
        if (single) {
          stays = true;
          if (!outcome_.setupChanged)
            synced = &live.state;
          continue;
        }
        onward.push_back(std::move(live));
        continue;
      }
      if (outcome_.flow.kind == FlowKind::Next) {
        callModally(activation, live, at, before);
        continue;
      }
      if (modal != Truth::No) // in front of what the block itself calls
        forget(live, *unit.dialect);
      leave(activation, live, at, before);
    }
    collector_.endStop();
    at = next;
    if (stays) {
      recorder.executed(block_, goesOn);
      continue;
    }
    recorder.interrupt();
    lives = std::move(onward);
    synced = nullptr;
  }
  cover(unit, activation.runBegin, activation.runEnd);
  return std::move(activation.exits);
}

/// Plain flow comes to a profile along which a cycle in front of it has finished already.
void Engine::runsIntoProfile(Activation &activation, const Live &live, const MachineState &before,
                             uint32_t at) {
  const auto finished = finishedAhead_.find(at);
  if (finished == finishedAhead_.end())
    return;
  const Flow flow = outcome_.flow;
  outcome_.flow = finished->second.first;
  issue(FlowIssue::ProfileReached, activation, live, before, finished->second.second,
        {unit_.source.id(), at, at + 1});
  outcome_.flow = flow;
}

/// A run is executed all the same where somebody wants to see what happens in it, and where a
/// subprogram that was called begins in it.
bool Engine::mayTakeOver(const RunPlace &run, const FileUnit &unit) const {
  const bool observed =
      unit.source.id() == observedFile_ && run.begin <= observedAt_ && observedAt_ < run.end;
  const auto target = localTargets_.lower_bound(run.begin);
  const auto finished = finishedAhead_.lower_bound(run.begin);
  return !observed && (target == localTargets_.end() || *target >= run.end) &&
         (finished == finishedAhead_.end() || finished->first >= run.end);
}

/// Takes over what a run of an earlier analysis has done, but for the state.
void Engine::follow(const RunPlace &run, Activation &activation) {
  if (run.begin != activation.runEnd) {
    cover(activation.region.unit, activation.runBegin, activation.runEnd);
    activation.runBegin = run.begin;
  }
  activation.runEnd = activation.high = run.end;
  activation.lastBegin = run.lastBegin;
  activation.lastEnd = run.lastEnd;
  activation.executedAny = true;
  blocks_ += run.blocks;
  steps_ += run.blocks;
  if (cancel_ && cancel_->load(std::memory_order_relaxed)) {
    stopped_ = true;
    cut("cancelled");
  }
}

void Engine::runOut(Activation &activation, Lives &lives) {
  const Region &region = activation.region;
  const SourceRange where{region.unit.source.id(), activation.lastBegin, activation.lastEnd};
  collector_.beginStop();
  for (Live &live : lives) {
    collector_.beginVisit(live.path);
    if (activation.executedAny && !inForeignLanguage(*region.unit.dialect, live.state))
      issue(region.kind == Kind::Main ? FlowIssue::MainRunsOut : FlowIssue::SubprogramRunsOut,
            activation, live, live.state, where);
    // Without a return the control goes on with whatever stands behind: nothing is known of it.
    if (region.kind != Kind::Main)
      activation.exits.push_back({std::move(live), notSet});
  }
  collector_.endStop();
}

} // namespace ncvet
