// What rules remember of the blocks that they have seen, in a form that can be compared.
#pragma once

#include "analyzer/rule/fields.h"
#include "formats/text/text_change.h"
#include "interp/state/state.h"

#include "llvm/ADT/DenseMap.h"
#include "llvm/ADT/Hashing.h"
#include "llvm/ADT/StringMap.h"
#include "llvm/ADT/bit.h"
#include "llvm/Support/xxhash.h"

#include <array>
#include <map>
#include <set>
#include <type_traits>
#include <unordered_map>

namespace ncvet {

/// A place in a text, for what a rule remembers: it moves with the text.
struct TextPlace {
  FileId file = 0;
  uint32_t offset = 0;

  auto operator<=>(const TextPlace &) const = default;
};

/// What a rule remembers and asks for in few blocks, such as what has been reported already: runs
/// in which it is not looked at are the same whatever it is.
template <typename T>
class Aside {
public:
  /// For a block that depends on it.
  T &look() {
    stateUse.aside = true;
    return value_;
  }
  /// For blocks that only add to it.
  T &note() { return value_; }

private:
  friend class RuleMemory;
  T value_{};
};

/// A list of points to which a rule only adds, and which is long: it is compared by a sum of them.
template <typename T>
class SummedList {
public:
  const std::vector<T> &items() const { return items_; }
  void add(const T &item) {
    items_.push_back(item);
    for (const double number : item)
      sum_ = llvm::hash_combine(sum_, llvm::bit_cast<uint64_t>(number));
  }

private:
  friend class RuleMemory;
  std::vector<T> items_;
  uint64_t sum_ = 0;
};

/// The memories of all rules at one place of a run, one after the other. Two that are equal let
/// the rules go on in the same way. Places in the analysed file move with its text.
///
/// What it writes of a value follows from the value's type: of a struct every member; of a class
/// what `remembered()` gives, which is all of its members; of a class with `isIdle()` nothing while
/// that is true, and as long as it is not the memory cannot be compared.
class RuleMemory {
public:
  explicit RuleMemory(FileId file) : file_(file) {}

  template <typename... T>
  void operator()(const T &...values) {
    (add(values), ...);
  }
  void clear() {
    for (Words &words : kinds_) {
      words.all.clear();
      words.places.clear();
    }
    comparable_ = true;
  }
  /// False: something is remembered that cannot be compared.
  bool isComparable() const { return comparable_; }
  /// Whether both let the rules go on in the same way. `asides`: what they keep aside counts.
  bool isSame(const RuleMemory &other, bool asides) const {
    return comparable_ && other.comparable_ && kinds_[0].all == other.kinds_[0].all &&
           (!asides || kinds_[1].all == other.kinds_[1].all);
  }
  FileId file() const { return file_; }
  void move(const TextChange &change) {
    for (Words &words : kinds_)
      for (const uint32_t place : words.places)
        words.all[place] = change.moved(uint32_t(words.all[place]));
  }
  /// Of a rule that never remembers anything.
  void leaveOut() { leftOut_ = true; }
  bool isLeftOut() const { return leftOut_; }

private:
  template <typename T>
  static constexpr bool isList = requires(const T &list) {
    list.begin();
    list.end();
    list.size();
  };
  template <typename T>
  static constexpr bool hasMembers = requires(const T &value) {
    value.remembered();
  };
  template <typename T>
  static constexpr bool mayBeIdle = requires(const T &value) {
    value.isIdle();
  };

  struct Words {
    std::vector<uint64_t> all;
    std::vector<uint32_t> places; ///< which of them are offsets in the file
  };
  Words &words() { return kinds_[kind_]; }

  void place(FileId file, uint32_t offset) {
    add(file);
    if (file == file_)
      words().places.push_back(uint32_t(words().all.size()));
    words().all.push_back(offset);
  }
  void add(const TextPlace &at) { place(at.file, at.offset); }
  template <typename T>
  void add(const Aside<T> &aside) {
    kind_ = 1;
    add(aside.value_);
    kind_ = 0;
  }
  template <typename T>
  void add(const SummedList<T> &list) {
    add(list.items_.size());
    add(list.sum_);
  }
  void add(const SourceRange &range) {
    if (range.end == 0)
      return words().all.push_back(0);
    place(range.file, range.begin);
    place(range.file, range.end);
  }
  void add(const Origin &origin) { add(SourceRange{origin.file, origin.begin, origin.end}); }
  void add(const std::string &text) { words().all.push_back(llvm::xxHash64(text)); }
  void add(const Interval &value) {
    add(value.lo);
    add(value.hi);
  }
  template <typename A, typename B>
  void add(const std::pair<A, B> &pair) {
    add(pair.first);
    add(pair.second);
  }
  template <typename T>
  void add(const std::optional<T> &value) {
    words().all.push_back(value.has_value());
    if (value)
      add(*value);
  }
  template <typename K, typename V>
  void add(const std::unordered_map<K, V> &map) {
    addUnordered(map.size());
  }
  template <typename K, typename V>
  void add(const llvm::DenseMap<K, V> &map) {
    addUnordered(map.size());
  }
  template <typename V>
  void add(const llvm::StringMap<V> &map) {
    addUnordered(map.size());
  }
  void addUnordered(size_t size) {
    words().all.push_back(size);
    comparable_ &= size == 0;
  }
  template <typename T>
  void add(const T &value) {
    if constexpr (std::is_floating_point_v<T>) {
      words().all.push_back(llvm::bit_cast<uint64_t>(double(value)));
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      words().all.push_back(uint64_t(value));
    } else if constexpr (hasMembers<T>) {
      static_assert(sizeof(value.remembered()) == sizeof(T), "a member is not remembered");
      add(value.remembered());
    } else if constexpr (mayBeIdle<T>) {
      comparable_ &= value.isIdle();
    } else if constexpr (isList<T>) {
      words().all.push_back(value.size());
      for (const auto &entry : value)
        add(entry);
    } else if constexpr (std::is_bounded_array_v<T>) {
      for (const auto &entry : value)
        add(entry);
    } else {
      static_assert(std::is_aggregate_v<T>, "a rule can only remember what can be compared");
      eachField(value, [&](const auto &field) { add(field); });
    }
  }

  FileId file_;
  std::array<Words, 2> kinds_; ///< what decides what rules do, and what they keep aside
  unsigned kind_ = 0;          ///< that is being written
  bool comparable_ = true;
  bool leftOut_ = false;
};

} // namespace ncvet
