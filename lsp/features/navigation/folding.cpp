// The parts of a document that an editor can fold.
#include "lsp/features/navigation/folding.h"

#include <algorithm>

namespace ncvet::lsp {

std::vector<Fold> folds(Snapshot &snapshot) {
  const llvm::StringRef text = snapshot.text();
  std::vector<Fold> folds;
  const auto add = [&](const Part &part, uint32_t end) {
    end = part.begin + uint32_t(text.slice(part.begin, end).rtrim().size());
    // Looked through from the end: of most parts the last line is short.
    if (text.slice(part.begin, end).find_last_of("\r\n") == llvm::StringRef::npos)
      return;
    folds.push_back({{snapshot.source().id(), part.begin, end}, part.kind});
  };
  for (const Part &part : partsOf(snapshot))
    add(part, part.end);
  std::vector<Part> structures = structuresOf(snapshot);
  for (size_t i = 0; i < structures.size(); ++i) {
    // The closing bracket stays in view. IF folds by its branches, the first of which begins where
    // it begins.
    const bool branched = structures[i].kind == PartKind::Loop && i + 1 < structures.size() &&
                          structures[i + 1].kind == PartKind::Branch &&
                          structures[i + 1].begin == structures[i].begin;
    if (!branched)
      add(structures[i], structures[i].closing);
  }
  std::stable_sort(folds.begin(), folds.end(), [](const Fold &a, const Fold &b) {
    return a.range.begin != b.range.begin ? a.range.begin < b.range.begin
                                          : a.range.end > b.range.end;
  });
  return folds;
}

} // namespace ncvet::lsp
