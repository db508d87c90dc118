// What happens in a block: the events that execution emits and rules listen to.
#pragma once

#include "formats/readers/block.h"
#include "interp/state/state.h"

#include <cassert>

namespace ncvet {

enum class EventKind : uint8_t {
  Block,            ///< a block with content is executed
  Code,             ///< a G or M code of the table; `code`, `word`
  UnknownCode,      ///< a G or M code that is in no table; `word`
  ToolWord,         ///< a T word; `word`, `toolNumber()`
  ToolChange,       ///< the tool in use changes; `word` is the T word or the code, `tool()`
  FeedWord,         ///< F; `word`, `feed()`
  SpeedWord,        ///< S; `word`, `speed()`, `limitsSpeed()`
  OffsetWord,       ///< H or D; `word`, `offset()`
  Motion,           ///< axes move by one of the motion codes; `motion`, `axes`, `code`,
                    ///< `inMachineCoordinates()`
  CycleStart,       ///< a cycle becomes active, or is called; `code`
  CycleRun,         ///< a cycle executes; `code`, `axes`
  CycleCancel,      ///< an active cycle ends; `code` is the cycle, `by` what ended it
  CompensationMove, ///< the move that engages or cancels compensation; `code`: G41, G42 or G40
  CoordinateChange, ///< shift, work offset, transformation; `code`
  SpindleChange,    ///< M03, M04, M05, M19 and their like; `code`
  Dwell,            ///< `code`, `word`, `seconds()`
  Call,             ///< a subprogram or macro is called; `code`
  CallReturned,     ///< the called program came back: the state before the call, and after it
  Return,           ///< M99 and its like
  ProgramEnd,       ///< the program ends here: M30, M02, end of file
  Statement,        ///< an item of the block, before any of it is executed; `item()`
  Assignment,       ///< a variable is written; `variable()`
  UnsetRead,        ///< a variable that the program has not given a value is read; `place()`
  DomainError,      ///< a value outside a function's domain: division by zero, root of a negative;
                    ///< `place()`
  Syntax,           ///< the reader found something; `issue()`
  WordIssue,        ///< a word of the block wants a look; `wordIssue()`, `word` the first one
  FlowIssue,        ///< control cannot go where the block says; `flowIssue()`
  Count
};
static_assert(unsigned(EventKind::Count) <= 32);

constexpr uint32_t bitOf(EventKind kind) { return uint32_t(1) << unsigned(kind); }

/// What is odd about words of a block, told by their addresses alone.
enum class WordIssue : uint8_t {
  Unknown,      ///< no address of this control
  Repeated,     ///< the address is more than once
  NoPoint,      ///< a number without a decimal point where one may be advised
  PointInWhole, ///< a decimal point in a word that takes whole numbers
  SkipLevel,    ///< a block skip of a level that the control does not have
  NumberInside, ///< a block number after other words
  Special       ///< a word that only some codes take
};

/// What the engine finds when it follows calls, jumps and ends. The event's range is in
/// `RuleContext::flowRange`.
enum class FlowIssue : uint8_t {
  NoTarget,           ///< a call or jump names no target
  UnknownProgram,     ///< the called program is nowhere
  UnknownBlock,       ///< no block has the number that a jump, local call or return names
  Recursion,          ///< the called program is being executed already
  TooDeep,            ///< more levels of calls than the control allows
  ReturnInMain,       ///< a return code in a program that nobody called
  EndInSubprogram,    ///< a program end inside a called program
  MainRunsOut,        ///< the main program reaches the end of its text
  SubprogramRunsOut,  ///< a called program reaches the end of its text without a return
  RunsIntoSubprogram, ///< plain flow reaches blocks that are called as a local subprogram
  ProfileMissing,     ///< a profile's first or last block does not exist
  ProfileReversed,    ///< a profile's last block is before its first
  ProfileReached,     ///< plain flow runs into the blocks of a profile
  ComputedTarget,     ///< a target is computed and its value not known
  StructureMismatch,  ///< WHILE without END, END without DO
  StructureOpen,      ///< the same where the control does not look for the end: the body runs
  IntoStructure,      ///< a jump leads into a bracket of structured flow from outside
  RepeatBounds,       ///< a section that is repeated holds its own repeat, or ends before it begins
  RepeatOverlap,      ///< such a section holds a part of a bracket of structured flow
  RepeatSame,         ///< every further pass of a call does exactly what the first did
  TooManyArguments,   ///< a call has more arguments than the program takes; or it takes none
  ArgumentLeftOut,    ///< a parameter without a value of its own gets none
  ArgumentNotVariable, ///< a parameter gives its value back, and the argument is no variable
  ArgumentType,        ///< a text where the program takes a number
  NotDeclared,         ///< a program of another file is called with arguments, and not declared
  DeclarationMismatch, ///< the program takes other arguments than its declaration says
  DuplicateLabel,      ///< another bracket of structured flow carries the same label
  EndlessLoop          ///< the state repeats: the program never leaves a loop
};

enum class MotionKind : uint8_t { Rapid, Feed, ArcCw, ArcCcw, Thread, Skip, Reference };
constexpr uint8_t bitOf(MotionKind kind) { return uint8_t(1u << unsigned(kind)); }
constexpr bool isArc(MotionKind kind) {
  return kind == MotionKind::ArcCw || kind == MotionKind::ArcCcw;
}
/// A move along a line or an arc at the programmed feed.
constexpr bool isFeed(MotionKind kind) { return kind == MotionKind::Feed || isArc(kind); }

/// Something that happens in a block. Lives only while the block is looked at. What only some kinds
/// have is read by the functions; each asserts that the event is of a kind that has it.
struct Event {
  EventKind kind = EventKind::Block;
  MotionKind motion = MotionKind::Rapid;
  uint16_t axes = 0;       ///< bit per axis that the block programs
  CodeIndex code = noCode; ///< with its variant resolved
  CodeIndex by = noCode;
  bool certain = true; ///< false: it happens on some of the paths that the state represents
  const Word *word = nullptr;

  /// `Statement`: index in `Block::items`.
  size_t item() const { return size_t(number(bitOf(EventKind::Statement))); }
  /// `Syntax`: index in `Block::issues`.
  size_t issue() const { return size_t(number(bitOf(EventKind::Syntax))); }
  ncvet::WordIssue wordIssue() const {
    return ncvet::WordIssue(number(bitOf(EventKind::WordIssue)));
  }
  ncvet::FlowIssue flowIssue() const {
    return ncvet::FlowIssue(number(bitOf(EventKind::FlowIssue)));
  }
  /// `UnsetRead`, `DomainError`: offset in the text of the variable or the operator.
  uint32_t place() const { return uint32_t(number(hasPlace)); }
  /// `Assignment`: key of the variable; `notKnown` where the program computes which one it is.
  int64_t variable() const { return number(bitOf(EventKind::Assignment)); }
  /// `ToolChange`: the new tool; negative where it is not known.
  int64_t tool() const { return number(bitOf(EventKind::ToolChange)); }
  /// True for a `Motion` of one block in machine coordinates (G53); false for events of all other
  /// kinds.
  bool inMachineCoordinates() const { return kind == EventKind::Motion && number_ != 0; }
  /// `SpeedWord`: true when the word is the limit of the spindle speed, not a speed.
  bool limitsSpeed() const { return number(bitOf(EventKind::SpeedWord)) != 0; }

  /// `ToolWord`, `FeedWord`, `SpeedWord`, `OffsetWord`: the value of `word`.
  const Interval &wordValue() const { return value(hasWordValue); }
  /// `ToolWord`: as written, on a lathe with the digits of the offset (101 for T0101).
  const Interval &toolNumber() const { return value(bitOf(EventKind::ToolWord)); }
  /// `FeedWord`: in the unit of the active feed mode.
  const Interval &feed() const { return value(bitOf(EventKind::FeedWord)); }
  /// `SpeedWord`: in 1/min, or a cutting speed where the active mode takes one.
  const Interval &speed() const { return value(bitOf(EventKind::SpeedWord)); }
  /// `OffsetWord`: number of the offset.
  const Interval &offset() const { return value(bitOf(EventKind::OffsetWord)); }
  /// `Dwell`: the time; of no meaning without `word`.
  const Interval &seconds() const { return value(bitOf(EventKind::Dwell)); }

  void setItem(size_t index) { setNumber(bitOf(EventKind::Statement), int64_t(index)); }
  void setIssue(size_t index) { setNumber(bitOf(EventKind::Syntax), int64_t(index)); }
  void setWordIssue(ncvet::WordIssue issue) {
    setNumber(bitOf(EventKind::WordIssue), int64_t(issue));
  }
  void setFlowIssue(ncvet::FlowIssue issue) {
    setNumber(bitOf(EventKind::FlowIssue), int64_t(issue));
  }
  void setPlace(uint32_t offset) { setNumber(hasPlace, offset); }
  void setVariable(int64_t key) { setNumber(bitOf(EventKind::Assignment), key); }
  void setTool(int64_t tool) { setNumber(bitOf(EventKind::ToolChange), tool); }
  void setInMachineCoordinates() { setNumber(bitOf(EventKind::Motion), 1); }
  void setSpeed(const Interval &speed, bool limits) {
    setNumber(bitOf(EventKind::SpeedWord), limits);
    value_ = speed;
  }
  void setWordValue(const Interval &value) {
    assert(bitOf(kind) & hasWordValue);
    value_ = value;
  }
  void setSeconds(const Interval &time) {
    assert(kind == EventKind::Dwell);
    value_ = time;
  }

private:
  static constexpr uint32_t hasPlace = bitOf(EventKind::UnsetRead) | bitOf(EventKind::DomainError);
  static constexpr uint32_t hasWordValue = bitOf(EventKind::ToolWord) | bitOf(EventKind::FeedWord) |
                                           bitOf(EventKind::SpeedWord) |
                                           bitOf(EventKind::OffsetWord);

  int64_t number([[maybe_unused]] uint32_t kinds) const {
    assert(bitOf(kind) & kinds && "events of this kind have no such number");
    return number_;
  }
  const Interval &value([[maybe_unused]] uint32_t kinds) const {
    assert(bitOf(kind) & kinds && "events of this kind have no such value");
    return value_;
  }
  void setNumber([[maybe_unused]] uint32_t kinds, int64_t number) {
    assert(bitOf(kind) & kinds && "events of this kind have no such number");
    number_ = number;
  }

  int64_t number_ = 0;
  Interval value_;
};
static_assert(sizeof(Event) <= 48, "every block emits several");

/// A G or M code of the block, with its variant resolved.
struct CodeUse {
  CodeIndex code = noCode;
  const Word *word = nullptr;
};

enum class FlowKind : uint8_t {
  Next,      ///< on to the next block
  Jump,      ///< to block number `target`, or as `item` has it; `condition` says whether
  LoopBegin, ///< WHILE or DO number `loop`; `condition` says whether the body runs
  LoopEnd,   ///< END number `loop`
  Call,      ///< program `target`, `repeat` times
  Branch,    ///< an operator's input: on, or to the argument of `item`
  Structure, ///< a bracket of structured flow, `item`; `condition` as its kind asks
  Repeat,    ///< the blocks between the arguments of `item` again, `repeat` times
  CallNamed, ///< the program that `item` names, `repeat` times
  CallModal, ///< on to the next block; from here on a program runs after every move
  CallLocal, ///< blocks from number `target` to the next return, in this program
  Return,    ///< to the caller, at its block `target` when that is known
  End,       ///< the program ends
  Alarm,     ///< the program stops itself with an alarm
  Contour,   ///< a cycle reads the program that the flow's text names
  Profile    ///< a cycle reads the blocks `first` to `last`
};

/// How control leaves a block.
struct Flow {
  FlowKind kind = FlowKind::Next;
  Truth condition = Truth::Yes;
  uint8_t loop = 0;
  bool macro = false;  ///< a call with variables of its own
  bool packed = false; ///< the target may have the count of runs before the program's number
  int16_t item = -1;   ///< number of the block's item that says where to; -1: words say it
  CodeIndex code = noCode;
  const Word *word = nullptr;  ///< the word that names the target, or the code
  uint32_t begin = 0, end = 0; ///< where the flow is written, for messages
  Value target;
  Interval choice; ///< of a jump by sign or value: what decides
  Value repeat = Value::of(1);
  Value startAt = Value::vacant(); ///< block number at which the called program starts
  int64_t first = notSet, last = notSet;
  Variables arguments{Value::vacant()};
};

/// All that executing one block produced. The storage is reused.
struct Outcome {
  llvm::SmallVector<Event, 16> events;
  llvm::SmallVector<CodeUse, 8> codes;
  uint32_t kinds = 0; ///< bit per kind of event emitted
  Flow flow;
  bool setupChanged = false; ///< something besides `MotionState` may have changed
  /// Nothing but numbers for axes, under G00 or G01: the block changes positions, and facts.
  bool plainMove = false;
  Truth callsModally = Truth::No; ///< whether the modal call in force runs after this block
  bool foreign = false;           ///< the block is another control's language: nothing is known
  /// Blocks of the same number in one run do the same in the same modes but for their coordinates,
  /// and leave the same modes. 0: nothing is known of it.
  uint64_t known = 0;
  /// The point that the words give where the motion does not end there: on the path to the
  /// reference point, and of a line by its angle. Of no meaning in other blocks.
  std::array<Interval, axisCount> via;
  /// Places at which a drilling cycle runs in this block, one after the other.
  llvm::SmallVector<std::array<Interval, axisCount>, 1> holes;

  void clear() {
    events.clear();
    codes.clear();
    kinds = 0;
    if (flow.kind != FlowKind::Next)
      flow = Flow();
    holes.clear();
    setupChanged = false;
    plainMove = false;
    callsModally = Truth::No;
    foreign = false;
    known = 0;
  }
  Event &emit(EventKind kind) {
    kinds |= bitOf(kind);
    Event &event = events.emplace_back();
    event.kind = kind;
    return event;
  }
};

} // namespace ncvet
