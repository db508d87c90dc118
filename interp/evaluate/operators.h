// The operators of all expressions, of programs and of tables: one table, one evaluator.
#pragma once

#include "interp/value/value.h"

#include "llvm/ADT/SmallVector.h"

#include <cstddef>
#include <optional>

namespace ncvet {

enum class Operator : uint8_t {
  Add,
  Subtract,
  Multiply,
  Divide,
  IntegerDivide, ///< quotient without its fraction
  Modulo,
  FloorModulo, ///< remainder that is never negative
  Power,
  Minimum,
  Maximum,
  Negate,
  Absolute,
  Equal,
  NotEqual,
  Greater,
  GreaterEqual,
  Less,
  LessEqual,
  BitAnd,
  BitOr,
  BitXor,
  And,
  Or,
  Not,
  Select, ///< the second operand where the first holds, else the third
  Sine,   ///< of degrees, as all angles
  Cosine,
  Tangent,
  ArcSine,
  ArcCosine,
  ArcTangent,
  ArcTangent2,
  SquareRoot,
  Square,
  Logarithm,
  Exponential,
  Round,
  Truncate,
  AwayFromZero,
  Floor,
  Ceiling,
  Count
};

/// What expressions of programs and of tables do not share.
struct OperatorRules {
  double tolerance = 0; ///< numbers that lie no further apart are equal
  /// Of an operand of which nothing is known nothing follows, as little as of a function's operand
  /// of which a part is known.
  bool strict = true;
};

/// Whether operands may lie outside the operator's domain: a division by zero, a root of a negative
/// number.
bool mayFail(Operator op);

/// Truth of a value as a condition: comparisons give 1 or 0.
Truth truthOf(const Interval &value);
/// The number that a comparison gives.
Interval numberOf(Truth truth);

/// What the operator makes of the last of `count` known numbers, which it takes away. Nothing, and
/// all of them stay, when there are too few, when they lie outside its domain, and where the result
/// is no one number.
std::optional<double> compute(Operator op, const double *numbers, size_t &count);

/// Computes an expression in postfix order.
class OperatorStack {
public:
  explicit OperatorStack(const OperatorRules &rules) : rules_(rules) {}

  void push(const Value &value) { values_.push_back(value); }
  /// Unknown where there is none.
  Value pop() { return values_.empty() ? Value::unknown() : values_.pop_back_val(); }
  bool empty() const { return values_.empty(); }
  /// Puts what the operator makes of its operands in their place. False when they lie outside its
  /// domain: then that is unknown.
  bool apply(Operator op);
  /// The value of the expression, when all of it is computed.
  Value result() const { return values_.size() == 1 ? values_.back() : Value::unknown(); }

private:
  const OperatorRules rules_;
  llvm::SmallVector<Value, 8> values_;
};

} // namespace ncvet
