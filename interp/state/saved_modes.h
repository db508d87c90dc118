// Modes that a program has kept, as a part of the machine's state.
#pragma once

#include "interp/state/mode_state.h"
#include "interp/value/value.h"

#include <memory>

namespace ncvet {

/// What a program has kept of its state, to bring it back.
struct KeptModes {
  ModeState modes;
  Interval feed, speed;
  uint64_t factsMay = 0, factsMust = 0; ///< of the feed and the speed
  SwitchState switches;
  uint8_t spindle = 0;
  Interval presetOn;               ///< 1 where a shift over all work offsets was in force
  Truth lengthOn = Truth::Unknown; ///< whether a length offset other than zero was

  friend bool operator==(const KeptModes &a, const KeptModes &b);
};

/// What is kept at a level of calls; states share it.
struct SavedModes {
  std::shared_ptr<const KeptModes> modes; ///< null: none
  bool known = true;                      ///< false: some, or none

  friend bool operator==(const SavedModes &a, const SavedModes &b) {
    return a.known == b.known &&
           (a.modes == b.modes || (a.modes && b.modes && *a.modes == *b.modes));
  }
};

SavedModes join(const SavedModes &a, const SavedModes &b);
uint64_t hash(const SavedModes &saved);

} // namespace ncvet
