// An offset that was switched off on the way to a machine position.
#pragma once

#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"

namespace ncvet {

/// Whether `off`, the word that switched the offset of the tool off, is in the block of a move in
/// machine coordinates: `SUPA G0 Z500 D0`, as retracts are written.
inline bool isOfRetract(const RuleContext &ctx, const Origin &off) {
  if (!off.known())
    return false;
  Block block;
  readBlockOf(ctx, off, block);
  return findCode(ctx.dialect(), block, {Action::MachineMove});
}

} // namespace ncvet
