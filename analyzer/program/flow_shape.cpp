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
  uint32_t head;                  ///< of an IF: its own offset, whichever branch is open
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

/// A branch of an IF.
struct OpenBranch {
  uint32_t head; ///< of the IF
  uint32_t at;   ///< of the branch
};

/// A bracket with a label.
struct Labelled {
  uint32_t at;
  llvm::SmallVector<OpenBranch, 2> branches; ///< that hold it, the outermost first

  /// Whether the two are in different branches of one IF: no pass through it runs both.
  bool excludes(const Labelled &other) const {
    for (size_t i = 0; i < std::min(branches.size(), other.branches.size()); ++i)
      if (branches[i].head != other.branches[i].head)
        return false;
      else if (branches[i].at != other.branches[i].at)
        return true;
    return false;
  }
};
/// Branches in each other that are kept of a bracket, and brackets of one label that exclude each
/// other: more than people write, and few enough for a text that only nests.
constexpr size_t mostBranches = 16, mostOfALabel = 64;

class ShapeReader {
public:
  ShapeReader(const Reader &reader, uint32_t begin, uint32_t end)
      : reader_(reader), begin_(begin), end_(end) {}

  FlowShape read() {
    for (const Block &block : blocks(reader_, begin_, end_))
      for (const Item &item : block.items) {
        shape_.branches |= isBranch(item);
        bracket(item, block.begin, block.next);
      }
    for (const Open &left : open_)
      leftOpen(left);
    llvm::sort(shape_.mismatched);
    nestParts();
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
      if (find({Bracket::Numbered}) == open_.size())
        label_ = 0; // the loop whose number is missing
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
      if (returnsEarly(next))
        return;
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

  /// Which part holds which.
  void nestParts() {
    for (const auto &[head, past] : shape_.past)
      shape_.parts.push_back({head, past, ~0u});
    llvm::sort(shape_.parts, [](const FlowPart &a, const FlowPart &b) { return a.head < b.head; });
    uint32_t outer = ~0u;
    for (uint32_t i = 0; i < shape_.parts.size(); ++i) {
      while (outer != ~0u && shape_.parts[outer].past <= shape_.parts[i].head)
        outer = shape_.parts[outer].outer;
      shape_.parts[i].outer = outer;
      outer = i;
    }
  }

  bool insideSub() const { return openSubs_ != 0; }

  /// An end of the open subprogram inside one of its brackets is a return when another one follows
  /// it: a bracket that is left out goes on to its own end, whatever is between.
  bool returnsEarly(uint32_t next) const {
    const size_t sub = find({Bracket::Sub});
    if (sub + 1 >= open_.size())
      return false;
    for (const Block &block : blocks(reader_, next, end_))
      for (const Item &item : block.items)
        if (item.kind == ItemKind::Structure && item.label == label_ &&
            (item.structure == Structure::Sub || item.structure == Structure::EndSub))
          return item.structure == Structure::EndSub;
    return false;
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
      std::vector<Labelled> &known = labels_[{bracket == Bracket::Sub ? 0 : scope_, label_}];
      Labelled here{at, openBranches()};
      const auto first =
          llvm::find_if(known, [&](const Labelled &other) { return !here.excludes(other); });
      if (first != known.end())
        shape_.duplicates[at] = first->at;
      else if (known.size() < mostOfALabel)
        known.push_back(std::move(here));
    }
    enlist(bracket, label_, open_.size());
    if (bracket == Bracket::If)
      ifs_.push_back(open_.size());
    open_.push_back({at, bracket, label_, at, {}, {}, {}});
    openSubs_ += bracket == Bracket::Sub;
    shape_.depth = std::max(shape_.depth, unsigned(open_.size()));
  }

  /// The outermost branches of IFs that are open.
  llvm::SmallVector<OpenBranch, 2> openBranches() const {
    llvm::SmallVector<OpenBranch, 2> result;
    for (const size_t i : ifs_)
      if (result.size() < mostBranches)
        result.push_back({open_[i].head, open_[i].offset});
      else
        break;
    return result;
  }

  /// Innermost open bracket of these kinds with the current label; `open_.size()`: none.
  size_t find(std::initializer_list<Bracket> kinds) const {
    std::optional<size_t> innermost;
    for (const Bracket kind : kinds)
      if (const auto known = byKind_.find({kind, label_}); known != byKind_.end())
        innermost = std::max(innermost.value_or(0), known->second.back());
    return innermost.value_or(open_.size());
  }

  void enlist(Bracket bracket, uint64_t label, size_t index) {
    byKind_[{bracket, label}].push_back(index);
  }
  /// The innermost of its kind and label is closed, or becomes another.
  void strike(const Open &open) {
    const auto known = byKind_.find({open.bracket, open.label});
    known->second.pop_back();
    if (known->second.empty())
      byKind_.erase(known);
  }
  /// All after the first `count` are closed.
  void closeAfter(size_t count) {
    while (open_.size() > count) {
      strike(open_.back());
      openSubs_ -= open_.back().bracket == Bracket::Sub;
      open_.pop_back();
      if (!ifs_.empty() && ifs_.back() == open_.size())
        ifs_.pop_back();
    }
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
    closeAfter(i + 1);
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
    strike(open);
    open.bracket = bracket;
    enlist(bracket, open.label, i);
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
    closeAfter(i);
  }

  const Reader &reader_;
  const uint32_t begin_, end_;
  FlowShape shape_;
  std::vector<Open> open_;
  /// Indices of the open brackets of each kind and label, the innermost last.
  std::map<std::pair<Bracket, uint64_t>, std::vector<size_t>> byKind_;
  unsigned openSubs_ = 0;
  uint64_t label_ = 0; ///< of the current bracket
  unsigned scope_ = 0; ///< subprogram that it is in; 0: none
  unsigned subprograms_ = 0;
  std::vector<size_t> ifs_; ///< indices of the open IFs
  std::map<std::pair<unsigned, uint64_t>, std::vector<Labelled>> labels_; ///< by scope and label
};

} // namespace

std::optional<uint32_t> FlowShape::partEntered(uint32_t from, uint32_t target) const {
  // The innermost one decides: whatever holds it and not `from` is entered with it.
  const auto after =
      llvm::partition_point(parts, [&](const FlowPart &part) { return part.head < target; });
  for (auto i = uint32_t(after - parts.begin()) - 1; i != ~0u; i = parts[i].outer)
    if (target < parts[i].past)
      return from < parts[i].head || from >= parts[i].past ? std::optional(parts[i].head)
                                                           : std::nullopt;
  return std::nullopt;
}

FlowShape readShape(const Reader &reader, uint32_t begin, uint32_t end) {
  return ShapeReader(reader, begin, end).read();
}

} // namespace ncvet
