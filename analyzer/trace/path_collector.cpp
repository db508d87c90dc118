// Takes the motions of a trace as moves of a tool path.
#include "analyzer/trace/path_collector.h"

#include "analyzer/flow/activation.h"

#include <cmath>

namespace ncvet {

namespace {

float plain(const Interval &value) {
  return value.isConstant() ? float(value.value()) : pathUnknown;
}

PathFeed feedOf(Action mode) {
  return mode == Action::FeedPerMinute       ? PathFeed::PerMinute
         : mode == Action::FeedPerRevolution ? PathFeed::PerRevolution
         : mode == Action::FeedInverseTime   ? PathFeed::InverseTime
                                             : PathFeed::Unknown;
}

} // namespace

uint16_t PathFiles::of(FileId file) {
  const auto found = llvm::find(ids_, file);
  if (found != ids_.end())
    return uint16_t(found - ids_.begin());
  const std::string &path = sources_->get(file).path();
  const auto known = llvm::find(paths_, path);
  const auto number = size_t(known - paths_.begin());
  if (known != paths_.end())
    ids_[number] = file;
  else if (number < most) {
    ids_.push_back(file);
    paths_.push_back(path);
  }
  return uint16_t(std::min(number, most - 1));
}

void PathFiles::use(const SourceSet &sources) {
  sources_ = &sources;
  ids_.assign(paths_.size(), unopened);
}

CurveWriter::CurveWriter(const Dialect &dialect, PathCurve &curve) : curve_(curve) {
  for (unsigned i = 0; i < 3; ++i)
    lengths_[i] = dialect.lengthsPerUnit(Axis(i));
}

PathMove *CurveWriter::add(const Move &move) {
  PathMove next;
  switch (move.kind) {
  case MoveKind::Rapid:
    next.motion = PathMotion::Rapid;
    break;
  case MoveKind::Linear:
    next.motion = PathMotion::Feed;
    break;
  case MoveKind::Arc:
    next.motion = addArc(move) ? PathMotion::Arc : PathMotion::Feed;
    break;
  case MoveKind::Thread:
    next.motion = PathMotion::Thread;
    break;
  case MoveKind::Dwell:
    next.motion = PathMotion::Dwell;
    break;
  case MoveKind::Tool:
    next.motion = PathMotion::Tool;
    break;
  case MoveKind::Spindle:
  case MoveKind::End:
    return nullptr;
  }
  if (move.kind <= MoveKind::Thread)
    goTo(move, next);
  next.to = at_;
  return &curve_.moves.emplace_back(next);
}

void CurveWriter::goTo(const Move &move, PathMove &next) {
  for (unsigned i = 0; i < 3; ++i) {
    const bool onMachine = move.machineAxes >> i & 1;
    next.machine |= onMachine;
    at_[i] = onMachine ? pathUnknown : float(plain(move.to[i]) / lengths_[i]);
  }
}

bool CurveWriter::addArc(const Move &move) {
  if (move.plane[0] > Axis::Z || move.plane[1] > Axis::Z || !move.turns.isConstant())
    return false;
  PathArc arc;
  arc.move = uint32_t(curve_.moves.size());
  arc.first = uint8_t(move.plane[0]);
  arc.second = uint8_t(move.plane[1]);
  for (unsigned i = 0; i < 2; ++i)
    arc.centre[i] = float(plain(move.centre[i]) / lengths_[size_t(move.plane[i])]);
  arc.turns = float(move.clockwise ? -move.turns.value() : move.turns.value());
  curve_.arcs.push_back(arc);
  return true;
}

bool isSameNumber(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

bool isSamePoint(const CurveWriter::Point &a, const CurveWriter::Point &b) {
  return isSameNumber(a[0], b[0]) && isSameNumber(a[1], b[1]) && isSameNumber(a[2], b[2]);
}

PathCollector::PathCollector(const Dialect &dialect, ToolPath &path, PathFiles &files, size_t most)
    : path_(path), most_(most), writer_(dialect, path.programmed), files_(files), sections_(path) {
  others_.fill(Interval::unknown());
}

uint32_t PathCollector::markOf(const Step &step) {
  return cancel ? 0 : sections_.enter(step, files_.of(step.unit().source.id()));
}

void PathCollector::moved(const TracedMove &traced) {
  const Move &move = traced.move;
  if (move.kind == MoveKind::End)
    endAt(*traced.unit, traced.begin, PathEnd::Whole, {});
  if (cancel)
    return;
  if (path_.programmed.moves.size() >= most_) {
    cancel = true;
    return endAt(*traced.unit, traced.begin, PathEnd::Cut, {});
  }
  PathMove *const next = writer_.add(move);
  if (!next)
    return;
  next->file = files_.of(traced.unit->source.id());
  next->line = lines_.lineOf(traced.unit->source.lines(), traced.begin);
  hasCentre_ |= move.side != 0 && move.toolRadius && *move.toolRadius != 0;
  const auto number = uint32_t(path_.programmed.moves.size() - 1);
  sections_.moved(number, move.mark, move.kind == MoveKind::Linear || move.kind == MoveKind::Arc);
  if (move.kind == MoveKind::Dwell)
    path_.dwells.push_back({number, plain(move.value)});
  else if (move.kind != MoveKind::Tool && move.kind != MoveKind::Rapid)
    noteFeed(number, move);
  if (move.kind <= MoveKind::Thread)
    noteOthers(number, move);
}

void PathCollector::lost(const FileUnit &unit, SourceRange where, llvm::StringRef why) {
  endAt(unit, where.begin, PathEnd::Unknown, why.str());
  ended_ = true;
}

PathCollector::Rest PathCollector::rest() const {
  Rest rest;
  rest.at = writer_.at();
  rest.others = others_;
  rest.hasFeed = !path_.feeds.empty();
  if (rest.hasFeed)
    rest.feed = path_.feeds.back();
  rest.sections = sections_.rest();
  return rest;
}

void PathCollector::resume(const Rest &rest) {
  writer_.setAt(rest.at);
  others_ = rest.others;
  sections_.resume(rest.sections);
  ended_ = cancel = false;
  lines_ = {}; // of a text that is no longer there
}

void PathCollector::endAt(const FileUnit &unit, uint32_t begin, PathEnd::Kind kind,
                          std::string why) {
  if (std::exchange(ended_, true))
    return;
  path_.end = {kind, files_.of(unit.source.id()), unit.source.lines().lineOf(begin),
               std::move(why)};
}

void PathCollector::noteFeed(uint32_t number, const Move &move) {
  const PathChange feed{number, plain(move.feed), uint8_t(feedOf(move.feedMode))};
  if (path_.feeds.empty() || !isSameNumber(path_.feeds.back().value, feed.value) ||
      path_.feeds.back().kind != feed.kind)
    path_.feeds.push_back(feed);
}

void PathCollector::noteOthers(uint32_t number, const Move &move) {
  for (unsigned i = unsigned(Axis::A); i < axisCount; ++i)
    if (move.to[i].isConstant() && move.to[i] != others_[i]) {
      others_[i] = move.to[i];
      path_.others.push_back({number, plain(move.to[i]), uint8_t("XYZABCUVW"[i])});
    }
}

bool goOnAlike(const PathCollector::Rest &before, const PathCollector::Rest &after) {
  const bool sameFeed = before.hasFeed == after.hasFeed &&
                        (!before.hasFeed || (before.feed.kind == after.feed.kind &&
                                             isSameNumber(before.feed.value, after.feed.value)));
  return sameFeed && isSamePoint(before.at, after.at) && before.others == after.others &&
         goOnAlike(before.sections, after.sections);
}

CentreCollector::CentreCollector(const Dialect &dialect, ToolPath &path, PathFiles &files,
                                 size_t most)
    : path_(path), most_(most), writer_(dialect, path.centre), files_(files) {}

void CentreCollector::moved(const TracedMove &traced) {
  if (traced.move.kind > MoveKind::Thread || cancel)
    return;
  if (path_.centre.moves.size() >= most_) {
    cancel = true;
    return;
  }
  if (PathMove *const next = writer_.add(traced.move)) {
    next->file = files_.of(traced.unit->source.id());
    next->line = lines_.lineOf(traced.unit->source.lines(), traced.begin);
  }
}

void CentreCollector::resume(const CurveWriter::Point &rest) {
  writer_.setAt(rest);
  cancel = false;
  lines_ = {};
}

} // namespace ncvet
