// A control's language as data: addresses, modal groups, codes, what each code does, and limits.
#pragma once

#include "formats/dialect/action.h"
#include "formats/dialect/address.h"
#include "formats/dialect/formula.h"
#include "formats/finding/finding.h"

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/SmallVector.h"
#include "llvm/ADT/StringMap.h"
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
constexpr unsigned maxGroups = 64;
constexpr unsigned maxGroupMembers = 62;
/// Bit of a modal group that says: no member is known to be active (power-on state not documented).
constexpr uint64_t groupUnset = uint64_t(1) << 63;
constexpr unsigned maxSwitches = 32;

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

/// Canned and turning cycles, by the motions that they make.
enum class CycleKind : uint8_t {
  None,
  Drill,
  DrillDwell,
  Peck,
  ChipBreak,
  Tap,
  TapLeft,
  RigidTap,
  RigidTapLeft,
  Ream,
  ReamDwell,
  BoreStop,
  BoreManual,
  BoreDwellManual,
  FineBore,
  BackBore,
  TurnPass,
  FacePass,
  ThreadPass,
  RoughTurn,
  RoughFace,
  PatternRepeat,
  Finish,
  GrooveFace,
  GrooveRadial,
  ThreadMulti,
  Pattern, ///< moves from place to place; the active modal cycle runs at each
  Face,    ///< mills a face
  Contour, ///< mills along a contour
  Pocket,
  Slot,
  ThreadMill,
  Measure,      ///< touches the work
  ThreadInfeed, ///< threads pass by pass beside a line along Z, each deeper than the one before
  Surface,      ///< mills a surface: at each place at another depth
  ThreadChain   ///< threads from place to place, pass by pass
};
llvm::StringRef toString(CycleKind kind); ///< as in the tables: "chip-break"
std::optional<CycleKind> parseCycleKind(llvm::StringRef text);

/// When a notice, a word requirement or a variant applies. Every part that is given must hold.
struct Condition {
  AddressMask has = 0;   ///< all of these addresses stand in the block
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
  AddressMask before = 0;            ///< one of these stands in front of the code
  AddressMask behind = 0;            ///< one of these stands behind the code
  std::optional<bool> spindleTurns;  ///< the spindle certainly turns, or stands, before the block
  std::vector<std::string> toolKind; ///< the tool in use is known to be one of these
  std::vector<std::string> otherToolKind; ///< … is known, and none of these
  Formula formula; ///< of the words of the code that the condition belongs to
};

/// A fact of the table that a rule reports as it stands.
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
  Relief
};
llvm::StringRef toString(Role role); ///< as in the tables: "peck-first"
std::optional<Role> parseRole(llvm::StringRef text);

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
  Required, ///< in every block with the code
  First     ///< in the block that makes the code active; later blocks keep the value
};

/// One word of a code's format, or several that stand for each other (`X|U`).
struct WordSpec {
  AddressMask any = 0;
  unsigned position = 0;   ///< from 1: an argument of the code's call instead; 0: not one
  uint64_t variable = 0;   ///< `variableKey` of a variable that the code reads instead; 0: none
  uint64_t orVariable = 0; ///< one that may stand for it; 0: none
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
  uint16_t number = 0; ///< number times ten plus the digit behind the point: G84.2 is 842
  GroupIndex group = noGroup;
  uint8_t bit = 0; ///< member number within the group
  Action action = Action::None;
  CycleKind cycle = CycleKind::None;
  FrameKind frame = FrameKind::None; ///< of frame-set and frame-add; None: nothing is known of it
  std::vector<FrameStep> frameSteps; ///< of a frame of steps, the outermost first
  Formula frameWhen;                 ///< the steps are right only then; empty: always
  Formula losesPlace;        ///< when it holds, no position is known behind the code; empty: never
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
  bool stopsSpindle = false;      ///< the spindle stands behind it, unless its block starts it
  bool ownMove = false;      ///< the block's move is the code's own, whatever motion is in force
  bool returns = false;      ///< the tool comes back to where the move began
  bool waits = false;        ///< a modal cycle that does not run in its own block
  bool cancelsCalls = false; ///< ends a modal call of a program too
  /// What runs behind moves runs behind a motion code without coordinates too.
  bool firesByMotionCode = false;
  bool isProgram = false;  ///< a program of the control: one of the same name hides it
  bool endsMotion = false; ///< no motion code is in force behind it
  bool foreign = false;    ///< another control's code: here it is none
  int32_t storedAt = 0;    ///< first variable of the place to which it leads or that it stores
  uint8_t arguments = 0;   ///< most arguments that its call takes; 0: not limited
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
  std::vector<Variant> variants; ///< first match wins; none: this entry
  CodeIndex base = noCode; ///< of a variant: the code that it belongs to; else the code itself
  SwitchEffect effect;
  CodeIndex opposite = noCode; ///< what ends or reverses it (G80 for G81), for messages and fixes
  std::string source;          ///< manual's file and line
};

/// Codes of which one at a time is active.
struct GroupInfo {
  std::string id; ///< "motion", "plane", "cycle", …; the names in `StandardGroup` have a meaning
  std::string title;
  std::vector<CodeIndex> members;
  uint8_t initial = 0xFF;   ///< member active at power-on; 0xFF: not documented
  bool exclusive = true;    ///< two members in one block are a conflict
  bool oneShot = false;     ///< its codes act in their own block only: the group has no state
  bool forgetsFeed = false; ///< a code of it that has no F beside it leaves no feed in force
};

/// Groups that the interpreter knows by name. A dialect may lack some and may have others.
enum class StandardGroup : uint8_t {
  Motion,
  Plane,
  Units,
  Distance,
  FeedMode,
  SpeedMode,
  Compensation,
  LengthOffset,
  Cycle,
  ReturnLevel,
  WorkOffset,
  PathMode,
  Polar,
  Rotation,
  Scaling,
  Mirror,
  MacroModal,
  Language,
  ArcDistance,
  Diameter,
  Spindle,
  Coolant,
  Program,
  Count
};
llvm::StringRef toString(StandardGroup group);

enum class AddressKind : uint8_t {
  Unknown,   ///< not an address of this control
  Axis,      ///< absolute (or by the distance mode) coordinate
  Increment, ///< incremental coordinate of another axis (U of X)
  Polar,     ///< angle or radius of an end point in the plane
  Element,   ///< name of a contour's element that another block defines
  Code,      ///< G or M
  Parameter, ///< everything else
  Number     ///< whole number by nature: N, O, L
};
enum class AddressUnit : uint8_t { None, Length, Angle, Feed, Speed, Time, Whole };

/// Axes of the machine state.
enum class Axis : uint8_t { X, Y, Z, A, B, C, U, V, W, Count };
constexpr unsigned axisCount = unsigned(Axis::Count);

struct AddressInfo {
  AddressKind kind = AddressKind::Unknown;
  AddressUnit unit = AddressUnit::None;
  Axis axis = Axis::Count;   ///< for axes and increments
  bool diameter = false;     ///< value is a diameter (X of a lathe)
  bool repeatable = false;   ///< may stand more than once in a block
  bool corner = false;       ///< asks for a chamfer or rounding to the next move
  bool rounding = false;     ///< … a rounding
  bool linesOnly = false;    ///< … between two straight lines only
  bool acrossCorner = false; ///< … a chamfer by its own length, not by that of its legs
  bool lineAngle = false;    ///< direction of a straight line
  uint8_t switches = 0xFF;   ///< index of the switch that a value other than zero turns on
  double least = -std::numeric_limits<double>::infinity(); ///< of its values
  double most = std::numeric_limits<double>::infinity();
  /// A length written without a decimal point may be scaled by the control.
  bool pointAdvised = false;
  std::string title;
};

/// Something that stays on until it is switched off, and which rule reports it when it is left on.
struct SwitchInfo {
  std::string id;     ///< "coolant", "mirror-x", …
  std::string title;  ///< "coolant", for messages
  std::string leftOn; ///< id of the rule that reports it at the program's end; empty: none
  std::optional<Severity> severity;
  bool atToolChange = false;  ///< also reported at a tool change
  bool survivesReset = false; ///< a reset code leaves it as it is
  std::string off;            ///< how to switch it off, for messages: "M09"
};

/// How expressions are read.
enum class Arithmetic : uint8_t {
  MacroB, ///< AND binds as a product, OR as a sum; both work on bits; FIX cuts off
  Ngc     ///< `**` first, AND OR XOR last and on truth; EQ within 0.0001; FIX rounds down; only a
          ///< bracket holds operators
};

/// Which numbered variables are whose. Those behind the common ones belong to the control.
struct VariableRanges {
  int32_t lastLocal = 33;   ///< `#1` up to here belong to the running program
  int32_t lastCommon = 999; ///< from there up to here all programs share them
  bool namedLocal = false;  ///< a variable with a name belongs to the running program
  int32_t place = 0; ///< of the tool's coordinates in the unit in force, X first; 0: there are none
  GroupIndex units = noGroup; ///< group of that unit
  uint64_t inch = 0;          ///< its members that are inches
};

/// Numbers of the variables in which a control keeps where its coordinates lie, in millimetres and
/// degrees: each the first of one for every axis, X first. Its programs may read and write them.
struct ZeroVariables {
  int32_t systems = 0;  ///< of the first work offset; 0: the control keeps them elsewhere
  int32_t step = 0;     ///< from one work offset to the next
  int32_t preset = 0;   ///< of the shift that lies over all work offsets
  int32_t presetOn = 0; ///< 1 where that shift is in force
  int32_t length = 0;   ///< of the length offset in force

  /// Behind the axes of a work offset: its angle in the XY plane.
  int32_t rotation(int32_t system) const { return systems + system * step + 9; }
};

/// How a control drills, where controls differ.
struct DrillingHabits {
  /// The initial level is the one at which a row of cycles began, not the single cycle.
  bool levelOfRow = false;
  /// Below the level of approach the tool first rises to it, and it withdraws no lower.
  bool risesFirst = false;
  /// Cycles that are fed out are fed to the level to which they withdraw.
  bool feedsOutToLevel = false;
};

enum class Semicolon : uint8_t { Comment, EndOfBlock };
enum class MachineKind : uint8_t { Lathe, Mill };

/// What the reader must know of the spelling.
struct Lexical {
  bool incrementOperator = false; ///< `XI-4`
  AddressMask commaAddresses = 0; ///< which of `,A ,C ,R` exist
  Semicolon semicolon = Semicolon::Comment;
  bool percentHeader = false; ///< `%O1234` is a program's first line
  bool macro = true;          ///< variables, expressions, IF, WHILE, GOTO are known
  bool structures = true; ///< FOR, WHILE, DEF and the like are known where the reader knows them
  /// O-words control the flow: `o100 sub`, `o<name> call [1]`, `o101 if [..]`; IF and GOTO do not.
  bool flowWords = false;
  /// Assignments take effect behind the words of their block.
  bool assignsBehind = false;
  bool freeNumbers = false; ///< blanks may stand in numbers, and block numbers may have decimals
  Arithmetic arithmetic = Arithmetic::MacroB;
  bool blocksSpanLines = false;    ///< a block ends where the next one begins, not with its line
  bool commaSeparates = false;     ///< commas separate arguments
  std::string headerMarks = "%O:"; ///< characters with which a program's first line may begin
  std::string endLabel;            ///< label that ends a repeated section; empty: there is none
  std::string abortMark;  ///< a comment that begins with it stops the program; empty: none does
  uint8_t skipLevels = 9; ///< block skip `/1` … `/9`; 1: plain `/` only
};

struct Limits {
  uint16_t blockLength = 0;    ///< characters; 0: not limited
  uint16_t structureDepth = 0; ///< structures in each other; 0: not limited
  uint16_t repeatDepth = 0;    ///< repeats in each other; 0: not limited
  uint16_t labelLength = 0;    ///< letters of a label that count; 0: all
  uint16_t nameLength = 0;     ///< letters of a program's name; 0: not limited
  uint16_t mCodesPerBlock = 0; ///< 0: not limited
  uint16_t callDepth = 0;      ///< levels below the main program; 0: not documented
  uint16_t programDigitsMin = 1;
  uint16_t programDigitsMax = 0; ///< 0: not limited
  std::vector<int> reservedPrograms;
};

/// Marks in a program's text or name that speak for a dialect.
struct DetectMark {
  std::string pattern; ///< POSIX extended regular expression, matched against single lines
  int score = 0;       ///< added once when any of the first lines matches
  std::string reason;  ///< "`G54.1 P` names an extended work offset", shown by --stats
};

/// Where a program itself says what radius compensation uses.
struct ToolRadiusSource {
  std::string variable;        ///< "$TC_DP6[{tool},{edge}]", "_RADIUS[{offset}]"; empty: nowhere
  uint8_t unknownWhile = 0xFF; ///< a switch that changes it by a stock; 0xFF: none
};

/// What a dialect says of a rule, over the rule's page.
struct RuleOverride {
  std::optional<Severity> severity;
  std::optional<bool> enabled;
  llvm::StringMap<double> numbers; ///< thresholds and other options of the rule
};

/// A whole control. Immutable after loading.
struct Dialect {
  std::string id;
  std::string title;
  std::string reader;    ///< "iso"
  bool abstract = false; ///< a base of others only
  MachineKind machine = MachineKind::Mill;
  bool toolChangeByT = false;       ///< the T word itself changes the tool; else M06 does
  bool profileRunsThrough = false;  ///< behind a roughing cycle the control runs the profile itself
  bool cycleSurvivesMotion = false; ///< a motion code does not end a drilling cycle
  bool emptyBlocksRun = false;      ///< an active cycle runs in blocks without words too
  bool callsModally = false;        ///< some code makes a program run behind every later move
  bool endReturns = false;          ///< a program end inside a called program leads back
  bool offsetsOfTool = false;       ///< length and radius belong to the tool, not to numbers
  bool dwellInMilliseconds = false; ///< a dwell time without a point counts in 1/1000 s
  ToolRadiusSource toolRadius;
  Lexical lexical;
  Limits limits;
  VariableRanges variableRanges;
  ZeroVariables zeros;
  DrillingHabits drilling;
  bool polarByDistance = false;  ///< under incremental distances, words of angle and radius add up
  bool dwellBesideMove = false;  ///< a block that dwells may move too
  bool loadsWhole = true;        ///< blocks that no way reaches are read all the same at the start
  bool localsBeginVacant = true; ///< false: a main program finds values of the one before it
  std::array<AddressInfo, addressCount> addresses;
  std::vector<std::string> addressNames; ///< names of addresses of several letters
  std::vector<GroupInfo> groups;
  /// Index of each standard group in `groups`, or `noGroup`.
  std::array<GroupIndex, unsigned(StandardGroup::Count)> standard;
  std::vector<CodeInfo> codes;
  std::vector<CodeIndex> gTable;       ///< by number * 10 + decimal; `noCode`: unknown
  std::vector<CodeIndex> mTable;       ///< by number
  llvm::StringMap<CodeIndex> keywords; ///< codes that are words of their own, in capitals
  std::vector<SwitchInfo> switches;
  std::vector<DetectMark> detect;
  std::vector<std::string> variableNames; ///< variables of the control with names of their own
  std::vector<std::string> axisVariables; ///< those that hold the name of an axis
  std::vector<std::string> readOnly;    ///< beginnings of names of variables that cannot be written
  std::vector<std::string> machineData; ///< … that hold for every later program
  std::vector<std::string> readAhead;   ///< … whose value the control reads too early
  std::vector<std::string> mainExtensions;       ///< file name endings of main programs
  std::vector<std::string> subprogramExtensions; ///< … and of subprograms
  std::vector<std::string> hiddenPrograms; ///< beginnings of names of the control's own programs
  std::vector<std::string> extensions;     ///< file name endings that speak for it, without the dot
  llvm::StringMap<RuleOverride> rules;
  llvm::StringMap<std::string> options; ///< options of the machine profile with their defaults
  AddressMask axisWords = 0;            ///< all addresses of kind Axis and Increment
  AddressMask incrementWords = 0;       ///< those of kind Increment
  AddressMask polarWords = 0;           ///< end points without coordinates: Polar, Element
  /// The tool change puts the tool's length in force: no code of this group is any more.
  GroupIndex lengthByTool = noGroup;
  AddressMask lineAngleWords = 0;           ///< give the direction of a line
  AddressMask elementWords = 0;             ///< those of kind Element
  AddressId arcRadius = letterAddress('R'); ///< the radius of an arc
  AddressId arcAngle = noAddress;           ///< its opening angle
  /// Coordinates of a point that it leads through, along X, Y and Z.
  std::array<AddressId, 3> arcThrough{noAddress, noAddress, noAddress};
  AddressMask speedLimitWords = 0; ///< set the greatest speed of the spindle
  AddressMask orientWords = 0;     ///< stop the spindle at an angle
  AddressMask switchWords = 0;     ///< turn a switch on or off
  AddressMask cornerWords = 0;     ///< ask for a chamfer or rounding
  AddressMask known = 0;           ///< all addresses of this control
  AddressMask repeatable = 0;      ///< may stand more than once in a block
  AddressMask whole = 0;           ///< take whole numbers
  AddressMask pointAdvised = 0;    ///< in some code at least, a decimal point is advised
  /// Axis words, codes and the words that always act by themselves (F, S, T, tool offsets).
  AddressMask plain = 0;
  /// File names and texts of the tables that this one was made of, base first: for `overlay`.
  std::vector<std::pair<std::string, std::string>> layers;

  GroupIndex group(StandardGroup which) const { return standard[unsigned(which)]; }
  bool isLathe() const { return machine == MachineKind::Lathe; }
  /// What a coordinate of the axis counts for a millimetre of way: 2 for a diameter, else 1.
  double lengthsPerUnit(Axis axis) const;
  /// The code `letter` with `number` times ten plus decimal, without looking at variants.
  CodeIndex find(char letter, uint32_t numberTimesTen) const {
    if (letter == 'G')
      return numberTimesTen < gTable.size() ? gTable[numberTimesTen] : noCode;
    if (numberTimesTen % 10)
      return noCode;
    return numberTimesTen / 10 < mTable.size() ? mTable[numberTimesTen / 10] : noCode;
  }
  /// A code by its name in the table ("G84.2", "M3" or "M03"); `noCode` when there is none.
  CodeIndex find(llvm::StringRef name) const;
  /// The code that is the word `text` itself, in capitals or not; `noCode` when there is none.
  CodeIndex keyword(llvm::StringRef text) const {
    if (keywords.empty())
      return noCode;
    const auto found = keywords.find(text.upper());
    return found == keywords.end() ? noCode : found->second;
  }
  /// Name of an address for messages: "X", ",R", "CR".
  std::string addressName(AddressId address) const;
  /// "X or U" from a mask.
  std::string alternatives(AddressMask mask) const;
};

} // namespace ncvet
