// Abstract values: intervals of numbers, and variables that may be vacant or unknown.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace ncvet {

/// What is known of a number: the closed interval [lo, hi]; unknown is [-inf, +inf].
struct Interval {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();

  static Interval exactly(double value) { return {value + 0.0, value + 0.0}; } // + 0.0: no -0
  static Interval unknown() { return {}; }

  bool isConstant() const { return lo == hi; }
  bool isUnknown() const { return std::isinf(lo) && std::isinf(hi) && lo < hi; }
  /// Both ends are finite.
  bool isBounded() const { return std::isfinite(lo) && std::isfinite(hi); }
  double value() const { return lo; } ///< of a constant
  bool contains(double value) const { return lo <= value && value <= hi; }

  friend bool operator==(const Interval &a, const Interval &b) {
    return a.lo == b.lo && a.hi == b.hi;
  }
};

Interval operator+(const Interval &a, const Interval &b);
Interval operator-(const Interval &a, const Interval &b);
Interval operator*(const Interval &a, double factor);
/// Smallest interval that holds both.
Interval join(const Interval &a, const Interval &b);
/// `next` joined to `previous`, with every bound that moved thrown open: chains of it end.
Interval widen(const Interval &previous, const Interval &next);

/// Value of a variable or an expression.
struct Value {
  enum class Kind : uint8_t { Vacant, Number, Unknown };
  Kind kind = Kind::Unknown;
  Interval number; ///< of kind Number

  static Value vacant() { return {Kind::Vacant, {}}; }
  static Value unknown() { return {Kind::Unknown, {}}; }
  static Value of(double value) { return {Kind::Number, Interval::exactly(value)}; }
  static Value of(Interval interval) {
    return interval.isUnknown() ? unknown() : Value{Kind::Number, interval};
  }

  bool isVacant() const { return kind == Kind::Vacant; }
  bool isConstant() const { return kind == Kind::Number && number.isConstant(); }
  /// The number; a vacant value counts as zero, as in arithmetic; unknown as everything.
  Interval asNumber() const {
    return kind == Kind::Number   ? number
           : kind == Kind::Vacant ? Interval::exactly(0)
                                  : Interval::unknown();
  }

  friend bool operator==(const Value &a, const Value &b) {
    return a.kind == b.kind && (a.kind != Kind::Number || a.number == b.number);
  }
};

Value join(const Value &a, const Value &b);
Value widen(const Value &previous, const Value &next);

/// Answer to a question about an abstract state.
enum class Truth : uint8_t { No, Yes, Unknown };

} // namespace ncvet
