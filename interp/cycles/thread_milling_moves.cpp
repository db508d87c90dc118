// The motions of a cycle that mills a thread: on a helix from its top to its bottom, in a bore or
// round a pin.
#include "interp/cycles/cycle_moves.h"
#include "interp/cycles/depth_levels.h"
#include "interp/cycles/milling_writer.h"
#include "interp/geometry/direction.h"

namespace ncvet {

namespace {

class ThreadMillingMoves : private MillingWriter {
public:
  ThreadMillingMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                     llvm::SmallVectorImpl<Move> &moves)
      : MillingWriter(executed, cycle, moves) {}

  /// In a bore the tool begins and ends in the middle; round a pin it is somewhere beside it.
  /// Both paths between there and the thread are arcs that lead on along the tool axis: how far is
  /// not followed.
  void run() {
    const bool inside = parameters_.number(Measure::Inside) == Interval::exactly(1);
    const PlanePlace centre{length(Measure::CentreFirst), length(Measure::CentreSecond)};
    const PlanePlace nowhere{}, &outOfThread = inside ? centre : nowhere;
    const Interval back = backLevel(parameters_).value_or(Interval::unknown());
    setPlane(outOfThread);
    go(MoveKind::Rapid, tool_, back);
    go(MoveKind::Rapid, tool_, approachLevel(parameters_).value_or(Interval::unknown()));
    helix(centre, inside);
    setPlane(nowhere);
    feed(go(MoveKind::Linear, tool_, Interval::unknown()), Measure::FeedAlong);
    setPlane(outOfThread);
    go(MoveKind::Rapid);
    go(MoveKind::Rapid, tool_, back);
  }

private:
  Interval length(Measure what) const {
    return parameters_.length(what).value_or(Interval::unknown());
  }
  /// Distance of the tool's centre from that of the thread.
  std::optional<double> distance(bool inside) const {
    const auto tool = toolRadius();
    const Interval thread = length(Measure::Radius);
    if (!tool || !thread.isConstant())
      return std::nullopt;
    const double away = inside ? thread.value() - *tool : thread.value() + *tool;
    return away > tolerance ? std::optional(away) : std::nullopt;
  }

  /// Once along the thread. Where on the circle it begins the manuals do not say.
  void helix(const PlanePlace &centre, bool inside) {
    const Interval top = length(Measure::Top), bottom = length(Measure::Bottom),
                   lead = length(Measure::Lead);
    const auto away = distance(inside);
    if (!away || !centre[0].isConstant() || !centre[1].isConstant() || !lead.isConstant() ||
        std::fabs(lead.value()) < tolerance || !top.isConstant() || !bottom.isConstant()) {
      setPlane(PlanePlace{});
      feed(go(MoveKind::Linear, tool_, bottom), Measure::FeedAlong);
      return;
    }
    const auto place = [&](double turns) -> PlanePlace {
      const Vector off = *away * unitVector(fullTurn * turns);
      return {centre[0] + Interval::exactly(off.x()), centre[1] + Interval::exactly(off.y())};
    };
    setPlane(place(0));
    feed(go(MoveKind::Linear, tool_, top), Measure::FeedAlong);
    const double turns = std::fabs((top.value() - bottom.value()) / lead.value());
    setPlane(place(clockwise() ? -turns : turns));
    at_[size_t(tool_)] = bottom;
    arc(centre, clockwise(), turns);
  }
};

} // namespace

void appendThreadMillingMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                              llvm::SmallVectorImpl<Move> &moves) {
  ThreadMillingMoves(executed, cycle, moves).run();
}

} // namespace ncvet
