// The tool path of a program for reports that draw it.
#include "analyzer/flow/tool_path_trace.h"

#include "analyzer/flow/activation.h"
#include "analyzer/flow/path_sections.h"
#include "analyzer/flow/trace.h"

#include <cmath>

namespace ncvet {

namespace {

float plain(const Interval &value) {
  return value.isConstant() ? float(value.value()) : pathUnknown;
}

bool isSame(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

PathFeed feedOf(Action mode) {
  return mode == Action::FeedPerMinute       ? PathFeed::PerMinute
         : mode == Action::FeedPerRevolution ? PathFeed::PerRevolution
         : mode == Action::FeedInverseTime   ? PathFeed::InverseTime
                                             : PathFeed::Unknown;
}

/// Numbers of the files of a path, in the order in which they come.
class FileNumbers {
public:
  explicit FileNumbers(std::vector<FileId> &files) : files_(files) {}
  uint16_t of(FileId file) {
    const auto found = llvm::find(files_, file);
    const auto number = size_t(found - files_.begin());
    if (found == files_.end() && number < most)
      files_.push_back(file);
    return uint16_t(std::min(number, most - 1));
  }

private:
  /// More programs than a control has levels and a folder has subprograms.
  static constexpr size_t most = 4096;
  std::vector<FileId> &files_;
};

/// Motions of a trace as moves of a curve.
class CurveWriter {
public:
  CurveWriter(const Dialect &dialect, PathCurve &curve) : curve_(curve) {
    for (unsigned i = 0; i < 3; ++i)
      lengths_[i] = dialect.lengthsPerUnit(Axis(i));
  }

  /// Adds a motion; none for what is no motion, no dwell and no tool.
  PathMove *add(const Move &move) {
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

private:
  void goTo(const Move &move, PathMove &next) {
    for (unsigned i = 0; i < 3; ++i) {
      const bool onMachine = move.machineAxes >> i & 1;
      next.machine |= onMachine;
      at_[i] = onMachine ? pathUnknown : float(plain(move.to[i]) / lengths_[i]);
    }
  }

  bool addArc(const Move &move) {
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

  PathCurve &curve_;
  std::array<double, 3> lengths_{};
  std::array<float, 3> at_{pathUnknown, pathUnknown, pathUnknown};
};

/// Takes the programmed path with everything that belongs to it.
class PathCollector : public TraceSink {
public:
  PathCollector(const Dialect &dialect, ToolPath &path, size_t most)
      : path_(path), most_(most), writer_(dialect, path.programmed), files_(path.files),
        sections_(path) {
    others_.fill(Interval::unknown());
  }

  uint32_t markOf(const Step &step) override {
    return sections_.enter(step, files_.of(step.unit().source.id()));
  }

  void moved(const TracedMove &traced) override {
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
    next->line = traced.unit->source.lines().lineOf(traced.begin);
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

  void lost(const FileUnit &unit, SourceRange where, llvm::StringRef why) override {
    endAt(unit, where.begin, PathEnd::Unknown, why.str());
    ended_ = true;
  }

  bool hasCentre() const { return hasCentre_; }
  std::atomic<bool> cancel = false;

private:
  void endAt(const FileUnit &unit, uint32_t begin, PathEnd::Kind kind, std::string why) {
    if (std::exchange(ended_, true))
      return;
    path_.end = {kind, files_.of(unit.source.id()), unit.source.lines().lineOf(begin),
                 std::move(why)};
  }

  void noteFeed(uint32_t number, const Move &move) {
    const PathChange feed{number, plain(move.feed), uint8_t(feedOf(move.feedMode))};
    if (path_.feeds.empty() || !isSame(path_.feeds.back().value, feed.value) ||
        path_.feeds.back().kind != feed.kind)
      path_.feeds.push_back(feed);
  }

  void noteOthers(uint32_t number, const Move &move) {
    for (unsigned i = unsigned(Axis::A); i < axisCount; ++i)
      if (move.to[i].isConstant() && move.to[i] != others_[i]) {
        others_[i] = move.to[i];
        path_.others.push_back({number, plain(move.to[i]), uint8_t("XYZABCUVW"[i])});
      }
  }

  ToolPath &path_;
  size_t most_;
  CurveWriter writer_;
  FileNumbers files_;
  PathSections sections_;
  Place others_;
  bool ended_ = false, hasCentre_ = false;
};

/// Takes where compensation puts the tool.
class CentreCollector : public TraceSink {
public:
  CentreCollector(const Dialect &dialect, ToolPath &path, size_t most)
      : path_(path), most_(most), writer_(dialect, path.centre), files_(path.files) {}

  void moved(const TracedMove &traced) override {
    if (traced.move.kind > MoveKind::Thread || cancel)
      return;
    if (path_.centre.moves.size() >= most_) {
      cancel = true;
      return;
    }
    if (PathMove *const next = writer_.add(traced.move)) {
      next->file = files_.of(traced.unit->source.id());
      next->line = traced.unit->source.lines().lineOf(traced.begin);
    }
  }
  void lost(const FileUnit & /*unit*/, SourceRange /*where*/, llvm::StringRef /*why*/) override {}

  std::atomic<bool> cancel = false;

private:
  ToolPath &path_;
  size_t most_;
  CurveWriter writer_;
  FileNumbers files_;
};

PathBox boxOf(const Stock &stock, const Dialect &dialect) {
  PathBox box;
  for (unsigned i = 0; i < 3; ++i) {
    const double length = dialect.lengthsPerUnit(Axis(i));
    if (stock.min[i])
      box.min[i] = *stock.min[i] / length;
    if (stock.max[i])
      box.max[i] = *stock.max[i] / length;
  }
  return box;
}

PathMachine machineOf(const MachineProfile &profile, const Dialect &dialect) {
  PathMachine machine;
  machine.rapid = profile.rapid;
  machine.feedMax = profile.feedMax;
  machine.spindleMax = profile.spindleMax;
  machine.acceleration = profile.number("acceleration");
  machine.toolChange = profile.number("toolChangeTime");
  Stock travel;
  for (unsigned i = 0; i < 3; ++i) {
    travel.min[i] = profile.axes[i].min;
    travel.max[i] = profile.axes[i].max;
  }
  machine.envelope = boxOf(travel, dialect);
  if (profile.stock)
    machine.stock = boxOf(*profile.stock, dialect);
  for (const Stock &clamp : profile.clamps)
    machine.clamps.push_back(boxOf(clamp, dialect));
  for (const auto &[code, place] : profile.offsets)
    for (unsigned i = 0; i < 3; ++i)
      if (place[i])
        machine.offsets[code][i] = *place[i] / dialect.lengthsPerUnit(Axis(i));
  for (const auto &[number, tool] : profile.tools)
    machine.tools[number] = {tool.kind, tool.radius, tool.length};
  return machine;
}

} // namespace

ToolPath traceToolPath(Project &project, FileUnit &unit, const AnalysisLimits &limits,
                       size_t mostMoves) {
  ToolPath path;
  const Dialect &dialect = project.dialect();
  path.files.push_back(unit.source.id());
  path.lathe = dialect.isLathe();
  path.diameter = dialect.lengthsPerUnit(Axis::X) == 2;
  path.machine = machineOf(unit.machine, dialect);
  PathCollector programmed(dialect, path, mostMoves);
  trace(project, unit, limits, programmed, TracedPath::Programmed, &programmed.cancel);
  if (programmed.hasCentre()) {
    CentreCollector centre(dialect, path, mostMoves);
    trace(project, unit, limits, centre, TracedPath::EveryCentre, &centre.cancel);
  }
  return path;
}

} // namespace ncvet
