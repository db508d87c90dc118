// What a cycle's formulas and words give, from its block and the parameter block before it.
#include "interp/evaluate/cycle_parameters.h"

#include "interp/evaluate/cycle_words.h"
#include "interp/evaluate/formula.h"
#include "interp/value/units.h"

#include <cmath>

namespace ncvet {

namespace {} // namespace

CycleParameters::CycleParameters(const ExecutedBlock &executed, const CodeInfo &cycle)
    : executed_(executed), cycle_(cycle) {}

const CodeInfo *CycleParameters::parameterBlock() const {
  const CodeIndex pending = executed_.before.pendingCycle;
  return cycle_.twoBlock && pending != noCode ? &executed_.dialect.codes[pending] : nullptr;
}

bool CycleParameters::has(Measure what) const { return formulaOf(cycle_, what); }

std::optional<Interval> CycleParameters::number(Measure what, double index) const {
  if (const Formula *formula = formulaOf(cycle_, what))
    return valueOfGiven(*formula, cycle_,
                        {executed_.dialect,
                         executed_.machine,
                         executed_.block,
                         {},
                         executed_.after,
                         /*keptWords=*/!cycle_.twoBlock,
                         index});
  const CodeInfo *data = parameterBlock();
  const Formula *formula = data ? formulaOf(*data, what) : nullptr;
  if (!formula)
    return std::nullopt;
  static const Block none;
  return valueOfGiven(*formula, *data,
                      {executed_.dialect,
                       executed_.machine,
                       none,
                       {},
                       executed_.before,
                       /*keptWords=*/true,
                       index});
}

Interval CycleParameters::lengthFactor() const {
  const Dialect &dialect = executed_.dialect;
  const GroupIndex units = dialect.group(StandardGroup::Units);
  if (units == noGroup || executed_.after.group(units) == groupUnset)
    return Interval::exactly(1);
  switch (executed_.after.activeAction(dialect, StandardGroup::Units)) {
  case Action::None:
    return Interval::unknown();
  case Action::Inch:
    return Interval::exactly(millimetresPerInch);
  default:
    return Interval::exactly(1);
  }
}

std::optional<Interval> CycleParameters::length(Measure what, double index) const {
  const auto value = number(what, index);
  const Interval factor = lengthFactor();
  if (!value || !factor.isConstant())
    return value ? std::optional(Interval::unknown()) : std::nullopt;
  return *value * factor.value();
}

std::optional<Interval> CycleParameters::length(Role role) const {
  if (const auto own = CycleWordReader(executed_, cycle_).value(role))
    return own;
  const CodeInfo *data = parameterBlock();
  if (!data)
    return std::nullopt;
  const CycleWords &words = executed_.before.cycle;
  for (const WordSpec &spec : data->words)
    for (unsigned letter = 0; spec.role == role && letter < words.value.size(); ++letter)
      if (spec.any >> letter & words.present >> letter & 1) {
        const Interval factor = lengthFactor();
        return std::isnan(words.value[letter]) || !factor.isConstant()
                   ? Interval::unknown()
                   : Interval::exactly(words.value[letter] * factor.value());
      }
  return std::nullopt;
}

} // namespace ncvet
