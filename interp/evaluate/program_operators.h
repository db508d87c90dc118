// Which operators the operations of programs are.
#pragma once

#include "formats/readers/block.h"
#include "interp/evaluate/operators.h"

#include <array>
#include <optional>
#include <utility>

namespace ncvet {

/// The operator that an operation of a program is; none for operands and what is not followed.
inline constexpr auto programOperators = [] {
  constexpr std::pair<Op, Operator> known[] = {
      {Op::Add, Operator::Add},
      {Op::Subtract, Operator::Subtract},
      {Op::Multiply, Operator::Multiply},
      {Op::Divide, Operator::Divide},
      {Op::IntegerDivide, Operator::IntegerDivide},
      {Op::Modulo, Operator::Modulo},
      {Op::FloorModulo, Operator::FloorModulo},
      {Op::Power, Operator::Power},
      {Op::Minimum, Operator::Minimum},
      {Op::Maximum, Operator::Maximum},
      {Op::Negate, Operator::Negate},
      {Op::Abs, Operator::Absolute},
      {Op::Equal, Operator::Equal},
      {Op::NotEqual, Operator::NotEqual},
      {Op::Greater, Operator::Greater},
      {Op::GreaterEqual, Operator::GreaterEqual},
      {Op::Less, Operator::Less},
      {Op::LessEqual, Operator::LessEqual},
      {Op::And, Operator::BitAnd},
      {Op::Or, Operator::BitOr},
      {Op::Xor, Operator::BitXor},
      {Op::Not, Operator::Not},
      {Op::Sin, Operator::Sine},
      {Op::Cos, Operator::Cosine},
      {Op::Tan, Operator::Tangent},
      {Op::Asin, Operator::ArcSine},
      {Op::Acos, Operator::ArcCosine},
      {Op::Atan, Operator::ArcTangent},
      {Op::Atan2, Operator::ArcTangent2},
      {Op::Sqrt, Operator::SquareRoot},
      {Op::Square, Operator::Square},
      {Op::Ln, Operator::Logarithm},
      {Op::Exp, Operator::Exponential},
      {Op::Round, Operator::Round},
      {Op::Fix, Operator::Truncate},
      {Op::Truncate, Operator::Truncate},
      {Op::Fup, Operator::AwayFromZero},
      {Op::Floor, Operator::Floor},
      {Op::Ceiling, Operator::Ceiling},
  };
  std::array<std::optional<Operator>, size_t(Op::Unknown) + 1> table;
  for (const auto &[op, is] : known)
    table[size_t(op)] = is;
  return table;
}();

/// Whether the operation has operands that it cannot compute: zero for a division.
inline bool mayFail(Op op) {
  const std::optional<Operator> known = programOperators[size_t(op)];
  return known && mayFail(*known);
}

} // namespace ncvet
