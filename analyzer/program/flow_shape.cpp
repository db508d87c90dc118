// Which brackets of loops and structured flow belong together in a program.
#include "analyzer/program/flow_shape.h"

#include "analyzer/program/block_reading.h"

#include <algorithm>
#include <map>

namespace ncvet {

namespace {

/// What a closing bracket closes.
enum class Bracket : uint8_t { Numbered, If, ElseIf, Else, While, For, Loop, Repeat, Times, Sub };

struct Open {
  uint32_t offset;
  Bracket bracket;
  uint64_t label;                 ///< number or label; 0: none
  std::vector<uint32_t> branches; ///< of an IF: the ELSEIFs so far
  std::vector<uint32_t> breaks, continues;
};

bool isBranch(const Item &item) {
  switch (item.kind) {
  case ItemKind::If:
  case ItemKind::While:
  case ItemKind::Jump:
    return true;
  case ItemKind::Input: // the operator's answer may lead elsewhere
    return item.arguments != 0;
  case ItemKind::Structure:
    return item.structure == Structure::If || item.structure == Structure::ElseIf ||
           item.structure == Structure::While || item.structure == Structure::Until ||
           item.structure == Structure::For || item.structure == Structure::Times;
  default:
    return false;
  }
}

class ShapeReader {
public:
  FlowShape read(const Reader &reader, uint32_t begin, uint32_t end) {
    for (const Block &block : blocks(reader, begin, end))
      for (const Item &item : block.items) {
        shape_.branches |= isBranch(item);
        bracket(item, block.begin, block.next);
      }
    for (const Open &left : open_)
      leftOpen(left);
    return std::move(shape_);
  }

private:
  void bracket(const Item &item, uint32_t at, uint32_t next) {
    switch (item.kind) {
    case ItemKind::While:
    case ItemKind::Do:
      label_ = item.loop;
      return begin(at, Bracket::Numbered);
    case ItemKind::End:
      label_ = item.loop;
      return end(at, next, {Bracket::Numbered});
    case ItemKind::Structure:
      label_ = item.label;
      return structure(item.structure, at, next);
    default:
      return;
    }
  }

  void structure(Structure structure, uint32_t at, uint32_t next) {
    switch (structure) {
    case Structure::If:
      return begin(at, Bracket::If);
    case Structure::ElseIf:
      return branch(at, at, Bracket::ElseIf);
    case Structure::Else:
      return branch(at, next, Bracket::Else);
    case Structure::EndIf:
      return end(at, next, {Bracket::If, Bracket::ElseIf, Bracket::Else});
    case Structure::While:
      // With the label of an open loop it is that loop's end.
      if (label_ && find({Bracket::Repeat}) < open_.size())
        return end(at, next, {Bracket::Repeat});
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
    case Structure::Times:
      return begin(at, Bracket::Times);
    case Structure::EndTimes:
      return end(at, next, {Bracket::Times});
    case Structure::Sub:
      if (insideSub())
        shape_.mismatched.push_back(at); // bodies do not nest
      begin(at, Bracket::Sub);
      scope_ = ++subprograms_;
      return;
    case Structure::EndSub:
      scope_ = 0;
      return end(at, next, {Bracket::Sub});
    case Structure::Return:
      if (!insideSub())
        shape_.mismatched.push_back(at);
      return;
    case Structure::Break:
    case Structure::Continue:
      return leave(at, structure);
    }
  }

  bool insideSub() const {
    return llvm::any_of(open_, [](const Open &one) { return one.bracket == Bracket::Sub; });
  }

  /// Out of the loop with this label, or to its test.
  void leave(uint32_t at, Structure structure) {
    const size_t i = find({Bracket::While, Bracket::Repeat});
    if (i == open_.size()) {
      shape_.mismatched.push_back(at);
      shape_.strayExits.push_back(at);
      return;
    }
    (structure == Structure::Break ? open_[i].breaks : open_[i].continues).push_back(at);
  }

  void begin(uint32_t at, Bracket bracket) {
    if (bracket != Bracket::Numbered && label_) {
      // Labels of a subprogram are its own.
      const auto [first, fresh] =
          labels_.try_emplace({bracket == Bracket::Sub ? 0 : scope_, label_}, at);
      if (!fresh)
        shape_.duplicates[at] = first->second;
    }
    open_.push_back({at, bracket, label_, {}, {}, {}});
    shape_.depth = std::max(shape_.depth, unsigned(open_.size()));
  }

  /// Innermost open bracket of these kinds with the current label; `open_.size()`: none.
  size_t find(std::initializer_list<Bracket> kinds) const {
    for (size_t i = open_.size(); i-- > 0;)
      if (llvm::is_contained(kinds, open_[i].bracket) && open_[i].label == label_)
        return i;
    return open_.size();
  }

  /// A bracket that is never closed: nothing inside leads out of it either.
  void leftOpen(const Open &open) {
    shape_.mismatched.push_back(open.offset);
    for (const auto *places : {&open.branches, &open.breaks, &open.continues})
      shape_.mismatched.insert(shape_.mismatched.end(), places->begin(), places->end());
  }

  /// Those inside bracket `i` that were not closed are broken.
  void breakInside(size_t i) {
    for (size_t j = i + 1; j < open_.size(); ++j)
      leftOpen(open_[j]);
    open_.resize(i + 1);
  }

  /// A further branch of an IF: the one before it leads to `target` when it is not taken.
  void branch(uint32_t at, uint32_t target, Bracket bracket) {
    const size_t i = find({Bracket::If, Bracket::ElseIf});
    if (i == open_.size()) {
      shape_.mismatched.push_back(at);
      // After the ELSE of an open IF a second one opens nothing.
      const bool second = !open_.empty() && open_.back().bracket == Bracket::Else;
      if (bracket == Bracket::Else && !label_ && !second)
        begin(at, bracket);
      return;
    }
    breakInside(i);
    Open &open = open_[i];
    shape_.past[open.offset] = target;
    shape_.back[at] = open.offset;
    if (bracket == Bracket::ElseIf)
      open.branches.push_back(at);
    open.offset = at;
    open.bracket = bracket;
  }

  /// Closes the innermost open bracket of these kinds.
  void end(uint32_t at, uint32_t next, std::initializer_list<Bracket> kinds) {
    const size_t i = find(kinds);
    if (i == open_.size()) {
      shape_.mismatched.push_back(at);
      return;
    }
    breakInside(i);
    const Open &open = open_[i];
    shape_.past[open.offset] = next;
    shape_.back[at] = open.offset;
    for (const uint32_t place : open.branches)
      shape_.out[place] = next;
    for (const uint32_t place : open.breaks)
      shape_.out[place] = next;
    for (const uint32_t place : open.continues)
      shape_.out[place] = open.bracket == Bracket::Repeat ? at : open.offset;
    open_.resize(i);
  }

  FlowShape shape_;
  std::vector<Open> open_;
  uint64_t label_ = 0; ///< of the current bracket
  unsigned scope_ = 0; ///< subprogram that it is in; 0: none
  unsigned subprograms_ = 0;
  std::map<std::pair<unsigned, uint64_t>, uint32_t> labels_; ///< scope and label: first bracket
};

} // namespace

FlowShape readShape(const Reader &reader, uint32_t begin, uint32_t end) {
  return ShapeReader().read(reader, begin, end);
}

} // namespace ncvet
