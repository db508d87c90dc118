// The variables of a macro program: a small map that is cheap to copy.
#pragma once

#include "interp/value.h"

#include "llvm/ADT/IntrusiveRefCntPtr.h"
#include "llvm/ADT/STLExtras.h"

#include <vector>

namespace ncvet {

/// Map from a variable's key (its number, or `variableKey`) to its value. Copies share their
/// storage until one of them is written to. What is not in the map has the value that `fallback`
/// says.
class Variables {
public:
  explicit Variables(Value fallback = Value::unknown()) : fallback_(fallback) {}

  Value get(uint64_t key) const;
  /// Whether the program has given it a value, on some way at least.
  bool has(uint64_t key) const;
  void set(uint64_t key, const Value &value);
  /// From here on the program has given it no value.
  void erase(uint64_t key);
  /// Forgets everything: all variables unknown.
  void forget();
  bool empty() const { return !data_ || data_->entries.empty(); }

  static Variables join(const Variables &a, const Variables &b);
  static Variables widen(const Variables &previous, const Variables &next);
  friend bool operator==(const Variables &a, const Variables &b);
  uint64_t hash() const;

private:
  struct Entry {
    uint64_t number;
    Value value;
  };
  struct Data {
    std::vector<Entry> entries; ///< sorted by number
    mutable unsigned users = 0;

    Data() = default;
    Data(const Data &other) : entries(other.entries) {}
    void Retain() const { ++users; }
    void Release() const {
      if (--users == 0)
        delete this;
    }
  };
  template <typename Combine>
  static Variables merge(const Variables &a, const Variables &b, Combine combine);

  llvm::IntrusiveRefCntPtr<Data> data_;
  Value fallback_;
};

} // namespace ncvet
