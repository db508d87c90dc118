// Lets a rule speak once for one cause, however many blocks follow from it.
#pragma once

#include "analyzer/rule/rule.h"

#include "llvm/ADT/DenseMap.h"

namespace ncvet {

/// Remembers at which block a cause was reported. The same block may report it again, as it does
/// when several states or passes reach it.
class OncePerCause {
public:
  /// True when `block` is the first that reports the cause set at `origin` (nowhere counts as one).
  bool speaks(const Origin &origin, const RuleContext &ctx) {
    stateUse.aside = true;
    const uint64_t here = uint64_t(ctx.source().id()) << 32 | ctx.block().begin;
    const uint64_t cause = origin.known() ? uint64_t(origin.file) << 32 | origin.begin : nowhere;
    return spoken_.try_emplace(cause, here).first->second == here;
  }

  void remember(RuleMemory &memory) const {
    memory.aside([&] {
      // In the order of the text, wherever the table keeps them.
      const std::map<uint64_t, uint64_t> sorted(spoken_.begin(), spoken_.end());
      for (const auto &[cause, block] : sorted) {
        if (cause == nowhere)
          memory(cause);
        else
          memory.place(FileId(cause >> 32), uint32_t(cause));
        memory.place(FileId(block >> 32), uint32_t(block));
      }
      memory(sorted.size());
    });
  }

private:
  static constexpr uint64_t nowhere = ~uint64_t(0) - 2; // DenseMap keeps the two largest for itself
  llvm::DenseMap<uint64_t, uint64_t> spoken_;
};

} // namespace ncvet
