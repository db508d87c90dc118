// Values of operations that no text of the ISO family spells.
#include "interp/evaluate/expression.h"
#include "interp/state/event.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ncvet {
namespace {

/// `left` to the power of `right`; NaN when it is not known. `errors` counts those of the domain.
double power(double left, double right, unsigned &errors) {
  Block block;
  block.operations = {{Op::Number, 0, left}, {Op::Number, 1, right}, {Op::Power, 2, 0}};
  Expression expression;
  expression.count = 3;
  block.expressions.push_back(expression);
  Outcome outcome;
  const Value value = evaluate(block, 0, MachineState(), &outcome);
  errors = 0;
  for (const Event &event : outcome.events)
    errors += event.kind == EventKind::DomainError;
  return value.isConstant() ? value.number.value() : std::nan("");
}

TEST(Expressions, APowerHasItsValue) {
  unsigned errors = 0;
  EXPECT_EQ(power(2, 10, errors), 1024);
  EXPECT_EQ(power(-2, 3, errors), -8);
  EXPECT_EQ(power(4, 0.5, errors), 2);
  EXPECT_EQ(power(0, 0, errors), 1);
  EXPECT_EQ(errors, 0u);
}

TEST(Expressions, APowerOutsideItsDomainIsAnErrorWithoutAValue) {
  unsigned errors = 0;
  EXPECT_TRUE(std::isnan(power(-2, 0.5, errors)));
  EXPECT_EQ(errors, 1u);
  EXPECT_TRUE(std::isnan(power(0, -1, errors)));
  EXPECT_EQ(errors, 1u);
}

TEST(Expressions, APowerBeyondAllNumbersIsNotKnown) {
  unsigned errors = 0;
  EXPECT_TRUE(std::isnan(power(10, 400, errors)));
  EXPECT_EQ(errors, 0u);
}

} // namespace
} // namespace ncvet
