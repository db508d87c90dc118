// Follows a program as its control would: calls, jumps, loops, block skip, profiles.
#include "analyzer/engine.h"

#include <algorithm>
#include <new>

namespace ncvet {

namespace {

/// States kept apart at one place; beyond that the two closest are joined.
constexpr size_t maxLives = 4;
/// Visits of a loop head with joined states before bounds that still move are given up.
constexpr unsigned visitsBeforeWidening = 8;
/// Results of one called program that are remembered.
constexpr size_t memosPerProgram = 64;
/// Passes of one call's repeat count that are run for real.
constexpr double maxRepeats = 10000;
/// A jump to a number that is not known may go to any block with a number, when these are few.
constexpr size_t maxComputedTargets = 64;
/// The cancel flag is looked at once in so many blocks (a power of two).
constexpr uint64_t cancelInterval = 256;

/// Finds blocks that only go on as the block before: what is not told by coordinates is the same.
struct PlainRun {
  AddressMask addresses = 0; ///< of the block before; 0: it was no plain move
  uint32_t machineAxes = 0;
  uint64_t may = 0, must = 0; ///< facts in front of it

  bool goesOn(const Block &block, const Outcome &outcome, const MachineState &before) {
    if (!outcome.plainMove) {
      addresses = 0;
      return false;
    }
    const bool same = addresses == block.addresses && machineAxes == before.machineAxes &&
                      may == before.factsMay && must == before.factsMust;
    addresses = block.addresses;
    machineAxes = before.machineAxes;
    may = before.factsMay;
    must = before.factsMust;
    return same;
  }
};

} // namespace

Engine::Engine(Project &project, FileUnit &unit, const RuleSelection &rules,
               const AnalysisLimits &limits, const std::atomic<bool> *cancel)
    : project_(project), unit_(unit), limits_(limits), cancel_(cancel),
      collector_(rules, *unit.dialect, limits),
      dispatcher_(*unit.dialect, unit.machine, rules, collector_) {}

void Engine::cut(std::string why) {
  complete_ = false;
  if (!llvm::is_contained(cuts_, why))
    cuts_.push_back(std::move(why));
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

void Engine::add(Activation &activation, uint32_t offset, Live live) {
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

Engine::Exits Engine::execute(const Region &region, Lives entry) {
  Activation activation{region, {}, ~0u, {}, {}, 0, 0, 0, 0, 0, false};
  activation.runBegin = activation.runEnd = region.start;
  FileUnit &unit = region.unit;
  const uint32_t end = region.program.end;
  uint32_t at = region.start;
  Lives lives = std::move(entry);
  MachineState before;
  const MachineState *synced = nullptr; // the state of which `before` is a copy, set-up part too
  PlainRun plainRun;

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
          add(activation, at, std::move(live));
        lives = takePending(activation, at);
      }
      synced = nullptr;
    }
    if (at >= end) {
      runOut(activation, lives);
      lives.clear();
      continue;
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
    else if (++repeated_ > limits_.repeatedBlocks) {
      if (!abstract_)
        cut("loops and calls were too long to be run to the end");
      abstract_ = true;
      if (repeated_ > 2 * limits_.repeatedBlocks) {
        stopped_ = true;
        break;
      }
    }
    activation.executedAny = true;
    activation.lastBegin = block_.begin;
    activation.lastEnd = block_.end;
    const uint32_t next = block_.tapeInside ? end : block_.next;
    const bool lastOfProfile = at == region.lastBlock;

    // Block skip: the operator's switch decides, once for all blocks of a level.
    if (block_.skip >= 0) {
      const auto level = size_t(block_.skip <= 1 ? 0 : block_.skip);
      Lives executing;
      for (Live &live : lives) {
        if (live.skip[level] != 1) {
          activation.forks += live.skip[level] == 0;
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
          ++activation.forks;
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
    bool stays = false;
    for (Live &live : lives) {
      if (synced == &live.state) {
        static_cast<MotionState &>(before) = live.state;
      } else {
        before = live.state;
        plainRun = {};
      }
      synced = nullptr;
      const bool guardHolds =
          block_.items.empty() || unit.executor.guard(block_, live.state) != Truth::No;
      unit.executor.execute(block_, before, live.state, outcome_, guardHolds);
      collector_.beginVisit(live.path);
      if (region.kind == Kind::Main && block_.number >= 0 && &unit == &unit_ &&
          localTargets_.count(at))
        issue(FlowIssue::RunsIntoSubprogram, activation, live, before,
              {unit.source.id(), block_.begin, block_.end});
      if (plainRun.goesOn(block_, outcome_, before))
        dispatcher_.dispatchMove(unit, block_, outcome_, before, live.state, region.depth);
      else if (outcome_.kinds & dispatcher_.kinds())
        dispatcher_.dispatch(unit, block_, outcome_, before, live.state, region.depth);
      const int32_t macro = outcome_.macroAfterMove;
      if (lastOfProfile) {
        activation.exits.push_back({std::move(live), notSet});
        continue;
      }
      if (region.kind == Kind::Profile && outcome_.flow.kind != FlowKind::Next &&
          outcome_.flow.kind != FlowKind::End && outcome_.flow.kind != FlowKind::Return)
        outcome_.flow = Flow(); // a profile is contour data: nothing is called or jumped to from it
      if (outcome_.flow.kind == FlowKind::Next && macro == notSet) {
        if (single) {
          stays = true;
          if (!outcome_.setupChanged)
            synced = &live.state;
          continue;
        }
        onward.push_back(std::move(live));
        continue;
      }
      if (macro != notSet) {
        callMacro(activation, live, macro, before);
        continue;
      }
      leave(activation, live, at, before);
    }
    collector_.endStop();
    at = next;
    if (stays)
      continue;
    lives = std::move(onward);
    synced = nullptr;
  }
  cover(unit, activation.runBegin, activation.runEnd);
  return std::move(activation.exits);
}

void Engine::runOut(Activation &activation, Lives &lives) {
  const Region &region = activation.region;
  const SourceRange where{region.unit.source.id(), activation.lastBegin, activation.lastEnd};
  collector_.beginStop();
  for (Live &live : lives) {
    collector_.beginVisit(live.path);
    if (activation.executedAny)
      issue(region.kind == Kind::Main ? FlowIssue::MainRunsOut : FlowIssue::SubprogramRunsOut,
            activation, live, live.state, where);
    // Without a return the control goes on with whatever stands behind: nothing is known of it.
    if (region.kind != Kind::Main)
      activation.exits.push_back({std::move(live), notSet});
  }
  collector_.endStop();
}

// ---------------------------------------------------------------------------------------------
// Leaving a block

bool Engine::leave(Activation &activation, Live &live, uint32_t at, const MachineState &before) {
  const Region &region = activation.region;
  const Flow flow = outcome_.flow;
  const SourceRange where = flowRange(region.unit);
  switch (flow.kind) {
  case FlowKind::Next:
    add(activation, block_.next, std::move(live));
    return true;
  case FlowKind::Jump:
    jump(activation, live, at, before);
    return true;
  case FlowKind::LoopBegin:
  case FlowKind::LoopEnd:
    loop(activation, live, at, before);
    return true;
  case FlowKind::Call:
  case FlowKind::CallLocal:
    call(activation, live, at, before);
    return true;
  case FlowKind::Profile:
    profile(activation, live, at, before);
    return true;
  case FlowKind::End:
    if (region.kind != Kind::Main && region.kind != Kind::Profile)
      issue(FlowIssue::EndInSubprogram, activation, live, before, where);
    return true;
  case FlowKind::Alarm:
    return true;
  case FlowKind::Return:
    break;
  }
  int64_t target = notSet;
  if (flow.target.isConstant())
    target = int64_t(flow.target.number.value());
  if (region.kind == Kind::Main) {
    if (target != notSet) {
      // M99 P in a main program is a jump.
      usedNumbers_.insert(target);
      if (const auto offset = region.unit.index.block(region.program, target, at))
        goTo(activation, at, *offset, std::move(live), true);
      else
        issue(FlowIssue::UnknownBlock, activation, live, before, where);
      return true;
    }
    issue(FlowIssue::ReturnInMain, activation, live, before, where);
    return true;
  }
  activation.exits.push_back({std::move(live), target});
  return true;
}

/// Continues at `target`; jumps that lead back are counted, so that every analysis ends.
void Engine::goTo(Activation &activation, uint32_t from, uint32_t target, Live live, bool certain) {
  if (target > from)
    add(activation, target, std::move(live));
  else
    backTo(activation, target, std::move(live), certain);
}

void Engine::backTo(Activation &activation, uint32_t target, Live live, bool certain) {
  Head &head = activation.heads[target];
  ++head.visits;
  if (certain && !head.abstract && !abstract_) {
    // Run for real, unless the same state comes round again: then it comes round for ever. Hashing
    // every pass would cost more than running it, so this is looked for at growing distances.
    constexpr unsigned window = 4;
    if (head.visits == head.nextSnapshot) {
      head.snapshot = hash(live.state);
      head.snapshotForks = activation.forks;
      head.windowEnd = head.visits + window;
      head.nextSnapshot *= 4;
    } else if (head.visits <= head.windowEnd && hash(live.state) == head.snapshot) {
      // A way out that depends on something unknown was taken beside this one.
      if (head.snapshotForks == activation.forks)
        issue(FlowIssue::EndlessLoop, activation, live, live.state,
              {activation.region.unit.source.id(), activation.lastBegin, activation.lastEnd});
      return;
    }
    add(activation, target, std::move(live));
    return;
  }
  if (head.hasSeen) {
    if (covers(head.seen, live.state))
      return;
    head.seen = head.visits < visitsBeforeWidening ? join(head.seen, live.state)
                                                   : widen(head.seen, live.state);
  } else {
    head.seen = live.state;
    head.hasSeen = true;
  }
  live.state = head.seen;
  live.path = step(live.path, PathNode::Kind::LoopPass,
                   {activation.region.unit.source.id(), activation.lastBegin, activation.lastEnd});
  add(activation, target, std::move(live));
}

void Engine::jump(Activation &activation, Live &live, uint32_t at, const MachineState &before) {
  const Region &region = activation.region;
  const Flow flow = outcome_.flow;
  const SourceRange where = flowRange(region.unit);
  if (flow.condition != Truth::Yes) {
    Live straight = live;
    if (flow.condition == Truth::Unknown) {
      ++activation.forks;
      straight.path = step(live.path, PathNode::Kind::NoJump, where);
    }
    add(activation, block_.next, std::move(straight));
    if (flow.condition == Truth::No)
      return;
  }
  const bool certain = flow.condition == Truth::Yes;
  live.path = step(live.path, PathNode::Kind::Jump, where);
  if (flow.target.isVacant()) {
    issue(FlowIssue::NoTarget, activation, live, before, where);
    return;
  }
  if (!flow.target.isConstant()) {
    ++activation.forks;
    issue(FlowIssue::ComputedTarget, activation, live, before, where);
    const llvm::ArrayRef<NumberedBlock> all = region.unit.index.numbers(region.program);
    if (all.size() > maxComputedTargets) {
      cut("a computed jump may lead to too many blocks");
      return;
    }
    std::vector<NumberedBlock> targets(all.begin(), all.end());
    for (const NumberedBlock &target : targets) {
      usedNumbers_.insert(target.number);
      goTo(activation, at, target.offset, live, false);
    }
    return;
  }
  const auto number = int64_t(flow.target.number.value());
  usedNumbers_.insert(number);
  if (const auto target = region.unit.index.block(region.program, number, at))
    goTo(activation, at, *target, std::move(live), certain);
  else
    issue(FlowIssue::UnknownBlock, activation, live, before, where);
}

const Engine::LoopShape &Engine::loops(const FileUnit &unit, const ProgramInfo &program) {
  const auto [found, fresh] = loops_.try_emplace({unit.source.id(), program.begin});
  LoopShape &shape = found->second;
  if (!fresh)
    return shape;
  Block block;
  struct Open {
    uint32_t offset;
    uint8_t loop;
  };
  std::vector<Open> open;
  for (uint32_t at = program.begin; at < program.end; at = block.next) {
    unit.reader->read(at, block);
    for (const Item &item : block.items) {
      if (item.kind == ItemKind::While || item.kind == ItemKind::Do) {
        open.push_back({at, item.loop});
      } else if (item.kind == ItemKind::End) {
        // The innermost loop with this number; loops inside that were not closed are broken.
        size_t i = open.size();
        while (i > 0 && open[i - 1].loop != item.loop)
          --i;
        if (i == 0) {
          shape.mismatched.push_back(at);
          continue;
        }
        for (size_t j = i; j < open.size(); ++j)
          shape.mismatched.push_back(open[j].offset);
        shape.endOf[open[i - 1].offset] = block.next;
        shape.headOf[at] = open[i - 1].offset;
        open.resize(i - 1);
      }
    }
  }
  for (const Open &left : open)
    shape.mismatched.push_back(left.offset);
  return shape;
}

void Engine::loop(Activation &activation, Live &live, uint32_t at, const MachineState &before) {
  const Region &region = activation.region;
  const Flow flow = outcome_.flow;
  const uint32_t next = block_.next;
  const LoopShape &shape = loops(region.unit, region.program);
  if (llvm::is_contained(shape.mismatched, at))
    issue(FlowIssue::StructureMismatch, activation, live, before, flowRange(region.unit));
  if (flow.kind == FlowKind::LoopEnd) {
    const auto head = shape.headOf.find(at);
    if (head == shape.headOf.end())
      add(activation, next, std::move(live));
    else
      backTo(activation, head->second, std::move(live), !activation.heads[head->second].abstract);
    return;
  }
  const auto behind = shape.endOf.find(at);
  if (flow.condition == Truth::Yes || behind == shape.endOf.end()) {
    if (flow.condition != Truth::No)
      add(activation, next, std::move(live));
    return;
  }
  if (flow.condition == Truth::Unknown) {
    // From now on this head is a place where states are joined.
    ++activation.forks;
    activation.heads[at].abstract = true;
    Live body = live;
    body.path = step(live.path, PathNode::Kind::Jump, flowRange(region.unit));
    add(activation, next, std::move(body));
  }
  add(activation, behind->second, std::move(live));
}

// ---------------------------------------------------------------------------------------------
// Calls

/// Runs a called body, or remembers what it did for the same state before.
Engine::Exits Engine::callBody(const Region &region, Live live) {
  auto &memos = memos_[{region.unit.source.id(), region.start}];
  const uint64_t print = hash(live.state);
  for (const Memo &memo : memos)
    if (memo.hash == print && equal(memo.entry, live.state)) {
      Exits exits = memo.exits;
      for (Returned &exit : exits)
        exit.live.path = live.path;
      return exits;
    }
  // The storage of the block at hand is needed again behind the call.
  Block savedBlock = block_;
  Outcome savedOutcome = outcome_;
  callStack_.push_back({region.unit.source.id(), region.start});
  const MachineState entry = live.state;
  const PathNode *path = live.path;
  Lives lives;
  lives.push_back(std::move(live));
  Exits raw = execute(region, std::move(lives));
  callStack_.pop_back();
  block_ = std::move(savedBlock);
  outcome_ = std::move(savedOutcome);
  // Ways that return to the same place in the same modes are one.
  Exits exits;
  std::map<int64_t, Lives> byTarget;
  for (Returned &exit : raw) {
    exit.live.path = path;
    mergeInto(region.unit, byTarget[exit.target], std::move(exit.live));
  }
  for (auto &[target, group] : byTarget)
    for (Live &exit : group)
      exits.push_back({std::move(exit), target});
  if (!stopped_ && memos.size() < memosPerProgram)
    memos.push_back({print, entry, exits});
  return exits;
}

void Engine::call(Activation &activation, Live &live, uint32_t at, const MachineState &before) {
  const Region &region = activation.region;
  FileUnit &unit = region.unit;
  const Flow flow = outcome_.flow;
  const SourceRange where = flowRange(unit);
  const uint32_t next = block_.next;
  const auto goOnUnknown = [&] {
    forget(live, *unit.dialect);
    add(activation, next, std::move(live));
  };
  if (flow.target.isVacant()) {
    issue(FlowIssue::NoTarget, activation, live, before, where);
    goOnUnknown();
    return;
  }
  if (!flow.target.isConstant()) {
    issue(FlowIssue::ComputedTarget, activation, live, before, where);
    goOnUnknown();
    return;
  }
  const auto number = int64_t(flow.target.number.value());
  FileUnit *target = &unit;
  const ProgramInfo *program = &region.program;
  uint32_t start = 0;
  Kind kind = Kind::Subprogram;
  if (flow.kind == FlowKind::CallLocal) {
    usedNumbers_.insert(number);
    const auto offset = unit.index.block(*program, number, at);
    if (!offset) {
      issue(FlowIssue::UnknownBlock, activation, live, before, where);
      goOnUnknown();
      return;
    }
    start = *offset;
    kind = Kind::LocalSubprogram;
    if (&unit == &unit_)
      localTargets_.insert(start);
  } else {
    calledPrograms_.insert(number);
    std::tie(target, program) = project_.findProgram(unit, number);
    if (!program) {
      issue(FlowIssue::UnknownProgram, activation, live, before, where);
      goOnUnknown();
      return;
    }
    start = program->body;
    if (flow.startAt.isConstant()) {
      const auto first = int64_t(flow.startAt.number.value());
      if (target == &unit_)
        usedNumbers_.insert(first);
      if (const auto offset = target->index.block(*program, first, program->begin))
        start = *offset;
    }
  }
  const auto key = std::make_pair(target->source.id(), start);
  const bool running =
      llvm::is_contained(callStack_, key) ||
      (kind == Kind::Subprogram && target == &unit && program == &region.program) ||
      (kind == Kind::Subprogram && target == &unit_ && !unit_.index.programs().empty() &&
       program == &unit_.index.programs().front());
  if (running) {
    // Without a condition nothing ends it; with one it is followed until the control's levels end.
    const llvm::StringRef body = target->source.text(program->begin, program->end);
    const bool conditional = body.contains("IF") || body.contains("WHILE") || body.contains("GOTO");
    if (!conditional || region.depth + 1 >= limits_.callDepth) {
      issue(FlowIssue::Recursion, activation, live, before, where,
            {target->source.id(), start, start + 1});
      goOnUnknown();
      return;
    }
  }
  const unsigned allowed = unit.dialect->limits.callDepth;
  if (allowed && region.depth + 1 > allowed)
    issue(FlowIssue::TooDeep, activation, live, before, where);
  if (region.depth + 1 >= limits_.callDepth) {
    goOnUnknown();
    return;
  }
  double repeats = 1;
  if (flow.repeat.isConstant())
    repeats = flow.repeat.number.value();
  if (!(repeats >= 1)) // a bad count is the rules' business; the body is looked at once
    repeats = 1;
  const bool counted = flow.repeat.isConstant() && repeats <= maxRepeats;
  if (!counted)
    repeats = std::min(repeats, 2.0);
  const PathNode *path = live.path;
  live.path = step(path, PathNode::Kind::Call, where, number);
  const Variables locals = live.state.locals;
  if (flow.macro)
    live.state.locals = flow.arguments;
  Lives current;
  current.push_back(std::move(live));
  const Region body{*target, *program, start, kind, region.depth + 1};
  for (double pass = 0; pass < repeats && !current.empty() && !stopped_; ++pass) {
    Lives behind;
    bool changed = false;
    for (Live &one : current) {
      const MachineState entry = one.state;
      for (Returned &exit : callBody(body, std::move(one))) {
        if (exit.target != notSet) {
          // M99 P: the caller goes on at that block.
          exit.live.path = path;
          if (flow.macro)
            exit.live.state.locals = locals;
          if (const auto offset = unit.index.block(region.program, exit.target, at)) {
            usedNumbers_.insert(exit.target);
            goTo(activation, at, *offset, std::move(exit.live), true);
          } else {
            issue(FlowIssue::UnknownBlock, activation, exit.live, before, where);
          }
          continue;
        }
        changed |= !equal(entry, exit.live.state);
        mergeInto(unit, behind, std::move(exit.live));
      }
    }
    current = std::move(behind);
    if (!changed) // every further pass is the same
      break;
  }
  activation.forks += current.size() > 1;
  for (Live &one : current) {
    one.path = path;
    if (flow.macro)
      one.state.locals = locals;
    if (!counted)
      for (Interval &position : one.state.position)
        position = Interval::unknown();
    if (dispatcher_.kinds() & bitOf(EventKind::CallReturned))
      dispatcher_.callReturned(unit, block_, outcome_, before, one.state, region.depth);
    add(activation, next, std::move(one));
  }
}

/// The call that a modal macro (G66) makes behind a move.
void Engine::callMacro(Activation &activation, Live &live, int32_t program,
                       const MachineState &before) {
  Flow flow;
  flow.kind = FlowKind::Call;
  flow.macro = true;
  flow.begin = block_.begin;
  flow.end = block_.end;
  flow.target = program >= 0 ? Value::of(program) : Value::unknown();
  if (const auto *p = project_.findProgram(activation.region.unit, program).second; !p) {
    forget(live, *activation.region.unit.dialect);
    live.state.modalMacro = program;
    add(activation, block_.next, std::move(live));
    return;
  }
  outcome_.flow = flow;
  live.state.modalMacro = notSet; // moves inside the macro do not call it again
  const uint32_t next = block_.next;
  call(activation, live, block_.begin, before);
  const auto waiting = activation.pending.find(next);
  if (waiting != activation.pending.end())
    for (Live &one : waiting->second)
      one.state.modalMacro = program;
}

/// A cycle reads the blocks between two numbers: as data when it roughs, for real when it finishes.
void Engine::profile(Activation &activation, Live &live, uint32_t at, const MachineState &before) {
  const Region &region = activation.region;
  FileUnit &unit = region.unit;
  const Dialect &dialect = *unit.dialect;
  const Flow flow = outcome_.flow;
  const SourceRange where = flowRange(unit);
  const uint32_t next = block_.next;
  if (flow.first < 0 || flow.last < 0) { // missing or not known: the word rules speak of it
    add(activation, next, std::move(live));
    return;
  }
  usedNumbers_.insert(flow.first);
  usedNumbers_.insert(flow.last);
  const auto first = unit.index.block(region.program, flow.first, at);
  const auto last = unit.index.block(region.program, flow.last, first ? *first - 1 : at);
  if (!first || !last) {
    issue(FlowIssue::ProfileMissing, activation, live, before, where);
    add(activation, next, std::move(live));
    return;
  }
  if (*last <= *first) {
    issue(FlowIssue::ProfileReversed, activation, live, before, where);
    add(activation, next, std::move(live));
    return;
  }
  const bool finishing = dialect.codes[flow.code].cycle == CycleKind::Finish;
  // Blocks that plain flow has run already, and that this cycle runs again.
  bool reached = *first >= activation.runBegin && *first < activation.runEnd;
  if (&unit == &unit_ && !reached)
    for (const auto &[begin, end] : covered_)
      reached |= *first >= begin && *first < end && *first < at;
  if (finishing && reached && *first < at && !profileStarts_.count(*first))
    issue(FlowIssue::ProfileReached, activation, live, before, where,
          {unit.source.id(), *first, *first + 1});
  const bool adjacent = *first >= next && [&] {
    Block between;
    for (uint32_t offset = next; offset < *first; offset = between.next) {
      unit.reader->read(offset, between);
      if (!between.isEmpty())
        return false;
    }
    return true;
  }();
  const bool runsThrough = !finishing && dialect.profileRunsThrough;
  if (!runsThrough && &unit == &unit_)
    profileStarts_.insert(*first);

  Live contour = live;
  contour.state.profile = finishing ? 2 : 1;
  contour.path = step(live.path, PathNode::Kind::Call, where, flow.first);
  const Region body{unit, region.program, *first, Kind::Profile, region.depth, *last};
  Exits exits = callBody(body, std::move(contour));
  if (finishing) {
    // Modes that the contour set stay; the tool returns to where the cycle began.
    Lives behind;
    for (Returned &exit : exits) {
      exit.live.state.profile = before.profile;
      exit.live.state.position = live.state.position;
      exit.live.state.machineAxes = live.state.machineAxes;
      exit.live.path = live.path;
      mergeInto(unit, behind, std::move(exit.live));
    }
    for (Live &one : behind)
      add(activation, next, std::move(one));
    return;
  }
  // Behind roughing the control goes on behind the profile, or runs it.
  uint32_t onward = next;
  if (adjacent && !runsThrough) {
    Block lastBlock;
    unit.reader->read(*last, lastBlock);
    onward = lastBlock.next;
  }
  add(activation, onward, std::move(live));
}

// ---------------------------------------------------------------------------------------------
// The whole file

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

/// Programs that the first one did not call: main programs of their own when they end as such,
/// else subprograms whose caller is not known, of which only what is wrong for every caller counts.
void Engine::runOtherPrograms() {
  const llvm::ArrayRef<ProgramInfo> programs = unit_.index.programs();
  for (size_t i = 1; i < programs.size() && !stopped_; ++i) {
    const ProgramInfo &program = programs[i];
    if (calledPrograms_.count(program.number) && unit_.index.find(program.number) == &program)
      continue;
    bool ends = false, returns = false;
    Block block;
    for (uint32_t at = program.body; at < program.end; at = block.next) {
      unit_.reader->read(at, block);
      for (const Word &word : block.words) {
        if (word.address != letterAddress('M'))
          continue;
        const CodeIndex code = unit_.dialect->find('M', word.codeNumber());
        if (code == noCode)
          continue;
        const Action action = unit_.dialect->codes[code].action;
        ends |= action == Action::ProgramEnd || action == Action::ProgramEndRewind;
        returns |= action == Action::Return;
      }
    }
    const bool subprogram = returns && !ends;
    Lives lives(1);
    lives[0].state = subprogram ? unknownState(*unit_.dialect) : initialState(*unit_.dialect);
    collector_.setDefiniteOnly(subprogram);
    const Region region{unit_, program, program.body, subprogram ? Kind::Subprogram : Kind::Main,
                        subprogram ? 1u : 0u};
    execute(region, std::move(lives));
    collector_.setDefiniteOnly(false);
  }
}

/// Blocks that no path reaches are read all the same: what the control cannot read stops it when
/// the program is loaded. Only what the text alone decides is told to the rules.
void Engine::inspectUnreached() {
  constexpr uint32_t wanted = bitOf(EventKind::Syntax) | bitOf(EventKind::WordIssue);
  if (!(dispatcher_.kinds() & wanted) || stopped_)
    return;
  const Dialect &dialect = *unit_.dialect;
  const std::vector<SourceRange> reached = reachedRanges();
  const auto size = uint32_t(unit_.source.text().size());
  const MachineState unknown = unknownState(dialect);
  MachineState state;
  size_t range = 0;
  for (uint32_t at = unit_.reader->first(); at < size;) {
    while (range < reached.size() && reached[range].end <= at)
      ++range;
    if (range < reached.size() && reached[range].begin <= at) {
      at = reached[range].end;
      continue;
    }
    unit_.reader->read(at, block_);
    const ProgramInfo &program = unit_.index.programAt(at);
    // Behind the closing mark of the tape stands no program.
    const bool closes = block_.kind == BlockKind::Tape && at > program.begin;
    at = closes ? std::max(program.end, block_.next) : block_.next;
    if (block_.issues.empty() && !(block_.addresses & ~dialect.known) &&
        !(block_.repeated & ~dialect.repeatable))
      continue;
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
}

AnalysisResult Engine::run() {
  const llvm::ArrayRef<ProgramInfo> programs = unit_.index.programs();
  const ProgramInfo &main = programs.front();
  // A file whose only end is a return is a subprogram: its caller, and with it the state on entry,
  // is not known.
  const llvm::StringRef tail = unit_.source.text().take_back(4096);
  bool returns = false, ends = false;
  if (programs.size() == 1) {
    Block block;
    const uint32_t from =
        unit_.source.lines().lineBegin(uint32_t(unit_.source.text().size() - tail.size()));
    for (uint32_t at = std::max(from, main.body); at < main.end; at = block.next) {
      unit_.reader->read(at, block);
      for (const Word &word : block.words) {
        if (word.address != letterAddress('M'))
          continue;
        const CodeIndex code = unit_.dialect->find('M', word.codeNumber());
        if (code == noCode)
          continue;
        const Action action = unit_.dialect->codes[code].action;
        ends |= action == Action::ProgramEnd || action == Action::ProgramEndRewind;
        returns |= action == Action::Return;
      }
    }
  }
  Lives lives(1);
  const bool subprogram = returns && !ends;
  lives[0].state = subprogram ? unknownState(*unit_.dialect) : initialState(*unit_.dialect);
  collector_.setDefiniteOnly(subprogram);
  execute({unit_, main, main.body, Kind::Main, 0}, std::move(lives));
  collector_.setDefiniteOnly(false);
  runOtherPrograms();
  inspectUnreached();

  const std::vector<SourceRange> reached = reachedRanges();
  const std::vector<int64_t> numbers(usedNumbers_.begin(), usedNumbers_.end());
  const std::vector<int64_t> called(calledPrograms_.begin(), calledPrograms_.end());
  const FileSummary summary{unit_.index, unit_.source, *unit_.reader, reached,
                            numbers,     called,       complete_};
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
