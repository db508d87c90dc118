// Calls and returns that are executed again: what of them depends on numbers.
#include "interp/execute/macro_arguments.h"

#include "interp/evaluate/condition.h"
#include "interp/evaluate/known_number.h"
#include "interp/evaluate/variable_access.h"

namespace ncvet {

namespace {

/// Whether no value has been given back, as at the end of a subprogram that gives none.
bool nothingGivenBack(const MachineState &state) {
  const auto isZero = [&](uint64_t key) {
    const Value value = state.commons.get(key);
    return value.isConstant() && value.number.value() == 0 &&
           state.commons.given(key) == Truth::Yes;
  };
  return isZero(givenBackKey()) && isZero(isGivenBackKey());
}

} // namespace

bool isBracketFlow(const Block &block) {
  if (block.kind != BlockKind::Normal || block.skip >= 0 || !block.words.empty() ||
      !block.issues.empty() || block.items.size() != 1)
    return false;
  const Item &item = block.items.front();
  if (item.condition != noExpression || item.value != noExpression || item.count != noExpression)
    return false;
  return item.kind == ItemKind::Call
             ? item.positional && !item.modal && item.nameEnd > item.nameBegin
             : item.kind == ItemKind::Structure && item.structure == Structure::EndSub;
}

bool isKnownFlow(const Dialect &dialect, const Block &block, const Outcome &outcome) {
  if (isBracketFlow(block)) {
    constexpr uint32_t expected =
        bitOf(EventKind::Block) | bitOf(EventKind::Statement) | bitOf(EventKind::Call);
    return !(outcome.kinds & ~expected) && outcome.codes.empty() && !outcome.foreign &&
           outcome.callsModally == Truth::No;
  }
  constexpr uint32_t events = bitOf(EventKind::Block) | bitOf(EventKind::Code) |
                              bitOf(EventKind::Call) | bitOf(EventKind::Return) |
                              bitOf(EventKind::WordIssue);
  const Flow &flow = outcome.flow;
  if ((flow.kind != FlowKind::Call && flow.kind != FlowKind::Return) || block.isEmpty() ||
      !block.items.empty() || !block.issues.empty() || outcome.codes.size() != 1 ||
      (outcome.kinds & ~events) || outcome.foreign || outcome.callsModally != Truth::No ||
      block.skip >= 0)
    return false;
  const CodeInfo &base = dialect.codes[dialect.codes[outcome.codes[0].code].base];
  if (llvm::any_of(base.variants, [](const Variant &variant) { return asksNumber(variant.when); }))
    return false;
  constexpr AddressMask ofCall = lettersMask("GMPLQ");
  return llvm::none_of(block.words, [&](const Word &word) {
    return word.has(wordNoValue) ||
           (word.has(wordExpression) && (!flow.macro || (ofCall & maskOf(word.address)) ||
                                         word.reading() != WordReading::Modal));
  });
}

bool computeArguments(const Block &block, const MachineState &state, Outcome &outcome) {
  Flow &flow = outcome.flow;
  if (flow.kind == FlowKind::Structure)
    return nothingGivenBack(state);
  if (!flow.macro || block.expressions.empty())
    return true;
  llvm::SmallVector<std::pair<uint32_t, Value>, 8> given;
  bool known = true;
  forEachArgument(block, *outcome.codes[0].word, [&](uint32_t variable, const Word &word) {
    const std::optional<double> number = word.has(wordExpression)
                                             ? knownNumber(block, uint16_t(word.mantissa), state)
                                             : word.value() + 0.0;
    known &= number.has_value();
    if (number)
      given.emplace_back(variable, Value{Value::Kind::Number, {*number, *number}});
  });
  if (known)
    for (const auto &[variable, value] : given)
      flow.arguments.set(variable, value);
  return known;
}

} // namespace ncvet
