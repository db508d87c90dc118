// Names of a program text: what is the same name, and where it is defined.
#include "lsp/features/names.h"

#include "lsp/features/name_pass.h"

#include "llvm/ADT/StringExtras.h"

#include <algorithm>
#include <tuple>

namespace ncvet::lsp {

namespace {

/// What all occurrences of one name have in common.
auto sameName(const Occurrence &one) { return std::make_tuple(one.kind, one.scope, one.key); }

} // namespace

Names::Names(const FileUnit &unit) : unit_(unit) {
  FoundNames found = NamePass(unit).find();
  all_ = std::move(found.all);
  scopes_ = std::move(found.scopes);
  untold_ = std::move(found.untold);
}

uint32_t Names::programAt(uint32_t offset) const {
  const auto programs = unit_.index.programs();
  return uint32_t(&unit_.index.programAt(offset) - programs.begin());
}

const Occurrence *Names::at(uint32_t offset) const {
  auto next = std::upper_bound(all_.begin(), all_.end(), offset,
                               [](uint32_t o, const Occurrence &one) { return o < one.begin; });
  const Occurrence *touched = nullptr;
  for (auto i = next; i != all_.begin() && next - i < 4;) {
    --i;
    if (offset < i->end)
      return &*i;
    if (offset == i->end)
      touched = &*i;
  }
  if (touched || next == all_.end())
    return touched;
  // At the address letter or the mark before it.
  constexpr uint32_t longest = 4;
  const llvm::StringRef text = unit_.source.text();
  if (next->begin - offset > longest)
    return nullptr;
  const llvm::StringRef mark = text.slice(offset, next->begin).rtrim(" \t");
  const bool inWord = offset > 0 && llvm::isAlnum(text[offset - 1]) && llvm::isAlnum(text[offset]);
  const bool isMark =
      !mark.empty() && mark.size() <= 2 && !inWord && llvm::all_of(mark, [](char c) {
        return llvm::isAlpha(c) || llvm::StringRef("#<[:%\"").contains(c);
      });
  return isMark ? &*next : nullptr;
}

llvm::ArrayRef<uint32_t> Names::same(const Occurrence &one) const {
  if (byName_.empty()) {
    byName_.resize(all_.size());
    for (size_t i = 0; i < all_.size(); ++i)
      byName_[i] = uint32_t(i);
    std::stable_sort(byName_.begin(), byName_.end(),
                     [&](uint32_t a, uint32_t b) { return sameName(all_[a]) < sameName(all_[b]); });
  }
  const auto key = sameName(one);
  const auto first =
      llvm::partition_point(byName_, [&](uint32_t i) { return sameName(all_[i]) < key; });
  const auto last = std::partition_point(first, byName_.end(),
                                         [&](uint32_t i) { return sameName(all_[i]) == key; });
  return llvm::makeArrayRef(byName_).slice(size_t(first - byName_.begin()), size_t(last - first));
}

llvm::ArrayRef<Occurrence> Names::within(uint32_t begin, uint32_t end) const {
  const auto before = [](const Occurrence &one, uint32_t o) { return one.begin < o; };
  const auto first = std::lower_bound(all_.begin(), all_.end(), begin, before);
  const auto last = std::lower_bound(first, all_.end(), std::max(begin, end), before);
  return llvm::makeArrayRef(all_).slice(size_t(first - all_.begin()), size_t(last - first));
}

const Occurrence *Names::firstOf(const Occurrence &last) const {
  const auto at = size_t(&last - all_.data());
  if (at >= all_.size())
    return nullptr;
  for (size_t distance = 1; distance <= 3; ++distance)
    for (const size_t i : {at - distance, at + distance})
      if (i < all_.size() && all_[i].use == NameUse::First && all_[i].scope == last.scope)
        return &all_[i];
  return nullptr;
}

const Occurrence *Names::definition(const Occurrence &one) const {
  if (one.scope == otherFile)
    return nullptr;
  const bool places = one.kind == NameKind::Block || one.kind == NameKind::Label;
  if (places && one.use == NameUse::Definition)
    return &one;
  uint32_t from = one.begin;
  if (one.use == NameUse::Last)
    if (const Occurrence *first = firstOf(one))
      if (const Occurrence *begin = definition(*first))
        from = begin->begin ? begin->begin - 1 : 0;
  const Occurrence *before = nullptr, *written = nullptr;
  for (const uint32_t i : same(one)) {
    const Occurrence &other = all_[i];
    if (other.use == NameUse::Write && !written)
      written = &other;
    if (other.use != NameUse::Definition)
      continue;
    if (!places)
      return &other;
    if (other.begin > from) {
      if (one.search != Search::Backward)
        return &other;
      break;
    }
    if (!before || one.search == Search::Backward)
      before = &other;
  }
  if (places)
    return one.search == Search::Forward ? nullptr : before;
  if (one.kind == NameKind::Variable)
    return written;
  return one.kind == NameKind::Bracket && !same(one).empty() ? &all_[same(one)[0]] : nullptr;
}

} // namespace ncvet::lsp
