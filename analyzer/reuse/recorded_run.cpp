// A run of plain blocks: where it begins again, what it leaves alone, and what an edit does to it.
#include "analyzer/reuse/recorded_run.h"

#include <bit>

namespace ncvet {

namespace {

template <typename Visit>
void forEachBit(uint64_t bits, const Visit &visit) {
  for (; bits; bits &= bits - 1)
    visit(size_t(std::countr_zero(bits)));
}

/// Makes those bits of `to` that `use` does not have what they are in `from`.
template <typename Bits>
void putUnused(Bits &to, Bits from, Bits use) {
  to = (to & use) | (from & ~use);
}

/// Calls `visit` with the place of every origin that is looked at or set.
template <typename Visit>
void forEachOrigin(const StateUse &use, const Visit &visit) {
  forEachBit(use.groupOrigins, visit);
  const uint64_t ages = use.ages ? use.ages | bitOf(StatePart::Tool) : 0;
  forEachBit(use.otherOrigins | ages, [&](size_t i) {
    if (i < OriginState::count - maxGroups)
      visit(maxGroups + i);
  });
}

std::vector<Origin> originsOf(const StateUse &use, const OriginState &state) {
  std::vector<Origin> origins;
  forEachOrigin(use, [&](size_t i) { origins.push_back(state.all()[i]); });
  return origins;
}

/// Gives `to` those parts of `from` that are neither looked at nor set.
void putUnused(KnownState &to, const KnownState &from, const StateUse &use) {
  const uint64_t groups = ~use.groups;
  forEachBit(groups, [&](size_t i) { to.groups[i] = from.groups[i]; });
  putUnused(to.statedMay, from.statedMay, use.groups);
  putUnused(to.statedMust, from.statedMust, use.groups);
  putUnused(to.factsMay, from.factsMay, use.facts);
  putUnused(to.factsMust, from.factsMust, use.facts);
  const auto switches = uint32_t(use.others);
  putUnused(to.switches.may, from.switches.may, switches);
  putUnused(to.switches.must, from.switches.must, switches);
  forEachBit(~switches, [&](size_t i) { to.switches.axes[i] = from.switches.axes[i]; });
  const auto part = [&](auto &target, const auto &source, StatePart which) {
    if (!use.has(which))
      target.peek() = source.peek();
  };
  part(to.tool, from.tool, StatePart::Tool);
  part(to.toolOffset, from.toolOffset, StatePart::ToolOffset);
  part(to.preselected, from.preselected, StatePart::Preselected);
  part(to.lengthOffset, from.lengthOffset, StatePart::LengthOffset);
  part(to.radiusOffset, from.radiusOffset, StatePart::RadiusOffset);
  part(to.spindle, from.spindle, StatePart::Spindle);
  part(to.liveTool, from.liveTool, StatePart::LiveTool);
  part(to.speed, from.speed, StatePart::Speed);
  part(to.speedLimit, from.speedLimit, StatePart::SpeedLimit);
  part(to.feed, from.feed, StatePart::Feed);
  if (!use.has(StatePart::Variables)) {
    to.locals = from.locals;
    to.commons = from.commons;
  }
}

bool isSettled(const PlainRun &plain, const KnownState &state) {
  return plain.may == state.factsMay && plain.must == state.factsMust;
}

} // namespace

/// Whether its moves leave the level from which the tool was fed down what it is.
bool StraightRun::sparesLevel(const KnownState &state) const {
  return !use.has(StatePart::FeedLevel) && depth.spare(state.fedFrom.peek()) &&
         depth.spare(entry.fedFrom.peek());
}

void StraightRun::finish(const StateUse &used, const OriginState &before, const MachineState &after,
                         const PlainRun &plainAfter) {
  use = used;
  exit = after;
  plainExit = plainAfter;
  entryOrigins_ = originsOf(use, before);
  exitOrigins_ = originsOf(use, after.origin);
}

bool StraightRun::begins(const MachineState &state, const PlainRun &plain,
                         const RuleMemory &now) const {
  return memory.isSame(now, use.aside) && leadsFrom(state, plain);
}

bool StraightRun::leadsFrom(const MachineState &state, const PlainRun &plain) const {
  if (plain.addresses != plainEntry.addresses || plain.machineAxes != plainEntry.machineAxes ||
      isSettled(plain, state) != isSettled(plainEntry, entry))
    return false;
  // Most states that meet differ in where they are.
  if (std::memcmp(state.position.data(), entry.position.data(), sizeof state.position) != 0)
    return false;
  KnownState here = state;
  putUnused(here, entry, use);
  if (sparesLevel(state))
    here.fedFrom = entry.fedFrom;
  if (!use.has(StatePart::CutArea))
    here.cutArea = entry.cutArea;
  return equal(here, entry) && originsOf(use, state.origin) == entryOrigins_;
}

void StraightRun::carry(MachineState &state, PlainRun &plain) const {
  const uint64_t may = plainExit.may ^ exit.factsMay, must = plainExit.must ^ exit.factsMust;
  const bool spared = sparesLevel(state);
  const KnownState before = std::move(state);
  static_cast<KnownState &>(state) = exit;
  putUnused(state, before, use);
  size_t next = 0;
  forEachOrigin(use, [&](size_t i) { state.origin.all()[i] = exitOrigins_[next++]; });
  state.fedFrom = before.fedFrom;
  state.fedFrom.add(depth);
  if (!spared)
    state.fedFrom.peek() = exit.fedFrom.peek();
  if (!use.has(StatePart::CutArea)) {
    state.cutArea = before.cutArea;
    state.cutArea.add(cut);
  }
  // What the last block changed it has changed here as well.
  plain = plainExit;
  plain.may = state.factsMay ^ may;
  plain.must = state.factsMust ^ must;
}

void StraightRun::join(const StraightRun &next, const MachineState &after,
                       const PlainRun &plainAfter) {
  extend(next);
  from = std::min(from, next.from);
  to = std::max(to, next.to);
  isClean &= next.isClean;
  // What only the next one looks at was set there before this one as well.
  OriginState before;
  size_t i = 0;
  forEachOrigin(next.use, [&](size_t at) { before.all()[at] = next.entryOrigins_[i++]; });
  i = 0;
  forEachOrigin(use, [&](size_t at) { before.all()[at] = entryOrigins_[i++]; });
  StateUse both = use;
  both |= next.use;
  for (size_t axis = 0; axis < cut.size(); ++axis)
    cut[axis] = ncvet::join(cut[axis], next.cut[axis]);
  depth.add(next.depth);
  gathered.insert(gathered.end(), next.gathered.begin(), next.gathered.end());
  finish(both, before, after, plainAfter);
}

void StraightRun::move(const TextChange &change, Moved &moved) {
  if (from >= change.end) {
    RunPlace::move(change);
    from = change.moved(from);
    to = change.moved(to);
  }
  for (std::vector<Origin> *origins : {&entryOrigins_, &exitOrigins_})
    for (Origin &origin : *origins) {
      if (!origin.known() || origin.file != memory.file())
        continue;
      origin.begin = change.moved(origin.begin);
      origin.end = change.moved(origin.end);
    }
  memory.move(change);
  for (const auto &[rule, what] : gathered)
    if (moved.insert(what.get()).second)
      what->move(change);
}

bool StraightRun::stemsFrom(const TextChange &change) const {
  return llvm::any_of(entryOrigins_, [&](const Origin &origin) {
    return origin.known() && origin.file == memory.file() &&
           !change.spares(origin.begin, origin.end);
  });
}

} // namespace ncvet
