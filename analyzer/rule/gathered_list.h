// A list that a rule gathers block by block.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// What a rule has added to its list since gathering started. `T` may have a member
/// `move(const TextChange &)` for its places in the text.
template <typename T>
class GatheredList {
public:
  void start() { part_.emplace(); }
  void add(const T &item) {
    if (part_)
      part_->items.push_back(item);
  }
  /// Nothing that decides what a rule does.
  void remember(RuleMemory &) const {}
  /// For `Rule::gathered`.
  std::shared_ptr<Gathered> part() const {
    return part_ && !part_->items.empty() ? std::make_shared<Part>(*part_) : nullptr;
  }
  static llvm::ArrayRef<T> itemsOf(const Gathered &gathered) {
    return static_cast<const Part &>(gathered).items;
  }

private:
  struct Part final : Gathered {
    std::vector<T> items;

    void move(const TextChange &change) override {
      if constexpr (requires(T item) { item.move(change); })
        for (T &item : items)
          item.move(change);
    }
  };
  std::optional<Part> part_; ///< since gathering started
};

} // namespace ncvet
