// The machine's state at one point of a program, as far as it is known.
#pragma once

#include "formats/dialect/dialect.h"
#include "interp/geometry/frame.h"
#include "interp/state/modal_call.h"
#include "interp/state/saved_modes.h"
#include "interp/value/spindle.h"
#include "interp/value/variables.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <utility>

namespace ncvet {

/// Where something was set: a place in a file.
struct Origin {
  FileId file = 0;
  uint32_t begin = 0;
  uint32_t end = 0; ///< 0: nowhere
  bool known() const { return end != 0; }
  SourceRange range() const { return {file, begin, end}; }
  friend bool operator==(const Origin &, const Origin &) = default;
};

/// Yes/no facts of the past that rules ask for. Each is kept as "may" and "must".
enum class Fact : uint8_t {
  ToolCalled,          ///< a T word was executed
  Moved,               ///< an axis has moved
  Cut,                 ///< an axis has moved at feed
  CutSinceTool,        ///< … since the last tool change
  MovedSinceTool,      ///< … an axis, since the last tool change
  FeedSet,             ///< an F word was executed
  FeedIsLead,          ///< the F in force was given as a thread lead
  FeedCarried,         ///< the unit of the feed was stated after the F in force
  SpeedSet,            ///< an S word that sets the spindle's speed was executed
  SpeedSinceMode,      ///< … since G96 or G97 was last switched
  SpeedLimitSet,       ///< the speed clamp was programmed
  WorkOffsetStated,    ///< a work offset code was executed
  LengthSinceTool,     ///< a length offset was activated since the last tool change
  AwayFromPart,        ///< since the last cut the tool went to a machine position or by rapid
  AtMachinePosition,   ///< since the last work-coordinate move the tool went to a machine position
  ReferenceReturned,   ///< G28 was executed
  MovedSincePreset,    ///< an axis has moved since G92 shifted the system
  SkipMoveDone,        ///< a skip move (G31) was the last measuring move
  SpindleStated,       ///< M03, M04 or M05 was executed
  SpindleStoppedByTap, ///< rigid tapping, or a code that is for something else, left it stopped
  CycleRan,            ///< the active cycle has run at least once
  InContour,           ///< in a program that a milling cycle reads as a contour
  ContourBegun,        ///< … after its first position
  PoleSet,             ///< a pole for angle and radius was programmed
  PolarRadiusSet,      ///< the word that is the radius under polar input was programmed
  UnknownCode,         ///< a code without a table entry was executed: anything may have changed
  ChuckOpen,
  SpindleClamped,
  AxisEngaged,          ///< C axis coupled to the spindle
  OrientedSinceTool,    ///< an oriented spindle stop was executed with this tool
  PlungedUncompensated, ///< fed along the tool axis into the work without compensation, not yet cut
                        ///< in the plane
  CompensatedCut,       ///< since compensation engaged, an axis of the plane has moved
  ContourCompensated,   ///< … by an arc, a slanted line or a corner element
  EnteredInward,        ///< compensation engaged on a move towards smaller X
  EnteredOutward,       ///< … towards larger X
  Count
};
static_assert(unsigned(Fact::Count) <= 64);

constexpr uint64_t bitOf(Fact fact) { return uint64_t(1) << unsigned(fact); }

/// Set of the phases in which radius compensation may be.
enum CompensationPhase : uint8_t {
  phaseOff = 1,
  phaseStarting = 2, ///< the code was read, the move that engages is still to come
  phaseOn = 4,
  phaseEnding = 8 ///< G40 was read, the move that cancels is still to come
};

/// A whole number of a word (tool, offset) as the state keeps it.
constexpr int32_t notSet = -1;
constexpr int32_t notKnown = -2;

/// Words of the active cycle, by letter.
struct CycleWords {
  uint32_t present = 0;           ///< bit per letter
  std::array<double, 26> value{}; ///< NaN: present, but its value is not known

  bool has(char letter) const { return present >> (letter - 'A') & 1; }
  double get(char letter) const { return value[size_t(letter - 'A')]; }
};

/// Holds no number; joined to another interval it gives that one.
constexpr Interval emptyInterval{std::numeric_limits<double>::infinity(),
                                 -std::numeric_limits<double>::infinity()};

/// Box of X and Y. What a stretch of blocks adds to it can be added elsewhere too.
class CutArea {
public:
  using Box = std::array<Interval, 2>;

  Box get() const {
    stateUse.others |= bitOf(StatePart::CutArea);
    return all();
  }
  void set(const Box &box) {
    stateUse.others |= bitOf(StatePart::CutArea);
    before_ = box;
    here_ = none;
  }
  void clear() { set(none); }
  /// A cut reaches up to here.
  void add(size_t axis, const Interval &at) { here_[axis] = join(here_[axis], at); }
  /// Without notice.
  Box all() const { return {join(before_[0], here_[0]), join(before_[1], here_[1])}; }
  /// What was added since the last call.
  Box takeAdded() {
    before_ = all();
    return std::exchange(here_, none);
  }
  void add(const Box &box) {
    for (size_t axis = 0; axis < box.size(); ++axis)
      add(axis, box[axis]);
  }
  static constexpr Box none{emptyInterval, emptyInterval};

private:
  Box before_ = none, here_ = none; ///< what was taken, and what was added since then
};

/// Moves along the tool's axis.
struct DepthMoves {
  /// Highest end of one of them; infinite when one is not known.
  double highest = -std::numeric_limits<double>::infinity();
  bool feedsDown = false;

  void add(const DepthMoves &other) {
    highest = std::max(highest, other.highest);
    feedsDown |= other.feedsDown;
  }
  /// Whether they leave the level from which the tool was fed down what it is.
  bool spare(const Interval &level) const {
    return level.isConstant() ? highest < level.value() : !feedsDown;
  }
};

/// Level from which a tool was fed down and below which it has been since; unknown when it is clear
/// of the work or nothing is known.
class FeedLevel {
public:
  const Interval &get() const {
    stateUse.others |= bitOf(StatePart::FeedLevel);
    return level_;
  }
  /// Nothing is known of it any more.
  void forget() {
    stateUse.others |= bitOf(StatePart::FeedLevel);
    level_ = Interval::unknown();
  }
  /// A move along the tool's axis, both places in the same coordinates.
  void move(const Interval &from, const Interval &to, bool isRapid) {
    const bool known = from.isConstant() && to.isConstant();
    const bool down = !isRapid && known && to.value() < from.value();
    moves_.add({known ? to.value() : std::numeric_limits<double>::infinity(), down});
    if (!known || (level_.isConstant() && to.value() >= level_.value()))
      level_ = Interval::unknown();
    if (down && !level_.isConstant())
      level_ = from;
  }
  /// Without notice.
  const Interval &peek() const { return level_; }
  Interval &peek() { return level_; }
  /// The moves since the last call.
  DepthMoves takeMoves() { return std::exchange(moves_, DepthMoves()); }
  /// These were made too.
  void add(const DepthMoves &moves) { moves_.add(moves); }

private:
  Interval level_;
  DepthMoves moves_;
};

/// What changes with nearly every block.
struct MotionState {
  std::array<Interval, axisCount> position; ///< mm or degrees; lathe X as programmed
  uint32_t machineAxes = 0;                 ///< bit per axis: `position` is in machine coordinates
  uint64_t factsMay = 0, factsMust = 0;
  /// As programmed; unknown when never set (see Fact::FeedSet).
  Noted<Interval, StatePart::Feed> feed;
  FeedLevel fedFrom; ///< mills: Z
  /// Mills: where the tool in use has cut; empty (lo > hi) before its first cut.
  CutArea cutArea;
};

/// What the current block is to a cycle that works along a profile.
enum class ProfileMode : uint8_t {
  Off,      ///< no block of a profile
  Recorded, ///< a block of a profile that the cycle reads as data: nothing moves
  Executed  ///< a block of a profile that the cycle runs to finish it
};

/// What changes with set-up codes.
struct SetupState {
  Noted<int32_t, StatePart::Tool> tool = notSet; ///< tool in the spindle or in cutting position
  Noted<int32_t, StatePart::ToolOffset> toolOffset = notSet; ///< lathe: offset number of the T word
  Noted<int32_t, StatePart::Preselected> preselected =
      notSet; ///< mill: T word that waits for the change
  Noted<int32_t, StatePart::LengthOffset> lengthOffset = notSet; ///< H
  Noted<int32_t, StatePart::RadiusOffset> radiusOffset = notSet; ///< D
  Noted<uint8_t, StatePart::Spindle> spindle = spindleOff;
  Noted<uint8_t, StatePart::LiveTool> liveTool = spindleOff;
  uint8_t compensation = phaseOff;
  uint8_t idleBlocks = 0; ///< blocks without a move in the plane since the last one, at most 255
  Noted<Interval, StatePart::Speed> speed;           ///< S as programmed
  Noted<Interval, StatePart::SpeedLimit> speedLimit; ///< 1/min
  SwitchState switches;
  CycleWords cycle;
  Interval initialLevel;              ///< position along the tool axis when the cycle began
  std::array<Interval, 3> cycleStart; ///< X Y Z when the cycle began
  CodeIndex pendingCycle = noCode;    ///< two-block cycle whose parameter block was the last block
  int64_t roughFirst = notSet,
          roughLast = notSet;          ///< P and Q of the last roughing not yet finished
  std::array<Interval, 2> roughStart;  ///< X and Z where that roughing began
  std::array<uint8_t, 4> transforms{}; ///< switches of transformations, in the order switched on
  ModalCalls modalCalls;               ///< programs that run after every move
  SavedModes saved;                    ///< of the running program
  /// An IF whose condition did not hold looks for its next branch.
  bool seeksBranch = false;
  bool restoresModes = false; ///< the running program gives its caller the modes back
  ProfileMode profile = ProfileMode::Off;
  std::array<Interval, 2> polar; ///< radius and angle of polar input that were written last
  FrameStack frames;             ///< over the work offset; `position` is inside all of them
  std::array<Interval, 2> pole{Interval::exactly(0), Interval::exactly(0)}; ///< in the plane's axes
};

/// Where things were set; never compared. A look at one of them is noted.
class OriginState {
public:
  /// Of groups, switches and parts.
  static constexpr size_t count = maxGroups + maxSwitches + size_t(StatePart::Count);
  using Places = std::array<Origin, count>;

  const Origin &of(StatePart part) const { return look(indexOf(part)); }
  const Origin &ofSwitch(size_t index) const { return look(maxGroups + index); }
  const Origin &ofGroup(size_t group) const { return look(group); }
  /// Whether the tool was changed after the part was set, as the text of one file has them. Where
  /// nothing else is looked at, that is a mode as others are.
  bool isOlderThanTool(StatePart part) const {
    stateUse.ages |= bitOf(part);
    return isOlder(part);
  }
  void set(StatePart part, const Origin &origin) { put(indexOf(part), origin); }
  void setSwitch(size_t index, const Origin &origin) { put(maxGroups + index, origin); }
  void setGroup(size_t group, const Origin &origin) { put(group, origin); }

  /// Without notice.
  const Places &all() const { return at_; }
  Places &all() { return at_; }
  bool isOlder(StatePart part) const {
    const Origin &on = at_[indexOf(part)], &tool = at_[indexOf(StatePart::Tool)];
    return on.known() && tool.known() && on.file == tool.file && tool.begin > on.begin;
  }
  /// Parts of which that may be asked.
  static constexpr std::array<StatePart, 2> aging{StatePart::Cycle, StatePart::Compensation};
  /// Whether the place, an index in `all`, decides that.
  static constexpr bool ages(size_t place) {
    return place == indexOf(StatePart::Tool) || place == indexOf(aging[0]) ||
           place == indexOf(aging[1]);
  }

private:
  static constexpr size_t indexOf(StatePart part) { return maxGroups + maxSwitches + size_t(part); }
  static void touch(size_t index) {
    if (index < maxGroups)
      stateUse.groupOrigins |= uint64_t(1) << index;
    else
      stateUse.otherOrigins |= uint64_t(1) << (index - maxGroups);
  }
  const Origin &look(size_t index) const {
    touch(index);
    return at_[index];
  }
  void put(size_t index, const Origin &origin) {
    touch(index);
    at_[index] = origin;
  }

  Places at_;
};

/// All that the machine does next depends on.
struct KnownState : ModeState, MotionState, SetupState {
  Variables locals{Value::vacant()};
  Variables commons;
  VariableRanges ranges; ///< of the dialect; never compared
};

struct MachineState : KnownState {
  OriginState origin;

  bool may(Fact fact) const {
    stateUse.facts |= bitOf(fact);
    return factsMay & bitOf(fact);
  }
  bool must(Fact fact) const {
    stateUse.facts |= bitOf(fact);
    return factsMust & bitOf(fact);
  }
  void set(Fact fact) {
    stateUse.facts |= bitOf(fact);
    factsMay |= bitOf(fact);
    factsMust |= bitOf(fact);
  }
  void clear(Fact fact) {
    stateUse.facts |= bitOf(fact);
    factsMay &= ~bitOf(fact);
    factsMust &= ~bitOf(fact);
  }
  /// Several at once: those of `on` hold, those of `off` do not.
  void put(uint64_t on, uint64_t off) {
    stateUse.facts |= on | off;
    factsMust = (factsMust | on) & ~off;
    factsMay = (factsMay | on) & ~off;
  }
  /// They may hold.
  void allow(uint64_t facts) {
    stateUse.facts |= facts;
    factsMay |= facts;
  }
  Truth is(Fact fact) const {
    return must(fact) ? Truth::Yes : may(fact) ? Truth::Unknown : Truth::No;
  }

  /// Whether a program runs after every move.
  Truth callsModally() const {
    return !modalCalls ? Truth::No : modalCalls->known ? Truth::Yes : Truth::Unknown;
  }

  /// Members of a standard group that may be active; `groupUnset` when the dialect has no such
  /// group.
  uint64_t active(const Dialect &dialect, StandardGroup which) const {
    const GroupIndex index = dialect.group(which);
    return index == noGroup ? groupUnset : group(index);
  }
  /// The one active code of a standard group; null when it is not certain or none is.
  const CodeInfo *activeCode(const Dialect &dialect, StandardGroup which) const;
  /// Action of that code; `Action::None` when it is not certain.
  Action activeAction(const Dialect &dialect, StandardGroup which) const {
    const CodeInfo *code = activeCode(dialect, which);
    return code ? code->action : Action::None;
  }
  /// Whether a code whose action is among `actions` is active in that group.
  Truth isActive(const Dialect &dialect, StandardGroup which,
                 std::initializer_list<Action> actions) const;
  /// Whether a cycle that runs with further blocks is active.
  Truth cycleActive(const Dialect &dialect) const;
  /// Whether radius compensation is selected (its code active), whatever its phase.
  Truth compensationActive(const Dialect &dialect) const;
  /// The members of a group that may be active, as codes.
  llvm::SmallVector<const CodeInfo *, 4> candidates(const Dialect &dialect,
                                                    StandardGroup which) const;
  Origin originOf(const Dialect &dialect, StandardGroup which) const {
    const GroupIndex index = dialect.group(which);
    return index == noGroup ? Origin() : origin.ofGroup(index);
  }
  Interval &at(Axis axis) { return position[size_t(axis)]; }
  const Interval &at(Axis axis) const { return position[size_t(axis)]; }
  bool inMachineCoordinates(Axis axis) const { return machineAxes >> unsigned(axis) & 1; }
  bool switchMayBeOn(unsigned index) const { return switches.mayBeOn(1u << index); }
  bool switchMustBeOn(unsigned index) const { return switches.areOn(1u << index); }
};

/// State at the start of a program: power-on modes where the table has them, the rest not stated.
MachineState initialState(const Dialect &dialect);
/// State on entry of a program whose caller is not known: everything is possible.
MachineState unknownState(const Dialect &dialect);
/// Whether the machine has the one spindle that its M codes turn, as far as the control tells.
bool hasOneSpindle(const Dialect &dialect);

/// Exact equality of what the two states say.
bool equal(const KnownState &a, const KnownState &b);
uint64_t hash(const MachineState &state);
/// True when every concrete machine that `b` represents is also one of `a`.
bool covers(const MachineState &a, const MachineState &b);
/// Least state that covers both; origins are those of `a`, or of `b` where `a` has none.
MachineState join(const MachineState &a, const MachineState &b);
/// As `join`, but with every value that moved given up: chains of it end.
MachineState widen(const MachineState &previous, const MachineState &next);
/// In how many modes the states of two paths that meet differ: codes in force, compensation, tool
/// and its offsets, spindle, switches. Where it is none, they differ in numbers only.
unsigned modeDifferences(const MachineState &a, const MachineState &b);

} // namespace ncvet
