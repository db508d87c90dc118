// A list that copies of its owner share until one of them is changed.
#pragma once

#include "llvm/ADT/IntrusiveRefCntPtr.h"

namespace ncvet {

/// Counted by its owners, which all run on one thread.
template <typename List>
struct SharedList {
  List entries;
  mutable unsigned users = 0;

  SharedList() = default;
  SharedList(const SharedList &other) : entries(other.entries) {}
  SharedList &operator=(const SharedList &) = delete;
  void Retain() const { ++users; }
  void Release() const {
    if (--users == 0)
      delete this;
  }
};

/// The entries, from now on shared with nobody: what `data` shared is copied.
template <typename List>
List &ownEntries(llvm::IntrusiveRefCntPtr<SharedList<List>> &data) {
  if (!data)
    data = new SharedList<List>;
  else if (data->users > 1)
    data = new SharedList<List>(*data);
  return data->entries;
}

} // namespace ncvet
