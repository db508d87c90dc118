// The motions that a program makes, from its first block to its end.
#include "analyzer/trace/tracer.h"

#include "analyzer/flow/engine.h"
#include "analyzer/program/project.h"
#include "interp/cycles/block_moves.h"
#include "interp/evaluate/tool_data.h"
#include "interp/path/arc_block.h"

#include <utility>

namespace ncvet {

Tracer::Tracer(Project &project, FileUnit &unit, TraceSink &sink, TracedPath path)
    : project_(project), sink_(sink), corners_(project.dialect()), path_(project.dialect()),
      contour_(project.dialect()) {
  if (path == TracedPath::EveryCentre ||
      (path == TracedPath::ToolCentre && !project.dialect().isLathe()))
    compensated_.emplace(project.dialect(), habitsOf(project.dialect(), unit.machine));
}

Tracer::Tracer(Project &project, TraceSink &sink, const TraceRest &rest)
    : project_(project), sink_(sink), corners_(project.dialect()), path_(rest.corners),
      contour_(project.dialect()), last_(rest.last) {
  if (rest.compensated)
    compensated_.emplace(*rest.compensated);
}

bool Tracer::goesOnAs(const TraceRest &rest) const {
  return last_ == rest.last && path_.goesOnAs(rest.corners) &&
         bool(compensated_) == bool(rest.compensated) &&
         (!compensated_ || compensated_->goesOnAs(*rest.compensated));
}

void Tracer::executed(const Step &step, bool /*continues*/) {
  const FileUnit &unit = step.unit();
  const Block &block = step.block;
  const MachineState &before = step.before, &after = step.live.state;
  const ExecutedBlock executed = step.executed();
  mark_ = sink_.markOf(step);
  moves_.clear();
  appendMoves(executed, moves_);
  const uint64_t tag = uint64_t(unit.source.id()) << 32 | block.begin;
  if (before.profile == ProfileMode::Recorded && after.profile == ProfileMode::Recorded) {
    if (cycle_) // the contour of no cycle is not followed
      contour_.take(executed, moves_);
    return;
  }
  if (before.profile == ProfileMode::Executed && cycle_)
    for (Move &move : moves_)
      shiftByRest(*cycle_, move);
  if (auto cycle = contourCycle(executed)) {
    cycle_ = std::move(cycle);
    cycleTag_ = tag;
    cycleMark_ = mark_;
    contour_.begin(executed, *cycle_);
  }
  if (moves_.empty())
    return;
  const CornerRequest corner = corners_.read(executed);
  const std::array<Axis, 2> plane = arcWords(*unit.dialect, after, block).axes;
  if (after.compensation == phaseOn) {
    const int8_t side = compensatedSide(*unit.dialect, after);
    const auto radius = compensationRadius(*unit.dialect, unit.machine, after);
    for (Move &move : moves_) {
      move.side = side;
      move.toolRadius = radius;
      move.plane = plane;
    }
  }
  for (Move &move : moves_) {
    move.mark = mark_;
    add(tag, move, corner, plane);
  }
}

void Tracer::pathLost(SourceRange where, llvm::StringRef why) {
  finish();
  sink_.lost(unitOf(where.file), where, why);
}

void Tracer::contourEnded() {
  if (!cycle_)
    return;
  const auto write = [&](const Move &move) {
    Move marked = move;
    marked.mark = cycleMark_;
    add(cycleTag_, marked, {}, {Axis::Z, Axis::X});
  };
  const llvm::ArrayRef<Move> contour = contour_.end(*cycle_);
  if (cycle_->has(CycleTrait::Turned)) {
    turn(*cycle_, contour, write);
  } else if (cycle_->has(CycleTrait::TurnsContour)) {
    turnContour(*cycle_, contour, write);
  } else if (cycle_->kind == CycleKind::Contour) {
    millContour(*cycle_, contour, write);
  } else {
    if (cycle_->kind != CycleKind::Finish)
      roughContour(*cycle_, contour, write);
    returnToStart(*cycle_, last_, write);
  }
  cycle_.reset();
}

void Tracer::finish() {
  path_.finish([&](uint64_t from, const Move &move) { compensate(from, move); });
  if (compensated_)
    compensated_->finish([&](uint64_t from, const Move &move) { give(from, move); });
}

void Tracer::add(uint64_t tag, const Move &move, const CornerRequest &corner,
                 const std::array<Axis, 2> &plane) {
  last_ = move.to;
  path_.add(tag, move, corner, plane, [&](uint64_t from, const Move &m) { compensate(from, m); });
}

/// Passes of which nothing is known lead nobody knows where.
void Tracer::turn(const ContourCycle &cycle, llvm::ArrayRef<Move> contour,
                  llvm::function_ref<void(const Move &)> write) {
  if (cycle.profile && profilePasses(*cycle.profile, cycle.start, cycle.feed, contour, write))
    return;
  Move lost = cycle.start;
  lost.to[size_t(Axis::X)] = lost.to[size_t(Axis::Z)] = Interval::unknown();
  write(lost);
}

const FileUnit &Tracer::unitOf(FileId file) { return project_.unit(project_.sources().get(file)); }

void Tracer::compensate(uint64_t tag, const Move &move) {
  if (compensated_)
    compensated_->add(tag, move, [&](uint64_t from, const Move &m) { give(from, m); });
  else
    give(tag, move);
}

void Tracer::give(uint64_t tag, const Move &move) {
  sink_.moved({&unitOf(FileId(tag >> 32)), uint32_t(tag), move});
}

void trace(Project &project, FileUnit &unit, const AnalysisLimits &limits, TraceSink &sink,
           TracedPath path, const std::atomic<bool> *cancel) {
  Tracer tracer(project, unit, sink, path);
  Engine engine(project, unit, limits, cancel);
  engine.listen(tracer);
  engine.follow();
  tracer.finish();
}

} // namespace ncvet
