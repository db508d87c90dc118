// The conditions that a path has decided.
#include "analyzer/flow/decided_conditions.h"

namespace ncvet {

Truth decided(const DecidedCondition *path, const ConditionKey &condition) {
  for (; path; path = path->before)
    if (path->condition == condition.sum)
      return path->holds != condition.negated ? Truth::Yes : Truth::No;
  return Truth::Unknown;
}

const DecidedCondition *decidedByBoth(const DecidedCondition *a, const DecidedCondition *b) {
  while (a != b) {
    const bool first = a && (!b || a->length >= b->length);
    (first ? a : b) = first ? a->before : b->before;
  }
  return a;
}

} // namespace ncvet
