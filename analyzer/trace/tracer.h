// Makes motions of the blocks that are executed.
#pragma once

#include "analyzer/flow/cycle_contour.h"
#include "analyzer/flow/flow_listener.h"
#include "analyzer/trace/trace.h"
#include "interp/path/compensated_path.h"

namespace ncvet {

/// What a trace carries from one block to the next, beside the machine's state.
struct TraceRest {
  CornerPath corners;
  std::optional<CompensatedPath> compensated;
  Place last; ///< where the last motion ended, without what corners change
};

/// Listens to a run, and tells a sink of the motions.
class Tracer : public FlowListener {
public:
  Tracer(Project &project, FileUnit &unit, TraceSink &sink, TracedPath path);
  /// Takes a trace up again that has left `rest`.
  Tracer(Project &project, TraceSink &sink, const TraceRest &rest);

  FlowInterest interest() const override { return {0, false, true, true}; }
  void executed(const Step &step, bool continues) override;
  void pathLost(SourceRange where, llvm::StringRef why) override;
  /// After a contour the tool goes back to where the cycle began.
  void contourEnded() override;
  /// Nothing follows: what waits is told.
  void finish();

  /// All motions of the blocks so far have been told, and none of them decides about later ones.
  bool isIdle() const {
    return !cycle_ && path_.isIdle() && (!compensated_ || compensated_->isIdle());
  }
  TraceRest rest() const { return {path_, compensated_, last_}; }
  /// Whether this trace, which is idle, tells the same of what follows as one that has left `rest`.
  bool goesOnAs(const TraceRest &rest) const;

private:
  void add(uint64_t tag, const Move &move, const CornerRequest &corner,
           const std::array<Axis, 2> &plane);
  static void turn(const ContourCycle &cycle, llvm::ArrayRef<Move> contour,
                   llvm::function_ref<void(const Move &)> write);
  const FileUnit &unitOf(FileId file);
  void compensate(uint64_t tag, const Move &move);
  void give(uint64_t tag, const Move &move);

  Project &project_;
  TraceSink &sink_;
  const CornerWords corners_;
  CornerPath path_;
  std::optional<CompensatedPath> compensated_;
  CycleContour contour_;
  std::optional<ContourCycle> cycle_; ///< whose contour is read, or run
  uint64_t cycleTag_ = 0;
  uint32_t mark_ = 0, cycleMark_ = 0; ///< of the last block, and of that of the cycle
  Place last_;                        ///< where the last motion ends, without what corners change
  llvm::SmallVector<Move, 16> moves_;
};

} // namespace ncvet
