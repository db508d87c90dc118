// The state of reading one Sinumerik block, and the grammar of its parts.
#pragma once

#include "formats/dialect/dialect.h"
#include "formats/readers/block_scanner.h"
#include "formats/readers/reader.h"
#include "formats/readers/sinumerik/sinumerik_expression.h"
#include "formats/readers/sinumerik/sinumerik_keyword.h"

#include <optional>

namespace ncvet {

/// Characters that do not print count as blanks, as those that punch tapes and old editors leave in
/// a text (Ctrl-Z, DC1, DC3); `&` does too.
constexpr bool isSinumerikBlank(char c) {
  return isLineBlank(c) || c == '&' || (uint8_t(c) < 0x20 && !isLineEnd(c));
}

/// Reads one block. Each part of the grammar has a file of its own.
class SinumerikScanner : BlockScanner<isSinumerikBlank> {
public:
  SinumerikScanner(const Reader &reader, const Dialect &dialect,
                   const llvm::StringMap<AddressId> &addresses, uint32_t offset, Block &block)
      : BlockScanner(reader.text(), offset, block), reader_(reader), dialect_(dialect),
        addresses_(addresses) {}

  void scan();

private:
  using Keyword = SinumerikKeyword;

  static bool isNameLetter(char c) { return isLetter(c) || c == '_'; }
  static bool isNameCharacter(char c) { return isNameLetter(c) || isNumberDigit(c); }

  /// Nothing but a comment is left of the block.
  bool atBlockEnd() const { return atLineEnd() || *at_ == ';'; }
  bool startsBlock() const { return block_.words.empty() && block_.items.empty(); }
  /// A single `=`, not the `==` of a comparison.
  bool isEquals(const char *p) const {
    return p < end_ && *p == '=' && (p + 1 == end_ || p[1] != '=');
  }
  llvm::StringRef identifier() const {
    const char *p = at_;
    while (p < end_ && isNameCharacter(*p))
      ++p;
    return {at_, size_t(p - at_)};
  }
  void rest() {
    while (!atBlockEnd())
      ++at_;
  }
  /// Steps over the current brackets, whatever they hold.
  void skipIndices() {
    if (at_ < end_ && *at_ == '[')
      while (!atBlockEnd() && *at_++ != ']')
        ;
  }
  uint16_t expression() { return parsed(&SinumerikExpression::parse); }
  uint16_t condition() { return parsed(&SinumerikExpression::parseCondition); }

  // sinumerik_reader.cpp
  CodeIndex codeNamed(llvm::StringRef name) const;
  bool isProse() const;
  void dropProse();
  void scanSkip();
  void scanItem();
  void scanComment();
  void scanHeader();
  bool isData(llvm::StringRef name) const;
  bool isFiled(const char *p) const;
  void skipUnit();
  bool scanLabel();
  bool scanBadName();
  void scanNumberOfBlock(const char *begin);
  void scanQuotes();
  void skipValue();
  void scanOther();

  // sinumerik_words.cpp
  void addExpression(AddressId address, const char *begin, uint16_t expression,
                     WordReading reading = WordReading::Modal);
  bool scanStart(char letter);
  void scanDistant(char letter, const char *begin);
  void scanLetter();
  void scanAfterLetter(char letter, const char *begin);
  void scanExtended(char letter, const char *begin);
  void scanValue(AddressId address, const char *begin);
  void scanIndexed(const char *begin, AddressId address);
  void scanPolynomial(const char *begin);
  uint16_t scanList();
  bool switchesAxis(const char *begin) const;
  bool givesParameters() const;
  bool isLetterForZero(llvm::StringRef name, const char *after) const;
  void letterForZero(llvm::StringRef name);
  bool scanNumber(Word &word, const char *begin);
  bool atDecimalComma() const;
  void scanAddress(AddressId address, const char *begin);
  void scanName();
  void scanAssignment(const char *begin, bool acting = false);
  void addValue(const Item &item);

  // sinumerik_calls.cpp
  std::optional<llvm::StringRef> scanString();
  void scanCode(CodeIndex code, llvm::StringRef name);
  void scanCall(llvm::StringRef name, Item &item);
  void scanArguments(Item &item, bool words);
  void scanQuoted(Argument &argument, unsigned mark);
  void scanText(Argument &argument);
  void scanArgument(Item &item, char separator, bool words);
  void scanModalCall(const char *begin, llvm::StringRef name);
  void scanIndirectCall(Keyword keyword, const char *begin);
  void scanSection(Item item);

  // sinumerik_flow.cpp
  void structure(Structure structure, const char *begin, uint16_t condition = noExpression);
  void scanStatement(Keyword keyword, const char *begin);
  bool scanPartedEnd(llvm::StringRef name);
  void scanIf(const char *begin);
  void scanJump(Keyword keyword, const char *begin);
  void scanTarget(Item &item);
  void scanCase(const char *begin);
  void scanFor(const char *begin);
  void scanRepeat(bool single, const char *begin);

  // sinumerik_definitions.cpp
  bool isTaken(llvm::StringRef name) const;
  VariableType scanType();
  void skipProperties();
  void scanSizes(Item &item, const char *begin);
  void scanDefinitions(const char *keyword);
  Argument scanParameter(char separator);
  void scanParameters(ItemKind kind, const char *begin);
  void scanParameterList(Item &item, const char *begin);
  void scanRedefinition(const char *begin);
  void scanMacro(const char *begin);

  // sinumerik_actions.cpp
  /// What a synchronised action does to the machine, as far as it matters.
  struct Deeds {
    bool turns = false; ///< it may start or stop a spindle
  };
  void addKeyword(llvm::StringRef name);
  bool addActing(llvm::StringRef name);
  void scanProgram(llvm::StringRef name);
  void scanSynchronised(Keyword keyword, const char *begin);
  void scanActionCondition(Item &item);
  bool mayTurnSpindle(llvm::StringRef number) const;
  void scanAction(Deeds &deeds);
  bool scanActionValue(llvm::StringRef name, const char *begin);

  const Reader &reader_;
  const Dialect &dialect_;
  const llvm::StringMap<AddressId> &addresses_;
};

} // namespace ncvet
