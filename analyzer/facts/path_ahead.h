// The path after the current block, followed in the text for rules that look at two elements.
#pragma once

#include "analyzer/facts/blocks_ahead.h"
#include "interp/path/corner_path.h"

namespace ncvet {

/// The current block, as it was executed.
ExecutedBlock executedBlock(const RuleContext &ctx);

/// Executes the blocks after the current one, one move after the other. Outlives the call in which
/// it was made, not the analysis.
class PathAhead {
public:
  explicit PathAhead(const RuleContext &ctx);

  /// On to the next block that moves, in whichever program that is. False when none follows soon,
  /// or when what comes before it decides itself at run time, or changes the coordinates.
  bool next();
  const Block &block() const { return block_; }
  SourceRange range() const { return ahead_.range(block_); }
  const Outcome &outcome() const { return outcome_; }
  ExecutedBlock executed() const {
    return {*dialect_, *machine_, block_, outcome_, before_, after_};
  }

private:
  const Dialect *dialect_;
  const MachineProfile *machine_;
  BlocksAhead ahead_;
  const Executor &executor_;
  Block block_;
  Outcome outcome_;
  MachineState before_, after_;
  bool ended_;
};

/// A straight element of a contour: millimetres along the axes of its plane, where a diameter is
/// turned into a radius.
struct StraightElement {
  Point from = Point::Zero(), to = Point::Zero();

  double length() const { return distance(from, to); } ///< mm
  Vector direction() const { return (to - from) / length(); }
};

/// Whether lengths are the same inside of the frames and outside: there are none, or they shift,
/// turn and mirror alone.
bool keepsLengths(const FrameStack &frames);

/// The line that the block cuts in its plane and nowhere else; none when it is no line, or its ends
/// or the lengths of its frame are not known.
std::optional<StraightElement> straightElement(const ExecutedBlock &executed);

/// Direction in which the line or arc that the block cuts in its plane begins, or ends; a vector of
/// length one, none under the conditions of `straightElement`, or when the circle is not known.
std::optional<Vector> directionAt(const ExecutedBlock &executed, bool end);

/// The line or arc that the block cuts in its plane; none under the conditions of `directionAt`.
std::optional<ContourElement> contourElementOf(const ExecutedBlock &executed);

/// What a rounding of that radius (mm) takes away of the two elements that meet in it, in
/// millimetres along each; infinite where it touches the one or the other nowhere near. None when
/// they do not meet in a corner.
std::optional<std::array<double, 2>> takenByRounding(double radius, const ContourElement &in,
                                                     const ContourElement &out);

/// What a corner takes away of each of the two lines that meet in it, in millimetres; none when
/// there is no corner.
std::optional<double> takenByCorner(const CornerRequest &corner, const StraightElement &in,
                                    const StraightElement &out);

} // namespace ncvet
