// Hands what happens in a run to those who listen.
#pragma once

#include "analyzer/flow/activation.h"
#include "analyzer/flow/flow_listener.h"

namespace ncvet {

/// The listeners of one run. Their interests are asked once, so that a block in which nobody has an
/// interest costs one test.
class Listeners {
public:
  void add(FlowListener &listener) {
    const FlowInterest interest = listener.interest();
    all_.push_back({&listener, interest});
    sum();
  }
  void removeLast() {
    all_.pop_back();
    sum();
  }

  /// Somebody follows one path alone.
  bool followOnePath() const { return all_.end() != onePath(); }
  bool want(EventKind kind) const { return kinds_ & bitOf(kind); }
  bool wantAny(uint32_t kinds) const { return kinds_ & kinds; }
  bool mustSee(FileId file, uint32_t begin, uint32_t end) const {
    return llvm::any_of(all_, [&](const Entry &entry) {
      return entry.interest.everyBlock && entry.listener->mustSee(file, begin, end);
    });
  }

  /// Somebody looks at blocks before they are executed.
  bool watchArrivals() const { return beforeBlocks_; }
  /// What the last of them decides.
  Truth arrives(const Arrival &arrival) const {
    Truth decision = Truth::Unknown;
    for (const Entry &entry : all_)
      if (entry.interest.beforeBlocks)
        decision = entry.listener->arrives(arrival);
    return decision;
  }

  /// `lost`: the one path was lost.
  void executed(const Step &step, bool continues, bool lost) const {
    if (!(continues ? everyMove_ : step.outcome.kinds & kinds_ || everyBlock_))
      return;
    for (const Entry &entry : all_)
      if (!lost || !entry.interest.onePath)
        entry.listener->executed(step, continues);
  }
  /// Whether they are all told in vain of further blocks of the stretch that only go on.
  bool sleepThrough(uint64_t stretch) const {
    return !everyMove_ || llvm::all_of(all_, [&](const Entry &entry) {
      return !(entry.interest.everyMove || entry.interest.everyBlock) ||
             entry.listener->sleepsThrough(stretch);
    });
  }
  /// Whether somebody is told of those that lead to where the tool is all the same.
  bool wantStill() const {
    return llvm::any_of(all_, [](const Entry &entry) { return entry.listener->wantsStill(); });
  }
  /// The same of a block that does what the one before did, see `FlowListener::executedAgain`.
  bool executedAgain(const Step &step, bool lost) const {
    if (!(step.outcome.kinds & kinds_ || everyBlock_))
      return true;
    bool settled = true;
    for (const Entry &entry : all_)
      if (!lost || !entry.interest.onePath)
        settled &= entry.listener->executedAgain(step);
    return settled;
  }
  /// As `FlowListener::executedRow`: where several listen all are told hole by hole.
  size_t executedRow(const Step &step, const HoleRow &row, size_t most) const {
    return all_.size() == 1 ? all_[0].listener->executedRow(step, row, most) : 0;
  }
  template <typename Tell>
  void tell(Tell &&tell) const {
    for (const Entry &entry : all_)
      tell(*entry.listener);
  }

private:
  struct Entry {
    FlowListener *listener;
    FlowInterest interest;
  };

  const Entry *onePath() const {
    return llvm::find_if(all_, [](const Entry &entry) { return entry.interest.onePath; });
  }
  void sum() {
    kinds_ = 0;
    everyMove_ = everyBlock_ = beforeBlocks_ = false;
    for (const Entry &entry : all_) {
      kinds_ |= entry.interest.kinds;
      everyBlock_ |= entry.interest.everyBlock;
      beforeBlocks_ |= entry.interest.beforeBlocks;
      everyMove_ |= entry.interest.everyMove || entry.interest.everyBlock;
    }
  }

  llvm::SmallVector<Entry, 2> all_;
  uint32_t kinds_ = 0;
  bool everyMove_ = false, everyBlock_ = false, beforeBlocks_ = false;
};

} // namespace ncvet
