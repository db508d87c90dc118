// What is said of blocks that no path reaches.
#include "analyzer/flow/unreached.h"

#include <algorithm>

namespace ncvet {

namespace {

constexpr uint32_t textEvents = bitOf(EventKind::Syntax) | bitOf(EventKind::WordIssue);

/// One look at the text that was not reached, from its begin to its end.
class UnreachedText {
public:
  UnreachedText(FlowRun &run, StraightRuns *runs)
      : run_(run), unit_(run.unit), runs_(runs), unknown_(unknownState(*run.unit.dialect)),
        reached_(run.covered.ranges(run.unit.source.id())), at_(begin(run.unit)) {}

  void inspect() {
    const auto size = uint32_t(unit_.source.text().size());
    while (at_ < size)
      if (!passReached() && !passKnown())
        inspectBlock();
    keep(size);
  }

private:
  /// What comes before the tape's first mark and a program is a leader, which the control skips. A
  /// file of data holds no program at all.
  static uint32_t begin(const FileUnit &unit) {
    const llvm::ArrayRef<uint32_t> marks = unit.index.tapeMarks();
    const uint32_t first = unit.index.programs().front().begin;
    if (first == unit.source.text().size())
      return first;
    const bool leader =
        unit.dialect->lexical.tapeLeader && !marks.empty() && marks.front() <= first;
    return leader ? marks.front() : unit.reader->first();
  }

  /// Ends the text of which nothing was to be said; what follows may begin another.
  void keep(uint32_t next) {
    if (runs_ && quiet_.blocks >= shortestRun)
      runs_->quiet.insert(quiet_);
    quiet_ = RunPlace();
    quiet_.begin = next;
  }

  bool passReached() {
    while (range_ < reached_.size() && reached_[range_].end <= at_)
      ++range_;
    if (range_ == reached_.size() || reached_[range_].begin > at_)
      return false;
    at_ = reached_[range_].end;
    keep(at_);
    return true;
  }

  bool passKnown() {
    if (!runs_)
      return false;
    const RunPlace *known = runs_->quiet.find(at_);
    if (const StraightRun *run = known ? nullptr : runs_->straight.find(at_); run && run->isClean)
      known = run; // once it was reached
    if (!known || (range_ < reached_.size() && known->end > reached_[range_].begin))
      return false;
    at_ = known->end;
    keep(at_);
    return true;
  }

  void inspectBlock() {
    unit_.reader->read(at_, block_);
    const ProgramInfo &program = unit_.index.programAt(at_);
    // After the closing mark of the tape there is no program.
    const bool closes = block_.kind == BlockKind::Tape && at_ > program.begin;
    at_ = closes ? std::max(program.end, block_.next) : block_.next;
    if (!isClean(block_, *unit_.dialect)) {
      keep(at_);
      return tell();
    }
    if (closes) // and what follows it is left out
      return keep(at_);
    quiet_.end = block_.next;
    if (++quiet_.blocks == longestRun)
      keep(at_);
  }

  void tell() {
    state_ = unknown_;
    unit_.executor().execute(block_, unknown_, state_, outcome_);
    llvm::erase_if(outcome_.events,
                   [](const Event &event) { return !(bitOf(event.kind) & textEvents); });
    outcome_.kinds &= textEvents;
    run_.visits.begin();
    run_.visits.visit(nullptr);
    run_.listeners.tell([&](FlowListener &listener) {
      listener.unreached(unit_, block_, outcome_, unknown_, state_);
    });
    run_.endStop();
  }

  FlowRun &run_;
  FileUnit &unit_;
  StraightRuns *runs_;
  const MachineState unknown_;
  MachineState state_;
  const std::vector<SourceRange> reached_;
  size_t range_ = 0; ///< of those, the first that may hold `at_`
  uint32_t at_;
  RunPlace quiet_;
  Block block_;
  Outcome outcome_;
};

} // namespace

void inspectUnreached(FlowRun &run, StraightRuns *runs) {
  if (run.listeners.wantAny(textEvents) && !run.stopped && run.unit.dialect->loadsWhole)
    UnreachedText(run, runs).inspect();
}

} // namespace ncvet
