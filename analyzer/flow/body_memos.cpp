// What called bodies have done, by the states in which they began.
#include "analyzer/flow/body_memos.h"

#include "interp/state/equal_but_cut.h"

namespace ncvet {

namespace {

/// Memos that are kept from one run to the next: each has some kilobytes.
constexpr size_t mostKept = 8192;

/// Where things were set that the body neither looks at nor sets is where that was on the way here.
void keepOrigins(const StateUse &use, const MachineState &here, MachineState &left) {
  const OriginState::Places &before = here.origin.all();
  OriginState::Places &after = left.origin.all();
  for (size_t i = 0; i < after.size(); ++i) {
    const bool isGroup = i < maxGroups;
    const uint64_t used = isGroup ? use.groupOrigins : use.otherOrigins;
    if (!(used >> (isGroup ? i : i - maxGroups) & 1))
      after[i] = before[i];
  }
}

} // namespace

/// Where the tool has cut before, only some look at.
bool BodyMemos::Memo::holdsFor(uint64_t sum, const MachineState &state) const {
  return hash == sum && equalButCut(entry, state) &&
         (!effect.use.has(StatePart::CutArea) || entry.cutArea.all() == state.cutArea.all());
}

void BodyMemos::Memo::leadOn(const MachineState &state, size_t exit, MachineState &left) const {
  keepOrigins(effect.use, state, left);
  if (!effect.use.has(StatePart::CutArea)) {
    left.cutArea = state.cutArea;
    left.cutArea.add(effect.added[exit].cut);
  }
  const Interval level = left.fedFrom.peek();
  left.fedFrom = state.fedFrom;
  left.fedFrom.add(effect.added[exit].depth);
  left.fedFrom.peek() = level;
}

/// In the place of one of the same state that was made less deep.
void BodyMemos::Remembered::add(Memo memo) {
  for (Memo &known : memos)
    if (known.depth < memo.depth && known.holdsFor(memo.hash, memo.entry)) {
      known = std::move(memo);
      return;
    }
  if (hasRoom())
    memos.push_back(std::move(memo));
}

void BodyMemos::begin(const std::shared_ptr<const Dialect> &dialect) {
  size_t kept = 0;
  for (const auto &[region, body] : bodies_)
    kept += body.memos.size();
  if (kept > mostKept || dialect_ != dialect)
    bodies_.clear();
  dialect_ = dialect;
  ++run_;
}

} // namespace ncvet
