// A rule that adds to a list block by block, and takes over what recorded runs have added.
#pragma once

#include "analyzer/rule/rule.h"

#include <variant>

namespace ncvet {

/// Moves the places of an item with the text: those of its members that are a `TextPlace`.
template <typename T>
void moveWithText(T &item, const TextChange &change) {
  if constexpr (std::is_same_v<T, TextPlace>)
    item.offset = change.moved(item.offset);
  else if constexpr (std::is_aggregate_v<T> && std::is_class_v<T>)
    if constexpr (!requires { item.size(); })
      eachField(item, [&](auto &part) { moveWithText(part, change); });
}

/// A stateful rule that also gathers items, more than can be compared at each block. A run that is
/// taken over tells what its blocks have gathered. `List` is what the rule makes of them; as the
/// items say all about it, it is not compared.
template <typename State, typename Item, typename List = std::monostate>
class GatheringRule : public StatefulRule<State> {
public:
  void startGathering() final { part_.emplace(); }
  std::shared_ptr<Gathered> gathered() const final {
    return part_ && !part_->items.empty() ? std::make_shared<Part>(*part_) : nullptr;
  }
  bool gather(const Gathered &gathered) final {
    return takeOver(static_cast<const Part &>(gathered).items);
  }

protected:
  /// Takes items for its own as if their blocks had been executed; false when the rule would have
  /// had something to say.
  virtual bool takeOver(llvm::ArrayRef<Item> items) const = 0;
  bool isGathering() const { return part_.has_value(); }
  /// Of the block that is being executed.
  void note(const Item &item) const {
    if (part_)
      part_->items.push_back(item);
  }
  List &list() const { return list_; }

private:
  struct Part final : Gathered {
    std::vector<Item> items;

    void move(const TextChange &change) override {
      for (Item &item : items)
        moveWithText(item, change);
    }
  };
  mutable std::optional<Part> part_; ///< since gathering started
  mutable List list_;
};

} // namespace ncvet
