// Reads the values of words on a state.
#include "interp/evaluate/block_words.h"

#include "interp/evaluate/expression.h"
#include "interp/state/state.h"
#include "interp/value/units.h"

namespace ncvet {

uint64_t givenVariable(const WordSpec &spec, const MachineState &state) {
  return spec.orVariable && state.commons.given(spec.variable) == Truth::No ? spec.orVariable
                                                                            : spec.variable;
}

Truth givenBefore(const WordSpec &spec, const MachineState &state) {
  if (!spec.variable)
    return Truth::No;
  const Truth first = state.commons.given(spec.variable);
  if (first == Truth::Yes || !spec.orVariable)
    return first;
  const Truth other = state.commons.given(spec.orVariable);
  return other == Truth::No ? first : other;
}

Interval wordValue(const Word &word, const Block &block, const MachineState &state) {
  if (!word.has(wordExpression) || word.has(wordNoValue))
    return assignedWordValue(word, block, state);
  const Value value = evaluateInBlock(block, uint16_t(word.mantissa), state);
  return value.kind == Value::Kind::Number ? value.number : Interval::unknown();
}

std::optional<double> lengthFactor(const Word &word, const Dialect &dialect,
                                   const MachineProfile &machine, const MachineState &state) {
  if (dialect.addresses[word.address].unit != AddressUnit::Length)
    return 1;
  double factor = 1;
  const GroupIndex units = dialect.group(StandardGroup::Units);
  if (units != noGroup && state.group(units) != groupUnset) {
    const Action unit = state.activeAction(dialect, StandardGroup::Units);
    if (unit == Action::None)
      return std::nullopt;
    factor = unit == Action::Inch ? millimetresPerInch : 1;
  }
  if (word.isNumber() && !word.has(wordPoint))
    if (const auto reading = machine.option("decimalPoint"); reading && *reading == "increment")
      factor *= leastIncrement;
  return factor;
}

Interval lengthOf(const Word &word, const Block &block, const Dialect &dialect,
                  const MachineProfile &machine, const MachineState &state) {
  const Interval result = assignedWordValue(word, block, state);
  if (result.isUnknown() || dialect.addresses[word.address].unit != AddressUnit::Length)
    return result;
  const std::optional<double> factor = lengthFactor(word, dialect, machine, state);
  return factor ? result * *factor : Interval::unknown();
}

} // namespace ncvet
