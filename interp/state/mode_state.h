// Modal codes and switches: which of them may be in force.
#pragma once

#include "formats/dialect/dialect.h"
#include "interp/value/access_log.h"

#include <array>
#include <cstdint>

namespace ncvet {

/// Modal codes: of each group the members that may be active, and whether the program has stated
/// it. A look at one group is noted, one at all of them is not.
struct ModeState {
  /// The members of the group that may be active, as a bit set.
  uint64_t group(size_t index) const {
    touch(index);
    return groups[index];
  }
  void setGroup(size_t index, uint64_t members) {
    touch(index);
    groups[index] = members;
  }
  /// The program has made `members` the active ones.
  void state(size_t index, uint64_t members) {
    setGroup(index, members);
    statedMay |= uint64_t(1) << index;
    statedMust |= uint64_t(1) << index;
  }
  bool mayBeStated(size_t index) const {
    touch(index);
    return statedMay >> index & 1;
  }
  bool isStated(size_t index) const {
    touch(index);
    return statedMust >> index & 1;
  }

  std::array<uint64_t, maxGroups> groups;
  uint64_t statedMay = 0, statedMust = 0; ///< bit per group

private:
  static void touch(size_t index) { stateUse.groups |= uint64_t(1) << index; }
};

/// The switches of the dialect. A look at some of them is noted, one at the whole is not.
struct SwitchState {
  /// Those of `which` that may be on, and that are.
  uint32_t mayBeOn(uint32_t which) const {
    stateUse.others |= which;
    return may & which;
  }
  uint32_t areOn(uint32_t which) const {
    stateUse.others |= which;
    return must & which;
  }
  /// Axes for which a switch may be on.
  uint16_t axesOf(unsigned index) const {
    stateUse.others |= uint64_t(1) << index;
    return axes[index];
  }
  void put(unsigned index, bool mayBe, bool is, uint16_t forAxes) {
    const uint32_t bit = 1u << index;
    stateUse.others |= bit;
    may = mayBe ? may | bit : may & ~bit;
    must = is ? must | bit : must & ~bit;
    axes[index] = forAxes;
  }

  uint32_t may = 0, must = 0; ///< bit per switch
  std::array<uint16_t, maxSwitches> axes{};

  friend bool operator==(const SwitchState &, const SwitchState &) = default;
};

} // namespace ncvet
