// What rules remember of the blocks that they have seen, in a form that can be compared.
#pragma once

#include "formats/text/text_change.h"
#include "interp/state.h"

#include "llvm/ADT/StringMap.h"
#include "llvm/Support/xxhash.h"

#include <array>
#include <bit>
#include <map>
#include <set>
#include <type_traits>

namespace ncvet {

/// The memories of all rules at one place of a run, one behind the other. Two that are equal let
/// the rules go on in the same way. Places in the analysed file move with its text.
class RuleMemory {
public:
  explicit RuleMemory(FileId file) : file_(file) {}

  template <typename... T>
  void operator()(const T &...values) {
    (add(values), ...);
  }
  void clear() {
    words_.clear();
    places_.clear();
    comparable_ = true;
  }
  /// False: something is remembered that cannot be compared.
  bool isComparable() const { return comparable_; }
  friend bool operator==(const RuleMemory &a, const RuleMemory &b) {
    return a.comparable_ && b.comparable_ && a.words_ == b.words_;
  }
  FileId file() const { return file_; }
  void move(const TextChange &change) {
    for (const uint32_t place : places_)
      words_[place] = change.moved(uint32_t(words_[place]));
  }
  /// A place in a file.
  void place(FileId file, uint32_t offset) {
    add(file);
    if (file == file_)
      places_.push_back(uint32_t(words_.size()));
    words_.push_back(offset);
  }

private:
  template <typename T>
  static constexpr bool isList = requires(const T &list) {
    list.begin();
    list.end();
    list.size();
  };
  template <typename T>
  static constexpr bool remembers = requires(const T &value, RuleMemory &memory) {
    value.remember(memory);
  };

  void add(const SourceRange &range) {
    if (range.end == 0)
      return words_.push_back(0);
    place(range.file, range.begin);
    place(range.file, range.end);
  }
  void add(const Origin &origin) { add(SourceRange{origin.file, origin.begin, origin.end}); }
  void add(const std::string &text) { words_.push_back(llvm::xxHash64(text)); }
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
    words_.push_back(value.has_value());
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
    words_.push_back(size);
    comparable_ &= size == 0;
  }
  template <typename T>
  void add(const T &value) {
    if constexpr (std::is_floating_point_v<T>) {
      words_.push_back(std::bit_cast<uint64_t>(double(value)));
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      words_.push_back(uint64_t(value));
    } else if constexpr (remembers<T>) {
      value.remember(*this);
    } else if constexpr (isList<T>) {
      words_.push_back(value.size());
      for (const auto &entry : value)
        add(entry);
    } else {
      comparable_ = false;
    }
  }

  FileId file_;
  std::vector<uint64_t> words_;
  std::vector<uint32_t> places_; ///< which of the words are offsets in the file
  bool comparable_ = true;
};

} // namespace ncvet
