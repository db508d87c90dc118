// The state of reading one MEFI block, and the grammar of its parts.
#pragma once

#include "formats/dialect/dialect.h"
#include "formats/readers/block_scanner.h"

namespace ncvet {

/// Between words: a block goes on over the ends of lines.
inline bool isMefiGap(char c) { return isLineBlank(c) || isLineEnd(c); }

/// Reads one block. Each part of the grammar has a file of its own.
class MefiScanner : BlockScanner<isMefiGap> {
public:
  MefiScanner(const Dialect &dialect, llvm::StringRef text, uint32_t offset, Block &block)
      : BlockScanner(text, offset, block), dialect_(dialect) {}

  void scan();

private:
  static bool isNameLetter(char c) { return isLetter(c) || c == '_'; }
  static bool isNameCharacter(char c) { return isNameLetter(c) || isNumberDigit(c); }

  llvm::StringRef rest() const { return {at_, size_t(end_ - at_)}; }
  /// The place after the blanks at `p`; the line goes on there.
  const char *afterLineBlanks(const char *p) const {
    while (p < end_ && (*p == ' ' || *p == '\t'))
      ++p;
    return p;
  }
  void skipLineBlanks() { at_ = afterLineBlanks(at_); }
  llvm::StringRef takeName() {
    const llvm::StringRef name = rest().take_while(isNameCharacter);
    at_ = name.end();
    return name;
  }
  /// A letter N that no name holds and no name begins with.
  bool startsBlock() const {
    return at_ < end_ && (*at_ == 'N' || *at_ == 'n') && (at_ + 1 == end_ || !isNameLetter(at_[1]));
  }

  // mefi_reader.cpp
  void scanNumberOfBlock();
  void scanItem();
  void scanComment();
  void scanOther();
  void finish();

  // mefi_words.cpp
  void scanWord();
  bool scanParameter();
  bool isParameter(llvm::StringRef name) const;
  bool scanLetterNumber();
  void scanAssignment(llvm::StringRef name);
  uint16_t keyOf(llvm::StringRef name);
  uint16_t valueOf(const Word &word);

  // mefi_numbers.cpp
  bool scanNumber(Word &word, const char *begin, bool commaIsPoint = true);
  bool takeDash();
  unsigned takeDigits(Word &word, int64_t &mantissa, unsigned most);
  void takePoint(Word &word, const char *begin, int64_t &mantissa, unsigned most,
                 bool commaIsPoint);
  bool numberGoesOn(bool commaIsPoint) const;
  bool readsAsZero(const char *p) const;

  // mefi_names.cpp
  void scanName();
  CodeIndex codeNamed(llvm::StringRef name, const char *after) const;
  void scanCall(llvm::StringRef name);
  Word scanArgument(Argument &argument);

  const Dialect &dialect_;
  const char *content_ = nullptr; ///< after the last byte that is no blank
  bool leading_ = false;          ///< is before the first N
};

} // namespace ncvet
