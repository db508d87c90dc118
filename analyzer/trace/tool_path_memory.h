// The tool path of a program that is being edited: after an edit only the blocks near it are
// executed again.
#pragma once

#include "analyzer/trace/path_collector.h"
#include "analyzer/trace/tracer.h"
#include "formats/text/text_change.h"

#include "llvm/ADT/SmallVector.h"

#include <memory>

namespace ncvet {

/// What an edit has made of a text.
struct PathEdit {
  TextChange change;
  uint32_t tail = 0; ///< offset, before it, of the first line that is wholly after it
  uint32_t line = 1; ///< number of that line, from 1
  int64_t lines = 0; ///< so many lines it has put in; below zero: taken out
};

/// Text of the file that has been executed: blocks of the main program, and the programs that it
/// has called.
struct ExecutedText {
  struct Range {
    uint32_t begin = 0, end = 0;
  };

  Range main;                           ///< of the main program, with what lies between its blocks
  llvm::SmallVector<Range, 2> programs; ///< others, each as a whole, by its place

  /// Whether an edit leaves all of it as it was.
  bool isClearOf(const PathEdit &edit) const;
  /// The edit, which leaves it as it was, may have moved it.
  void moveBy(const PathEdit &edit);
};

/// Between two blocks of the main program of a file that simply follow one another: all that its
/// path depends on from there.
struct PathPoint {
  uint32_t next = 0; ///< offset of the second block
  MachineState state;
  TraceRest trace;
  std::optional<TraceRest> centreTrace;
  PathCollector::Rest rest;
  CurveWriter::Point centreRest = CurveWriter::nowhere;
  ToolPathChange before; ///< of each list how many elements there were, as `first`
  ExecutedText text;     ///< since the point before
  uint64_t detours = 0;  ///< jumps: where they lead is looked up in text that is not executed
};

/// Follows the main program of a file, and after each edit of the file again. From time to time it
/// keeps a point from which the path can be taken up: the next run begins at the last one before
/// the edit, and ends at the first one after it that it reaches in the same state.
///
/// Where a program jumps, all is followed: only of one that goes straight on, round in loops, or
/// through other programs of its file, it is known that it does not come by the edit once more.
class ToolPathMemory {
public:
  /// `mostMoves`: a longer path is cut.
  explicit ToolPathMemory(size_t mostMoves) : most_(mostMoves) {}

  /// Brings the path up to the text of `unit`. `edit`: what has become of the text that was
  /// followed last; none: it was another one, it held other programs, or something else has changed
  /// that the path depends on. Programs of other files are those of the last time. Nothing when
  /// `cancel` was set meanwhile: the next time all is followed.
  ///
  /// `piece`, when not zero: where an edit changes all that follows, about so many blocks are
  /// executed, or moves made, and the rest of the path stays as it was before the edit. The next
  /// call goes on there, see `isPartial`.
  std::optional<ToolPathChange> follow(Project &project, FileUnit &unit,
                                       const AnalysisLimits &limits, const PathEdit *edit,
                                       const std::atomic<bool> *cancel, uint64_t piece = 0);

  /// Whether the end of the path is still that of an earlier text.
  bool isPartial() const { return stale_; }

  const ToolPath &path() const { return path_; }
  /// Paths of the files whose blocks the path has; the first is that of the program itself.
  const std::vector<std::string> &files() const { return files_->paths(); }
  /// Blocks that the last call has executed.
  uint64_t executed() const { return executed_; }

private:
  struct Run;
  class Marker;

  void clear();
  std::optional<ToolPathChange> followAll(const Run &run, bool withCentre);
  std::optional<ToolPathChange> followEdit(const Run &run, const PathEdit &edit);
  std::vector<PathPoint> takeAfter(const PathEdit &edit, size_t &fresh);
  void takeOver(llvm::MutableArrayRef<PathPoint> known, const PathPoint &met, bool isAlike);
  void meet(const Marker &marker, llvm::MutableArrayRef<PathPoint> known, size_t fresh);
  void runFrom(const Run &run, const PathPoint *from, Marker &marker);
  bool mayBeCompared() const;
  bool mayBeTakenUp() const;

  size_t most_;
  std::shared_ptr<const Dialect> dialect_; ///< to which the points refer
  ToolPath path_;
  std::optional<PathFiles> files_;
  std::optional<PathCollector> programmed_;
  std::optional<CentreCollector> centre_; ///< none: the tool is nowhere else
  PathCollector::Rest start_;             ///< before the first block
  std::vector<PathPoint> points_;         ///< as they were passed
  size_t fresh_ = 0;                      ///< so many of them in the text as it is now
  bool stale_ = false;                    ///< the path after these is that of an earlier text
  ExecutedText text_;                     ///< after the last point
  uint64_t detours_ = 0;                  ///< of the whole path
  size_t settingsAtFirst_ = 0;            ///< when all was followed last
  bool whole_ = false;                    ///< the path was followed to its end
  uint64_t executed_ = 0;
};

} // namespace ncvet
