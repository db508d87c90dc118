// A control's language as data: addresses, modal groups, codes, what each code does, and limits.
#pragma once

#include "formats/dialect/code.h"

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/SmallVector.h"
#include "llvm/ADT/StringMap.h"
#include "llvm/ADT/StringRef.h"

#include <memory>
#include <variant>

namespace ncvet {

constexpr unsigned maxGroups = 64;
constexpr unsigned maxSwitches = 32;

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
  bool repeatable = false;   ///< may occur more than once in a block
  bool corner = false;       ///< asks for a chamfer or rounding to the next move
  bool rounding = false;     ///< … a rounding
  bool linesOnly = false;    ///< … between two straight lines only
  bool acrossCorner = false; ///< … a chamfer by its own length, not by that of its legs
  bool lineAngle = false;    ///< direction of a straight line
  bool lineLength = false;   ///< length of one, beside its direction
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
  bool blocksAreData = false; ///< what blocks hold while it is on are data
  unsigned mostNamed = 0;     ///< things of its kind that are kept by name; 0: any number
  std::string off;            ///< how to switch it off, for messages: "M09"
};

/// How expressions are read.
enum class Arithmetic : uint8_t {
  MacroB,        ///< AND binds as a product, OR as a sum; both work on bits; FIX cuts off
  MacroB30,      ///< the same, with named variables `[#NAME]`, POW, AX, AXNUM and PRM
  MacroBDecimal, ///< as MacroB; a variable's number may have decimals
  Ngc ///< `**` first, AND OR XOR last and on truth; EQ within 0.0001; FIX rounds down; only a
      ///< bracket holds operators
};

/// Numbers of the variables in which a control keeps where its coordinates lie, in millimetres and
/// degrees: each the first of one for every axis, X first. Its programs may read and write them.
struct ZeroVariables {
  int32_t systems = 0;  ///< of the first work offset; 0: the control keeps them elsewhere
  int32_t step = 0;     ///< from one work offset to the next
  int32_t preset = 0;   ///< of the shift that lies over all work offsets
  int32_t presetOn = 0; ///< 1 where that shift is in force
  int32_t length = 0;   ///< of the length offset in force

  /// After the axes of a work offset: its angle in the XY plane.
  int32_t rotation(int32_t system) const { return systems + system * step + 9; }
};

/// A variable of the control that says what is in force: a value while a code is, or what `part`
/// names.
struct ShownVariable {
  enum class Part : uint8_t { Code, Tool, Feed, Speed, PlaceOnMachine };
  uint64_t key = 0; ///< number, or key of a name that all programs share
  Part part = Part::Code;
  GroupIndex group = noGroup;
  uint64_t member = 0; ///< bit of the code in its group
  double value = 0;    ///< while it is in force; of a place: number of the axis
};
/// Sorted by their keys.
using ShownVariables = std::vector<ShownVariable>;

/// Which numbered variables are whose. Those after the common ones belong to the control.
struct VariableRanges {
  int32_t lastLocal = 33;   ///< `#1` up to here belong to the running program
  int32_t lastCommon = 999; ///< from there up to here all programs share them
  bool namedLocal = false;  ///< a variable with a name belongs to the running program
  int32_t place = 0; ///< of the tool's coordinates in the unit in force, X first; 0: there are none
  GroupIndex units = noGroup;            ///< group of that unit
  uint64_t inch = 0;                     ///< its members that are inches
  const ShownVariables *shown = nullptr; ///< of the dialect; null: none
  ZeroVariables zeros;                   ///< likewise
};

/// How a control drills, where controls differ.
struct DrillingHabits {
  /// The initial level is the one at which a row of cycles began, not the single cycle.
  bool levelOfRow = false;
  /// Below the level of approach the tool first rises to it, and it withdraws no lower.
  bool risesFirst = false;
  /// Cycles that are fed out are fed to the level to which they withdraw.
  bool feedsOutToLevel = false;
  /// A last peck that only rounding leaves is made too.
  bool pecksExactly = false;
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
  /// Assignments take effect after the words of their block.
  bool assignsAfterWords = false;
  bool conditionFirst = false; ///< `[#100 LT 10] M99 P10`: a condition guards what is after it
  bool fileInComment = false;  ///< `M98 (PART.NC)`: the comment names what is called
  bool freeNumbers = false;    ///< numbers may have blanks, and block numbers may have decimals
  Arithmetic arithmetic = Arithmetic::MacroB;
  bool blocksSpanLines = false; ///< a block ends where the next one begins, not with its line
  bool commaSeparates = false;  ///< commas separate arguments
  bool indexedNames = false;    ///< `X1=10.`, `S2=500`: axes and spindles have names with an index
  bool namedPrograms = false;   ///< `<NAME>` heads a program, and calls name it so
  bool tapeLeader = false;      ///< what comes before the first `%` and a header is no code
  std::string headerMarks = "%O:"; ///< characters with which a program's first line may begin
  std::string endLabel;            ///< label that ends a repeated section; empty: there is none
  std::string abortMark; ///< a comment that begins with it stops the program; empty: none does
  std::string callMark;  ///< "L<": a call by name begins with it; empty: with the name itself
  std::vector<std::string> axisSwitches; ///< `SCC[X]`: names that give an axis a property, no value
  std::string foreignJump; ///< word of a jump in the other language that the control knows
  uint8_t skipLevels = 9;  ///< block skip `/1` … `/9`; 1: plain `/` only
};

struct Limits {
  uint16_t blockLength = 0;       ///< characters; 0: not limited
  uint16_t structureDepth = 0;    ///< structures in each other; 0: not limited
  uint16_t repeatDepth = 0;       ///< repeats in each other; 0: not limited
  uint16_t labelLength = 0;       ///< letters of a label that count; 0: all
  uint16_t nameLength = 0;        ///< letters of a program's name; 0: not limited
  uint16_t mCodesPerBlock = 0;    ///< 0: not limited
  uint16_t functionsPerBlock = 0; ///< of M, S, T, D and H together; 0: not limited
  uint16_t callDepth = 0;         ///< levels below the main program; 0: not documented
  /// Digits of a program's number in a call whose P has the count of runs before it
  /// (`P51000`); 0: P is the number alone.
  uint16_t packedCallDigits = 0;
  /// Programs from this number on, of four digits, belong to the machine's builder: they need not
  /// lie in the project. 0: none do.
  int32_t protectedPrograms = 0;
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
  std::string variable;  ///< "$TC_DP6[{tool},{edge}]", "_RADIUS[{offset}]"; empty: nowhere
  std::string allowance; ///< variable with a stock that is added to it; empty: none

  /// One of the variables that `variable` names: what is asked for often is worked out once.
  struct Place {
    std::string name;
    uint64_t key = 0;           ///< of the name, of a list's before its bracket
    bool isList = false;        ///< `_RADIUS[...]`
    bool isPlain = true;        ///< it names no field
    std::vector<uint64_t> keys; ///< by the number of its only field; those beyond are worked out
  };
  std::vector<Place> places;
  uint64_t allowanceKey = 0;
};

/// Value of an option of a rule: a number, 1 and 0 for true and false, or one of the option's
/// names.
using OptionValue = std::variant<double, std::string>;

/// What a dialect says of a rule, over the rule's page.
struct RuleOverride {
  std::optional<Severity> severity;
  std::optional<bool> enabled;
  std::string toldAs; ///< rule under whose name its findings are told; empty: its own
  llvm::StringMap<std::string> toldAt; ///< the same in blocks with a code, by its name
  bool uncalledStops = false;          ///< the control also stops in a body that it does not run
  llvm::StringMap<OptionValue> options;
};

struct ControlFacts; // formats/dialect/control_facts.h

/// One of the tables that a control's was made of.
struct TableLayer {
  std::string name; ///< of the file, for messages
  llvm::StringRef text;
  std::shared_ptr<const std::string> kept; ///< holds the text, unless that comes with the program
};

/// A whole control. Immutable after loading.
struct Dialect {
  std::string id;
  std::string title;
  std::string reader;    ///< "iso"
  bool abstract = false; ///< a base of others only
  MachineKind machine = MachineKind::Mill;
  bool toolChangeByT = false;       ///< the T word itself changes the tool; else M06 does
  bool profileRunsThrough = false;  ///< after a roughing cycle the control runs the profile itself
  bool cycleSurvivesMotion = false; ///< a motion code does not end a drilling cycle
  bool emptyBlocksRun = false;      ///< an active cycle runs in blocks without words too
  bool callsModally = false;        ///< some code makes a program run after every later move
  bool callsKeepModes = false;      ///< programs that are not known leave common modes as they are
  bool endReturns = false;          ///< a program end inside a called program leads back
  bool offsetsOfTool = false;       ///< length and radius belong to the tool, not to numbers
  bool dwellInMilliseconds = false; ///< a dwell time without a point counts in 1/1000 s
  ToolRadiusSource toolRadius;
  Lexical lexical;
  Limits limits;
  VariableRanges variableRanges;
  std::shared_ptr<ShownVariables> shown; ///< null: none
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
  std::vector<CodeIndex> gTable; ///< by number * 10 + decimal; `noCode`: unknown
  std::vector<CodeIndex> mTable; ///< by number
  std::string builderMacros; ///< the G code from whose number on unknown ones are macros; or empty
  CodeIndex builderMacro = noCode;     ///< its entry, which counts for all of them
  llvm::StringMap<CodeIndex> keywords; ///< codes that are words of their own, in capitals
  std::vector<SwitchInfo> switches;
  uint32_t dataSwitches = 0; ///< those whose blocks are data, by their bits
  std::vector<DetectMark> detect;
  std::vector<std::string> variableNames; ///< variables of the control with names of their own
  std::vector<std::string> axisVariables; ///< those that hold the name of an axis
  std::vector<std::string> readOnly; ///< beginnings of names of variables that cannot be written
  std::vector<int> readOnlyNumbers;  ///< first and last number of each range that cannot be written
  std::vector<std::string> machineData;          ///< … that hold for every later program
  std::vector<std::string> readAhead;            ///< … whose value the control reads too early
  std::vector<std::string> mainExtensions;       ///< file name endings of main programs
  std::vector<std::string> subprogramExtensions; ///< … and of subprograms
  std::vector<std::string> hiddenPrograms; ///< beginnings of names of the control's own programs
  std::vector<std::string> extensions;     ///< file name endings that speak for it, without the dot
  llvm::StringMap<RuleOverride> rules;
  std::shared_ptr<const ControlFacts> facts; ///< for rules; never null in a loaded dialect
  llvm::StringMap<std::string> options;      ///< options of the machine profile with their defaults
  AddressMask axisWords = 0;                 ///< all addresses of kind Axis and Increment
  AddressMask incrementWords = 0;            ///< those of kind Increment
  AddressMask polarWords = 0;                ///< end points without coordinates: Polar, Element
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
  AddressMask feedWords = 0;       ///< give a feed that stays, beside F
  AddressMask blockFeedWords = 0;  ///< give a feed of their own block
  AddressMask switchWords = 0;     ///< turn a switch on or off
  AddressMask cornerWords = 0;     ///< ask for a chamfer or rounding
  AddressMask known = 0;           ///< all addresses of this control
  AddressMask repeatable = 0;      ///< may occur more than once in a block
  AddressMask whole = 0;           ///< take whole numbers
  AddressMask pointAdvised = 0;    ///< in some code at least, a decimal point is advised
  /// Axis words, codes and the words that always act by themselves (F, S, T, tool offsets).
  AddressMask plain = 0;
  std::vector<TableLayer>
      layers; ///< the tables that this one was made of, base first: for `overlay`

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
