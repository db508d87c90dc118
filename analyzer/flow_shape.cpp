// Which brackets of loops and structured flow belong together in a program.
#include "analyzer/flow_shape.h"

#include <algorithm>

namespace ncvet {

namespace {

/// What a closing bracket closes.
enum class Bracket : uint8_t { Numbered, If, Else, While, For, Loop, Repeat };

struct Open {
  uint32_t offset;
  Bracket bracket;
  uint8_t loop; ///< of a numbered one
};

class ShapeReader {
public:
  FlowShape read(const Reader &reader, uint32_t begin, uint32_t end) {
    Block block;
    for (uint32_t at = begin; at < end; at = block.next) {
      reader.read(at, block);
      for (const Item &item : block.items)
        bracket(item, at, block.next);
    }
    for (const Open &left : open_)
      shape_.mismatched.push_back(left.offset);
    return std::move(shape_);
  }

private:
  void bracket(const Item &item, uint32_t at, uint32_t next) {
    switch (item.kind) {
    case ItemKind::While:
    case ItemKind::Do:
      return begin(at, Bracket::Numbered, item.loop);
    case ItemKind::End:
      return end(at, next, {Bracket::Numbered}, item.loop);
    case ItemKind::Structure:
      break;
    default:
      return;
    }
    switch (item.structure) {
    case Structure::If:
      return begin(at, Bracket::If);
    case Structure::Else:
      end(at, next, {Bracket::If});
      return begin(at, Bracket::Else);
    case Structure::EndIf:
      return end(at, next, {Bracket::If, Bracket::Else});
    case Structure::While:
      return begin(at, Bracket::While);
    case Structure::EndWhile:
      return end(at, next, {Bracket::While});
    case Structure::For:
      return begin(at, Bracket::For);
    case Structure::EndFor:
      return end(at, next, {Bracket::For});
    case Structure::Loop:
      return begin(at, Bracket::Loop);
    case Structure::EndLoop:
      return end(at, next, {Bracket::Loop});
    case Structure::Repeat:
      return begin(at, Bracket::Repeat);
    case Structure::Until:
      return end(at, next, {Bracket::Repeat});
    }
  }

  void begin(uint32_t at, Bracket bracket, uint8_t loop = 0) {
    open_.push_back({at, bracket, loop});
    shape_.depth = std::max(shape_.depth, unsigned(open_.size()));
  }

  /// Closes the innermost open bracket of these kinds; those inside that were not closed are
  /// broken.
  void end(uint32_t at, uint32_t next, std::initializer_list<Bracket> kinds, uint8_t loop = 0) {
    size_t i = open_.size();
    while (i > 0 && !(llvm::is_contained(kinds, open_[i - 1].bracket) && open_[i - 1].loop == loop))
      --i;
    if (i == 0) {
      shape_.mismatched.push_back(at);
      return;
    }
    for (size_t j = i; j < open_.size(); ++j)
      shape_.mismatched.push_back(open_[j].offset);
    const uint32_t head = open_[i - 1].offset;
    shape_.past[head] = next;
    shape_.back[at] = head;
    open_.resize(i - 1);
  }

  FlowShape shape_;
  std::vector<Open> open_;
};

} // namespace

FlowShape readShape(const Reader &reader, uint32_t begin, uint32_t end) {
  return ShapeReader().read(reader, begin, end);
}

} // namespace ncvet
