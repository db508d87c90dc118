// A code of a control as data: its words, conditions, notices, and what it does.
#pragma once

#include "formats/dialect/action.h"
#include "formats/dialect/address.h"
#include "formats/dialect/cycle_kind.h"
#include "formats/dialect/formula.h"
#include "formats/finding/finding.h"

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/StringRef.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace ncvet {

using CodeIndex = uint16_t; ///< index into `Dialect::codes`
constexpr CodeIndex noCode = 0xFFFF;
using GroupIndex = uint8_t; ///< index into `Dialect::groups`
constexpr GroupIndex noGroup = 0xFF;
constexpr unsigned maxGroupMembers = 62;
/// Bit of a modal group that says: no member is known to be active (power-on state not documented).
constexpr uint64_t groupUnset = uint64_t(1) << 63;

/// Whether a number has a decimal point, as a condition.
enum class PointRule : uint8_t { Any, Required, Forbidden };

/// A test of the value of a word of the block: true when the word is present and its known value
/// breaks the bounds.
struct ValueTest {
  AddressId address = noAddress;
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool minExclusive = false;
  bool maxExclusive = false;
  bool integer = false; ///< also broken by a value that is not whole
  PointRule point = PointRule::Any;
  std::vector<double> oneOf; ///< when not empty: also broken by any other value
};

/// When a notice, a word requirement or a variant applies. Every part that is given must hold.
struct Condition {
  AddressMask has = 0;   ///< all of these addresses are in the block
  AddressMask any = 0;   ///< at least one of these (0: no condition)
  AddressMask lacks = 0; ///< none of these
  /// (group, members): the group's state before the block is certainly one of the members.
  std::vector<std::pair<GroupIndex, uint64_t>> active;
  /// (group, members): the block itself holds a code of the group among these members.
  std::vector<std::pair<GroupIndex, uint64_t>> with;
  /// (group, members): the block holds none of these codes.
  std::vector<std::pair<GroupIndex, uint64_t>> without;
  std::vector<CodeIndex> withCode;    ///< the block holds one of these codes
  std::vector<CodeIndex> withoutCode; ///< the block holds none of these codes
  /// The code was not active before this block (a modal code's first block).
  bool first = false;
  /// The block before was the parameter block of a two-block cycle of this kind.
  std::optional<CycleKind> pending;
  /// An option of the machine profile has this value (text form: "true", "SL-30", "2.5").
  std::vector<std::pair<std::string, std::vector<std::string>>> options;
  std::vector<ValueTest> broken;     ///< each of these tests is broken
  uint32_t on = 0;                   ///< switches that certainly are on before the block
  uint32_t off = 0;                  ///< switches that certainly are off
  AddressMask before = 0;            ///< one of these is before the code
  AddressMask after = 0;             ///< one of these is after the code
  AddressMask next = 0;              ///< the word right after the code is one of these
  AddressMask noneAfter = 0;         ///< none of these is after the code
  std::optional<bool> spindleTurns;  ///< the spindle certainly turns, or does not, before the block
  std::vector<std::string> toolKind; ///< the tool in use is known to be one of these
  std::vector<std::string> otherToolKind; ///< … is known, and none of these
  Formula formula; ///< of the words of the code that the condition belongs to
};

/// A fact of the table that a rule reports in the table's words.
struct Notice {
  std::string rule; ///< id of the canonical rule
  std::optional<Severity> severity;
  Condition when;
  std::string message;      ///< `{code}` and `{X}` (a word of the block) are replaced
  AddressId at = noAddress; ///< the word to mark; the code itself when none
  bool advice = false;      ///< only where the user selected the rule
  uint64_t atVariable = 0;  ///< or the assignment to the variable with this key; 0: none
};

/// What a word is for in a code's format; rules of one family pick the words of their roles.
enum class Role : uint8_t {
  None,
  Target,
  Depth,
  Retract,
  Dwell,
  Time,
  Peck,
  PeckFirst,
  PeckStep,
  PeckLeast,
  PeckClearance,
  Repeat,
  Lead,
  ProfileFirst,
  ProfileLast,
  AllowanceX,
  AllowanceZ,
  CutDepth,
  PassCount,
  StockX,
  StockZ,
  Height,
  FirstCut,
  LeastCut,
  ThreadForm,
  Angle,
  Taper,
  Shift,
  Program,
  Sequence,
  Speed,
  Feed,
  Step,
  Centre,
  Radius,
  Offset,
  Ratio,
  Method,
  Limit,
  Argument,
  StartAngle,
  Relief,
  Counterbore
};
llvm::StringRef toString(Role role); ///< as in the tables: "peck-first"

/// How a frame changes coordinates.
enum class FrameKind : uint8_t {
  None,
  Shift,
  Rotation,
  Scale,
  Mirror,
  Offset,     ///< a shift of the axes that the block names; the others keep what they had
  MirrorAxes, ///< a mirror of those axes about the zero point, likewise
  Steps       ///< what the table's steps say
};

/// One step of a frame: a shift, a turn, factors or a whole matrix.
struct FrameStep {
  enum class Kind : uint8_t { Shift, Turn, Scale, Matrix };
  static constexpr uint8_t toolAxis = 3;

  Kind kind = Kind::Shift;
  uint8_t axis = toolAxis; ///< of a turn: 0 to 2, or `toolAxis`
  /// Three lengths; an angle in degrees and three coordinates of its centre, or the angle alone;
  /// three factors; three rows of a matrix, each of three factors and a length.
  std::vector<Formula> numbers;
};

/// What a code does with the thing of the control that a word names.
enum class Naming : uint8_t { None, Define, Use, Drop };

enum class Need : uint8_t {
  Optional,
  Required, ///< in every block with the code; a variable that has a value will do
  First,    ///< in the block that makes the code active; later blocks keep the value
  Here      ///< in every block with the code, whatever a variable holds
};

/// One word of a code's format, or several of which each will do (`X|U`).
struct WordSpec {
  AddressMask any = 0;
  unsigned position = 0;   ///< from 1: an argument of the code's call instead; 0: not one
  uint64_t variable = 0;   ///< `variableKey` of a variable that the code reads instead; 0: none
  uint64_t orVariable = 0; ///< one that may replace it; 0: none
  std::string name;        ///< of that argument or variable: "RTP", "ENT"
  bool text = false;       ///< the argument is a string
  std::string characters;  ///< that the string may have, with ranges: "A-Z0-9"; empty: all
  Naming naming = Naming::None;
  std::optional<double> absent; ///< the value that counts when it is not given
  Need need = Need::Optional;
  Role role = Role::None;
  std::optional<Severity> severity; ///< of its absence, when it differs from the rule's
  Condition when;                   ///< the requirement applies only then
  bool hasRange = false;
  ValueTest range; ///< `address` is not used here: every present address of `any` is tested
  std::optional<Severity> rangeSeverity;
  /// Over the address's own: whether the word should be written with a decimal point here.
  std::optional<bool> pointAdvised;
  std::string note; ///< what the word means, for messages and hover: "peck depth"
};

enum class SpindleNeed : uint8_t { Any, Running, Clockwise, CounterClockwise, StartsItself };

/// Where a code that switches something leaves a switch.
struct SwitchEffect {
  uint8_t index = 0xFF; ///< into `Dialect::switches`; 0xFF: no switch
  bool on = false;
  /// The switch has one state per axis named in the block (mirror, local shift): a zero value of
  /// every named axis switches it off when `offByZero`.
  bool offByZero = false;
};

/// What a code leaves in a variable of the control, for the formulas of later codes.
struct Store {
  uint64_t variable = 0; ///< its key
  std::string list;      ///< instead: the name of several, of which `index` says which one
  Formula index;         ///< "_RADIUS" and 5: the variable `_RADIUS[5]`
  bool forgets = false;  ///< from here on it has no value
  Formula value;         ///< stored when all words that it names are given; empty: not known
  Formula when;          ///< empty: always
};

enum class Measure : uint8_t; // formats/dialect/measure.h
enum class CycleTrait : uint8_t;

/// A quantity of a cycle, for its motions.
struct CycleMeasure {
  Measure what{};
  Formula formula;
};

struct Variant {
  Condition when;
  CodeIndex code = noCode; ///< the code's meaning then, an entry of `Dialect::codes`
};

/// A G or M code, or one of its variants.
struct CodeInfo {
  std::string name;    ///< as messages show it: "G01", "G84.2", "M03"
  std::string title;   ///< "linear feed", lower case
  char letter = 'G';   ///< 0: a code that is a word of its own
  uint16_t number = 0; ///< number times ten plus the digit after the point: G84.2 is 842
  GroupIndex group = noGroup;
  uint8_t bit = 0; ///< member number within the group
  Action action = Action::None;
  /// Of a plane: the axis from which its angles count, 0 to 2; 0xFF: X of XY, Z of ZX, Y of YZ.
  uint8_t firstAxis = 0xFF;
  CycleKind cycle = CycleKind::None;
  FrameKind frame = FrameKind::None; ///< of frame-set and frame-add; None: nothing is known of it
  std::vector<FrameStep> frameSteps; ///< of a frame of steps, the outermost first
  Formula frameWhen;                 ///< the steps are right only then; empty: always
  Formula losesPlace;        ///< when it holds, no position is known after the code; empty: never
  bool cancelsCycle = false; ///< ends an active canned cycle of the group "cycle"
  SpindleNeed spindle = SpindleNeed::Any;
  bool needsFeed = false;  ///< a feed must be in force
  bool needsSpeed = false; ///< a spindle speed must be in force
  /// Addresses whose words the code reads, axis words of motions included; every other word of the
  /// block is unused as far as this code goes.
  AddressMask takes = 0;
  /// A modal cycle runs again in a later block that holds one of these.
  AddressMask fires = 0;
  bool firesOnEveryBlock = false; ///< runs again in every block without a motion code
  bool twoBlock = false;          ///< a parameter block comes before the executing block
  bool alone = false;             ///< wants a block of its own (other than N and comments)
  bool exclusive = false;         ///< one-shot action: only one such code per block
  std::string family;             ///< of cycles and what cancels them; empty: all are one
  bool firesInPlane = false;      ///< runs with every move in the plane, in its own block too
  bool stopsSpindle = false;      ///< the spindle is stopped after it, unless its block starts it
  bool arrivesSoftly = false;     ///< compensation that leads in along an arc of its own
  bool leavesNoSpeed = false;     ///< its move uses the S up
  bool ownMove = false;      ///< the block's move is the code's own, whatever motion is in force
  bool returns = false;      ///< the tool comes back to where the move began
  bool waits = false;        ///< a modal cycle that does not run in its own block
  bool cancelsCalls = false; ///< ends a modal call of a program too
  /// What runs after moves runs after a motion code without coordinates too.
  bool firesByMotionCode = false;
  bool isProgram = false;        ///< a program of the control: one of the same name hides it
  bool endsMotion = false;       ///< no motion code is in force after it
  bool foreign = false;          ///< another control's code: here it is none
  bool stopsPreparation = false; ///< the next block is prepared once all moves are done
  bool elsewhere = false;        ///< what it calls is elsewhere: it is not looked for
  int32_t storedAt = 0;  ///< first variable of the place to which it leads or that it stores
  uint8_t arguments = 0; ///< most arguments that its call takes; 0: not limited
  std::vector<WordSpec> words;
  /// Of a cycle along the tool axis: level from which it feeds and the one to which it feeds, where
  /// they are no word of their own (empty: the words with the roles Retract and Depth).
  Formula approach, bottom;
  std::vector<CycleMeasure> measures; ///< of a cycle's motions
  uint32_t traits = 0;                ///< bit per `CycleTrait`: what the cycle does its own way
  Formula count;                      ///< of the places of a pattern; empty: they are not known
  /// Their coordinates in the plane, by `index()`; of a motion: where it leads in the plane.
  std::array<Formula, 2> places;
  /// Sets of words that exclude each other, each pair of masks.
  std::vector<std::pair<AddressMask, AddressMask>> excludes;
  std::vector<Notice> notices;
  std::vector<Store> stores;
  std::vector<std::pair<uint64_t, double>> shows; ///< variables and their values while it is on
  std::vector<Variant> variants;                  ///< first match wins; none: this entry
  CodeIndex base = noCode; ///< of a variant: the code that it belongs to; else the code itself
  SwitchEffect effect;
  CodeIndex opposite = noCode; ///< what ends or reverses it (G80 for G81), for messages and fixes
  std::string source;          ///< manual's file and line
};

} // namespace ncvet
