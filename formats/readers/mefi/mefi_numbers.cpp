// Numbers of MEFI blocks.
#include "formats/readers/mefi/mefi_scanner.h"

namespace ncvet {

namespace {

/// Dashes that look like a minus: U+2010 to U+2015 and U+2212 in UTF-8, the two of Windows.
constexpr llvm::StringLiteral dashes[] = {"\xE2\x80\x90", "\xE2\x80\x91", "\xE2\x80\x92",
                                          "\xE2\x80\x93", "\xE2\x80\x94", "\xE2\x80\x95",
                                          "\xE2\x88\x92", "\x96",         "\x97"};

} // namespace

/// `[sign] digits [. digits]`; false, with nothing read, when there is no digit. `begin` is the
/// word's begin.
bool MefiScanner::scanNumber(Word &word, const char *begin, bool commaIsPoint) {
  const char *const from = at_;
  bool negative = takeDash();
  if (!negative && at_ < end_ && (*at_ == '-' || *at_ == '+')) {
    negative = *at_++ == '-';
    if (!negative)
      word.flags |= wordPlus;
  }
  const char *const sign = at_;
  while (sign > from && at_ < end_ && (*at_ == '-' || *at_ == '+'))
    ++at_;
  const char *const first = at_;
  int64_t mantissa = 0;
  const unsigned whole = takeDigits(word, mantissa, maxNumberDigits);
  takePoint(word, begin, mantissa, maxNumberDigits - whole, commaIsPoint);
  if (whole + word.decimals == 0) {
    at_ = from;
    return false;
  }
  const bool goesOn = numberGoesOn(commaIsPoint);
  while (numberGoesOn(commaIsPoint) || (goesOn && at_ < end_ && isNumberDigit(*at_)))
    ++at_;
  if (goesOn || first > sign) {
    issue(SyntaxIssueKind::MalformedNumber, begin, at_);
    word.flags |= wordMalformed;
  }
  if (negative)
    word.flags |= wordMinus;
  if (whole > 1 && *first == '0')
    word.flags |= wordLeadingZero;
  word.mantissa = negative ? -mantissa : mantissa;
  return true;
}

/// A dash of a word processor instead of the minus; false when there is none.
bool MefiScanner::takeDash() {
  for (const llvm::StringRef dash : dashes)
    if (rest().startswith(dash)) {
      issue(SyntaxIssueKind::TypographicMinus, at_, at_ + dash.size());
      at_ += dash.size();
      return true;
    }
  return false;
}

/// Digits, of which those after `most` are dropped; how many count.
unsigned MefiScanner::takeDigits(Word &word, int64_t &mantissa, unsigned most) {
  unsigned count = 0;
  for (; at_ < end_ && isNumberDigit(*at_); ++at_)
    if (count < most) {
      mantissa = mantissa * 10 + (*at_ - '0');
      ++count;
    } else {
      word.flags |= wordMalformed;
    }
  return count;
}

/// The point, or the comma that means one, and the decimals after it.
void MefiScanner::takePoint(Word &word, const char *begin, int64_t &mantissa, unsigned most,
                            bool commaIsPoint) {
  const bool comma = commaIsPoint && at_ + 1 < end_ && *at_ == ',' && isNumberDigit(at_[1]);
  if (at_ == end_ || (*at_ != '.' && !comma))
    return;
  ++at_;
  word.decimals = uint8_t(takeDigits(word, mantissa, most));
  word.flags |= wordPoint;
  if (comma)
    issue(SyntaxIssueKind::DecimalComma, begin, at_);
}

/// A second point or sign is here, or the letter O for a zero.
bool MefiScanner::numberGoesOn(bool commaIsPoint) const {
  return at_ < end_ && (*at_ == '.' || *at_ == '-' || *at_ == '+' ||
                        (commaIsPoint && *at_ == ',') || readsAsZero(at_));
}

/// A letter O among the digits of a number, up to whose end nothing but O, digits and a point
/// are.
bool MefiScanner::readsAsZero(const char *p) const {
  if (p >= end_ || (*p != 'O' && *p != 'o') ||
      dialect_.addresses[letterAddress('O')].kind != AddressKind::Unknown)
    return false;
  while (p < end_ && (*p == 'O' || *p == 'o' || *p == '.' || isNumberDigit(*p)))
    ++p;
  return p == end_ || (!isNameLetter(*p) && *p != '=' && *p != '(');
}

} // namespace ncvet
