// The variables of a macro program: a small map that is cheap to copy.
#include "interp/value/variables.h"

#include "interp/value/access_log.h"
#include "interp/value/work_meter.h"

#include "llvm/ADT/Hashing.h"
#include "llvm/ADT/bit.h"

#include <algorithm>

namespace ncvet {

/// So many variables are brought together, and compared before and after that, in the time of a
/// plain move.
constexpr size_t entriesOfOneMove = 32;

bool Variables::before(const Entry &entry, uint64_t number) { return entry.number < number; }

const Variables::Entry *Variables::find(uint64_t number) const {
  if (!data_)
    return nullptr;
  const auto &entries = data_->entries;
  if (entries.empty())
    return nullptr;
  // Most often the numbers of those before it have no gaps.
  const auto guess = size_t(number - entries.front().number);
  if (guess < entries.size() && entries[guess].number == number)
    return &entries[guess];
  const auto *const at = std::lower_bound(entries.begin(), entries.end(), number, before);
  return at != entries.end() && at->number == number ? &*at : nullptr;
}

Variables::Entry Variables::entryOf(uint64_t number) const {
  const Entry *entry = find(number);
  return entry ? *entry : Entry{number, fallback_, othersGiven_};
}

namespace {

void touch() { stateUse.others |= bitOf(StatePart::Variables); }

} // namespace

Value Variables::get(uint64_t number) const {
  touch();
  const Entry *entry = find(number);
  return entry ? entry->value : fallback_;
}

bool Variables::empty() const {
  touch();
  return !data_ || data_->entries.empty();
}

bool Variables::mayBeGivenFrom(uint64_t key) const {
  touch();
  if (othersGiven_ != Truth::No || !data_)
    return othersGiven_ != Truth::No;
  const auto &entries = data_->entries;
  for (auto at = entries.rbegin(); at != entries.rend() && at->number >= key; ++at)
    if (at->given != Truth::No)
      return true;
  return false;
}

Truth Variables::given(uint64_t number) const {
  touch();
  const Entry *entry = find(number);
  return entry ? entry->given : othersGiven_;
}

bool Variables::givenOnSomePaths(uint64_t number) const {
  touch();
  const Entry *entry = find(number);
  return entry && entry->given == Truth::Unknown && othersGiven_ == Truth::No;
}

void Variables::set(uint64_t number, const Value &value) {
  touch();
  write({number, value});
}

Variables Variables::numbered(llvm::ArrayRef<Value> values) {
  touch();
  Variables result;
  result.data_ = new SharedList<Entries>;
  Entries &entries = result.data_->entries;
  entries.resize_for_overwrite(values.size());
  for (size_t i = 0; i < values.size(); ++i)
    entries[i] = {i + 1, values[i]};
  return result;
}

void Variables::write(const Entry &entry) {
  const Entry *const known = find(entry.number);
  if (known && known->value == entry.value && known->given == entry.given)
    return; // others may go on sharing the list
  const size_t index = known ? size_t(known - data_->entries.begin()) : 0;
  auto &entries = ownEntries(data_);
  if (known)
    entries[index] = entry;
  else
    entries.insert(std::lower_bound(entries.begin(), entries.end(), entry.number, before), entry);
}

void Variables::erase(uint64_t number) {
  touch();
  if (othersGiven_ == Truth::No && !find(number))
    return;
  if (othersGiven_ == Truth::No)
    llvm::erase_if(ownEntries(data_), [&](const Entry &e) { return e.number == number; });
  else
    write({number, fallback_, Truth::No});
}

void Variables::forget() {
  touch();
  data_ = nullptr;
  fallback_ = Value::unknown();
  othersGiven_ = Truth::Unknown;
}

template <typename Combine>
Variables Variables::merge(const Variables &a, const Variables &b, Combine combine) {
  if (a.data_ == b.data_ && a.fallback_ == b.fallback_ && a.othersGiven_ == b.othersGiven_)
    return a;
  const auto both = [](Truth x, Truth y) { return x == y ? x : Truth::Unknown; };
  Variables result(combine(a.fallback_, b.fallback_));
  result.othersGiven_ = both(a.othersGiven_, b.othersGiven_);
  static const Entries none;
  const auto &left = a.data_ ? a.data_->entries : none;
  const auto &right = b.data_ ? b.data_->entries : none;
  workDone += (left.size() + right.size()) / entriesOfOneMove;
  const auto *i = left.begin();
  const auto *j = right.begin();
  llvm::IntrusiveRefCntPtr<SharedList<Entries>> data(new SharedList<Entries>);
  const auto add = [&](const Entry &x, const Entry &y) {
    data->entries.push_back({x.number, combine(x.value, y.value), both(x.given, y.given)});
  };
  while (i != left.end() || j != right.end())
    if (j == right.end() || (i != left.end() && i->number < j->number)) {
      add(*i, {i->number, b.fallback_, b.othersGiven_});
      ++i;
    } else if (i == left.end() || j->number < i->number) {
      add({j->number, a.fallback_, a.othersGiven_}, *j);
      ++j;
    } else {
      add(*i++, *j++);
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
  touch();
  if (!(a.fallback_ == b.fallback_) || a.othersGiven_ != b.othersGiven_)
    return false;
  if (a.data_ == b.data_)
    return true;
  // An entry that says what the rest says counts for nothing: compare what the two answer.
  static const Variables::Entries none;
  const auto same = [&](const Variables::Entry &x, const Variables::Entry &y) {
    return x.value == y.value && x.given == y.given;
  };
  if (a.data_ && b.data_) { // most often the two name the same variables
    const auto &left = a.data_->entries, &right = b.data_->entries;
    if (std::equal(left.begin(), left.end(), right.begin(), right.end(),
                   [](const auto &x, const auto &y) { return x.number == y.number; }))
      return std::equal(left.begin(), left.end(), right.begin(), same);
  }
  for (const auto &entry : a.data_ ? a.data_->entries : none)
    if (!same(entry, b.entryOf(entry.number)))
      return false;
  for (const auto &entry : b.data_ ? b.data_->entries : none)
    if (!same(entry, a.entryOf(entry.number)))
      return false;
  return true;
}

uint64_t Variables::hash() const {
  uint64_t result = llvm::hash_combine(unsigned(fallback_.kind), unsigned(othersGiven_));
  if (data_)
    for (const Entry &entry : data_->entries)
      if (!(entry.value == fallback_) || entry.given != othersGiven_)
        result = llvm::hash_combine(
            result, entry.number, unsigned(entry.given), unsigned(entry.value.kind),
            llvm::hash_value(llvm::bit_cast<uint64_t>(entry.value.number.lo)),
            llvm::hash_value(llvm::bit_cast<uint64_t>(entry.value.number.hi)));
  return result;
}

} // namespace ncvet
