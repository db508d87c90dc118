// Blocks of a region that only calculate and are executed again, in loops and in programs that are
// called: what happens in them is known, but for their numbers. It is what the general way in
// region_run.cpp does.
#include "analyzer/flow/region_run.h"
#include "interp/evaluate/expression.h"
#include "interp/state/modes_number.h"
#include "interp/value/sum.h"
#include "interp/value/work_meter.h"

namespace ncvet {

/// Such blocks one after the other, up to the first from which control goes elsewhere. False: there
/// is none, at least not here.
bool RegionRun::goOnCalculating() {
  bool any = false, stays = true;
  while (stays && !run_.stopped && mayCalculate()) {
    Calculated gives;
    const KnownCalculation *const known = calculationHere(gives);
    if (!known)
      break;
    any = true;
    interruptRecord();
    block_ = &kept_->block;
    pattern_ = nullptr;
    spelling_ = nullptr;
    if (!noteRead() || !spend())
      break;
    calculate(*known, gives);
    stays = known->goesOn && !(loopBegins() && activation_.pending.hasRounds());
    stays ? staysCalculated() : leaveCalculated();
  }
  return any;
}

/// Whether one state comes to a block that was executed before.
bool RegionRun::mayCalculate() const {
  return !run_.inFull && lives_.size() == 1 && !isStraight() && activation_.pending.next() > at_ &&
         at_ != region_.stopAt && at_ != region_.lastBlock && at_ < region_.program.end &&
         region_.kind != RegionKind::Profile && !run_.listeners.watchArrivals() &&
         !lives_[0].state->seeksBranch;
}

/// What the block at `at_` does, with the numbers of this state; null: that is not known.
const KnownCalculation *RegionRun::calculationHere(Calculated &gives) {
  KeptBlock *const kept = run_.readBlocks.find(unit_, at_);
  if (!kept || kept->known.empty())
    return nullptr;
  const MachineState &state = lives_[0].state;
  const auto numbers = ncvet::calculate(kept->block, *kept->calculation, state);
  if (!numbers)
    return nullptr;
  if (synced_ != &state) {
    before_ = state;
    synced_ = &state;
    plainRun_ = {};
    modes_ = 0;
    done_ = nullptr;
    calculated_ = false;
  }
  if (!modes_)
    modes_ = modesNumber(*unit_.dialect, state);
  const uint64_t here = situation();
  for (const KnownCalculation &known : kept->known)
    if (known.situation == here && known.condition == numbers->condition) {
      kept_ = kept;
      gives = *numbers;
      return &known;
    }
  return nullptr;
}

/// A number for the modes and for the calls that lead here.
uint64_t RegionRun::situation() {
  if (!callers_) {
    Sum sum(1);
    for (const CallSite *call = region_.caller; call; call = call->before) {
      sum.add(reinterpret_cast<uintptr_t>(call->program));
      sum.add(uint64_t(call->next) << 2 | uint64_t(call->once) << 1 | uint64_t(call->macro));
    }
    callers_ = sum.get();
  }
  Sum sum(callers_);
  sum.add(modes_);
  return sum.get();
}

/// As `executeBlock`, up to where control goes.
void RegionRun::calculate(const KnownCalculation &known, const Calculated &gives) {
  Live &live = lives_[0];
  run_.visits.begin();
  keepBefore(live.state);
  done_ = nullptr;
  calculated_ = true;
  outcome_ = known.outcome.get();
  blockUse_ = known.use;
  stateUse |= blockUse_;
  written_ = gives.writes ? kept_->calculation->target : 0;
  if (written_) {
    value_ = gives.written();
    writeVariable(live.state, int64_t(written_), value_);
  }
  // A bracket of structured flow may count in a variable of its own.
  wrote_ = outcome_->flow.kind != FlowKind::Structure;
  tell(live);
}

/// The state goes on with the next block.
void RegionRun::staysCalculated() {
  run_.endStop();
  at_ = next_;
  if (loopBegins()) {
    ++workDone; // in the general way it waits there
    interruptRecord();
  } else if (recorder_) {
    recorder_->executed(*block_, goesOn_);
  }
}

/// The state goes on as the flow says.
void RegionRun::leaveCalculated() {
  Live &live = lives_[0];
  const uint64_t serial = live.state.serial();
  goesOnWithNext(live);
  waits_ = serial;
  run_.endStop();
  at_ = next_;
  interruptRecord();
  lives_.clear();
  synced_ = nullptr;
}

/// The block was executed in full and has only calculated: notes what it does.
void RegionRun::learnCalculation(const MachineState &after) {
  modes_ = 0;
  if (lives_.size() != 1 || before_.seeksBranch || !run_.readBlocks.mayLearn(*kept_))
    return;
  const auto gives = ncvet::calculate(*block_, *kept_->calculation, before_);
  const uint64_t modes = modesNumber(*unit_.dialect, before_);
  if (!gives || modes != modesNumber(*unit_.dialect, after))
    return;
  MachineState made = before_;
  if (gives->writes)
    writeVariable(made, int64_t(kept_->calculation->target), gives->written());
  if (!equal(made, after) || made.origin.all() != after.origin.all())
    return;
  modes_ = modes;
  KnownCalculation &known = kept_->known.emplace_back();
  known.situation = situation();
  known.condition = gives->condition;
  known.goesOn = outcome_->flow.kind == FlowKind::Next ||
                 (loopBegins() && outcome_->flow.condition == Truth::Yes &&
                  !run_.shape(unit_, region_.program).isMismatched(at_));
  known.outcome = std::make_unique<Outcome>(*outcome_);
  known.outcome->known = ++run_.knownBlocks;
  known.use = blockUse_;
}

} // namespace ncvet
