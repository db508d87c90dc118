// The passes of a thread that is cut by a list of diameters.
#include "analyzer/facts/thread_passes.h"

#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"

namespace ncvet {

llvm::SmallVector<double, 8> threadPassesAhead(const RuleContext &ctx, double from) {
  constexpr unsigned mostBlocks = 30; // threads have fewer passes
  constexpr AddressMask diameters = lettersMask("XU");
  llvm::SmallVector<double, 8> passes;
  BlocksAhead ahead(ctx);
  Block next;
  for (unsigned i = 0; i < mostBlocks && ahead.next(next); ++i) {
    const CodeInfo *cycle = findCode(ctx.dialect(), next, {Action::Cycle});
    const bool again = cycle && cycle->cycle == CycleKind::ThreadPass;
    if ((next.has(letterAddress('G')) && !again) || next.has(letterAddress('T')) ||
        !next.items.empty())
      break;
    const Word *word = next.findAny(diameters);
    if (word && word->isNumber())
      passes.push_back(word->address == letterAddress('U') ? from + word->value() : word->value());
  }
  return passes;
}

} // namespace ncvet
