// What a cycle's formulas and words give, from its block and the parameter block before it.
#pragma once

#include "formats/dialect/measure.h"
#include "interp/state/executed_block.h"

#include <optional>

namespace ncvet {

class CycleParameters {
public:
  CycleParameters(const ExecutedBlock &executed, const CodeInfo &cycle);

  /// Whether the cycle has such a formula.
  bool has(Measure what) const;
  /// Value of the formula as it is; none when the cycle has no such formula, or a word that it
  /// names is not given. `index` is the place that its `index()` means.
  std::optional<Interval> number(Measure what, double index = 0) const;
  /// The same of a length, in millimetres.
  std::optional<Interval> length(Measure what, double index = 0) const;
  /// Length (mm) of the word with that role.
  std::optional<Interval> length(Role role) const;
  std::optional<Interval> length(Measure what, Role role) const {
    const auto value = length(what);
    return value ? value : length(role);
  }
  /// Millimetres per unit of a length.
  Interval lengthFactor() const;

private:
  const CodeInfo *parameterBlock() const;

  const ExecutedBlock &executed_;
  const CodeInfo &cycle_;
};

/// A parameter's one value; nothing where it is not programmed, or not known.
inline std::optional<double> known(const std::optional<Interval> &value) {
  return value && value->isConstant() ? std::optional(value->value()) : std::nullopt;
}

} // namespace ncvet
