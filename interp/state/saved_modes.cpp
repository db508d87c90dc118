// Compares, joins and hashes the modes that programs have kept.
#include "interp/state/saved_modes.h"

#include "llvm/ADT/Hashing.h"
#include "llvm/ADT/bit.h"

namespace ncvet {

bool operator==(const KeptModes &a, const KeptModes &b) {
  return a.modes.groups == b.modes.groups && a.modes.statedMay == b.modes.statedMay &&
         a.modes.statedMust == b.modes.statedMust && a.feed == b.feed && a.speed == b.speed &&
         a.factsMay == b.factsMay && a.factsMust == b.factsMust && a.switches == b.switches &&
         a.spindle == b.spindle && a.presetOn == b.presetOn && a.lengthOn == b.lengthOn;
}

SavedModes join(const SavedModes &a, const SavedModes &b) {
  if (a == b)
    return a;
  return {nullptr, false};
}

uint64_t hash(const SavedModes &saved) {
  if (!saved.modes)
    return saved.known;
  const KeptModes &kept = *saved.modes;
  return llvm::hash_combine(
      llvm::hash_combine_range(kept.modes.groups.begin(), kept.modes.groups.end()),
      kept.modes.statedMay, kept.modes.statedMust, llvm::bit_cast<uint64_t>(kept.feed.lo),
      llvm::bit_cast<uint64_t>(kept.feed.hi), llvm::bit_cast<uint64_t>(kept.speed.lo),
      llvm::bit_cast<uint64_t>(kept.speed.hi), kept.factsMay, kept.factsMust, kept.switches.may,
      kept.switches.must, kept.spindle, unsigned(kept.lengthOn),
      llvm::bit_cast<uint64_t>(kept.presetOn.lo), llvm::bit_cast<uint64_t>(kept.presetOn.hi));
}

} // namespace ncvet
