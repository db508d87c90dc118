// The variables of a macro program: a small map that is cheap to copy.
#pragma once

#include "interp/value/shared_list.h"
#include "interp/value/value.h"

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/STLExtras.h"
#include "llvm/ADT/SmallVector.h"

namespace ncvet {

/// Map from a variable's key (its number, or `variableKey`) to its value. Copies share their
/// storage until one of them is written to. What is not in the map has the value that `fallback`
/// says, and was not given one by the program, unless everything has been forgotten.
class Variables {
public:
  explicit Variables(Value fallback = Value::unknown()) : fallback_(fallback) {}
  /// Those that have the numbers from 1 on are given these values.
  static Variables numbered(llvm::ArrayRef<Value> values);

  Value get(uint64_t key) const;
  /// Whether the program has given it a value: unknown where only some paths lead past an
  /// assignment and where everything has been forgotten.
  Truth given(uint64_t key) const;
  /// Whether some of the paths lead past an assignment and others do not, and nothing was forgotten
  /// on any of them.
  bool givenOnSomePaths(uint64_t key) const;
  void set(uint64_t key, const Value &value);
  /// From here on the program has given it no value.
  void erase(uint64_t key);
  /// Forgets everything: all variables unknown, and any of them may have been given a value.
  void forget();
  bool empty() const;
  /// Whether the program may have given a value to a variable with this key, or a higher one.
  bool mayBeGivenFrom(uint64_t key) const;

  static Variables join(const Variables &a, const Variables &b);
  static Variables widen(const Variables &previous, const Variables &next);
  friend bool operator==(const Variables &a, const Variables &b);
  uint64_t hash() const;

private:
  struct Entry {
    uint64_t number;
    Value value;
    Truth given = Truth::Yes;
  };
  using Entries = llvm::SmallVector<Entry, 12>; ///< sorted by number
  template <typename Combine>
  static Variables merge(const Variables &a, const Variables &b, Combine combine);

  const Entry *find(uint64_t key) const;
  /// What an entry says of a variable, or the rest does when there is none.
  Entry entryOf(uint64_t key) const;
  void write(const Entry &entry);
  static bool before(const Entry &entry, uint64_t key);

  llvm::IntrusiveRefCntPtr<SharedList<Entries>> data_;
  Value fallback_;
  Truth othersGiven_ = Truth::No; ///< of variables without an entry; No or Unknown
};

} // namespace ncvet
