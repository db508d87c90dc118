// Edits of a text: applying a set of them.
#include "formats/text/edit.h"

#include <algorithm>
#include <cassert>

namespace ncvet {

bool overlaps(const TextEdit &a, const TextEdit &b) {
  const SourceRange &x = a.range;
  const SourceRange &y = b.range;
  if (x.file != y.file)
    return false;
  if (x.empty() && y.empty())
    return x.begin == y.begin;
  if (x.empty())
    return y.begin < x.begin && x.begin < y.end;
  if (y.empty())
    return x.begin < y.begin && y.begin < x.end;
  return std::max(x.begin, y.begin) < std::min(x.end, y.end);
}

std::string applyEdits(llvm::StringRef text, llvm::ArrayRef<TextEdit> edits) {
  std::vector<const TextEdit *> sorted;
  sorted.reserve(edits.size());
  for (const TextEdit &edit : edits)
    sorted.push_back(&edit);
  // An insertion goes before a replacement that begins at the same place.
  std::stable_sort(sorted.begin(), sorted.end(), [](const TextEdit *a, const TextEdit *b) {
    return a->range.begin != b->range.begin ? a->range.begin < b->range.begin
                                            : a->range.end < b->range.end;
  });
  std::string out;
  out.reserve(text.size());
  size_t done = 0;
  [[maybe_unused]] const TextEdit *previous = nullptr; // for the assertion only
  for (const TextEdit *edit : sorted) {
    assert((!previous || !overlaps(*previous, *edit)) && "edits overlap");
    const size_t begin = std::max<size_t>(done, edit->range.begin);
    out += text.slice(done, begin);
    out += edit->text;
    done = std::max<size_t>(begin, edit->range.end);
    previous = edit;
  }
  out += text.substr(done);
  return out;
}

} // namespace ncvet
