// The variables of a macro program: a small map that is cheap to copy.
#include "interp/variables.h"

#include "llvm/ADT/Hashing.h"

#include <algorithm>
#include <bit>

namespace ncvet {

Value Variables::get(uint64_t number) const {
  if (!data_)
    return fallback_;
  const auto &entries = data_->entries;
  const auto at = std::lower_bound(entries.begin(), entries.end(), number,
                                   [](const Entry &e, uint64_t n) { return e.number < n; });
  return at != entries.end() && at->number == number ? at->value : fallback_;
}

bool Variables::has(uint64_t number) const {
  if (!data_)
    return false;
  const auto at = std::lower_bound(data_->entries.begin(), data_->entries.end(), number,
                                   [](const Entry &e, uint64_t n) { return e.number < n; });
  return at != data_->entries.end() && at->number == number;
}

void Variables::set(uint64_t number, const Value &value) {
  if (!data_)
    data_ = new Data;
  else if (data_->users > 1)
    data_ = new Data(*data_);
  auto &entries = data_->entries;
  const auto at = std::lower_bound(entries.begin(), entries.end(), number,
                                   [](const Entry &e, uint64_t n) { return e.number < n; });
  if (at != entries.end() && at->number == number)
    at->value = value;
  else
    entries.insert(at, {number, value});
}

void Variables::erase(uint64_t number) {
  if (!has(number))
    return;
  if (data_->users > 1)
    data_ = new Data(*data_);
  llvm::erase_if(data_->entries, [&](const Entry &e) { return e.number == number; });
}

void Variables::forget() {
  data_ = nullptr;
  fallback_ = Value::unknown();
}

template <typename Combine>
Variables Variables::merge(const Variables &a, const Variables &b, Combine combine) {
  if (a.data_ == b.data_ && a.fallback_ == b.fallback_)
    return a;
  Variables result(combine(a.fallback_, b.fallback_));
  static const std::vector<Entry> none;
  const auto &left = a.data_ ? a.data_->entries : none;
  const auto &right = b.data_ ? b.data_->entries : none;
  auto i = left.begin();
  auto j = right.begin();
  llvm::IntrusiveRefCntPtr<Data> data(new Data);
  while (i != left.end() || j != right.end()) {
    Entry entry;
    if (j == right.end() || (i != left.end() && i->number < j->number)) {
      entry = {i->number, combine(i->value, b.fallback_)};
      ++i;
    } else if (i == left.end() || j->number < i->number) {
      entry = {j->number, combine(a.fallback_, j->value)};
      ++j;
    } else {
      entry = {i->number, combine(i->value, j->value)};
      ++i;
      ++j;
    }
    data->entries.push_back(entry); // one that is not known any more has been given a value too
  }
  if (!data->entries.empty())
    result.data_ = data;
  return result;
}

Variables Variables::join(const Variables &a, const Variables &b) {
  return merge(a, b, [](const Value &x, const Value &y) { return ncvet::join(x, y); });
}

Variables Variables::widen(const Variables &previous, const Variables &next) {
  return merge(previous, next, [](const Value &x, const Value &y) { return ncvet::widen(x, y); });
}

bool operator==(const Variables &a, const Variables &b) {
  if (!(a.fallback_ == b.fallback_))
    return false;
  if (a.data_ == b.data_)
    return true;
  // An entry that equals the fallback says nothing: compare what the two answer.
  static const std::vector<Variables::Entry> none;
  for (const auto &entry : a.data_ ? a.data_->entries : none)
    if (!(b.get(entry.number) == entry.value))
      return false;
  for (const auto &entry : b.data_ ? b.data_->entries : none)
    if (!(a.get(entry.number) == entry.value))
      return false;
  return true;
}

uint64_t Variables::hash() const {
  uint64_t result = uint64_t(fallback_.kind);
  if (data_)
    for (const Entry &entry : data_->entries)
      if (!(entry.value == fallback_))
        result =
            llvm::hash_combine(result, entry.number, unsigned(entry.value.kind),
                               llvm::hash_value(std::bit_cast<uint64_t>(entry.value.number.lo)),
                               llvm::hash_value(std::bit_cast<uint64_t>(entry.value.number.hi)));
  return result;
}

} // namespace ncvet
