// A block of a part program in the one form that all readers produce.
#pragma once

#include "formats/dialect/address.h"
#include "formats/dialect/variable_key.h"

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/SmallVector.h"
#include "llvm/ADT/StringRef.h"

#include <cstdint>
#include <optional>

namespace ncvet {

/// How a word was spelled.
enum WordFlag : uint8_t {
  wordPoint = 1,        ///< has a decimal point
  wordMinus = 2,        ///< begins with a minus
  wordPlus = 4,         ///< begins with a plus
  wordLeadingZero = 8,  ///< an integer part of several digits that begins with 0
  wordExpression = 16,  ///< the value is an expression: `Block::expressions[mantissa]`
  wordIncremental = 32, ///< marked as incremental by itself (`XI-4`)
  wordNoValue = 64,     ///< nothing comes after the address
  wordMalformed = 128   ///< the number was bad; its value is what could be read
};

/// How the value of a word counts when the word itself says so: Sinumerik's `X=IC(5)`.
enum class WordReading : uint8_t {
  Modal,          ///< as the modes have it
  Absolute,       ///< `AC(..)`
  Incremental,    ///< `IC(..)`
  RotaryShortest, ///< `DC(..)`
  RotaryPositive, ///< `ACP(..)`
  RotaryNegative  ///< `ACN(..)`
};

/// By the decimals of a number.
inline constexpr double powersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8, 1e9,
                                         1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18};

/// Address and number. The number is exact: mantissa * 10^-decimals.
struct Word {
  AddressId address = noAddress;
  uint8_t flags = 0;
  uint8_t decimals = 0; ///< of an expression: its `WordReading`
  uint8_t length = 0;   ///< bytes in the text, 255 for longer ones (see `Block::range(word)`)
  uint32_t offset = 0;  ///< first byte in the file
  int64_t mantissa = 0;

  bool has(WordFlag flag) const { return flags & flag; }
  /// True when the value is a number that is in the text.
  bool isNumber() const { return !(flags & (wordExpression | wordNoValue)); }
  /// Of a word with an expression: how its value counts.
  WordReading reading() const {
    return has(wordExpression) ? WordReading(decimals) : WordReading::Modal;
  }
  bool isWhole() const { return decimals == 0; }
  /// Value of a plain number.
  double value() const {
    // A division by an exact power of ten is rounded once: the value is the nearest double.
    return decimals ? double(mantissa) / powersOfTen[decimals] : double(mantissa);
  }
  /// Code number times ten (G84.2 is 842); larger than any code when it has more decimals.
  uint32_t codeNumber() const;
};
static_assert(sizeof(Word) == 16);

/// Operations of an expression in postfix order.
enum class Op : uint8_t {
  Number,
  Vacant,
  Variable,   ///< `value` is its key
  VariableAt, ///< takes its number from the stack
  ElementAt,  ///< of the array whose key is `value`; takes the index from the stack
  ElementKey, ///< the key of that element
  Opaque,     ///< a value that no program decides: a system variable, a string, a call; takes
              ///< `value` operands from the stack
  Add,
  Subtract,
  Multiply,
  Divide,
  Modulo,
  Negate,
  Power,
  Equal,
  NotEqual,
  Greater,
  GreaterEqual,
  Less,
  LessEqual,
  And,
  Or,
  Xor,
  Not,
  Sin,
  Cos,
  Tan,
  Asin,
  Acos,
  Atan,
  Atan2,
  Sqrt,
  Abs,
  Round,
  Fix,
  Fup,
  Ln,
  Exp,
  Bin,
  Bcd,
  Adp,
  IntegerDivide, ///< quotient without its fraction
  Truncate,      ///< towards zero
  Square,
  Minimum,
  Maximum,
  Floor,
  Ceiling,
  FloorModulo, ///< remainder that is never negative
  Exists,      ///< whether the variable whose key is `value` has been given a value
  Unknown
};

struct ExpressionOp {
  Op op = Op::Number;
  uint32_t offset = 0; ///< of the operator or operand in the file
  double value = 0;    ///< of a number; the number of a variable
};
static_assert(sizeof(ExpressionOp) == 16);

/// A range of `Block::operations`, and where it is.
struct Expression {
  uint32_t first = 0;
  uint32_t count = 0;
  uint32_t begin = 0;
  uint32_t end = 0;
  bool bad = false; ///< could not be read; its value is unknown
};

enum class ItemKind : uint8_t {
  Assignment,  ///< target = value
  Jump,        ///< GOTO value; or to one of its arguments, by `jump`
  If,          ///< condition of the jump or statement that follows in the block
  While,       ///< WHILE [condition] DO loop
  Do,          ///< DO loop without a condition
  End,         ///< END loop
  Output,      ///< POPEN, PCLOS, DPRNT, BPRNT: no effect on the program
  Structure,   ///< a bracket of structured flow, `structure` says which
  Call,        ///< program `name`, or the one that `value` names, `count` times
  Repeat,      ///< the blocks from its first argument to its second again, `count` times
  Input,       ///< the operator gives `target` a value, or leaves to the argument
  Instruction, ///< a keyword with arguments; its word in `Block::words` is number `wordsBefore`
  Parameters,  ///< what program `name` takes: each argument a name, with its default value
  Definition,  ///< variable `target`, of `type`, with its first `value`; arguments: array sizes
  Declaration, ///< program `name` exists and takes arguments of these types
  Macro,       ///< `name` means words
  Abort        ///< the program stops itself: `(abort, text)`
};

/// Types of the variables that a program defines.
enum class VariableType : uint8_t { None, Integer, Real, Boolean, Character, String, Axis, Frame };

/// Brackets of structured flow. They match by kind, and by label where they have one, and nest;
/// their blocks hold nothing else.
enum class Structure : uint8_t {
  If, ///< `condition`
  Else,
  EndIf,
  While, ///< `condition`
  EndWhile,
  For, ///< variable `target` from `value` to `limit` by one
  EndFor,
  Loop,
  EndLoop,
  Repeat, ///< runs again until the condition of its end holds
  Until,  ///< `condition`
  // With labels: a WHILE with the label of an open Repeat is its end, which leads back.
  ElseIf,   ///< `condition`
  Times,    ///< runs `value` times; `target` counts
  EndTimes, //
  Break,    ///< leaves the loop with its label
  Continue, ///< goes on with the test of the loop with its label
  Sub,      ///< a subprogram; flow passes it
  EndSub,   ///< returns, perhaps with `value`
  Return    ///< returns, perhaps with `value`
};

/// Whether it begins a bracket that another word ends. (A subprogram is none: flow passes it.)
constexpr bool opensBracket(Structure structure) {
  switch (structure) {
  case Structure::If:
  case Structure::While:
  case Structure::For:
  case Structure::Loop:
  case Structure::Repeat:
  case Structure::Times:
    return true;
  default:
    return false;
  }
}

/// Whether it ends such a bracket.
constexpr bool closesBracket(Structure structure) {
  switch (structure) {
  case Structure::EndIf:
  case Structure::EndWhile:
  case Structure::EndFor:
  case Structure::EndLoop:
  case Structure::Until:
  case Structure::EndTimes:
    return true;
  default:
    return false;
  }
}

/// Where a jump looks for its target, and which of its targets it takes.
enum class JumpKind : uint8_t {
  Anywhere, ///< after the jump, then from the program's begin
  Forward,
  Backward,
  IfFound, ///< as `Anywhere`; without a target the next block follows
  ToStart, ///< the program's begin
  BySign,  ///< three targets: `condition` below zero, zero, above zero; no path on after it
  ByValue  ///< arguments in pairs, a constant and its target, the last alone as default
};

constexpr uint16_t noExpression = 0xFFFF;

enum class ArgumentKind : uint8_t {
  Empty, ///< nothing between two separators
  Expression,
  Text,        ///< a string; the range is without its quotes
  Name,        ///< a symbol: an axis, a program, ON
  BlockNumber, ///< `expression` is the number of a block
  Label        ///< the range is the label's text without its marks
};

/// An argument of an item: of a call, an instruction, a jump.
struct Argument {
  ArgumentKind kind = ArgumentKind::Empty;
  char separator = 0;                     ///< before it; 0 for the first
  VariableType type = VariableType::None; ///< of a parameter
  bool byReference = false;               ///< a parameter that gives its value back
  uint16_t expression = noExpression;
  uint32_t begin = 0, end = 0;
  uint32_t nameBegin = 0, nameEnd = 0; ///< `AX` of `AX=XY`; equal: it has none
};

/// A statement of the block that is not a word. An assignment that is also a word
/// (`variableAddress`) begins where its word begins.
struct Item {
  ItemKind kind = ItemKind::Assignment;
  uint8_t loop = 0; ///< number after DO or END
  Structure structure = Structure::If;
  JumpKind jump = JumpKind::Anywhere;
  VariableType type = VariableType::None; ///< of a definition
  bool single = false;                    ///< a repeat of the one block that its argument names
  bool modal = false;                     ///< a call that is made after every later move, not here
  bool external = false;                  ///< a call of a program that need not lie beside this one
  bool restores = false;          ///< parameters of a program that gives its caller the modes back
  bool positional = false;        ///< a call whose arguments become `#1`, `#2`, …
  uint32_t label = 0;             ///< of a bracket: hash of its name or number; 0: it has none
  uint16_t wordsBefore = 0;       ///< words of the block before it
  uint16_t target = noExpression; ///< key of the variable assigned to
  uint16_t value = noExpression;  ///< value assigned, number jumped to, program called
  uint16_t condition = noExpression;         ///< of IF and WHILE, of a jump by sign or value
  uint16_t count = noExpression;             ///< how often a call or repeat runs
  uint16_t limit = noExpression;             ///< last value of a FOR
  uint16_t firstArgument = 0, arguments = 0; ///< in `Block::arguments`
  uint32_t begin = 0;
  uint32_t end = 0;
  uint32_t nameBegin = 0, nameEnd = 0; ///< of the called program, or of the jump's; equal: none
};

struct Comment {
  uint32_t begin = 0; ///< with its opening mark
  uint32_t end = 0;
  bool shown = false; ///< to the operator, where the control knows others as well
};

enum class SyntaxIssueKind : uint8_t {
  InvalidCharacter, ///< a character that the control cannot read
  TypographicMinus, ///< a dash that looks like a minus
  SymbolAsAddress,  ///< a symbol with a number, where an address letter is due
  MalformedNumber,  ///< two points, or a sign or point without a digit
  BlankInNumber,    ///< a blank between sign and digits
  DecimalComma,
  MissingValue,   ///< an address without a number
  MissingAddress, ///< a number without an address
  UnclosedComment,
  NestedComment,
  StrayParenthesis, ///< a `)` without its `(`
  UnbalancedBracket,
  BadExpression,
  BadStatement,
  UnknownWord,      ///< letters that are neither a keyword nor an address with a number
  ForeignComment,   ///< a comment in the manner of another control
  OutsideBlock,     ///< code before the first block start
  TypographicQuote, ///< a quote that the word processor made of `'` or `"`
  UnclosedString,
  MissingArgument, ///< an argument list that ends too early
  TooManyArguments,
  NamedArgument,       ///< `RTP=50` where only the place of an argument counts
  MisplacedLabel,      ///< a label that is not where labels are
  MissingEquals,       ///< an address of several letters, or a calculation, without its `=`
  AssignmentInTest,    ///< `=` where two values are compared
  AmbiguousExpression, ///< operators whose order is another than it looks
  RealForInteger,      ///< `T=R5`: a real value where a whole number is to be made of it
  BadName,             ///< a name that begins with a digit, or is a word of the language
  SkipInside,          ///< a block skip that is not at the start of its block
  UnknownAttribute,    ///< a word after the head of a program that is none of its attributes
  NoAction,            ///< a word of the path among the actions of a synchronised block
  NotABlock            ///< text of which no part is code: prose, or another language
};

/// Bad text in a block; reading went on after it.
struct SyntaxIssue {
  SyntaxIssueKind kind;
  uint32_t begin = 0;
  uint32_t end = 0;
};

enum class BlockKind : uint8_t {
  Normal,
  Empty,        ///< nothing but blanks and comments
  Tape,         ///< a `%` line
  ProgramHeader ///< `O1234`, `:1234`, `%O1234`, alone or with words after it
};

/// One block. The storage is reused from block to block: reading allocates nothing once the vectors
/// have grown.
struct Block {
  BlockKind kind = BlockKind::Normal;
  uint32_t begin = 0; ///< first byte
  uint32_t end = 0;   ///< after the last byte, its line end not counted
  uint32_t next = 0;  ///< first byte of the next block
  int8_t skip = -1;   ///< block skip: 0 for `/`, 1…9 for `/n`; -1: none
  bool lowerCase = false;
  bool tapeInside = false; ///< a `%` comes after other words
  bool numberIsFirst = true;
  int64_t number = -1; ///< block number; -1: none
  uint32_t numberBegin = 0, numberEnd = 0;
  int64_t program = -1; ///< number of a program header; -1: none or unreadable
  uint32_t headerBegin = 0, headerEnd = 0;
  uint32_t nameBegin = 0, nameEnd = 0;   ///< name in a program header; equal: none
  uint32_t labelBegin = 0, labelEnd = 0; ///< label without its marks; equal: none
  bool mainBlock = false;                ///< the number comes after `:` instead of N
  AddressMask addresses = 0;             ///< of `words`
  AddressMask repeated = 0;              ///< addresses that are more than once
  AddressMask pointed = 0;               ///< addresses of numbers with a decimal point
  AddressMask pointless = 0; ///< addresses of numbers other than 0 without a decimal point
  /// Addresses of which it was found, when the block was read over another one, that each of their
  /// words is a letter and a plain number; 0: it was not read so.
  AddressMask plain = 0;

  llvm::SmallVector<Word, 16> words; ///< without the block number and the program header
  llvm::SmallVector<Item, 2> items;
  llvm::SmallVector<Argument, 4> arguments; ///< of `items`
  llvm::SmallVector<Expression, 4> expressions;
  llvm::SmallVector<ExpressionOp, 16> operations;
  llvm::SmallVector<Comment, 2> comments;
  llvm::SmallVector<SyntaxIssue, 2> issues;
  /// Whether an earlier issue of the block is of the same kind: one report is enough.
  bool repeatsIssue(size_t index) const {
    return llvm::any_of(llvm::makeArrayRef(issues).take_front(index),
                        [&](const SyntaxIssue &other) { return other.kind == issues[index].kind; });
  }

  void clear();
  bool has(AddressId address) const { return addresses & maskOf(address); }
  bool hasAny(AddressMask mask) const { return addresses & mask; }
  /// First word with this address, or null.
  const Word *find(AddressId address) const;
  const Word *find(char letter) const { return find(letterAddress(letter)); }
  /// Word number `position` (from 1) among the arguments of the block's call, or null.
  const Word *argument(unsigned position) const;
  llvm::ArrayRef<Argument> argumentsOf(const Item &item) const {
    return llvm::makeArrayRef(arguments).slice(item.firstArgument, item.arguments);
  }
  /// The number that an expression is by itself; none: it is computed, absent, or cannot be read.
  std::optional<double> numberIn(uint16_t expression) const;
  /// Key of the variable that an expression names, when the text says it; 0: it does not.
  uint64_t keyOf(uint16_t expression) const;
  /// Key of the variable whose value an expression is; 0: it is something else.
  uint64_t variableOf(uint16_t expression) const;
  bool hasLabel() const { return labelEnd > labelBegin; }
  /// First word with one of these addresses, or null.
  const Word *findAny(AddressMask mask) const;
  /// Byte offset after the last byte of `word`.
  uint32_t endOf(const Word &word) const;
  /// True when nothing is in the block that a control would execute.
  bool isEmpty() const { return words.empty() && items.empty(); }
};

} // namespace ncvet
