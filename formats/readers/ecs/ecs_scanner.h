// The state of reading one ECS block, and the grammar of its parts.
#pragma once

#include "formats/dialect/dialect.h"
#include "formats/readers/block_scanner.h"
#include "formats/readers/ecs/ecs_expression.h"

namespace ncvet {

/// Reads one block. Each part of the grammar has a file of its own.
class EcsScanner : BlockScanner<> {
public:
  EcsScanner(const Dialect &dialect, const llvm::StringMap<AddressId> &addresses,
             llvm::StringRef text, uint32_t offset, Block &block)
      : BlockScanner(text, offset, block), dialect_(dialect), addresses_(addresses) {}

  void scan();

private:
  static bool isNameCharacter(char c) { return isLetter(c) || isNumberDigit(c); }
  /// Bytes of a typographic quotation mark in UTF-8: U+2018 to U+201E; 0: none. `comment` says
  /// whether it means the one that opens a comment.
  static unsigned typographicQuote(const char *at, const char *end, bool &comment);
  /// The name of a program, perhaps with its folder before it and blanks after it.
  static llvm::StringRef withoutFolder(llvm::StringRef path);

  bool startsBlock() const { return block_.words.empty() && block_.items.empty(); }
  llvm::StringRef name() const {
    const char *p = at_;
    while (p < end_ && *p == '%' && p - at_ < 2)
      ++p;
    while (p < end_ && isNameCharacter(*p))
      ++p;
    return {at_, size_t(p - at_)};
  }
  uint16_t expression() { return parsed(&EcsExpression::parse); }
  /// `<expr>`; the cursor is at the bracket.
  uint16_t bracketed() {
    const char *const begin = at_++;
    const uint16_t index = expression();
    closeAngle(begin);
    return index;
  }
  /// The expression that `word` has goes on to here.
  void extendExpression(const Word &word) {
    if (word.has(wordExpression) && size_t(word.mantissa) < block_.expressions.size()) {
      uint32_t &end = block_.expressions[size_t(word.mantissa)].end;
      end = std::max(end, offset(at_));
    }
  }
  void add(Item &item) {
    item.arguments = uint16_t(block_.arguments.size() - item.firstArgument);
    BlockScanner::add(item);
  }

  // ecs_reader.cpp
  void scanItem();
  bool takesPlaces(CodeIndex code) const;
  bool beginsNextBlock();
  void scanLineComment(unsigned mark);
  void scanComment(char close);
  void scanLabel();
  void scanReset();
  void scanPhase();
  void scanOther();

  // ecs_words.cpp
  void keyword(CodeIndex code, const char *begin, const char *end);
  bool scanNumberOfBlock(const char *begin);
  bool scanRun();
  void scanLetter();
  void scanPlane(const char *begin);
  bool skipVariantName(const char *begin);
  void scanExpression(AddressId address, const char *begin);
  bool isReal(uint16_t index, llvm::StringRef text) const;
  void scanValue(AddressId address, const char *begin);
  bool scanNumber(Word &word, const char *begin);
  void scanElement(const char *begin);
  void scanAssignment(const char *begin);

  // ecs_instructions.cpp
  void closeAngle(const char *begin);
  void skipToAngle() {
    while (!atLineEnd() && *at_ != '>')
      ++at_;
  }
  void scanAngle();
  bool isInstruction(llvm::StringRef name) const;
  bool isVariable(llvm::StringRef name) const;
  void scanVariable(const char *begin, llvm::StringRef name);
  void scanInstruction(const char *begin, llvm::StringRef name);
  void argumentWord(const Argument &argument);
  llvm::SmallVector<Argument, 8> inOrder(llvm::ArrayRef<Argument> written, const CodeInfo &code);
  Argument scanPrompt();
  void scanInput(const char *begin);
  void scanCall(const char *begin);

  // ecs_arguments.cpp
  /// Whether an argument ends at `p`.
  bool endsArgument(const char *p) const {
    return p == end_ || isLineEnd(*p) || *p == '>' || *p == ';' || *p == ',';
  }
  char scanSeparator();
  void scanString(Argument &argument);
  Argument scanTarget(char separator);
  Argument scanArgument(char separator, bool named = false);
  llvm::StringRef scanProgramName();
  void tooManyArguments(const char *begin);

  // ecs_flow.cpp
  char scanOtherProgram(Item &item, const char *begin);
  void scanJump(const char *begin, bool other);
  void missingColon(const char *begin);
  void scanChoice(const char *begin, bool other);
  void scanRepeat(const char *begin);

  const Dialect &dialect_;
  const llvm::StringMap<AddressId> &addresses_;
};

} // namespace ncvet
