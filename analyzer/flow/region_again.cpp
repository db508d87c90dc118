// Blocks of a region that are executed again, in loops and in programs that are called: what
// happens in them is known, but for their numbers. It is what the general way in region_run.cpp
// does.
#include "analyzer/flow/region_run.h"
#include "interp/evaluate/variable_access.h"
#include "interp/execute/macro_arguments.h"
#include "interp/execute/make_known_move.h"
#include "interp/state/modes_number.h"
#include "interp/value/sum.h"
#include "interp/value/work_meter.h"

namespace ncvet {

/// Such blocks one after the other, up to the first from which control goes elsewhere. False: there
/// is none, at least not here.
bool RegionRun::goOnAgain() {
  bool any = false;
  Again next = Again::GoesOn;
  while (next == Again::GoesOn && !run_.stopped && mayGoOnAgain()) {
    KeptBlock *const kept = run_.readBlocks.find(unit_, at_);
    if (!kept)
      break;
    next = !kept->calculations.empty() ? calculateAgain(*kept)
           : !kept->moves.empty()      ? moveAgain(*kept)
           : !kept->flows.empty()      ? flowAgain(*kept)
                                       : Again::NotKnown;
    any |= next != Again::NotKnown;
  }
  return any;
}

/// Whether one state comes to a block that may have been executed before.
bool RegionRun::mayGoOnAgain() const {
  return !run_.inFull && lives_.size() == 1 && !isStraight() && activation_.pending.next() > at_ &&
         at_ != region_.stopAt && at_ != region_.lastBlock && at_ < region_.program.end &&
         !isSubprogram() && region_.kind != RegionKind::Profile &&
         !run_.listeners.watchArrivals() && !lives_[0].state->seeksBranch;
}

/// A number for the modes and for the calls that lead here. Brings `before_` in step.
uint64_t RegionRun::situation(const MachineState &state) {
  if (synced_ != &state) {
    before_ = state;
    synced_ = &state;
    plainRun_ = {};
    modes_ = 0;
    copied_ = true;
  }
  if (!modes_)
    modes_ = modesNumber(*unit_.dialect, state);
  return situationIn(modes_);
}

uint64_t RegionRun::situationIn(uint64_t modes) {
  if (!callers_) {
    Sum sum(1);
    for (const CallSite *call = region_.caller; call; call = call->before) {
      sum.add(reinterpret_cast<uintptr_t>(call->program));
      sum.add(uint64_t(call->next) << 2 | uint64_t(call->once) << 1 | uint64_t(call->macro));
    }
    callers_ = sum.get();
  }
  Sum sum(callers_);
  sum.add(modes);
  return sum.get();
}

/// The block is executed next; false: there has been too much.
bool RegionRun::begin(KeptBlock &kept) {
  interruptRecord();
  kept_ = &kept;
  block_ = &kept.block;
  pattern_ = nullptr;
  spelling_ = nullptr;
  if (!noteRead() || !spend())
    return false;
  run_.visits.begin();
  keepBefore(lives_[0].state);
  return true;
}

RegionRun::Again RegionRun::calculateAgain(KeptBlock &kept) {
  const MachineState &state = lives_[0].state;
  const auto gives = ncvet::calculate(kept.block, *kept.calculation, state);
  if (!gives)
    return Again::NotKnown;
  const uint64_t here = situation(state);
  const auto *const known = llvm::find_if(kept.calculations, [&](const KnownCalculation &one) {
    return one.situation == here && one.condition == gives->condition;
  });
  if (known == kept.calculations.end())
    return Again::NotKnown;
  const bool goesOn = known->goesOn;
  if (!begin(kept))
    return Again::Leaves;
  calculate(*known, *gives);
  return goesOn && !(loopBegins() && activation_.pending.hasRounds()) ? stay() : leave();
}

/// As `executeBlock`, up to where control goes.
void RegionRun::calculate(const KnownCalculation &known, const Calculated &gives) {
  Live &live = lives_[0];
  done_ = nullptr;
  calculated_ = true;
  outcome_ = known.outcome.get();
  noteUse(known.use);
  written_ = gives.writes ? kept_->calculation->target : 0;
  if (written_) {
    value_ = gives.written();
    writeVariable(live.state, int64_t(written_), value_);
  }
  // A bracket of structured flow may count in a variable of its own.
  wrote_ = outcome_->flow.kind != FlowKind::Structure;
  tell(live);
}

RegionRun::Again RegionRun::moveAgain(KeptBlock &kept) {
  Live &live = lives_[0];
  const uint64_t here = situation(live.state);
  const auto *const found =
      llvm::find_if(kept.moves, [&](const std::unique_ptr<KnownBlocks::Known> &one) {
        return one->before == here;
      });
  if (found == kept.moves.end() || !(*found)->move.compute(kept.block, live.state, numbers_))
    return Again::NotKnown;
  KnownBlocks::Known &known = **found;
  if (!begin(kept))
    return Again::Leaves;
  make(known, live);
  tell(live);
  return stay();
}

RegionRun::Again RegionRun::flowAgain(KeptBlock &kept) {
  Live &live = lives_[0];
  const uint64_t here = situation(live.state);
  const auto *const known =
      llvm::find_if(kept.flows, [&](const KnownFlow &one) { return one.situation == here; });
  if (known == kept.flows.end() || !computeArguments(kept.block, live.state, *known->outcome))
    return Again::NotKnown;
  if (!begin(kept))
    return Again::Leaves;
  done_ = nullptr;
  calculated_ = false;
  outcome_ = known->outcome.get();
  noteUse(known->use);
  tell(live);
  return leave();
}

/// The state goes on with the next block.
RegionRun::Again RegionRun::stay() {
  run_.endStop();
  at_ = next_;
  if (loopBegins()) {
    ++workDone; // in the general way it waits there
    interruptRecord();
  } else if (recorder_) {
    recorder_->executed(*block_, goesOn_);
  }
  return Again::GoesOn;
}

/// The state goes on as the flow says.
RegionRun::Again RegionRun::leave() {
  Live &live = lives_[0];
  const uint64_t serial = calculated_ ? live.state.serial() : 0;
  goesOnWithNext(live);
  waits_ = serial;
  run_.endStop();
  at_ = next_;
  interruptRecord();
  lives_.clear();
  synced_ = nullptr;
  return Again::Leaves;
}

/// The block, which is kept, was executed in full: notes what it does.
void RegionRun::learnAgain(Live &live) {
  modes_ = 0;
  const bool calculates = kept_->calculation && calculated_;
  if (run_.inFull || lives_.size() != 1 || before_.seeksBranch ||
      (!calculates && !kept_->block.items.empty() && !isBracketFlow(kept_->block)) ||
      !run_.readBlocks.mayLearn(*kept_))
    return;
  const uint64_t modes = modesNumber(*unit_.dialect, before_);
  const uint64_t after = modesNumber(*unit_.dialect, live.state);
  const uint64_t here = situationIn(modes);
  if (calculates && modes == after)
    learnCalculation(live.state, here);
  else if (outcome_->flow.kind == FlowKind::Next)
    learnMove(live, here);
  else if (modes == after)
    learnFlow(live.state, here);
  modes_ = after;
}

namespace {
bool isSame(const MachineState &a, const MachineState &b) {
  return equal(a, b) && a.origin.all() == b.origin.all();
}
} // namespace

void RegionRun::learnCalculation(const MachineState &after, uint64_t situation) {
  const auto gives = ncvet::calculate(*block_, *kept_->calculation, before_);
  if (!gives)
    return;
  MachineState made = before_;
  if (gives->writes)
    writeVariable(made, int64_t(kept_->calculation->target), gives->written());
  if (!isSame(made, after))
    return;
  const Flow &flow = outcome_->flow;
  const bool goesOn =
      flow.kind == FlowKind::Next || (loopBegins() && flow.condition == Truth::Yes &&
                                      !run_.shape(unit_, region_.program).isMismatched(at_));
  kept_->calculations.push_back(
      {situation, gives->condition, goesOn, std::make_unique<Outcome>(*outcome_), blockUse_});
  kept_->calculations.back().outcome->known = ++run_.knownBlocks;
}

void RegionRun::learnMove(Live &live, uint64_t situation) {
  if (!masks_)
    masks_.emplace(*unit_.dialect, unit_.machine);
  auto move = makeKnownMove(*unit_.dialect, unit_.machine, *masks_, unit_.source.id(), *block_,
                            before_, live.state, *outcome_, blockUse_);
  if (!move)
    return;
  auto known = std::make_unique<KnownBlocks::Known>();
  known->before = situation;
  known->move = std::move(*move);
  known->outcome = *outcome_;
  known->use = blockUse_;
  leaveModes(*known, live.state);
  kept_->moves.push_back(std::move(known));
}

void RegionRun::learnFlow(const MachineState &after, uint64_t situation) {
  if (!isKnownFlow(*unit_.dialect, *block_, *outcome_) || !isSame(before_, after))
    return;
  kept_->flows.push_back({situation, std::make_unique<Outcome>(*outcome_), blockUse_});
  kept_->flows.back().outcome->known = ++run_.knownBlocks;
}

} // namespace ncvet
