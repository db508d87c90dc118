// Blocks that only calculate: what they do when they are executed again.
#include "interp/execute/calculation.h"

#include "interp/evaluate/known_number.h"

#include <cmath>

namespace ncvet {

namespace {

/// Whether such a bracket does nothing but lead somewhere.
bool onlyLeads(Structure structure) {
  switch (structure) {
  case Structure::If:
  case Structure::Else:
  case Structure::EndIf:
  case Structure::While:
  case Structure::EndWhile:
  case Structure::Loop:
  case Structure::EndLoop:
  case Structure::Repeat:
  case Structure::Until:
  case Structure::Break:
  case Structure::Continue:
    return true;
  default:
    return false;
  }
}

bool isNumber(const Block &block, uint16_t index) {
  const Expression &expression = block.expressions[index];
  return expression.count == 1 && block.operations[expression.first].op == Op::Number;
}

bool addAssignment(const Block &block, const Item &item, Calculation &calculation) {
  if (item.kind != ItemKind::Assignment || item.value >= block.expressions.size() ||
      item.target >= block.expressions.size() || !isNumber(block, item.target))
    return false;
  const double key = block.operations[block.expressions[item.target].first].value;
  calculation.target = block.keyOf(item.target);
  calculation.value = item.value;
  return calculation.target != 0 && key == std::floor(key);
}

/// Whether the jump leads to a target that is in the text.
bool isFixed(const Block &block, const Item &jump) {
  return jump.condition == noExpression &&
         (jump.value == noExpression ||
          (jump.value < block.expressions.size() && isNumber(block, jump.value)));
}

/// The second statement of a block whose first one is an IF.
bool addGuarded(const Block &block, const Item &item, Calculation &calculation) {
  if (item.kind == ItemKind::Jump)
    return isFixed(block, item);
  calculation.guards = true;
  return addAssignment(block, item, calculation);
}

} // namespace

std::optional<Calculation> calculationOf(const Block &block) {
  if (block.kind != BlockKind::Normal || block.skip >= 0 || !block.words.empty() ||
      !block.issues.empty() || block.items.empty() || block.items.size() > 2)
    return std::nullopt;
  const Item &first = block.items.front();
  Calculation calculation;
  calculation.condition = first.condition;
  bool is = block.items.size() == 1;
  switch (first.kind) {
  case ItemKind::Assignment:
    is = is && addAssignment(block, first, calculation);
    break;
  case ItemKind::If:
    is = !is && addGuarded(block, block.items[1], calculation);
    break;
  case ItemKind::While:
  case ItemKind::Do:
  case ItemKind::End:
    break;
  case ItemKind::Structure:
    is = is && onlyLeads(first.structure);
    break;
  default:
    is = false;
  }
  return is ? std::optional(calculation) : std::nullopt;
}

std::optional<Calculated> calculate(const Block &block, const Calculation &calculation,
                                    const MachineState &state) {
  Calculated result;
  if (calculation.condition != noExpression) {
    const std::optional<double> asked = knownNumber(block, calculation.condition, state);
    if (!asked)
      return std::nullopt;
    result.condition = *asked != 0 ? Truth::Yes : Truth::No;
  }
  if (!calculation.target || (calculation.guards && result.condition != Truth::Yes))
    return result;
  const std::optional<double> value = knownNumber(block, calculation.value, state);
  if (!value)
    return std::nullopt;
  result.writes = true;
  result.value = *value;
  return result;
}

} // namespace ncvet
