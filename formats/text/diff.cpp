// Unified diff: finds the changed stretches by looking ahead for where both texts agree again. Much
// faster than a shortest edit script, and as short for what fixes and formatting change.
#include "formats/text/diff.h"

#include "llvm/ADT/ArrayRef.h"

#include <algorithm>
#include <vector>

namespace ncvet {

namespace {

using Lines = std::vector<llvm::StringRef>;

constexpr size_t lookAhead = 256; ///< lines; the search for agreement costs its square at most
constexpr size_t agreement = 2;   ///< equal lines that end a change
constexpr size_t context = 3;     ///< equal lines shown around a change

/// Lines with their ends.
Lines linesOf(llvm::StringRef text) {
  Lines lines;
  while (!text.empty()) {
    const size_t end = text.find('\n');
    lines.push_back(text.take_front(end == llvm::StringRef::npos ? end : end + 1));
    text = text.drop_front(lines.back().size());
  }
  return lines;
}

/// Lines [begin, end) of both texts that differ.
struct Change {
  size_t oldBegin, oldEnd, newBegin, newEnd;
};

bool agreesAt(const Lines &before, size_t i, const Lines &after, size_t j) {
  for (size_t k = 0; k < agreement; ++k) {
    const bool oldEnds = i + k >= before.size(), newEnds = j + k >= after.size();
    if (oldEnds || newEnds)
      return oldEnds && newEnds;
    if (before[i + k] != after[j + k])
      return false;
  }
  return true;
}

/// From a difference at (i, j), the nearest place where the texts agree again.
Change changeAt(const Lines &before, size_t i, const Lines &after, size_t j) {
  for (size_t steps = 1; steps <= lookAhead; ++steps)
    for (size_t removed = 0; removed <= steps; ++removed) {
      const size_t oldEnd = i + removed, newEnd = j + (steps - removed);
      if (oldEnd <= before.size() && newEnd <= after.size() &&
          agreesAt(before, oldEnd, after, newEnd))
        return {i, oldEnd, j, newEnd};
    }
  return {i, std::min(i + lookAhead / 2, before.size()), j,
          std::min(j + lookAhead / 2, after.size())};
}

std::vector<Change> changesOf(const Lines &before, const Lines &after) {
  std::vector<Change> changes;
  size_t i = 0, j = 0;
  while (i < before.size() || j < after.size()) {
    if (i < before.size() && j < after.size() && before[i] == after[j]) {
      ++i, ++j;
      continue;
    }
    const Change change = changeAt(before, i, after, j);
    i = change.oldEnd;
    j = change.newEnd;
    if (!changes.empty() && changes.back().oldEnd == change.oldBegin &&
        changes.back().newEnd == change.newBegin) {
      changes.back().oldEnd = i;
      changes.back().newEnd = j;
    } else {
      changes.push_back(change);
    }
  }
  return changes;
}

class DiffWriter {
public:
  DiffWriter(const Lines &before, const Lines &after, llvm::raw_ostream &out)
      : before_(before), after_(after), out_(out) {}

  /// Writes changes that are so near to each other that their context joins.
  void hunk(llvm::ArrayRef<Change> changes) {
    const Change &first = changes.front(), &last = changes.back();
    const size_t before = std::min(context, first.oldBegin);
    const size_t after = std::min(context, before_.size() - last.oldEnd);
    out_ << "@@ -";
    range(first.oldBegin - before, last.oldEnd + after);
    out_ << " +";
    range(first.newBegin - before, last.newEnd + after);
    out_ << " @@\n";
    size_t at = first.oldBegin - before;
    for (const Change &change : changes) {
      lines(' ', before_, at, change.oldBegin);
      lines('-', before_, change.oldBegin, change.oldEnd);
      lines('+', after_, change.newBegin, change.newEnd);
      at = change.oldEnd;
    }
    lines(' ', before_, at, at + after);
  }

private:
  void range(size_t begin, size_t end) {
    const size_t count = end - begin;
    // An empty range is given by the line before it.
    out_ << begin + (count ? 1 : 0);
    if (count != 1)
      out_ << ',' << count;
  }

  void lines(char sign, const Lines &from, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      out_ << sign << from[i];
      if (!from[i].endswith("\n"))
        out_ << "\n\\ No newline at end of file\n";
    }
  }

  const Lines &before_;
  const Lines &after_;
  llvm::raw_ostream &out_;
};

} // namespace

void writeUnifiedDiff(llvm::StringRef before, llvm::StringRef after, llvm::StringRef name,
                      llvm::raw_ostream &out) {
  if (before == after)
    return;
  const Lines oldLines = linesOf(before), newLines = linesOf(after);
  const std::vector<Change> changes = changesOf(oldLines, newLines);
  out << "--- " << name << "\n+++ " << name << '\n';
  DiffWriter writer(oldLines, newLines, out);
  for (size_t begin = 0; begin < changes.size();) {
    size_t end = begin + 1;
    while (end < changes.size() && changes[end].oldBegin - changes[end - 1].oldEnd <= 2 * context)
      ++end;
    writer.hunk(llvm::makeArrayRef(changes).slice(begin, end - begin));
    begin = end;
  }
}

} // namespace ncvet
