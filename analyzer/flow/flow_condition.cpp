// On what it depends where control goes from a block.
#include "analyzer/flow/flow_condition.h"

#include "analyzer/flow/activation.h"

namespace ncvet {

ConditionKey conditionOf(const Step &step) {
  const int at = step.outcome.flow.item;
  if (at < 0)
    return {};
  const llvm::ArrayRef<Item> items = step.block.items;
  const bool isAfterIf = items[size_t(at)].kind == ItemKind::Jump && at > 0 &&
                         items[size_t(at) - 1].kind == ItemKind::If;
  if (!isAfterIf && items[size_t(at)].kind != ItemKind::Structure)
    return {};
  return conditionKey(step.block, items[size_t(at - isAfterIf)].condition, step.live.state);
}

} // namespace ncvet
