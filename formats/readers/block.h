// A block of a part program in the one form that all readers produce.
#pragma once

#include "formats/dialect/address.h"

#include "llvm/ADT/SmallVector.h"
#include "llvm/ADT/StringRef.h"

#include <cstdint>

namespace ncvet {

/// How a word was spelled.
enum WordFlag : uint8_t {
  wordPoint = 1,        ///< has a decimal point
  wordMinus = 2,        ///< begins with a minus
  wordPlus = 4,         ///< begins with a plus
  wordLeadingZero = 8,  ///< an integer part of several digits that begins with 0
  wordExpression = 16,  ///< the value is an expression: `Block::expressions[mantissa]`
  wordIncremental = 32, ///< marked as incremental by itself (`XI-4`)
  wordNoValue = 64,     ///< nothing stands behind the address
  wordMalformed = 128   ///< the number was bad; its value is what could be read
};

/// Address and number. The number is exact: mantissa * 10^-decimals.
struct Word {
  AddressId address = noAddress;
  uint8_t flags = 0;
  uint8_t decimals = 0;
  uint8_t length = 0;  ///< bytes in the text, 255 for longer ones (see `Block::range(word)`)
  uint32_t offset = 0; ///< first byte in the file
  int64_t mantissa = 0;

  bool has(WordFlag flag) const { return flags & flag; }
  /// True when the value is a number that stands in the text.
  bool isNumber() const { return !(flags & (wordExpression | wordNoValue)); }
  bool isWhole() const { return decimals == 0; }
  /// Value of a plain number.
  double value() const;
  /// Code number times ten (G84.2 is 842); larger than any code when it has more decimals.
  uint32_t codeNumber() const;
};
static_assert(sizeof(Word) == 16);

/// Operations of an expression in postfix order.
enum class Op : uint8_t {
  Number,
  Vacant,
  Variable,
  VariableAt,
  NamedVariable, // VariableAt takes its number from the stack
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
  Unknown
};

struct ExpressionOp {
  Op op = Op::Number;
  uint32_t offset = 0; ///< of the operator or operand in the file
  double value = 0;    ///< of a number; the number of a variable
};
static_assert(sizeof(ExpressionOp) == 16);

/// A range of `Block::operations`, and where it stands.
struct Expression {
  uint32_t first = 0;
  uint32_t count = 0;
  uint32_t begin = 0;
  uint32_t end = 0;
  bool bad = false; ///< could not be read; its value is unknown
};

enum class ItemKind : uint8_t {
  Assignment, ///< target = value
  Jump,       ///< GOTO value
  If,         ///< condition of the jump or statement that follows in the block
  While,      ///< WHILE [condition] DO loop
  Do,         ///< DO loop without a condition
  End,        ///< END loop
  Output      ///< POPEN, PCLOS, DPRNT, BPRNT: no effect on the program
};

constexpr uint16_t noExpression = 0xFFFF;

/// A statement of the block that is not a word.
struct Item {
  ItemKind kind = ItemKind::Assignment;
  uint8_t loop = 0;                  ///< number behind DO or END
  uint16_t wordsBefore = 0;          ///< words of the block in front of it
  uint16_t target = noExpression;    ///< variable number assigned to
  uint16_t value = noExpression;     ///< value assigned, or number jumped to
  uint16_t condition = noExpression; ///< of IF and WHILE
  uint32_t begin = 0;
  uint32_t end = 0;
};

struct Comment {
  uint32_t begin = 0; ///< with its opening mark
  uint32_t end = 0;
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
  UnknownWord, ///< letters that are neither a keyword nor an address with a number
  NotABlock    ///< text of which no part is code: prose, or another language
};

/// Bad text in a block; reading went on behind it.
struct SyntaxIssue {
  SyntaxIssueKind kind;
  uint32_t begin = 0;
  uint32_t end = 0;
};

enum class BlockKind : uint8_t {
  Normal,
  Empty,        ///< nothing but blanks and comments
  Tape,         ///< a `%` line
  ProgramHeader ///< `O1234`, `:1234`, `%O1234`, alone or with words behind it
};

/// One block. The storage is reused from block to block: reading allocates nothing once the vectors
/// have grown.
struct Block {
  BlockKind kind = BlockKind::Normal;
  uint32_t begin = 0; ///< first byte
  uint32_t end = 0;   ///< behind the last byte, its line end not counted
  uint32_t next = 0;  ///< first byte of the next block
  int8_t skip = -1;   ///< block skip: 0 for `/`, 1…9 for `/n`; -1: none
  bool lowerCase = false;
  bool tapeInside = false; ///< a `%` stands behind other words
  bool numberIsFirst = true;
  int64_t number = -1; ///< block number; -1: none
  uint32_t numberBegin = 0, numberEnd = 0;
  int64_t program = -1; ///< number of a program header; -1: none or unreadable
  uint32_t headerBegin = 0, headerEnd = 0;
  AddressMask addresses = 0; ///< of `words`
  AddressMask repeated = 0;  ///< addresses that stand more than once
  AddressMask pointed = 0;   ///< addresses of numbers with a decimal point
  AddressMask pointless = 0; ///< addresses of numbers other than 0 without a decimal point

  llvm::SmallVector<Word, 16> words; ///< without the block number and the program header
  llvm::SmallVector<Item, 2> items;
  llvm::SmallVector<Expression, 4> expressions;
  llvm::SmallVector<ExpressionOp, 16> operations;
  llvm::SmallVector<Comment, 2> comments;
  llvm::SmallVector<SyntaxIssue, 2> issues;

  void clear();
  bool has(AddressId address) const { return addresses & maskOf(address); }
  bool hasAny(AddressMask mask) const { return addresses & mask; }
  /// First word with this address, or null.
  const Word *find(AddressId address) const;
  const Word *find(char letter) const { return find(letterAddress(letter)); }
  /// First word with one of these addresses, or null.
  const Word *findAny(AddressMask mask) const;
  /// Byte offset behind the last byte of `word`.
  uint32_t endOf(const Word &word) const;
  /// True when nothing stands in the block that a control would execute.
  bool isEmpty() const { return words.empty() && items.empty(); }
};

} // namespace ncvet
