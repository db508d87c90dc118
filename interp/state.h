// The machine's state at one point of a program, as far as it is known.
#pragma once

#include "formats/dialect/dialect.h"
#include "interp/frame.h"
#include "interp/modal_call.h"
#include "interp/variables.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <memory>

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
  SpindleStoppedByTap, ///< rigid tapping, or a code that is for something else, left it standing
  CycleRan,            ///< the active cycle has run at least once
  InContour,           ///< in a program that a milling cycle reads as a contour
  ContourBegun,        ///< … behind its first position
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

/// Set of what the main spindle may be doing.
enum SpindleBits : uint8_t {
  spindleOff = 1,
  spindleCw = 2,
  spindleCcw = 4,
  spindleOriented = 8,
  spindleAny = 15
};

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

/// Modal codes.
struct ModeState {
  std::array<uint64_t, maxGroups> group;  ///< bit set of members that may be active
  uint64_t statedMay = 0, statedMust = 0; ///< bit per group: the program has stated it
};

/// What a program has kept of its state, to bring it back.
struct KeptModes {
  ModeState modes;
  Interval feed, speed;
  uint64_t factsMay = 0, factsMust = 0; ///< of the feed and the speed
  uint32_t switchMay = 0, switchMust = 0;
  std::array<uint16_t, maxSwitches> switchAxes{};
  uint8_t spindle = 0;
  bool presetOn = false; ///< a shift over all work offsets may have been in force

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

/// What changes with nearly every block.
struct MotionState {
  std::array<Interval, axisCount> position; ///< mm or degrees; lathe X as programmed
  uint32_t machineAxes = 0;                 ///< bit per axis: `position` is in machine coordinates
  uint64_t factsMay = 0, factsMust = 0;
  Interval feed; ///< as programmed; unknown when never set (see Fact::FeedSet)
  /// Mills: Z from which the tool was fed down and below which it has been
  /// since; unknown when it is clear of the work or nothing is known.
  Interval fedFrom;
  /// Mills: box of X and Y in which the tool in use has cut; empty (lo > hi) before its first cut.
  std::array<Interval, 2> cutArea{emptyInterval, emptyInterval};
};

/// What changes with set-up codes.
struct SetupState {
  int32_t tool = notSet;         ///< tool in the spindle or in cutting position
  int32_t toolOffset = notSet;   ///< lathe: offset number of the T word
  int32_t preselected = notSet;  ///< mill: T word that waits for the change
  int32_t lengthOffset = notSet; ///< H
  int32_t radiusOffset = notSet; ///< D
  uint8_t spindle = spindleOff;
  uint8_t liveTool = spindleOff;
  uint8_t compensation = phaseOff;
  uint8_t idleBlocks = 0; ///< blocks without a move in the plane since the last one, at most 255
  Interval speed;         ///< S as programmed
  Interval speedLimit;    ///< 1/min
  uint32_t switchMay = 0, switchMust = 0;         ///< bit per switch of the dialect
  std::array<uint16_t, maxSwitches> switchAxes{}; ///< axes for which a switch may be on
  std::array<Interval, 3> localShift;             ///< G52, X Y Z
  CycleWords cycle;
  Interval initialLevel;              ///< position along the tool axis when the cycle began
  std::array<Interval, 3> cycleStart; ///< X Y Z when the cycle began
  CodeIndex pendingCycle = noCode;    ///< two-block cycle whose parameter block was the last block
  int64_t roughFirst = notSet,
          roughLast = notSet;          ///< P and Q of the last roughing not yet finished
  std::array<Interval, 2> roughStart;  ///< X and Z where that roughing began
  std::array<uint8_t, 4> transforms{}; ///< switches of transformations, in the order switched on
  ModalCalls modalCalls;               ///< programs that run behind every move
  SavedModes saved;                    ///< of the running program
  /// An IF whose condition did not hold looks for its next branch.
  bool seeksBranch = false;
  bool restoresModes = false; ///< the running program gives its caller the modes back
  uint8_t profile = 0;        ///< 0: not in a profile; 1: read as data for roughing; 2: finishing
  std::array<Interval, 2> polar; ///< radius and angle of polar input that were written last
  FrameStack frames;             ///< over the work offset; `position` is inside all of them
  std::array<Interval, 2> pole{Interval::exactly(0), Interval::exactly(0)}; ///< in the plane's axes
};

/// Where things were set; never compared.
struct OriginState {
  std::array<Origin, maxGroups> group;
  std::array<Origin, maxSwitches> switched;
  Origin tool, spindle, speed, feed, cycle, compensation, pending, preset, rough, lengthOffset,
      radiusOffset;

  friend bool operator==(const OriginState &, const OriginState &) = default;
};

/// Calls `visit` with each place of the state.
template <typename Origins, typename Visit>
void forEachOrigin(Origins &origins, const Visit &visit) {
  for (auto &origin : origins.group)
    visit(origin);
  for (auto &origin : origins.switched)
    visit(origin);
  for (auto *origin : {&origins.tool, &origins.spindle, &origins.speed, &origins.feed,
                       &origins.cycle, &origins.compensation, &origins.pending, &origins.preset,
                       &origins.rough, &origins.lengthOffset, &origins.radiusOffset})
    visit(*origin);
}

struct MachineState : ModeState, MotionState, SetupState {
  Variables locals{Value::vacant()};
  Variables commons;
  VariableRanges ranges; ///< of the dialect; never compared
  OriginState origin;

  bool may(Fact fact) const { return factsMay & bitOf(fact); }
  bool must(Fact fact) const { return factsMust & bitOf(fact); }
  void set(Fact fact) {
    factsMay |= bitOf(fact);
    factsMust |= bitOf(fact);
  }
  void clear(Fact fact) {
    factsMay &= ~bitOf(fact);
    factsMust &= ~bitOf(fact);
  }
  Truth is(Fact fact) const {
    return must(fact) ? Truth::Yes : may(fact) ? Truth::Unknown : Truth::No;
  }

  /// Whether a program runs behind every move.
  Truth callsModally() const {
    return !modalCalls ? Truth::No : modalCalls->known ? Truth::Yes : Truth::Unknown;
  }

  /// Members of a standard group that may be active; `groupUnset` when the dialect has no such
  /// group.
  uint64_t active(const Dialect &dialect, StandardGroup which) const {
    const GroupIndex index = dialect.group(which);
    return index == noGroup ? groupUnset : group[index];
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
    return index == noGroup ? Origin() : origin.group[index];
  }
  Interval &at(Axis axis) { return position[size_t(axis)]; }
  const Interval &at(Axis axis) const { return position[size_t(axis)]; }
  bool inMachineCoordinates(Axis axis) const { return machineAxes >> unsigned(axis) & 1; }
  bool switchMayBeOn(unsigned index) const { return switchMay >> index & 1; }
  bool switchMustBeOn(unsigned index) const { return switchMust >> index & 1; }
};

/// State at the start of a program: power-on modes where the table has them, the rest not stated.
MachineState initialState(const Dialect &dialect);
/// State on entry of a program whose caller is not known: everything is possible.
MachineState unknownState(const Dialect &dialect);

/// Exact equality of what the two states say (origins are not compared).
bool equal(const MachineState &a, const MachineState &b);
uint64_t hash(const MachineState &state);
/// True when every concrete machine that `b` stands for is also one of `a`.
bool covers(const MachineState &a, const MachineState &b);
/// Least state that covers both; origins are those of `a`, or of `b` where `a` has none.
MachineState join(const MachineState &a, const MachineState &b);
/// As `join`, but with every value that moved given up: chains of it end.
MachineState widen(const MachineState &previous, const MachineState &next);
/// States with the same fingerprint differ in numbers only, not in modes: distance mode, plane,
/// units, compensation, cycle, tool.
uint64_t controlFingerprint(const Dialect &dialect, const MachineState &state);

} // namespace ncvet
