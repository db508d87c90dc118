// The operators of all expressions: how many operands each takes, what it makes of them, and when
// it cannot.
#include "interp/evaluate/operators.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ncvet {

namespace {

constexpr double radiansPerDegree = std::numbers::pi / 180;

using Compute = Interval (*)(const Interval *operands, const OperatorRules &rules);
using Outside = bool (*)(const Interval *operands);

struct OperatorRow {
  Operator op = Operator::Add;
  uint8_t operands = 0;
  Compute compute = nullptr;
  Outside outside = nullptr; ///< whether the operands certainly lie outside the domain; null: never
};

Truth answer(bool yes, bool no) { return yes ? Truth::Yes : no ? Truth::No : Truth::Unknown; }

bool bothConstant(const Interval *x) { return x[0].isConstant() && x[1].isConstant(); }
bool isZero(const Interval &x) { return x.isConstant() && x.value() == 0; }

/// A function of a number that is known.
template <double (*function)(double)>
Interval of(const Interval *x, const OperatorRules &) {
  return x->isConstant() ? Interval::exactly(function(x->value())) : Interval::unknown();
}
double sine(double x) { return std::sin(x * radiansPerDegree); }
double cosine(double x) { return std::cos(x * radiansPerDegree); }
double tangent(double x) { return std::tan(x * radiansPerDegree); }
double arcSine(double x) { return std::asin(x) / radiansPerDegree; }
double arcCosine(double x) { return std::acos(x) / radiansPerDegree; }
double arcTangent(double x) { return std::atan(x) / radiansPerDegree; }
double squareRoot(double x) { return std::sqrt(x); }
double square(double x) { return x * x; }
double logarithm(double x) { return std::log(x); }
double exponential(double x) { return std::exp(std::min(x, 700.0)); }
double rounded(double x) { return std::round(x); }
double truncated(double x) { return std::trunc(x); }
double awayFromZero(double x) { return x < 0 ? std::floor(x) : std::ceil(x); }
double ceiling(double x) { return std::ceil(x); }

Interval add(const Interval *x, const OperatorRules &) { return x[0] + x[1]; }
Interval subtract(const Interval *x, const OperatorRules &) { return x[0] - x[1]; }
Interval multiply(const Interval *x, const OperatorRules &) {
  return x[1].isConstant()   ? x[0] * x[1].value()
         : x[0].isConstant() ? x[1] * x[0].value()
                             : Interval::unknown();
}
Interval divide(const Interval *x, const OperatorRules &) {
  if (bothConstant(x))
    return Interval::exactly(x[0].value() / x[1].value());
  return x[1].isConstant() ? x[0] * (1 / x[1].value()) : Interval::unknown();
}
Interval integerDivide(const Interval *x, const OperatorRules &) {
  return bothConstant(x) ? Interval::exactly(std::trunc(x[0].value() / x[1].value()))
                         : Interval::unknown();
}
Interval modulo(const Interval *x, const OperatorRules &) {
  return bothConstant(x) ? Interval::exactly(std::fmod(x[0].value(), x[1].value()))
                         : Interval::unknown();
}
Interval floorModulo(const Interval *x, const OperatorRules &rules) {
  const Interval rest = modulo(x, rules);
  return rest.isConstant() && rest.value() < 0
             ? Interval::exactly(rest.value() + std::fabs(x[1].value()))
             : rest;
}
Interval power(const Interval *x, const OperatorRules &) {
  const double result = bothConstant(x) ? std::pow(x[0].value(), x[1].value()) : INFINITY;
  return std::isfinite(result) ? Interval::exactly(result) : Interval::unknown();
}
Interval minimum(const Interval *x, const OperatorRules &) {
  return {std::min(x[0].lo, x[1].lo), std::min(x[0].hi, x[1].hi)};
}
Interval maximum(const Interval *x, const OperatorRules &) {
  return {std::max(x[0].lo, x[1].lo), std::max(x[0].hi, x[1].hi)};
}
Interval negate(const Interval *x, const OperatorRules &) { return x[0] * -1; }
Interval absolute(const Interval *x, const OperatorRules &) {
  if (x->lo >= 0)
    return *x;
  return x->hi <= 0 ? *x * -1 : Interval{0, std::max(-x->lo, x->hi)};
}
Interval arcTangent2(const Interval *x, const OperatorRules &) {
  return bothConstant(x)
             ? Interval::exactly(std::atan2(x[0].value(), x[1].value()) / radiansPerDegree)
             : Interval::unknown();
}
/// Of a number that is whole but for its rounding, the number.
Interval floorOf(const Interval *x, const OperatorRules &rules) {
  if (rules.strict && !x->isConstant())
    return Interval::unknown();
  const double lo = std::floor(x->lo + rules.tolerance), hi = std::floor(x->hi + rules.tolerance);
  return {lo + 0.0, hi + 0.0};
}

Truth isLess(const Interval &a, const Interval &b, double tolerance) {
  return answer(a.hi < b.lo - tolerance, a.lo >= b.hi - tolerance);
}
Truth isLessEqual(const Interval &a, const Interval &b, double tolerance) {
  return answer(a.hi <= b.lo + tolerance, a.lo > b.hi + tolerance);
}
Truth areEqual(const Interval *x, double tolerance) {
  const bool apart = x[0].hi < x[1].lo - tolerance || x[1].hi < x[0].lo - tolerance;
  return answer(bothConstant(x) && !apart, apart);
}
Truth negated(Truth truth) {
  return truth == Truth::Yes ? Truth::No : truth == Truth::No ? Truth::Yes : Truth::Unknown;
}
Interval equal(const Interval *x, const OperatorRules &rules) {
  return numberOf(areEqual(x, rules.tolerance));
}
Interval notEqual(const Interval *x, const OperatorRules &rules) {
  return numberOf(negated(areEqual(x, rules.tolerance)));
}
Interval less(const Interval *x, const OperatorRules &rules) {
  return numberOf(isLess(x[0], x[1], rules.tolerance));
}
Interval lessEqual(const Interval *x, const OperatorRules &rules) {
  return numberOf(isLessEqual(x[0], x[1], rules.tolerance));
}
Interval greater(const Interval *x, const OperatorRules &rules) {
  return numberOf(isLess(x[1], x[0], rules.tolerance));
}
Interval greaterEqual(const Interval *x, const OperatorRules &rules) {
  return numberOf(isLessEqual(x[1], x[0], rules.tolerance));
}

/// Bits of two whole numbers; a false operand decides AND, whatever the other is.
template <Operator op>
Interval bits(const Interval *x, const OperatorRules &) {
  constexpr double widest = 1e15;
  if (!bothConstant(x) || std::fabs(x[0].value()) > widest || std::fabs(x[1].value()) > widest) {
    const bool no = truthOf(x[0]) == Truth::No || truthOf(x[1]) == Truth::No;
    return op == Operator::BitAnd && no ? Interval::exactly(0) : Interval::unknown();
  }
  const auto a = int64_t(x[0].value()), b = int64_t(x[1].value());
  return Interval::exactly(double(op == Operator::BitAnd  ? (a & b)
                                  : op == Operator::BitOr ? (a | b)
                                                          : (a ^ b)));
}
Interval both(const Interval *x, const OperatorRules &) {
  const Truth a = truthOf(x[0]), b = truthOf(x[1]);
  return numberOf(answer(a == Truth::Yes && b == Truth::Yes, a == Truth::No || b == Truth::No));
}
Interval either(const Interval *x, const OperatorRules &) {
  const Truth a = truthOf(x[0]), b = truthOf(x[1]);
  return numberOf(answer(a == Truth::Yes || b == Truth::Yes, a == Truth::No && b == Truth::No));
}
Interval no(const Interval *x, const OperatorRules &rules) {
  const Truth truth = negated(truthOf(*x));
  return rules.strict && truth == Truth::Unknown ? Interval::unknown() : numberOf(truth);
}
Interval select(const Interval *x, const OperatorRules &) {
  const Truth holds = truthOf(x[0]);
  return holds == Truth::Yes ? x[1] : holds == Truth::No ? x[2] : join(x[1], x[2]);
}

bool divisorIsZero(const Interval *x) { return isZero(x[1]); }
bool noPower(const Interval *x) {
  return bothConstant(x) && ((x[0].value() < 0 && x[1].value() != std::trunc(x[1].value())) ||
                             (x[0].value() == 0 && x[1].value() < 0));
}
bool noSine(const Interval *x) { return x->isConstant() && std::fabs(x->value()) > 1; }
bool noTangent(const Interval *x) {
  constexpr double tolerance = 1e-9;
  return x->isConstant() && std::fabs(std::fmod(std::fabs(x->value()), 180) - 90) < tolerance;
}
bool isNegative(const Interval *x) { return x->isConstant() && x->value() < 0; }
bool isNotPositive(const Interval *x) { return x->isConstant() && x->value() <= 0; }

constexpr OperatorRow rows[] = {
    {Operator::Add, 2, add},
    {Operator::Subtract, 2, subtract},
    {Operator::Multiply, 2, multiply},
    {Operator::Divide, 2, divide, divisorIsZero},
    {Operator::IntegerDivide, 2, integerDivide, divisorIsZero},
    {Operator::Modulo, 2, modulo, divisorIsZero},
    {Operator::FloorModulo, 2, floorModulo, divisorIsZero},
    {Operator::Power, 2, power, noPower},
    {Operator::Minimum, 2, minimum},
    {Operator::Maximum, 2, maximum},
    {Operator::Negate, 1, negate},
    {Operator::Absolute, 1, absolute},
    {Operator::Equal, 2, equal},
    {Operator::NotEqual, 2, notEqual},
    {Operator::Greater, 2, greater},
    {Operator::GreaterEqual, 2, greaterEqual},
    {Operator::Less, 2, less},
    {Operator::LessEqual, 2, lessEqual},
    {Operator::BitAnd, 2, bits<Operator::BitAnd>},
    {Operator::BitOr, 2, bits<Operator::BitOr>},
    {Operator::BitXor, 2, bits<Operator::BitXor>},
    {Operator::And, 2, both},
    {Operator::Or, 2, either},
    {Operator::Not, 1, no},
    {Operator::Select, 3, select},
    {Operator::Sine, 1, of<sine>},
    {Operator::Cosine, 1, of<cosine>},
    {Operator::Tangent, 1, of<tangent>, noTangent},
    {Operator::ArcSine, 1, of<arcSine>, noSine},
    {Operator::ArcCosine, 1, of<arcCosine>, noSine},
    {Operator::ArcTangent, 1, of<arcTangent>},
    {Operator::ArcTangent2, 2, arcTangent2},
    {Operator::SquareRoot, 1, of<squareRoot>, isNegative},
    {Operator::Square, 1, of<square>},
    {Operator::Logarithm, 1, of<logarithm>, isNotPositive},
    {Operator::Exponential, 1, of<exponential>},
    {Operator::Round, 1, of<rounded>},
    {Operator::Truncate, 1, of<truncated>},
    {Operator::AwayFromZero, 1, of<awayFromZero>},
    {Operator::Floor, 1, floorOf},
    {Operator::Ceiling, 1, of<ceiling>},
};

constexpr bool inOrder() {
  for (size_t i = 0; i < std::size(rows); ++i)
    if (size_t(rows[i].op) != i)
      return false;
  return std::size(rows) == size_t(Operator::Count);
}
static_assert(inOrder(), "one row an operator, in the order of the enumeration");

bool isComparison(Operator op) { return op >= Operator::Equal && op <= Operator::LessEqual; }

} // namespace

bool mayFail(Operator op) { return rows[size_t(op)].outside; }

Truth truthOf(const Interval &value) {
  if (value.isConstant())
    return value.value() != 0 ? Truth::Yes : Truth::No;
  return value.contains(0) ? Truth::Unknown : Truth::Yes;
}

Interval numberOf(Truth truth) {
  return truth == Truth::Unknown ? Interval{0, 1} : Interval::exactly(truth == Truth::Yes);
}

std::optional<double> compute(Operator op, const double *numbers, size_t &count) {
  const OperatorRow &row = rows[size_t(op)];
  if (count < row.operands)
    return std::nullopt;
  std::array<Interval, 3> operands;
  for (size_t i = 0, first = count - row.operands; i < row.operands; ++i)
    operands[i] = {numbers[first + i], numbers[first + i]};
  if (row.outside && row.outside(operands.data()))
    return std::nullopt;
  const Interval result = row.compute(operands.data(), OperatorRules());
  if (!result.isConstant())
    return std::nullopt;
  count -= row.operands;
  return result.value();
}

bool OperatorStack::apply(Operator op) {
  const OperatorRow &row = rows[size_t(op)];
  while (values_.size() < row.operands) // what is missing is unknown
    values_.insert(values_.begin(), Value::unknown());
  Value *const values = values_.end() - row.operands;
  std::array<Interval, 3> numbers;
  bool unknown = false, vacant = false;
  for (size_t i = 0; i < row.operands; ++i) {
    numbers[i] = values[i].asNumber();
    unknown |= values[i].kind == Value::Kind::Unknown;
    vacant |= values[i].isVacant();
  }
  bool inside = true;
  if (rules_.strict && unknown && !isComparison(op)) {
    // Divided by zero, whatever is divided.
    inside = row.outside != divisorIsZero || !values[1].isConstant() || !divisorIsZero(&numbers[0]);
    values[0] = Value::unknown();
  } else if (op == Operator::Negate && vacant) {
    // `-#1` of a vacant variable is vacant, and vacant is equal only to vacant.
  } else if ((op == Operator::Equal || op == Operator::NotEqual) && vacant && !unknown) {
    const bool same = values[0].isVacant() && values[1].isVacant();
    values[0] = Value::of(same == (op == Operator::Equal));
  } else {
    inside = !row.outside || !row.outside(numbers.data());
    values[0] = inside ? Value::of(row.compute(numbers.data(), rules_)) : Value::unknown();
  }
  values_.truncate(values_.size() - (row.operands - 1u));
  return inside;
}

} // namespace ncvet
