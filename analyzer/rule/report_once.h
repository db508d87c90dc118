// Lets a rule speak once for one cause, however many blocks follow from it.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// Remembers at which block a cause was reported. The same block may report it again, as it does
/// when several states or passes reach it.
class OncePerCause {
public:
  /// True when `block` is the first that reports the cause set at `origin` (nowhere counts as one).
  bool speaks(const Origin &origin, const RuleContext &ctx) {
    const TextPlace here{ctx.source().id(), ctx.block().begin};
    const TextPlace cause = origin.known() ? TextPlace{origin.file, origin.begin} : nowhere;
    return spoken_.look().try_emplace(cause, here).first->second == here;
  }

  const auto &remembered() const { return spoken_; }

private:
  static constexpr TextPlace nowhere{FileId(~0u), ~0u};
  Aside<std::map<TextPlace, TextPlace>> spoken_; ///< by cause: the block that reported it
};

} // namespace ncvet
