// A change of a text: which bytes became which.
#pragma once

#include "formats/text/source.h"

namespace ncvet {

/// The bytes [begin, end) of a text became `added` bytes.
struct TextChange {
  uint32_t begin = 0, end = 0, added = 0;

  uint32_t endAfter() const { return begin + added; }
  /// Whether a range lies wholly before the change or after it.
  bool spares(uint32_t from, uint32_t to) const { return to <= begin || from >= end; }
  /// Where a place that is not inside the change is after it.
  uint32_t moved(uint32_t offset) const {
    return offset >= end ? offset - end + endAfter() : offset;
  }
};

/// What changes that were made one after the other have made of a text: pieces of it that became
/// other pieces, in order and apart from each other.
class TextChanges {
public:
  TextChanges() = default;
  explicit TextChanges(const TextChange &change) { add(change); }

  /// One more change, of the text as it is after all before it.
  void add(const TextChange &change);
  /// Pieces between which no line of `after`, the text as it is now, ends become one.
  void joinInLines(llvm::StringRef after);
  /// The pieces as changes to be made one after the other, from the front of the text.
  std::vector<TextChange> fromFront() const;
  bool empty() const { return pieces_.empty(); }

private:
  struct Piece {
    uint32_t before, beforeEnd; ///< in the first text
    uint32_t begin, end;        ///< in the last
  };
  std::vector<Piece> pieces_;
};

/// How a text has come from its last versions.
struct TextHistory {
  struct Step {
    std::weak_ptr<const std::string> before;
    TextChange change;
  };
  std::vector<Step> steps; ///< the last one leads to the present version

  /// The history of the version that `change` makes of `before`.
  static std::shared_ptr<const TextHistory> with(const SharedText &before,
                                                 const TextChange &change);
};

/// What has become of `before`: from the history of `after`, or by comparing the two.
TextChanges changesBetween(const std::shared_ptr<const std::string> &before,
                           const SharedText &after);

/// The one change that leads from a text to another: what lies between the bytes that they have in
/// common at their begin and at their end.
TextChange changeBetween(llvm::StringRef before, llvm::StringRef after);

} // namespace ncvet
