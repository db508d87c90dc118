// One motion of the tool, or what is between two of them.
#pragma once

#include "formats/dialect/dialect.h"
#include "interp/value/spindle.h"
#include "interp/value/value.h"

#include <array>
#include <optional>

namespace ncvet {

enum class MoveKind : uint8_t { Rapid, Linear, Arc, Thread, Dwell, Tool, Spindle, End };

/// Coordinates per axis, in millimetres and degrees; X of a lathe as programmed.
using Place = std::array<Interval, axisCount>;

/// A motion with its end point. Where it begins is where the one before ended.
struct Move {
  MoveKind kind = MoveKind::Rapid;
  uint32_t machineAxes = 0; ///< bit per axis: `to` is in machine coordinates
  Place to;
  /// Of an arc: its axes in the order in which a counter-clockwise turn leads from the first to the
  /// second, and the coordinates of its centre along them.
  std::array<Axis, 2> plane{Axis::X, Axis::Y};
  std::array<Interval, 2> centre;
  Interval turns; ///< angle of an arc in full turns, above zero
  bool clockwise = false;
  std::optional<double> radius; ///< of an arc that is given by it, with its sign
  bool tangential = false;      ///< of an arc: it goes on in the direction of the motion before
  /// Where compensation puts the tool's centre: 1 on the left of the path, -1 on its right, 0 on
  /// it.
  int8_t side = 0;
  std::optional<double> toolRadius; ///< mm, of a tool beside the path; none: not known
  Action feedMode = Action::None;   ///< None: not stated, or not certain
  Interval feed;                    ///< mm/min, mm per revolution or 1/min; of a thread its lead
  Interval value;                   ///< dwell in seconds, number of the tool, speed of the spindle
  uint8_t spindle = spindleOff;     ///< of Spindle: what it does
  uint32_t mark = 0;                ///< of whoever follows the program: comes along unchanged
};

/// Where a motion ends, without the axes whose end is told in machine coordinates.
inline Place workPlace(const Move &move) {
  Place place = move.to;
  for (unsigned i = 0; i < axisCount; ++i)
    if (move.machineAxes >> i & 1)
      place[i] = Interval::unknown();
  return place;
}

} // namespace ncvet
