// Finds the words of a block that a table's formats name, and reads their values.
#include "interp/evaluate/block_words.h"

#include "interp/evaluate/expression.h"
#include "interp/value/units.h"

namespace ncvet {

CodeIndex codeOf(const Dialect &dialect, const Word &word) {
  if (word.address == keywordAddress)
    return CodeIndex(word.mantissa);
  if ((word.address != letterAddress('G') && word.address != letterAddress('M')) ||
      !word.isNumber())
    return noCode;
  return dialect.find(char('A' + word.address), word.codeNumber());
}

const Word *assignmentOf(const Block &block, uint64_t variable) {
  if (!block.has(variableAddress))
    return nullptr;
  const Word *last = nullptr; // the last one counts
  for (const Item &item : block.items)
    if (item.kind == ItemKind::Assignment && block.keyOf(item.target) == variable)
      for (const Word &word : block.words)
        if (word.address == variableAddress && word.offset == item.begin)
          last = &word;
  return last;
}

const Word *wordFor(const Block &block, const WordSpec &spec) {
  if (spec.position) {
    const Word *word = block.argument(spec.position);
    return word && !word->has(wordNoValue) ? word : nullptr;
  }
  if (spec.variable)
    return assignmentOf(block, spec.variable);
  return block.findAny(spec.any);
}

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

Interval lengthOf(const Word &word, const Block &block, const Dialect &dialect,
                  const MachineProfile &machine, const MachineState &state) {
  const Interval result = assignedWordValue(word, block, state);
  if (result.isUnknown() || dialect.addresses[word.address].unit != AddressUnit::Length)
    return result;
  double factor = 1;
  const GroupIndex units = dialect.group(StandardGroup::Units);
  if (units != noGroup && state.group(units) != groupUnset) {
    const Action unit = state.activeAction(dialect, StandardGroup::Units);
    if (unit == Action::None)
      return Interval::unknown();
    factor = unit == Action::Inch ? millimetresPerInch : 1;
  }
  if (word.isNumber() && !word.has(wordPoint))
    if (const auto reading = machine.option("decimalPoint"); reading && *reading == "increment")
      factor *= leastIncrement;
  return result * factor;
}

} // namespace ncvet
