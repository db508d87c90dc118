// What a program moves, and what its selected blocks do: kept to be compared with the text after a
// rewriting.
#pragma once

#include "analyzer/program/project.h"
#include "analyzer/rule/analysis_limits.h"
#include "interp/geometry/move.h"

#include <atomic>
#include <map>
#include <vector>

namespace ncvet::lsp {

/// How coordinates of an axis change: `factor * x + shift`, mm or degrees, as programmed. What is
/// incremental takes the factor alone.
struct AxisChange {
  double factor = 1, shift = 0;
  bool isNone() const { return factor == 1 && shift == 0; }
};
using AxisChanges = std::array<AxisChange, axisCount>;

/// What the control made of a selected block, when it was executed.
struct Execution {
  std::array<double, axisCount> before{}, after{}; ///< positions; NaN: not known
  uint32_t machineAxes = 0; ///< bit per axis: `after` is in machine coordinates
  Action distance = Action::None, motion = Action::None, arcDistance = Action::None;
  double unit = 1;     ///< mm of one unit of length
  bool leaves = false; ///< control does not go on with the next block
  unsigned times = 0;  ///< it was executed; the rest is of the last time
  bool isAlike = true; ///< modes were the same every time
};

/// One run of a program's first path, as `trace` follows it.
struct SelectionRun {
  struct KeptMove {
    uint64_t rest = 0; ///< hash of all but places
    std::array<double, axisCount> to{};
    std::array<double, 2> centre{};
    double turns = 0;
    uint32_t begin = 0; ///< of its block
    bool inFile = true;
  };
  std::map<uint32_t, Execution> blocks; ///< the selected ones that were executed, by their begins
  std::vector<KeptMove> moves;
  std::vector<uint64_t> functions; ///< M codes but those of flow, hashes in their order
  bool isLost = false;             ///< something unknown decides how it goes on
  bool isTooLong = false;
};

/// Follows the file's first program. The selection is [begin, end). Moves are told as they would be
/// with the changes of the selection's coordinates; a coordinate that a later block does not name
/// stays where the selection has left it.
SelectionRun runSelection(Project &project, FileUnit &unit, uint32_t begin, uint32_t end,
                          const AxisChanges &changes, const AnalysisLimits &limits,
                          const std::atomic<bool> *cancel);

/// Begin of the first block of `before` whose moves or functions are others in `after`, lengths
/// compared within `tolerance` mm; none: both do the same.
std::optional<uint32_t> firstDifference(const SelectionRun &before, const SelectionRun &after,
                                        double tolerance);

} // namespace ncvet::lsp
