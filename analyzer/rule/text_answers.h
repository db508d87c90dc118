// What a rule works out from the texts alone.
#pragma once

#include <map>

namespace ncvet {

/// Answers to questions about the texts, each worked out once. They are the same whatever blocks
/// were executed before: nothing of them is remembered.
template <typename Key, typename T>
class TextAnswers {
public:
  /// The answer for `key`; `make` works it out.
  template <typename Make>
  const T &of(const Key &key, const Make &make) const {
    const auto [at, fresh] = known_.try_emplace(key);
    if (fresh)
      at->second = make();
    return at->second;
  }
  /// One that grows: what a part of the text has to say, of which more is read when it is asked
  /// for. Nothing but the text decides how it grows.
  T &growing(const Key &key) const { return known_[key]; }

private:
  mutable std::map<Key, T> known_;
};

} // namespace ncvet
