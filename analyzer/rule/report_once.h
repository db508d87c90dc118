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
    const TextPlace here = placeOf(ctx);
    return spoken_.look().try_emplace(causeOf(origin), here).first->second == here;
  }
  /// Whether `speaks` would be true.
  bool maySpeak(const Origin &origin, const RuleContext &ctx) {
    const auto known = spoken_.look().find(causeOf(origin));
    return known == spoken_.look().end() || known->second == placeOf(ctx);
  }

  const auto &remembered() const { return spoken_; }

private:
  static TextPlace placeOf(const RuleContext &ctx) {
    return {ctx.source().id(), ctx.block().begin};
  }
  static TextPlace causeOf(const Origin &origin) {
    return origin.known() ? TextPlace{origin.file, origin.begin} : nowhere;
  }

  static constexpr TextPlace nowhere{FileId(~0u), ~0u};
  Aside<std::map<TextPlace, TextPlace>> spoken_; ///< by cause: the block that reported it
};

} // namespace ncvet
