// One run of a region, and one block of it that was executed for one state.
#pragma once

#include "analyzer/flow/pending.h"
#include "analyzer/rule/text_ahead.h"
#include "interp/state/executed_block.h"

namespace ncvet {

/// What is remembered of a target of backward jumps.
struct LoopHead {
  unsigned visits = 0;
  bool abstract = false; ///< its states are joined: no longer run pass by pass
  bool hasSeen = false;
  MachineState seen;
  uint64_t snapshot = 0; ///< hash of the state at an earlier visit
  unsigned nextSnapshot = 16;
  unsigned snapshotForks = 0; ///< forks of the activation at the time of the snapshot
  unsigned snapshotStops = 0; ///< and how often the operator had been asked to go on by then
  unsigned windowEnd = 0;     ///< visits up to this one are compared with the snapshot
  unsigned lastForks = 0;     ///< forks of the activation at the last visit
  unsigned forkedVisits = 0;  ///< visits after a pass in which something unknown decided
  uint64_t firstStep = 0;     ///< blocks executed in the analysis at the first visit
  uint64_t variables = 0;     ///< hash of the variables at the snapshot
  unsigned joinedForks = 0;   ///< forks of the run when its states were first joined
  unsigned joinedStops = 0;   ///< and how often the operator had been asked to go on by then
  bool isAsked = false;       ///< whether it ends at all is being found out
  uint64_t askedAt = 0;       ///< blocks executed in the analysis when that began
};

/// A region while it runs.
struct Activation {
  explicit Activation(const Region &of) : region(of), runBegin(of.start), runEnd(of.start) {}

  const Region &region;
  Pending pending;
  std::map<uint32_t, LoopHead> heads;
  Exits exits;
  uint32_t runBegin, runEnd; ///< blocks executed in a row
  uint32_t high = 0;         ///< after the last block executed for the first time
  uint32_t lastBegin = 0, lastEnd = 0;
  bool executedAny = false;
  unsigned forks = 0;     ///< times that the path went on in more than one direction
  uint32_t lastNoted = 0; ///< the labels of jumps before this block are noted

  /// The state goes on at `offset`.
  void add(uint32_t offset, Live live) { pending.add(offset, std::move(live), high); }
  /// The state leaves the region.
  void exit(Live live, int64_t target = notSet) { exits.push_back({std::move(live), target}); }
  SourceRange lastBlock() const { return {region.unit.source.id(), lastBegin, lastEnd}; }
};

/// A block that was executed for one state, from which flow goes on. Whoever lets the state go on
/// moves it out of `live`.
struct Step {
  Activation &activation;
  Live &live;
  uint32_t at; ///< offset of the block
  const MachineState &before;
  const Block &block;
  Outcome &outcome;
  /// Blocks of the same number only go on, each as the one before.
  uint64_t stretch;
  TextAhead *ahead = nullptr; ///< null: the text is not read in its order
  uint64_t place = 0;         ///< of a block that is executed again: a number for file and offset

  const Region &region() const { return activation.region; }
  FileUnit &unit() const { return activation.region.unit; }
  ExecutedBlock executed() const {
    return {*unit().dialect, unit().machine, block, outcome, before, live.state};
  }
  SourceRange blockRange() const { return {unit().source.id(), block.begin, block.end}; }
  SourceRange flowRange() const {
    return {unit().source.id(), outcome.flow.begin, outcome.flow.end};
  }
  /// The state goes on with the next block.
  void goOn() { activation.add(block.next, std::move(live)); }
};

} // namespace ncvet
