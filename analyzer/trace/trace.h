// The motions that a program makes, from its first block to its end.
#pragma once

#include "analyzer/flow/analyze.h"
#include "interp/geometry/move.h"

namespace ncvet {

struct Step;

/// A motion with the block that it comes from.
struct TracedMove {
  const FileUnit *unit = nullptr;
  uint32_t begin = 0; ///< offset of that block
  Move move;
};

/// Receives the motions in the order in which they happen.
class TraceSink {
public:
  virtual ~TraceSink() = default;
  virtual void moved(const TracedMove &traced) = 0;
  /// A block was executed; its motions, which may be told later, carry the mark that is returned.
  virtual uint32_t markOf(const Step & /*step*/) { return 0; }
  /// After `where` only the run itself decides what happens.
  virtual void lost(const FileUnit &unit, SourceRange where, llvm::StringRef why) = 0;
};

enum class TracedPath : uint8_t {
  ToolCentre,  ///< of mills whose radius is known while compensation is on; else as programmed
  EveryCentre, ///< the same, and the centre of the nose of a lathe's tool
  Programmed
};

/// Follows the main program of `unit` with all that it calls: block skip off, optional stops off.
/// `cancel`, when given, ends it early.
void trace(Project &project, FileUnit &unit, const AnalysisLimits &limits, TraceSink &sink,
           TracedPath path = TracedPath::ToolCentre, const std::atomic<bool> *cancel = nullptr);

} // namespace ncvet
