// The machine's state at one point of a program, as far as it is known.
#include "interp/state/state.h"

#include "formats/dialect/control_facts.h"
#include "interp/state/equal_but_cut.h"

#include "llvm/ADT/Hashing.h"
#include "llvm/ADT/bit.h"
#include "llvm/Support/xxhash.h"

#include <bit>

namespace ncvet {

namespace {

constexpr uint8_t phaseAny = phaseOff | phaseStarting | phaseOn | phaseEnding;

Interval combine(const Interval &a, const Interval &b, bool wide) {
  return wide ? widen(a, b) : join(a, b);
}

int32_t combine(int32_t a, int32_t b) { return a == b ? a : notKnown; }

uint64_t knownMembers(const Dialect &dialect, GroupIndex index) {
  const size_t count = dialect.groups[index].members.size();
  return count >= 63 ? ~groupUnset : (uint64_t(1) << count) - 1;
}

Origin either(const Origin &a, const Origin &b) { return a.known() ? a : b; }

/// What the cycle in force keeps, and the one that waits for its second block.
void mergeCycle(MachineState &r, const MachineState &a, const MachineState &b, bool wide) {
  for (size_t i = 0; i < 3; ++i)
    r.cycleStart[i] = combine(a.cycleStart[i], b.cycleStart[i], wide);
  r.cycle.present = a.cycle.present | b.cycle.present;
  for (size_t i = 0; i < 26; ++i) {
    const bool both = (a.cycle.present & b.cycle.present) >> i & 1;
    if (!both || a.cycle.value[i] != b.cycle.value[i])
      r.cycle.value[i] = r.cycle.present >> i & 1 ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  }
  r.initialLevel = combine(a.initialLevel, b.initialLevel, wide);
  if (a.pendingCycle != b.pendingCycle)
    r.pendingCycle = noCode;
}

MachineState merge(const MachineState &a, const MachineState &b, bool wide) {
  MachineState r = a;
  for (size_t i = 0; i < maxGroups; ++i)
    r.groups[i] = a.groups[i] | b.groups[i];
  for (size_t i = 0; i < axisCount; ++i) {
    // A place in machine coordinates and one in work coordinates have nothing in common.
    const bool sameFrame = !((a.machineAxes ^ b.machineAxes) >> i & 1);
    r.position[i] = sameFrame ? combine(a.position[i], b.position[i], wide) : Interval::unknown();
  }
  r.machineAxes = a.machineAxes & b.machineAxes;
  r.statedMay = a.statedMay | b.statedMay;
  r.statedMust = a.statedMust & b.statedMust;
  r.factsMay = a.factsMay | b.factsMay;
  r.factsMust = a.factsMust & b.factsMust;
  r.feed.peek() = combine(a.feed.peek(), b.feed.peek(), wide);
  r.fedFrom.peek() = combine(a.fedFrom.peek(), b.fedFrom.peek(), wide);
  const CutArea::Box cutA = a.cutArea.all(), cutB = b.cutArea.all();
  r.cutArea.set({combine(cutA[0], cutB[0], wide), combine(cutA[1], cutB[1], wide)});
  r.tool.peek() = combine(a.tool.peek(), b.tool.peek());
  r.toolOffset.peek() = combine(a.toolOffset.peek(), b.toolOffset.peek());
  r.preselected.peek() = combine(a.preselected.peek(), b.preselected.peek());
  r.lengthOffset.peek() = combine(a.lengthOffset.peek(), b.lengthOffset.peek());
  r.radiusOffset.peek() = combine(a.radiusOffset.peek(), b.radiusOffset.peek());
  r.spindle.peek() = a.spindle.peek() | b.spindle.peek();
  r.liveTool.peek() = a.liveTool.peek() | b.liveTool.peek();
  r.compensation = a.compensation | b.compensation;
  r.idleBlocks = std::min(a.idleBlocks, b.idleBlocks);
  r.speed.peek() = combine(a.speed.peek(), b.speed.peek(), wide);
  r.speedLimit.peek() = combine(a.speedLimit.peek(), b.speedLimit.peek(), wide);
  r.switches.may = a.switches.may | b.switches.may;
  r.switches.must = a.switches.must & b.switches.must;
  for (size_t i = 0; i < maxSwitches; ++i)
    r.switches.axes[i] = a.switches.axes[i] | b.switches.axes[i];
  mergeCycle(r, a, b, wide);
  for (size_t i = 0; i < 2; ++i)
    r.roughStart[i] = combine(a.roughStart[i], b.roughStart[i], wide);
  if (a.roughFirst != b.roughFirst || a.roughLast != b.roughLast)
    r.roughFirst = r.roughLast = notKnown;
  if (a.transforms != b.transforms)
    r.transforms = {};
  r.frames = FrameStack::join(a.frames, b.frames);
  for (size_t i = 0; i < 2; ++i)
    r.pole[i] = combine(a.pole[i], b.pole[i], wide);
  for (size_t i = 0; i < 2; ++i)
    r.polar[i] = combine(a.polar[i], b.polar[i], wide);
  r.modalCalls = join(a.modalCalls, b.modalCalls);
  r.saved = join(a.saved, b.saved);
  r.seeksBranch = a.seeksBranch || b.seeksBranch;
  r.restoresModes = a.restoresModes || b.restoresModes;
  r.profile = std::max(a.profile, b.profile);
  r.locals = wide ? Variables::widen(a.locals, b.locals) : Variables::join(a.locals, b.locals);
  r.commons = wide ? Variables::widen(a.commons, b.commons) : Variables::join(a.commons, b.commons);
  for (size_t i = 0; i < r.origin.all().size(); ++i)
    r.origin.all()[i] = either(a.origin.all()[i], b.origin.all()[i]);
  return r;
}

/// A canonical sequence of numbers that says all that `equalButCut` and `hashButCut` look at.
template <typename Sink>
void visitParts(const KnownState &s, Sink sink) {
  const auto interval = [&](const Interval &i) {
    sink(llvm::bit_cast<uint64_t>(i.lo));
    sink(llvm::bit_cast<uint64_t>(i.hi));
  };
  for (uint64_t g : s.groups)
    sink(g);
  for (const Interval &p : s.position)
    interval(p);
  sink(s.statedMay);
  sink(s.statedMust);
  sink(s.machineAxes);
  sink(s.factsMay);
  sink(s.factsMust);
  interval(s.feed.peek());
  interval(s.fedFrom.peek());
  sink(uint64_t(uint32_t(s.tool.peek())) << 32 | uint32_t(s.toolOffset.peek()));
  sink(uint64_t(uint32_t(s.preselected.peek())) << 32 | uint32_t(s.lengthOffset.peek()));
  sink(uint64_t(uint32_t(s.radiusOffset.peek())));
  sink(s.modalCalls ? s.modalCalls->hash() : 0);
  sink(hash(s.saved));
  sink(uint64_t(s.spindle.peek()) | uint64_t(s.liveTool.peek()) << 8 |
       uint64_t(s.compensation) << 16 | uint64_t(s.idleBlocks) << 24 |
       uint64_t(s.pendingCycle) << 32 | uint64_t(s.profile) << 48 | uint64_t(s.seeksBranch) << 56 |
       uint64_t(s.restoresModes) << 57);
  interval(s.speed.peek());
  interval(s.speedLimit.peek());
  sink(uint64_t(s.switches.may) << 32 | s.switches.must);
  for (uint16_t axes : s.switches.axes)
    sink(axes);
  for (const Interval &i : s.cycleStart)
    interval(i);
  interval(s.initialLevel);
  sink(s.cycle.present);
  for (size_t i = 0; i < 26; ++i)
    if (s.cycle.present >> i & 1)
      sink(llvm::bit_cast<uint64_t>(s.cycle.value[i]));
  sink(uint64_t(s.roughFirst));
  sink(uint64_t(s.roughLast));
  for (const Interval &i : s.roughStart)
    interval(i);
  for (uint8_t t : s.transforms)
    sink(t);
  sink(s.frames.hash());
  for (const Interval &i : s.pole)
    interval(i);
  for (const Interval &i : s.polar)
    interval(i);
}

} // namespace

const CodeInfo *MachineState::activeCode(const Dialect &dialect, StandardGroup which) const {
  const uint64_t set = active(dialect, which);
  // Not has_single_bit: on a processor of which nothing is known it is a call.
  if (set == 0 || (set & (set - 1)) || set == groupUnset)
    return nullptr;
  return &dialect
              .codes[dialect.groups[dialect.group(which)].members[size_t(std::countr_zero(set))]];
}

namespace {
/// Calls `visit` with the codes of a group that are among `set`.
template <typename Visit>
void eachMember(const Dialect &dialect, StandardGroup which, uint64_t set, const Visit &visit) {
  set &= ~groupUnset;
  if (!set)
    return;
  const auto &members = dialect.groups[dialect.group(which)].members;
  for (; set; set &= set - 1)
    visit(dialect.codes[members[size_t(std::countr_zero(set))]]);
}
} // namespace

llvm::SmallVector<const CodeInfo *, 4> MachineState::candidates(const Dialect &dialect,
                                                                StandardGroup which) const {
  llvm::SmallVector<const CodeInfo *, 4> result;
  uint64_t set = active(dialect, which) & ~groupUnset;
  if (set == 0)
    return result;
  const auto &members = dialect.groups[dialect.group(which)].members;
  for (; set; set &= set - 1)
    result.push_back(&dialect.codes[members[size_t(std::countr_zero(set))]]);
  return result;
}

Truth MachineState::isActive(const Dialect &dialect, StandardGroup which,
                             std::initializer_list<Action> actions) const {
  const uint64_t set = active(dialect, which);
  bool yes = false, no = set & groupUnset;
  eachMember(dialect, which, set, [&](const CodeInfo &code) {
    const bool match = std::find(actions.begin(), actions.end(), code.action) != actions.end();
    (match ? yes : no) = true;
  });
  return yes ? (no ? Truth::Unknown : Truth::Yes) : (set & groupUnset ? Truth::Unknown : Truth::No);
}

Truth MachineState::cycleActive(const Dialect &dialect) const {
  bool yes = false;
  for (const StandardGroup which : {StandardGroup::Cycle, StandardGroup::Motion}) {
    const uint64_t set = active(dialect, which);
    bool here = false, other = set & groupUnset;
    eachMember(dialect, which, set,
               [&](const CodeInfo &code) { (code.action == Action::Cycle ? here : other) = true; });
    if (here && !other)
      return Truth::Yes;
    yes |= here;
  }
  return yes ? Truth::Unknown : Truth::No;
}

Truth MachineState::compensationActive(const Dialect &dialect) const {
  const Truth answer = isActive(dialect, StandardGroup::Compensation,
                                {Action::CompensationLeft, Action::CompensationRight});
  // Every manual that says anything has compensation off at power-on.
  if (answer == Truth::Unknown && active(dialect, StandardGroup::Compensation) == groupUnset)
    return Truth::No;
  return answer;
}

MachineState initialState(const Dialect &dialect) {
  MachineState state;
  for (size_t i = 0; i < maxGroups; ++i) {
    state.groups[i] = groupUnset;
    if (i < dialect.groups.size() && dialect.groups[i].initial != 0xFF)
      state.groups[i] = uint64_t(1) << dialect.groups[i].initial;
  }
  state.ranges = dialect.variableRanges;
  if (!dialect.localsBeginVacant)
    state.locals = Variables(); // unknown, and none given
  // A bit is spent on "away from the part": a program starts clear of it.
  state.set(Fact::AwayFromPart);
  return state;
}

bool hasOneSpindle(const Dialect &dialect) {
  return !dialect.isLathe() && !dialect.facts->spindle.others;
}

MachineState unknownState(const Dialect &dialect) {
  MachineState state;
  for (size_t i = 0; i < maxGroups; ++i) {
    state.groups[i] = groupUnset;
    if (i < dialect.groups.size())
      state.groups[i] |= knownMembers(dialect, GroupIndex(i));
  }
  state.statedMay = ~uint64_t(0);
  state.factsMay = ~uint64_t(0);
  state.tool = notKnown;
  state.toolOffset = notKnown;
  state.preselected = notKnown;
  state.lengthOffset = notKnown;
  state.radiusOffset = notKnown;
  state.spindle = spindleAny;
  state.liveTool = hasOneSpindle(dialect) ? spindleOff : spindleAny;
  state.compensation = phaseAny;
  state.switches.may = ~dialect.dataSwitches; // nobody leaves those on for others
  state.switches.axes.fill(0xFFFF);
  state.roughFirst = state.roughLast = notKnown;
  if (dialect.callsModally)
    state.modalCalls = unknownModalCall();
  state.saved.known = false;
  state.cycle.present = (1u << 26) - 1;
  state.cycle.value.fill(std::numeric_limits<double>::quiet_NaN());
  state.locals.forget();
  state.ranges = dialect.variableRanges;
  state.commons.forget();
  state.frames.put(0xFF, std::nullopt);
  state.pole = {};
  return state;
}

bool equal(const KnownState &a, const KnownState &b) {
  return equalButCut(a, b) && a.cutArea.all() == b.cutArea.all();
}

bool equalButCut(const KnownState &a, const KnownState &b) {
  // Most states that meet differ in what they have done or where they are.
  if (a.factsMay != b.factsMay || a.factsMust != b.factsMust || a.groups != b.groups ||
      std::memcmp(a.position.data(), b.position.data(), sizeof a.position) != 0)
    return false;
  llvm::SmallVector<uint64_t, 192> parts;
  visitParts(a, [&](uint64_t v) { parts.push_back(v); });
  size_t i = 0;
  bool same = true;
  visitParts(b, [&](uint64_t v) {
    same &= i < parts.size() && parts[i] == v;
    ++i;
  });
  return same && i == parts.size() && a.locals == b.locals && a.commons == b.commons;
}

uint64_t hash(const MachineState &state) {
  uint64_t sum = hashButCut(state);
  for (const Interval &i : state.cutArea.all())
    sum = llvm::hash_combine(sum, llvm::bit_cast<uint64_t>(i.lo), llvm::bit_cast<uint64_t>(i.hi));
  return sum;
}

uint64_t hashButCut(const MachineState &state) {
  llvm::SmallVector<uint64_t, 192> parts;
  visitParts(state, [&](uint64_t v) { parts.push_back(v); });
  parts.push_back(state.locals.hash());
  parts.push_back(state.commons.hash());
  return llvm::xxHash64(llvm::StringRef(reinterpret_cast<const char *>(parts.data()),
                                        parts.size() * sizeof(uint64_t)));
}

bool covers(const MachineState &a, const MachineState &b) { return equal(join(a, b), a); }

MachineState join(const MachineState &a, const MachineState &b) { return merge(a, b, false); }

MachineState widen(const MachineState &previous, const MachineState &next) {
  return merge(previous, next, true);
}

unsigned modeDifferences(const MachineState &a, const MachineState &b) {
  unsigned count = 0;
  for (size_t i = 0; i < a.groups.size(); ++i)
    count += a.groups[i] != b.groups[i];
  const bool others[] = {
      a.compensation != b.compensation, a.profile != b.profile, a.seeksBranch != b.seeksBranch,
      a.restoresModes != b.restoresModes, a.tool.peek() != b.tool.peek(),
      a.spindle.peek() != b.spindle.peek(), a.lengthOffset.peek() != b.lengthOffset.peek(),
      a.radiusOffset.peek() != b.radiusOffset.peek(),
      // (an F that counts in another unit than it was given in)
      a.must(Fact::FeedCarried) != b.must(Fact::FeedCarried), !(a.switches == b.switches)};
  return count + unsigned(std::count(std::begin(others), std::end(others), true));
}

} // namespace ncvet
