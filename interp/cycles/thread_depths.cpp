// How deep each pass of a turned thread cuts.
#include "interp/cycles/thread_depths.h"

#include <cmath>

namespace ncvet {

namespace {
constexpr unsigned mostThreadPasses = 10000; ///< more are an error that rules report
constexpr double passTolerance = 1e-9;       ///< mm

} // namespace

double knownOr(const CycleParameters &parameters, Measure what, double otherwise) {
  return known(parameters.number(what)).value_or(otherwise);
}

llvm::SmallVector<double, 32> threadDepths(const CycleParameters &parameters) {
  llvm::SmallVector<double, 32> list;
  const auto height = known(parameters.length(Measure::Height, Role::Height));
  const auto first = known(parameters.length(Measure::FirstCut, Role::FirstCut));
  const auto least = parameters.length(Measure::LeastCut, Role::LeastCut);
  const auto last = parameters.length(Measure::LastCut);
  if (!height || !first || *height <= 0 || *first <= 0 || (least && !least->isConstant()) ||
      (last && !last->isConstant()))
    return list;
  const double rest = last ? std::fabs(last->value()) : 0, rough = *height - rest;
  const bool constant = knownOr(parameters, Measure::ConstantDepth, 0) != 0;
  double depth = 0;
  for (unsigned n = 1; n <= mostThreadPasses && rough - depth > passTolerance; ++n) {
    const double next = constant ? n * *first : *first * std::sqrt(double(n));
    depth = std::min(rough, std::max(next, depth + (least ? std::fabs(least->value()) : 0)));
    list.push_back(depth);
  }
  const double finishing = knownOr(parameters, Measure::FinishPasses, rest > 0 ? 1 : 0);
  for (double n = 0; n < finishing && list.size() < mostThreadPasses; ++n)
    list.push_back(*height);
  return list;
}

bool feedsStraightIn(const CycleParameters &parameters) {
  const auto flanks = parameters.number(Measure::FlankAngle);
  return !flanks || *flanks == Interval::exactly(0) ||
         knownOr(parameters, Measure::BothFlanks, 0) != 0;
}

} // namespace ncvet
