// The levels on which a milling cycle works, from its top to its bottom.
#include "interp/cycles/depth_levels.h"

#include <cmath>

namespace ncvet {

namespace {
constexpr unsigned mostLevels = 10000;  ///< more are an error that rules report
constexpr double levelTolerance = 1e-9; ///< mm
} // namespace

std::optional<Interval> approachLevel(const CycleParameters &parameters) {
  return parameters.length(Measure::Approach, Role::Retract);
}

std::optional<Interval> backLevel(const CycleParameters &parameters) {
  return parameters.length(Measure::Back, Role::Height);
}

llvm::SmallVector<Interval, 8> depthLevels(const CycleParameters &parameters) {
  llvm::SmallVector<Interval, 8> list;
  const auto bottom = parameters.length(Measure::Bottom, Role::Depth);
  const auto approach = approachLevel(parameters);
  if (!bottom || !approach)
    return list;
  const Interval top = parameters.length(Measure::Top).value_or(*approach);
  const bool known = top.isConstant() && bottom->isConstant();
  const Interval rest = parameters.length(Measure::BottomRest).value_or(Interval::exactly(0));
  const Interval last =
      known ? *bottom + rest * (bottom->value() < top.value() ? 1 : -1) : Interval::unknown();
  const auto step = parameters.length(Measure::Step);
  const auto by = step ? step : parameters.length(Measure::MostStep);
  if (by && by->isConstant() && std::fabs(by->value()) > levelTolerance && top.isConstant() &&
      last.isConstant()) {
    const double length = std::fabs(by->value()), way = std::fabs(last.value() - top.value());
    const double sign = last.value() < top.value() ? -1 : 1;
    for (unsigned n = 1; n < mostLevels && n * length < way - levelTolerance; ++n)
      list.push_back(step ? Interval::exactly(top.value() + sign * n * length)
                          : Interval::unknown());
  }
  list.push_back(last);
  return list;
}

} // namespace ncvet
