// How a rule that is told of every move says that the next ones do not interest it.
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {

bool isFollowedByPlace(const RuleContext &ctx) {
  const Block *const next = ctx.nextAlike();
  if (!next || (next->addresses & ~ctx.dialect().axisWords))
    return false;
  ctx.index().noteRead(next->begin, next->next);
  return true;
}

} // namespace ncvet
