// The path of a tool through one program, as reports draw it: plain data that knows no control.
#pragma once

#include "formats/text/source.h"

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ncvet {

enum class PathMotion : uint8_t { Rapid, Feed, Arc, Thread, Dwell, Tool };

/// What is not known, of a coordinate, a feed or a time.
constexpr float pathUnknown = std::numeric_limits<float>::quiet_NaN();

/// One motion. Where it begins is where the one before ended.
struct PathMove {
  PathMotion motion = PathMotion::Rapid;
  bool machine = false; ///< an axis goes to machine coordinates (G28, G53): its place is unknown
  uint16_t file = 0;    ///< in `ToolPath::files`
  uint32_t line = 1;    ///< of the block, from 1
  /// X Y Z in the active work coordinates, mm; X of a lathe as a radius.
  std::array<float, 3> to{pathUnknown, pathUnknown, pathUnknown};
};

/// What a move of the kind `Arc` has besides.
struct PathArc {
  uint32_t move = 0;
  /// Numbers of its axes (0 to 2), in the order in which a counter-clockwise turn leads from the
  /// first to the second.
  uint8_t first = 0, second = 1;
  std::array<float, 2> centre{pathUnknown, pathUnknown}; ///< along these axes, mm
  float turns = 0; ///< full turns, above zero counter-clockwise
};

/// A value that holds from one move on.
struct PathChange {
  uint32_t move = 0;
  float value = pathUnknown;
  uint8_t kind = 0; ///< of a feed, see `PathFeed`; of a further axis its letter
};

enum class PathFeed : uint8_t { Unknown, PerMinute, PerRevolution, InverseTime };

/// Moves in the order in which they happen.
struct PathCurve {
  std::vector<PathMove> moves;
  std::vector<PathArc> arcs;
};

enum class PathSpindle : uint8_t { Unknown, Off, Clockwise, CounterClockwise, Oriented };

/// The modes under which moves are made.
struct PathSetting {
  int tool = -1;          ///< below zero: none, or not known
  int lengthOffset = -1;  ///< H, below zero: none, or not known
  int radiusOffset = -1;  ///< D, or the offset of a lathe's T word
  std::string workOffset; ///< "G54"; empty: none is named
  std::string cycle;      ///< "G83" that makes the moves; empty: the block itself does
  int side = 0;           ///< of compensation: 1 on the left of the path, -1 on its right
  PathSpindle spindle = PathSpindle::Unknown;
  std::optional<double> speed; ///< as programmed: 1/min, or m/min with `surfaceSpeed`
  bool surfaceSpeed = false;
  std::optional<double> speedLimit; ///< 1/min

  friend bool operator==(const PathSetting &, const PathSetting &) = default;
};

/// What one tool does in one go: from a tool change, a comment of its own line, or another cycle
/// on.
struct PathOperation {
  std::string comment; ///< without its marks; empty: there is none
  std::string cycle;   ///< with which it begins; empty: none
  int tool = -1;
  uint16_t file = 0;
  uint32_t line = 1;

  friend bool operator==(const PathOperation &, const PathOperation &) = default;
};

/// From this move on, until the next section.
struct PathSection {
  uint32_t move = 0, setting = 0, operation = 0;
};

/// Where the path ends, and why.
struct PathEnd {
  enum Kind : uint8_t {
    Whole,   ///< with the program
    Unknown, ///< only the run decides what comes next
    Cut      ///< there are more moves than a report takes
  };
  Kind kind = Whole;
  uint16_t file = 0;
  uint32_t line = 0;
  std::string why; ///< of Unknown
};

/// A box; where it has no bound it has no end.
struct PathBox {
  std::array<std::optional<double>, 3> min, max; ///< mm, X Y Z; X of a lathe as a radius
};

struct PathTool {
  std::string kind;                     ///< "endmill"; empty: not known
  std::optional<double> radius, length; ///< mm
};

/// What is known of the machine. Where a value is absent, a report assumes one and says so.
struct PathMachine {
  PathBox envelope;                                                    ///< machine coordinates
  std::optional<double> rapid;                                         ///< mm/min
  std::optional<double> feedMax;                                       ///< mm/min
  std::optional<double> spindleMax;                                    ///< 1/min
  std::optional<double> acceleration;                                  ///< mm/s2
  std::optional<double> toolChange;                                    ///< seconds
  std::optional<PathBox> stock;                                        ///< work coordinates
  std::vector<PathBox> clamps;                                         ///< work coordinates
  std::map<std::string, std::array<std::optional<double>, 3>> offsets; ///< origins, by code
  std::map<int, PathTool> tools;
};

struct ToolPath {
  std::vector<FileId> files; ///< of the blocks; the first is that of the program itself
  bool lathe = false;
  bool diameter = false;          ///< the program gives X as a diameter
  PathCurve programmed;           ///< as the program and its cycles have it
  PathCurve centre;               ///< where compensation puts the tool; empty: nowhere else
  std::vector<PathChange> feeds;  ///< of `programmed`, by ascending moves
  std::vector<PathChange> dwells; ///< seconds of its moves of that kind
  std::vector<PathChange> others; ///< axes beside X Y Z
  std::vector<PathSection> sections;
  std::vector<PathSetting> settings;
  std::vector<PathOperation> operations;
  PathEnd end;
  PathMachine machine;
};

/// From element `first` on, `removed` elements of a list became `added` ones.
struct ListChange {
  uint32_t first = 0, removed = 0, added = 0;

  bool isEmpty() const { return removed == 0 && added == 0; }
  /// Of how many elements the list has more: below zero, less.
  int64_t by() const { return int64_t(added) - removed; }
};

/// What an edit of the program has made of its path. Numbers of moves after those that changed are
/// others by `moves.by()`, numbers of operations by `operations.by()`; that is no change.
struct ToolPathChange {
  bool whole = true; ///< it is another path: the rest says nothing
  ListChange moves;  ///< of `programmed`, with their arcs
  /// When not empty: of the moves that changed only these do, and only where they end.
  std::vector<uint32_t> moved;
  ListChange centre; ///< moves of `centre`, with their arcs
  ListChange feeds, dwells, others, sections, operations;
  uint32_t settings = 0; ///< from this one on they are new
  /// Blocks of the first file that were in this line (from 1) or a later one are so many lines
  /// further down.
  uint32_t line = 1;
  int64_t lines = 0;
};

} // namespace ncvet
