// The lists of a tool path: cut at a move, and put together again with what has become of the rest.
#include "analyzer/trace/path_lists.h"

#include "analyzer/trace/path_collector.h"

namespace ncvet {

namespace {

template <typename T>
void cut(std::vector<T> &list, uint32_t length, std::vector<T> &rest) {
  rest.assign(std::make_move_iterator(list.begin() + length), std::make_move_iterator(list.end()));
  list.resize(length);
}

template <typename T>
llvm::ArrayRef<T> after(const std::vector<T> &rest, const ListChange &met, const ListChange &from) {
  return llvm::makeArrayRef(rest).drop_front(met.first - from.first);
}

/// Lines of blocks after the edit.
uint32_t movedLine(uint16_t file, uint32_t line, const ToolPathChange &change) {
  return file == 0 && line >= change.line ? uint32_t(line + change.lines) : line;
}

/// Whether both are the same but for where they end.
bool isSameMotion(const PathMove &old, const PathMove &made, const ToolPathChange &change) {
  return old.motion == made.motion && old.machine == made.machine && old.file == made.file &&
         movedLine(old.file, old.line, change) == made.line;
}

bool isSame(const PathMove &old, const PathMove &made, const ToolPathChange &change) {
  return isSameMotion(old, made, change) && isSamePoint(old.to, made.to);
}

/// The moves of `old` that end elsewhere in `made`, of which the first has the number `first`;
/// none: more than some do, or another thing has changed as well.
std::vector<uint32_t> movedAmong(llvm::ArrayRef<PathMove> old, llvm::ArrayRef<PathMove> made,
                                 uint32_t first, const ToolPathChange &change) {
  // Each is told with its number: fewer bytes than all of them when it is one of so many.
  constexpr size_t mostOf = 4;
  std::vector<uint32_t> moved;
  if (old.size() != made.size())
    return moved;
  for (size_t i = 0; i < old.size(); ++i) {
    const bool fits = isSameMotion(old[i], made[i], change) && moved.size() <= old.size() / mostOf;
    if (!fits)
      return {};
    if (!isSamePoint(old[i].to, made[i].to))
      moved.push_back(uint32_t(first + i));
  }
  return moved;
}

bool isSame(const PathArc &old, const PathArc &made, int64_t by) {
  return old.move + by == made.move && old.first == made.first && old.second == made.second &&
         isSameNumber(old.centre[0], made.centre[0]) &&
         isSameNumber(old.centre[1], made.centre[1]) && old.turns == made.turns;
}

bool isSame(const PathChange &old, const PathChange &made, int64_t by) {
  return old.move + by == made.move && old.kind == made.kind && isSameNumber(old.value, made.value);
}

void appendCurve(PathCurve &curve, const PathCurve &rest, llvm::ArrayRef<PathMove> moves,
                 uint32_t firstMove, const ToolPathChange &change) {
  const int64_t by = int64_t(curve.moves.size()) - firstMove;
  curve.moves.reserve(curve.moves.size() + moves.size());
  for (PathMove move : moves) {
    move.line = movedLine(move.file, move.line, change);
    curve.moves.push_back(move);
  }
  for (PathArc arc : rest.arcs)
    if (arc.move >= firstMove) {
      arc.move = uint32_t(arc.move + by);
      curve.arcs.push_back(arc);
    }
}

void appendChanges(std::vector<PathChange> &list, llvm::ArrayRef<PathChange> rest, int64_t by) {
  for (PathChange change : rest) {
    change.move = uint32_t(change.move + by);
    list.push_back(change);
  }
}

/// The first arc that belongs to that move or a later one.
size_t firstArc(const PathCurve &curve, uint32_t move) {
  return size_t(
      llvm::partition_point(curve.arcs, [&](const PathArc &arc) { return arc.move < move; }) -
      curve.arcs.begin());
}

/// The arcs of moves from that one on are taken away.
void cutArcs(PathCurve &curve, uint32_t move, PathCurve &rest) {
  cut(curve.arcs, uint32_t(firstArc(curve, move)), rest.arcs);
}

} // namespace

ToolPathChange lengthsOf(const ToolPath &path) {
  ToolPathChange lengths;
  lengths.moves.first = uint32_t(path.programmed.moves.size());
  lengths.centre.first = uint32_t(path.centre.moves.size());
  lengths.feeds.first = uint32_t(path.feeds.size());
  lengths.dwells.first = uint32_t(path.dwells.size());
  lengths.others.first = uint32_t(path.others.size());
  lengths.sections.first = uint32_t(path.sections.size());
  lengths.operations.first = uint32_t(path.operations.size());
  return lengths;
}

void moveLines(ToolPath &path, const ToolPathChange &change) {
  for (PathCurve *const curve : {&path.programmed, &path.centre})
    for (PathMove &move : curve->moves)
      move.line = movedLine(move.file, move.line, change);
  for (PathOperation &operation : path.operations)
    operation.line = movedLine(operation.file, operation.line, change);
}

CutPath::CutPath(ToolPath &path, const ToolPathChange &from) : path_(path), from_(from) {
  cut(path.programmed.moves, from.moves.first, rest_.programmed.moves);
  cutArcs(path.programmed, from.moves.first, rest_.programmed);
  cut(path.centre.moves, from.centre.first, rest_.centre.moves);
  cutArcs(path.centre, from.centre.first, rest_.centre);
  cut(path.feeds, from.feeds.first, rest_.feeds);
  cut(path.dwells, from.dwells.first, rest_.dwells);
  cut(path.others, from.others.first, rest_.others);
  cut(path.sections, from.sections.first, rest_.sections);
  cut(path.operations, from.operations.first, rest_.operations);
  rest_.end = std::exchange(path.end, {});
}

/// Elements that both lists have at their begin and at their end are no change. The first
/// `oldCount` of `old` became those of `made` from `list.first` on.
template <typename List, typename Same>
void CutPath::trim(const List &old, size_t oldCount, const List &made, ListChange &list,
                   const Same &same) {
  const size_t from = list.first, madeCount = made.size() - from;
  const size_t most = std::min(oldCount, madeCount);
  size_t front = 0, back = 0;
  while (front < most && same(old[front], made[from + front], false))
    ++front;
  while (back < most - front && same(old[oldCount - 1 - back], made[made.size() - 1 - back], true))
    ++back;
  list = {uint32_t(from + front), uint32_t(oldCount - front - back),
          uint32_t(madeCount - front - back)};
}

/// Compares what was taken, up to `oldLengths`, with what the path has now.
void CutPath::trimAll(const ToolPathChange &oldLengths, ToolPathChange &change) const {
  const auto count = [](const ListChange &to, const ListChange &from) {
    return size_t(to.first - from.first);
  };
  const ToolPathChange from = from_;
  const size_t oldMoves = count(oldLengths.moves, from.moves);
  const int64_t by = int64_t(path_.programmed.moves.size()) - (from.moves.first + oldMoves);
  const auto sameChange = [&](const PathChange &old, const PathChange &made, bool atEnd) {
    return isSame(old, made, atEnd ? by : 0);
  };
  trim(rest_.feeds, count(oldLengths.feeds, from.feeds), path_.feeds, change.feeds, sameChange);
  trim(rest_.dwells, count(oldLengths.dwells, from.dwells), path_.dwells, change.dwells,
       sameChange);
  trim(rest_.others, count(oldLengths.others, from.others), path_.others, change.others,
       sameChange);
  trim(rest_.operations, count(oldLengths.operations, from.operations), path_.operations,
       change.operations, [&](PathOperation old, const PathOperation &made, bool) {
         old.line = movedLine(old.file, old.line, change);
         return old == made;
       });
  trim(rest_.sections, count(oldLengths.sections, from.sections), path_.sections, change.sections,
       [&](const PathSection &old, const PathSection &made, bool atEnd) {
         return old.move + (atEnd ? by : 0) == made.move && old.setting == made.setting &&
                old.operation + (atEnd ? change.operations.by() : 0) == made.operation;
       });
  const bool sameModes = change.feeds.isEmpty() && change.others.isEmpty() &&
                         change.sections.isEmpty() && change.operations.isEmpty() &&
                         change.settings == path_.settings.size();
  const auto trimCurve = [&](const PathCurve &old, size_t oldCount, const PathCurve &made,
                             ListChange &list) {
    const int64_t arcsBy = int64_t(made.moves.size()) - (list.first + oldCount);
    ListChange arcs{uint32_t(firstArc(made, list.first)), 0, 0};
    trim(old.arcs, firstArc(old, uint32_t(list.first + oldCount)), made.arcs, arcs,
         [&](const PathArc &a, const PathArc &b, bool atEnd) {
           return isSame(a, b, atEnd ? arcsBy : 0);
         });
    if (sameModes && arcs.isEmpty())
      trim(old.moves, oldCount, made.moves, list,
           [&](const PathMove &a, const PathMove &b, bool) { return isSame(a, b, change); });
    else
      list = {list.first, uint32_t(oldCount), uint32_t(made.moves.size() - list.first)};
    return sameModes && arcs.isEmpty();
  };
  const uint32_t firstMove = change.moves.first;
  if (trimCurve(rest_.programmed, oldMoves, path_.programmed, change.moves) &&
      change.moves.removed == change.moves.added)
    change.moved = movedAmong(
        llvm::makeArrayRef(rest_.programmed.moves)
            .slice(change.moves.first - firstMove, change.moves.removed),
        llvm::makeArrayRef(path_.programmed.moves).slice(change.moves.first, change.moves.added),
        change.moves.first, change);
  trimCurve(rest_.centre, count(oldLengths.centre, from.centre), path_.centre, change.centre);
}

void CutPath::compare(ToolPathChange &change) const {
  ToolPathChange lengths = lengthsOf(rest_);
  const auto add = [](ListChange &to, const ListChange &from) { to.first += from.first; };
  add(lengths.moves, from_.moves);
  add(lengths.centre, from_.centre);
  add(lengths.feeds, from_.feeds);
  add(lengths.dwells, from_.dwells);
  add(lengths.others, from_.others);
  add(lengths.sections, from_.sections);
  add(lengths.operations, from_.operations);
  trimAll(lengths, change);
}

void CutPath::append(const ToolPathChange &met, ToolPathChange &change) {
  trimAll(met, change);
  const int64_t by = int64_t(path_.programmed.moves.size()) - met.moves.first;
  const int64_t operationsBy = int64_t(path_.operations.size()) - met.operations.first;
  appendCurve(path_.programmed, rest_.programmed,
              after(rest_.programmed.moves, met.moves, from_.moves), met.moves.first, change);
  appendCurve(path_.centre, rest_.centre, after(rest_.centre.moves, met.centre, from_.centre),
              met.centre.first, change);
  appendChanges(path_.feeds, after(rest_.feeds, met.feeds, from_.feeds), by);
  appendChanges(path_.dwells, after(rest_.dwells, met.dwells, from_.dwells), by);
  appendChanges(path_.others, after(rest_.others, met.others, from_.others), by);
  for (PathSection section : after(rest_.sections, met.sections, from_.sections)) {
    section.move = uint32_t(section.move + by);
    section.operation = uint32_t(section.operation + operationsBy);
    path_.sections.push_back(section);
  }
  for (PathOperation operation : after(rest_.operations, met.operations, from_.operations)) {
    operation.line = movedLine(operation.file, operation.line, change);
    path_.operations.push_back(std::move(operation));
  }
  path_.end = std::move(rest_.end);
  path_.end.line = movedLine(path_.end.file, path_.end.line, change);
}

} // namespace ncvet
