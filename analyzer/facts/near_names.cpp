// Finds names that differ by one letter through what is left of both when a letter is taken out.
#include "analyzer/facts/near_names.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {
namespace {

std::string lettersOf(llvm::StringRef name) {
  std::string kept;
  for (const char c : name)
    if (!llvm::isDigit(c))
      kept += llvm::toUpper(c);
  return kept;
}

/// Calls `use` for the letters, and for what is left without each of them.
template <typename Use>
void eachRest(llvm::StringRef letters, const Use &use) {
  use(letters);
  std::string rest;
  for (size_t i = 0; i < letters.size(); ++i) {
    // Without either of two equal letters the same is left.
    if (i > 0 && letters[i] == letters[i - 1])
      continue;
    rest.assign(letters.begin(), letters.begin() + i);
    rest.append(letters.begin() + i + 1, letters.end());
    use(rest);
  }
}

} // namespace

NearNames::NearNames(const FileIndex::Definitions &definitions, size_t shortest) {
  llvm::StringMap<uint32_t> places;
  for (const auto &entry : definitions) {
    const Defined &defined = entry.getValue();
    if (defined.kind != ItemKind::Definition || entry.getKey().size() < shortest)
      continue;
    const std::string letters = lettersOf(entry.getKey());
    const auto [at, fresh] = places.try_emplace(letters, uint32_t(names_.size()));
    if (fresh)
      names_.push_back({letters, defined});
    else if (Defined &first = names_[at->second].first; defined.begin < first.begin)
      first = defined;
  }
  for (uint32_t i = 0; i < names_.size(); ++i)
    eachRest(names_[i].letters, [&](llvm::StringRef rest) { byRest_[rest].push_back(i); });
}

std::optional<Defined> NearNames::near(llvm::StringRef name) const {
  const std::string own = lettersOf(name);
  std::optional<Defined> found;
  eachRest(own, [&](llvm::StringRef rest) {
    const auto at = byRest_.find(rest);
    if (at == byRest_.end())
      return;
    for (const uint32_t place : at->second) {
      const Name &other = names_[place];
      if (other.letters != own && (!found || other.first.begin < found->begin) &&
          llvm::StringRef(other.letters).edit_distance(own, true, 1) == 1)
        found = other.first;
    }
  });
  return found;
}

} // namespace ncvet
