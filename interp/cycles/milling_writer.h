// Writes the motions of a cycle that mills in the plane. Private to the files that take cycles
// apart.
#pragma once

#include "interp/cycles/cycle_writer.h"
#include "interp/evaluate/cycle_parameters.h"
#include "interp/evaluate/tool_data.h"
#include "interp/geometry/plane_place.h"

namespace ncvet {

/// A milling cycle with its plane, the tool's axis, and the feeds that its own words give.
class MillingWriter : protected CycleWriter {
protected:
  MillingWriter(const ExecutedBlock &executed, const CodeInfo &cycle,
                llvm::SmallVectorImpl<Move> &moves)
      : CycleWriter(executed, cycle, moves), parameters_(executed, cycle),
        tool_(toolAxis(executed.dialect, executed.after)),
        axes_(planeOrder(executed.dialect, executed.after)) {}

  void setPlane(const PlanePlace &place) {
    for (size_t i = 0; i < 2; ++i) {
      at_[size_t(axes_[i])] = place[i];
      machineAxes_ &= ~(1u << unsigned(axes_[i]));
    }
  }

  /// Gives the motion the feed of that measure, where the cycle has it.
  void feed(Move &move, Measure what) const {
    if (const auto own = parameters_.length(what)) {
      move.feed = *own;
      if (move.feedMode == Action::None)
        move.feedMode = Action::FeedPerMinute;
    }
  }

  /// An arc in the plane to where the tool is set.
  Move &arc(const PlanePlace &centre, bool clockwise, double turns) {
    Move &move = go(MoveKind::Arc);
    setFeed(executed_.dialect, executed_.after, move);
    feed(move, Measure::FeedAlong);
    move.plane = axes_;
    move.centre = centre;
    move.clockwise = clockwise;
    move.turns = Interval::exactly(turns);
    return move;
  }

  /// Of the tool that cuts, mm.
  std::optional<double> toolRadius() const {
    const ToolData *tool = toolInUse(executed_.machine, executed_.before);
    if (!tool || !tool->radius)
      tool = compensatingTool(executed_.dialect, executed_.machine, executed_.before);
    return tool ? tool->radius : std::nullopt;
  }

  /// Whether the cycle's direction is that of G02.
  bool clockwise() const {
    return parameters_.number(Measure::Direction) == Interval::exactly(clockwiseDirection);
  }

  const CycleParameters parameters_;
  const Axis tool_;
  const std::array<Axis, 2> axes_;
};

} // namespace ncvet
