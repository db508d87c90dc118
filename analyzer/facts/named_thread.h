// The lead of a thread that a comment names: `M8X1.25`, `1/4-20`, `#10-32`.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/STLExtras.h"
#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringRef.h"

#include <cmath>
#include <optional>

namespace ncvet {

constexpr double inchInMillimetres = 25.4;

/// Takes an unsigned number from the front of the text.
inline std::optional<double> takeNumber(llvm::StringRef &text) {
  const llvm::StringRef digits =
      text.take_while([](char c) { return llvm::isDigit(c) || c == '.'; });
  double value = 0;
  if (digits.empty() || !llvm::isDigit(digits[0] == '.' ? digits.back() : digits[0]) ||
      digits.getAsDouble(value))
    return std::nullopt;
  text = text.drop_front(digits.size());
  return value;
}

/// Lead in millimetres of the first thread that the text names with its lead; none: it names none.
inline std::optional<double> namedLead(llvm::StringRef text) {
  constexpr double greatestThread = 100, greatestLead = 8, leastTurns = 4, mostTurns = 80;
  for (size_t i = 0; i < text.size(); ++i) {
    if (i && (llvm::isAlnum(text[i - 1]) || text[i - 1] == '.' || text[i - 1] == '/'))
      continue;
    llvm::StringRef rest = text.drop_front(i);
    if (rest.consume_front("M") || rest.consume_front("m")) {
      const auto size = takeNumber(rest);
      rest = rest.ltrim();
      if (!size || *size > greatestThread || rest.empty() ||
          !llvm::StringRef("xX*").contains(rest[0]))
        continue;
      rest = rest.drop_front().ltrim();
      const auto lead = takeNumber(rest);
      if (lead && *lead > 0 && *lead <= greatestLead && *lead < *size / 2)
        return lead;
      continue;
    }
    const bool numbered = rest.consume_front("#");
    const auto size = takeNumber(rest);
    if (!size || (!numbered && !rest.consume_front("/")) || (!numbered && !takeNumber(rest)) ||
        !rest.consume_front("-"))
      continue;
    const auto turns = takeNumber(rest);
    if (turns && *turns >= leastTurns && *turns <= mostTurns)
      return inchInMillimetres / *turns;
  }
  return std::nullopt;
}

/// Whether taps with the lead, in millimetres, are made: metric ones, and whole turns to the inch.
inline bool isUsualLead(double lead) {
  constexpr double metric[] = {0.2,  0.225, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.6, 0.7, 0.75, 0.8, 1,
                               1.25, 1.5,   1.75, 2,   2.5,  3,   3.5,  4,   4.5, 5,   5.5,  6};
  constexpr double turns[] = {80, 72, 64, 56, 48, 44,   40, 36, 32, 28, 27, 26, 24, 20,  19,
                              18, 16, 14, 13, 12, 11.5, 11, 10, 9,  8,  7,  6,  5,  4.5, 4};
  constexpr double rounding = 0.015;
  const auto near = [&](double usual) { return std::fabs(lead - usual) <= rounding * usual; };
  return llvm::any_of(metric, near) ||
         llvm::any_of(turns, [&](double each) { return near(inchInMillimetres / each); });
}

} // namespace ncvet
