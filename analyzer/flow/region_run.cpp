// Runs one region block by block.
#include "analyzer/flow/region_run.h"

#include "analyzer/flow/decided_conditions.h"
#include "analyzer/flow/flow_condition.h"
#include "formats/text/crash_guard.h"
#include "formats/text/system/system.h"
#include "interp/value/work_meter.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace ncvet {

namespace {

/// The system is asked for the memory that is held once in so many.
constexpr uint64_t memoryInterval = 1024;

bool asksOperator(const Outcome &outcome, const Dialect &dialect) {
  return llvm::any_of(outcome.codes, [&](const CodeUse &use) {
    const Action action = dialect.codes[use.code].action;
    return action == Action::ProgramStop || action == Action::OptionalStop;
  });
}

/// A file that only defines subprograms is no main program.
bool onlyDefines(const Block &block) {
  return !block.items.empty() && block.items[0].kind == ItemKind::Structure &&
         block.items[0].structure == Structure::Sub;
}

} // namespace

RegionRun::RegionRun(FlowRun &run, BlockFlow &flow, const Region &region, Lives entry,
                     KnownRuns known, const std::atomic<bool> *cancel)
    : run_(run), flow_(flow), region_(region), unit_(region.unit), cancel_(cancel),
      quick_(run.quickReader(unit_)), activation_(region), recorder_(known.recorder),
      replay_(known.replay), lives_(std::move(entry)), at_(region.start) {
  constexpr uint64_t spread = 0x9E3779B97F4A7C15;
  if (const CallSite *caller = region.caller)
    caller_ = (uint64_t(caller->depth) << 1 | uint64_t(caller->macro)) * spread;
}

RegionRun::~RegionRun() {
  if (known_ && !run_.callStack.empty())
    run_.readBlocks.giveBack(unit_, std::move(known_));
}

Exits RegionRun::execute() {
  const CrashPlace place(unit_.source, at_);
  while (!run_.stopped && arrive()) {
    if (isAtEnd() || goOnInStretch() || goOnAsKnown() || goOnAgain() || takeOver() ||
        passEmptyLines() || !read() || passOver() || !spend())
      continue;
    if (block_->skip >= 0)
      decideSkip();
    if (lives_.empty())
      continue;
    if (run_.listeners.watchArrivals())
      announce();
    if (!block_->items.empty() && decision_ == Truth::Unknown)
      forkAtGuards();
    executeBlock();
  }
  run_.cover(unit_, activation_.runBegin, activation_.runEnd);
  return std::move(activation_.exits);
}

/// Brings together the states that come to the next block; false: there are none left.
bool RegionRun::arrive() {
  Pending &pending = activation_.pending;
  if (lives_.empty()) {
    if (pending.isEmpty())
      return false;
    lives_ = pending.take(at_);
  } else if (pending.next() > at_) {
    return true;
  } else if (pending.next() == at_) {
    for (Live &live : pending.take(at_))
      mergeInto(lives_, std::move(live));
  } else {
    // A backward jump: those states go first, these wait.
    for (Live &live : lives_)
      pending.wait(at_, std::move(live));
    lives_ = pending.take(at_);
  }
  const bool goesOn = waits_ && lives_.size() == 1 && lives_[0].state.serial() == waits_;
  synced_ = goesOn ? &*lives_[0].state : nullptr;
  waits_ = 0;
  if (!goesOn || lives_[0].state->seeksBranch)
    modes_ = 0;
  return true;
}

bool RegionRun::isAtEnd() {
  if (at_ == region_.stopAt) { // a section ends here, however it was reached
    for (Live &live : lives_)
      activation_.exit(std::move(live));
  } else if (isSubprogram()) {
    runIntoSubprogram();
  } else if (at_ >= region_.program.end) {
    runOut();
  } else {
    return false;
  }
  lives_.clear();
  return true;
}

/// The end of the program is missing: what the subprogram does for its callers is known, and what
/// it does here follows from that mistake alone.
void RegionRun::runIntoSubprogram() {
  interruptRecord();
  Block block;
  unit_.index.read(at_, block);
  const SourceRange where{unit_.source.id(), block.begin, block.end};
  run_.visits.begin();
  for (Live &live : lives_) {
    run_.visits.visit(live.path);
    run_.issue(FlowIssue::RunsIntoSubprogram, stepOf(live), live.state, live.state, where);
  }
  run_.endStop();
}

/// The program has no block any more, and has not ended.
void RegionRun::runOut() {
  const SourceRange where = activation_.lastBlock();
  run_.visits.begin();
  for (Live &live : lives_) {
    run_.visits.visit(live.path);
    if (activation_.executedAny && !inForeignLanguage(*unit_.dialect, live.state))
      run_.issue(region_.kind == RegionKind::Main ? FlowIssue::MainRunsOut
                                                  : FlowIssue::SubprogramRunsOut,
                 stepOf(live), live.state, live.state, where);
    // Without a return the control goes on with whatever follows: nothing is known of it.
    if (region_.kind != RegionKind::Main)
      activation_.exit(std::move(live));
  }
  run_.endStop();
}

/// Reads the next block; false: the analysis was cancelled.
bool RegionRun::read() {
  if (readsBySpelling()) {
    readStraight();
  } else { // may be executed often
    kept_ = run_.readBlocks.find(unit_, at_);
    block_ = kept_ ? &kept_->block : &run_.readBlocks.at(unit_, at_, own_);
    pattern_ = kept_ ? nullptr : &own_;
    spelling_ = nullptr;
  }
  return noteRead();
}

/// Up to where no other state comes to a block, and nothing ends.
uint32_t RegionRun::straightLimit() const {
  uint32_t limit = std::min(region_.program.end, activation_.pending.next());
  for (const uint32_t mark : {region_.stopAt, region_.lastBlock})
    if (mark >= at_)
      limit = std::min(limit, mark);
  if (const auto &called = run_.used.localSubprograms; !called.empty())
    if (const auto next = called.lower_bound(at_); next != called.end())
      limit = std::min(limit, *next);
  return limit;
}

/// Goes over lines that are nothing but blanks and comments; false: there is none here.
bool RegionRun::passEmptyLines() {
  if (!quick_ || run_.inFull)
    return false;
  const uint32_t limit = straightLimit();
  const EmptyLines empty = limit > at_ ? quick_->emptyLines(at_, limit) : EmptyLines();
  if (!empty.count)
    return false;
  noteText(empty.end);
  at_ = empty.end;
  countSteps(empty.count);
  return true;
}

/// Further text is passed over, or executed, that does not follow what was before.
void RegionRun::beginText() {
  run_.cover(unit_, activation_.runBegin, activation_.runEnd);
  activation_.runBegin = at_;
}

/// False: the analysis has come to the end of its memory.
bool RegionRun::fitsIntoMemory() {
  if (!run_.limits.memory || system::memoryHeld() <= run_.limits.memory)
    return true;
  run_.stopped = true;
  run_.cut(blockRange(), "it took more memory than it may");
  return false;
}

/// What is looked at now and then, after `before` blocks were read when it was not time for it;
/// false: the analysis was cancelled.
bool RegionRun::mayRunOn(uint64_t before) {
  if (isCancelled()) {
    run_.stopped = true;
    run_.cut(blockRange(), "cancelled");
    return false;
  }
  if (before / memoryInterval != run_.steps / memoryInterval && !fitsIntoMemory())
    return false;
  if (&unit_ == &run_.unit)
    unit_.source.forget(at_ > (1u << 16) ? at_ - (1u << 16) : 0);
  return true;
}

/// Whether there is nothing to execute in the block.
bool RegionRun::passOver() {
  const bool isHead = block_->kind == BlockKind::Tape || block_->kind == BlockKind::ProgramHeader;
  if (block_->kind != BlockKind::Empty && !(isHead && block_->isEmpty() && block_->issues.empty()))
    return false;
  if (block_->kind != BlockKind::Empty || !block_->issues.empty())
    interruptRecord();
  // The closing mark of the tape: what follows it is no program.
  const bool closes = block_->kind == BlockKind::Tape && activation_.executedAny;
  pattern_ = nullptr; // an empty line that comes next is no move like the one before this block
  at_ = closes ? region_.program.end : block_->next;
  return true;
}

/// Counts the block, and what the one before it has cost besides; false: there has been too much.
bool RegionRun::spend() {
  const uint64_t besides = std::exchange(workDone, 0);
  const bool isFirst = firstTime_ && countsOnce();
  run_.blocks += isFirst;
  const uint64_t work = isFirst ? 0 : kept_ ? kept_->work : workOf(*block_);
  if (!isFirst && !spend(besides + work * lives_.size()))
    return false;
  if (isFirst && besides > usualWork && !spend(besides))
    return false;
  activation_.executedAny |= !onlyDefines(*block_);
  activation_.lastBegin = block_->begin;
  activation_.lastEnd = block_->end;
  next_ = block_->tapeInside ? region_.program.end : block_->next;
  return true;
}

/// Counts so much work, in plain moves.
bool RegionRun::spend(uint64_t work) {
  const uint64_t budget = run_.limits.repeatedBlocks;
  run_.repeated += work;
  if (!work || run_.repeated <= budget)
    return true;
  if (!run_.abstract)
    run_.cut(blockRange(), "loops and calls were too long to be run to the end");
  run_.abstract = true;
  if (run_.repeated > 2 * budget)
    run_.stopped = true;
  return !run_.stopped;
}

/// Block skip: the operator's switch decides, once for all blocks of a level.
void RegionRun::decideSkip() {
  // A level that no control has shares the last switch.
  constexpr size_t last = std::tuple_size_v<decltype(Live::skip)> - 1;
  const auto level = std::min(size_t(block_->skip <= 1 ? 0 : block_->skip), last);
  Lives executing;
  for (Live &live : lives_) {
    if (live.skip[level] != SkipSwitch::Off) {
      Live skipped = live;
      skipped.skip[level] = SkipSwitch::On;
      if (live.skip[level] == SkipSwitch::Unknown) {
        run_.fork(activation_, blockRange());
        skipped.path = run_.lengthen(live.path, PathNode::Kind::Skip, blockRange());
      }
      if (at_ == region_.lastBlock)
        activation_.exit(std::move(skipped));
      else
        activation_.add(next_, std::move(skipped));
    }
    if (live.skip[level] != SkipSwitch::On) {
      live.skip[level] = SkipSwitch::Off;
      executing.push_back(std::move(live));
    }
  }
  lives_ = std::move(executing);
  synced_ = nullptr;
}

/// Tells those who look at blocks before they are executed; they may change the state.
void RegionRun::announce() {
  for (Live &live : lives_)
    decision_ = run_.listeners.arrives({region_, *block_, live.state, run_.callStack.size()});
  synced_ = nullptr;
}

/// What the state leaves open goes as the operator has decided.
void RegionRun::decide() {
  Flow &flow = outcome_->flow;
  if (flow.kind == FlowKind::Branch) {
    if (decision_ == Truth::Yes)
      flow.kind = FlowKind::Jump;
    else
      flow = Flow();
  } else if (flow.condition == Truth::Unknown) {
    flow.condition = decision_;
  }
}

/// Conditions before statements: on a path where one is not known, both happen.
void RegionRun::forkAtGuards() {
  Lives executing;
  for (Live &live : lives_) {
    if (unit_.executor().guard(*block_, live.state) != Truth::Unknown) {
      executing.push_back(std::move(live));
      continue;
    }
    const ConditionKey key =
        conditionKey(*block_, Executor::guardOf(*block_)->condition, live.state);
    const Truth known = decided(live.decided, key);
    if (known == Truth::Unknown) {
      run_.fork(activation_, blockRange());
      Live other = live;
      other.path = run_.lengthen(live.path, PathNode::Kind::NoJump,
                                 {unit_.source.id(), block_->items[0].begin, block_->items[0].end});
      other.decided = run_.decide(live.decided, key, false);
      live.decided = run_.decide(live.decided, key, true);
      activation_.add(next_, std::move(other));
    }
    if (known == Truth::No)
      activation_.add(next_, std::move(live));
    else
      executing.push_back(std::move(live));
  }
  lives_ = std::move(executing);
}

/// Executes the block for each of the states, which then leave it.
void RegionRun::executeBlock() {
  run_.visits.begin();
  Lives onward;
  const bool single = lives_.size() == 1;
  bool stays = false;
  for (Live &live : lives_) {
    executeFor(live);
    tell(live);
    const uint64_t serial = calculated_ && single ? live.state.serial() : 0;
    if (!goesOnWithNext(live)) {
      waits_ = serial;
      continue;
    }
    if (!single) {
      onward.push_back(std::move(live));
      continue;
    }
    stays = true;
    if (done_ || calculated_ || !outcome_->setupChanged)
      synced_ = &*live.state;
  }
  run_.endStop();
  at_ = next_;
  if (stays) {
    if (recorder_)
      recorder_->executed(*block_, goesOn_);
    return;
  }
  interruptRecord();
  lives_ = std::move(onward);
  synced_ = nullptr;
}

void RegionRun::executeFor(Live &live) {
  if (synced_ == &*live.state) {
    keepBefore(live.state);
  } else {
    before_ = live.state;
    copied_ = false;
    plainRun_ = {};
    modes_ = 0;
  }
  synced_ = nullptr;
  if (spelling_ && doAsKnown(live))
    return;
  execute(live);
  if (kept_)
    return learnAgain(live);
  if (spelling_ && modes_)
    learn(live);
  else
    modes_ = 0;
}

/// Executes the block in full.
void RegionRun::execute(Live &live) {
  outcome_ = &ownOutcome_;
  done_ = nullptr;
  wrote_ = false;
  bool guardHolds = true;
  if (!block_->items.empty()) {
    const Truth guard = unit_.executor().guard(*block_, live.state);
    guardHolds = (guard == Truth::Unknown ? decision_ : guard) != Truth::No;
  }
  const StateUse used = std::exchange(stateUse, StateUse());
  unit_.executor().execute(*block_, before_, live.state, *outcome_, guardHolds);
  blockUse_ = stateUse;
  stateUse |= used;
  calculated_ = onlyCalculates();
  if (decision_ != Truth::Unknown)
    decide();
  if (!activation_.heads.empty() || !run_.callStack.empty())
    run_.stops += asksOperator(*outcome_, *unit_.dialect);
  // A cycle among the blocks of a contour reads none of its own.
  if (region_.kind == RegionKind::Profile && outcome_->flow.kind == FlowKind::Profile)
    outcome_->flow = Flow();
}

/// Whether what was executed has changed nothing but variables, and which branch of an IF is
/// looked for: statements alone, while no other part of the machine waits for the end of a block.
bool RegionRun::onlyCalculates() const {
  constexpr uint32_t events = bitOf(EventKind::Block) | bitOf(EventKind::Statement) |
                              bitOf(EventKind::Assignment) | bitOf(EventKind::UnsetRead) |
                              bitOf(EventKind::DomainError);
  const auto leads = [&](FlowKind kind) { return outcome_->flow.kind == kind; };
  return !block_->items.empty() && block_->words.empty() && !(outcome_->kinds & ~events) &&
         !outcome_->foreign && before_.compensation == phaseOff && before_.pendingCycle == noCode &&
         !before_.modalCalls && !run_.inFull &&
         (leads(FlowKind::Next) || leads(FlowKind::LoopBegin) || leads(FlowKind::LoopEnd) ||
          leads(FlowKind::Structure) || leads(FlowKind::Jump)) &&
         llvm::none_of(block_->items, // (`M2=3` starts a spindle)
                       [](const Item &item) { return item.kind == ItemKind::Output; });
}

void RegionRun::tell(Live &live) {
  run_.visits.visit(live.path);
  if (block_->number >= 0 && region_.kind == RegionKind::Main && &unit_ == &run_.unit)
    runsInto(live);
  const bool same = plainRun_.goesOn(*block_, *outcome_, before_);
  if (!same)
    endStretch();
  goesOn_ = same && (outcome_->codes.empty() || (plainRun_.settled && !run_.inFull));
  if (recorder_ && !goesOn_)
    recorder_->goesOnNoMore(before_);
  // Whether it is enough to tell some of it is asked of the first, second, fourth, … such block.
  if (same && !goesOn_ && std::has_single_bit(++repeats_))
    plainRun_.settled = run_.listeners.executedAgain(stepOf(live), run_.stopped);
  else
    run_.listeners.executed(stepOf(live), goesOn_, run_.stopped);
}

/// Plain flow comes to a numbered block: a profile along which a cycle before it has finished
/// already.
void RegionRun::runsInto(Live &live) {
  const auto finished = run_.used.finishedAhead.find(at_);
  if (finished == run_.used.finishedAhead.end())
    return;
  const Flow flow = std::exchange(outcome_->flow, finished->second.first);
  run_.issue(FlowIssue::ProfileReached, stepOf(live), finished->second.second,
             {unit_.source.id(), at_, at_ + 1});
  outcome_->flow = flow;
}

/// The state leaves the block as its flow says; true: it goes on with the next block, and stays
/// where it is.
bool RegionRun::goesOnWithNext(Live &live) {
  const Truth modal = outcome_->callsModally;
  Flow &flow = outcome_->flow;
  if (at_ == region_.lastBlock) {
    activation_.exit(std::move(live));
    return false;
  }
  if (region_.kind == RegionKind::Profile && flow.kind != FlowKind::Next &&
      flow.kind != FlowKind::End && flow.kind != FlowKind::Return)
    flow = Flow(); // a profile is contour data: nothing is called or jumped to from it
  if (flow.kind == FlowKind::Next && modal == Truth::No)
    return true;
  Step step = stepOf(live);
  if (flow.kind == FlowKind::Next) {
    flow_.callModally(step);
    return false;
  }
  if (modal != Truth::No) // before what the block itself calls
    forget(live.state, *unit_.dialect);
  goWhereItSays(step);
  return false;
}

/// A condition that the path has decided before is decided.
void RegionRun::goWhereItSays(Step &step) {
  Flow &flow = outcome_->flow;
  const bool isOpen = flow.condition == Truth::Unknown && step.live.decided;
  if (isOpen)
    flow.condition = decided(step.live.decided, conditionOf(step));
  flow_.leave(step);
  if (isOpen)
    outcome_->flow.condition = Truth::Unknown; // as a block that is known says it
}

} // namespace ncvet
