// Which elements of a contour have been defined so far, and under which switches.
#pragma once

#include "analyzer/rule/rule.h"

#include <map>

namespace ncvet {

/// Elements by address and number, in the order in which the program defines and uses them.
class DefinedElements {
public:
  struct Element {
    SourceRange where;
    uint32_t switches = 0; ///< that certainly were on
    bool used = false;
  };

  /// The word that the current block defines, or null.
  static const Word *definedBy(const RuleContext &ctx) {
    return ctx.find({Action::DefineElement}) ? ctx.block().findAny(ctx.dialect().elementWords)
                                             : nullptr;
  }
  /// The element that the block consists of, besides its number, or null.
  static const Word *alone(const RuleContext &ctx) {
    const Block &block = ctx.block();
    return block.words.size() == 1 && block.items.empty() &&
                   block.hasAny(ctx.dialect().elementWords)
               ? &block.words.front()
               : nullptr;
  }

  /// The definition so far is replaced; null: there was none.
  std::optional<Element> define(const Word &word, const RuleContext &ctx) {
    const Element fresh{ctx.range(word), ctx.before().switches.areOn(~0u), false};
    const auto [at, first] = elements_.try_emplace(key(word), fresh);
    if (first)
      return std::nullopt;
    const Element old = at->second;
    at->second = fresh;
    return old;
  }
  /// The definition of the element that the word names, or null.
  Element *find(const Word &word) {
    const auto at = elements_.find(key(word));
    return at == elements_.end() ? nullptr : &at->second;
  }
  const std::map<std::pair<AddressId, int64_t>, Element> &all() const { return elements_; }
  const auto &remembered() const { return elements_; }

private:
  static std::pair<AddressId, int64_t> key(const Word &word) {
    return {word.address, word.mantissa};
  }
  std::map<std::pair<AddressId, int64_t>, Element> elements_;
};

} // namespace ncvet
