// Variables of a text whose values the editor shows beside them.
#include "lsp/features/showing/inline_values.h"

#include "lsp/features/names.h"

#include <set>

namespace ncvet::lsp {

namespace {

/// A line with more is none that a person reads.
constexpr size_t mostValues = 2000;

/// The variable with its mark: `#101`, `#<depth>`, `R1`.
SourceRange wholeOf(llvm::StringRef text, SourceRange name) {
  const llvm::StringRef before = text.take_front(name.begin);
  if (before.endswith("#<"))
    return {name.file, name.begin - 2, name.end + 1};
  if (before.endswith("#"))
    return {name.file, name.begin - 1, name.end};
  return name;
}

} // namespace

std::vector<InlineValue> inlineValues(Snapshot &snapshot, uint32_t begin, uint32_t end) {
  std::vector<InlineValue> values;
  const Names &names = snapshot.names();
  const llvm::StringRef text = snapshot.text();
  std::set<std::pair<uint32_t, uint64_t>> seen; // by line and variable
  for (const Occurrence &one : names.within(begin, end)) {
    if (one.kind != NameKind::Variable || values.size() == mostValues ||
        !seen.emplace(snapshot.source().lines().lineOf(one.begin), one.key).second)
      continue;
    const SourceRange whole = wholeOf(text, names.range(one));
    values.push_back({whole, text.slice(whole.begin, whole.end).str()});
  }
  return values;
}

} // namespace ncvet::lsp
