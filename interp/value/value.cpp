// Abstract values: intervals of numbers, and variables that may be vacant or unknown.
#include "interp/value/value.h"

#include <algorithm>

namespace ncvet {

Interval operator+(const Interval &a, const Interval &b) { return {a.lo + b.lo, a.hi + b.hi}; }
Interval operator-(const Interval &a, const Interval &b) { return {a.lo - b.hi, a.hi - b.lo}; }

Interval operator*(const Interval &a, double factor) {
  if (factor == 0)
    return Interval::exactly(0);
  return factor > 0 ? Interval{a.lo * factor, a.hi * factor}
                    : Interval{a.hi * factor, a.lo * factor};
}

Interval join(const Interval &a, const Interval &b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

Interval widen(const Interval &previous, const Interval &next) {
  Interval result = previous;
  if (next.lo < previous.lo)
    result.lo = -std::numeric_limits<double>::infinity();
  if (next.hi > previous.hi)
    result.hi = std::numeric_limits<double>::infinity();
  return result;
}

Value join(const Value &a, const Value &b) {
  if (a == b)
    return a;
  if (a.kind == Value::Kind::Number && b.kind == Value::Kind::Number)
    return Value::of(join(a.number, b.number));
  return Value::unknown();
}

Value widen(const Value &previous, const Value &next) {
  if (previous == next)
    return previous;
  if (previous.kind == Value::Kind::Number && next.kind == Value::Kind::Number)
    return Value::of(widen(previous.number, next.number));
  return Value::unknown();
}

} // namespace ncvet
