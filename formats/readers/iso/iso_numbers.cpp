// Numbers of word-address blocks that are not as usual: a plus, blanks, a comma, too many digits.
#include "formats/readers/iso/iso_scanner.h"

namespace ncvet {

/// The digits of a number, as many as it holds.
struct IsoScanner::Mantissa {
  uint64_t value = 0;
  unsigned digits = 0; ///< leading zeros do not count

  bool isFull() const { return digits >= maxNumberDigits; }
  void take(char digit) {
    value = value * 10 + unsigned(digit - '0');
    digits += value != 0;
  }
};

/// Reads `[sign] digits [. digits]`; false when there is no digit at all.
bool IsoScanner::scanNumber(Word &word, const char *begin) {
  if (scanPlainNumber(word))
    return true;
  const bool negative = takeSign(word, begin);
  Mantissa mantissa;
  const bool whole = takeWholePart(word, mantissa);
  const bool any = takeFraction(word, begin, mantissa) || whole;
  const auto isSign = [](char c) { return c == '-' || c == '+'; };
  if (at_ < end_ && (*at_ == '.' || (any && isSign(*at_) && at_ + 1 < end_ &&
                                     (isNumberDigit(at_[1]) || at_[1] == '.')))) {
    // A second point or sign: one report up to the next address.
    skipNumberCharacters();
    issue(SyntaxIssueKind::MalformedNumber, begin, at_);
    word.flags |= wordMalformed;
  } else if (!any) {
    issue(SyntaxIssueKind::MalformedNumber, begin, at_);
  }
  if (!any)
    return false;
  word.mantissa = negative ? -int64_t(mantissa.value) : int64_t(mantissa.value);
  return true;
}

/// The sign and the blanks after it; whether it is a minus.
bool IsoScanner::takeSign(Word &word, const char *begin) {
  const bool negative = takeSignMark(word);
  if (word.flags & (wordMinus | wordPlus))
    takeBlanksAfterSign(begin, /*allowed=*/lexical_.freeNumbers);
  return negative;
}

/// The digits before the point; false when there is none.
bool IsoScanner::takeWholePart(Word &word, Mantissa &mantissa) {
  const char *const first = at_;
  unsigned count = 0;
  for (; at_ < end_ && isNumberDigit(*at_); ++count) {
    if (mantissa.isFull())
      word.flags |= wordMalformed;
    else
      mantissa.take(*at_);
    ++at_;
    passBlanksInNumber();
  }
  if (count > 1 && *first == '0')
    word.flags |= wordLeadingZero;
  return count > 0;
}

/// The point, which may be a comma before a digit, and the digits after it; false when there is
/// none. Those that the mantissa does not hold are dropped.
bool IsoScanner::takeFraction(Word &word, const char *begin, Mantissa &mantissa) {
  const bool comma = commaFraction();
  if (at_ == end_ || (*at_ != '.' && !comma))
    return false;
  if (comma) {
    // A decimal comma: read as it was meant.
    const char *p = at_ + 1;
    while (p < end_ && isNumberDigit(*p))
      ++p;
    issue(SyntaxIssueKind::DecimalComma, begin, p);
  }
  word.flags |= wordPoint;
  ++at_;
  passBlanksInNumber();
  bool any = false;
  unsigned decimals = 0;
  for (; at_ < end_ && isNumberDigit(*at_); any = true) {
    if (!mantissa.isFull() && decimals < maxNumberDigits) {
      mantissa.take(*at_);
      ++decimals;
    }
    ++at_;
    passBlanksInNumber();
  }
  word.decimals = uint8_t(decimals);
  return any;
}

/// Steps over blanks before a further digit or point.
void IsoScanner::passBlanksInNumber() {
  if (continuesAfterBlanks(at_))
    skipBlanks();
}

} // namespace ncvet
