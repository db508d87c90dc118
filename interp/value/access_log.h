// What of a machine's state is looked at, and what is set, while blocks are executed: what a
// stretch of them depends on, and what it leaves alone.
#pragma once

#include "formats/dialect/dialect.h"

#include <cstdint>

namespace ncvet {

/// A part of the state that most blocks do not look at.
enum class StatePart : uint8_t {
  Tool,
  ToolOffset,
  Preselected,
  LengthOffset,
  RadiusOffset,
  Spindle,
  LiveTool,
  Speed,
  SpeedLimit,
  Feed,
  CutArea,
  FeedLevel,
  Variables,
  // Of these only where they were set.
  Cycle,
  Compensation,
  PendingCycle,
  Preset,
  Roughing,
  Count
};
static_assert(maxSwitches + unsigned(StatePart::Count) <= 64);

constexpr uint64_t bitOf(StatePart part) { return uint64_t(1) << (maxSwitches + unsigned(part)); }

/// What of the state has been looked at or set.
struct StateUse {
  uint64_t groups = 0; ///< modal groups
  uint64_t facts = 0;
  uint64_t others = 0;                         ///< switches, and above them the parts
  uint64_t groupOrigins = 0, otherOrigins = 0; ///< where they were set
  uint64_t ages = 0;  ///< parts of which it was asked whether they are older than the tool
  bool aside = false; ///< what rules keep aside, see `RuleMemory::aside`

  void everything() {
    groups = facts = others = groupOrigins = otherOrigins = ages = ~uint64_t(0);
    aside = true;
  }
  bool has(StatePart part) const { return others & bitOf(part); }
  StateUse &operator|=(const StateUse &other) {
    groups |= other.groups;
    facts |= other.facts;
    others |= other.others;
    groupOrigins |= other.groupOrigins;
    otherOrigins |= other.otherOrigins;
    ages |= other.ages;
    aside |= other.aside;
    return *this;
  }
};

/// Of the states that this thread works with, since it was last cleared.
inline constinit thread_local StateUse stateUse;

/// A part of the state that notes when it is looked at or set.
template <typename T, StatePart part>
class Noted {
public:
  Noted() = default;
  Noted(const T &value) : value_(value) {}
  Noted &operator=(const T &value) {
    stateUse.others |= bitOf(part);
    value_ = value;
    return *this;
  }
  const T &get() const {
    stateUse.others |= bitOf(part);
    return value_;
  }
  operator const T &() const { return get(); }
  const T *operator->() const { return &get(); }
  /// Without notice: for what compares and copies whole states.
  const T &peek() const { return value_; }
  T &peek() { return value_; }

private:
  T value_{};
};

} // namespace ncvet
