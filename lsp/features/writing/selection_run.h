// What a program moves, and what its selected blocks do: kept to be compared with the text after a
// rewriting.
#pragma once

#include "analyzer/program/project.h"
#include "analyzer/rule/analysis_limits.h"
#include "interp/geometry/move.h"

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace ncvet {
struct MachineState; // interp/state/state.h
}

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
  double unit = 1; ///< mm of one unit of length
  bool runsCycle = false;
  bool leaves = false; ///< control does not go on with the next block
  unsigned times = 0;  ///< it was executed; the rest is of the last time
  bool isAlike = true; ///< modes were the same every time
};

/// A selected block that was executed.
struct SelectedStep {
  uint32_t begin = 0;
  bool decides = false; ///< it only says which block comes next, and calls nothing
  friend bool operator==(const SelectedStep &, const SelectedStep &) = default;
};

/// One run of a program's first path, as `trace` follows it.
struct SelectionRun {
  struct KeptMove {
    uint64_t rest = 0; ///< hash of all but places
    MoveKind kind = MoveKind::Rapid;
    std::array<double, axisCount> to{};
    std::array<double, 2> centre{};
    double turns = 0;
    uint32_t begin = 0; ///< of its block
    bool inFile = true;
  };
  std::map<uint32_t, Execution> blocks; ///< the selected ones that were executed, by their begins
  std::vector<KeptMove> moves;
  std::vector<uint64_t> functions; ///< M codes but those of flow, hashes in their order
  /// The selected blocks in the order in which they were executed, a list for each time that the
  /// program came to the selection.
  std::vector<std::vector<SelectedStep>> visits;
  bool visitsAreWhole = true; ///< false: there were too many steps to be kept
  /// After the block that ended the program; null: none did.
  std::shared_ptr<const MachineState> ending;
  bool returns = false; ///< … which goes back to a caller
  bool isLost = false;  ///< something unknown decides how it goes on
  bool isTooLong = false;
};

/// Follows the file's main program. The selection is [begin, end). Moves are told as they would be
/// with the changes of the selection's coordinates; a coordinate that a later block does not name
/// stays where the selection has left it.
SelectionRun runSelection(Project &project, FileUnit &unit, uint32_t begin, uint32_t end,
                          const AxisChanges &changes, const AnalysisLimits &limits,
                          const std::atomic<bool> *cancel);

/// Begin of the first block of `before` whose moves or functions are others in `after`, lengths
/// compared within `tolerance` mm; none: both do the same.
std::optional<uint32_t> firstDifference(const SelectionRun &before, const SelectionRun &after,
                                        double tolerance);

/// Whether both runs leave the machine at the same place, with the same tool, offsets and
/// variables, and in the same modes. Where the program ends for good, modes that the control resets
/// then and the program's own variables do not count.
bool endAlike(const Dialect &dialect, const SelectionRun &a, const SelectionRun &b);

} // namespace ncvet::lsp
