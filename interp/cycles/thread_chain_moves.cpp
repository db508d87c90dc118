// The motions of a cycle that threads from place to place: at each depth once along all of them.
#include "interp/cycles/cycle_moves.h"
#include "interp/cycles/cycle_writer.h"
#include "interp/cycles/thread_depths.h"
#include "interp/evaluate/formula.h"

namespace ncvet {

namespace {

class ThreadChainMoves : private CycleWriter {
public:
  ThreadChainMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                   llvm::SmallVectorImpl<Move> &moves)
      : CycleWriter(executed, cycle, moves), parameters_(executed, cycle) {}

  void run() {
    readPlaces();
    const auto height = parameters_.length(Measure::Height);
    if (places_.size() < 2 || !height)
      return lost();
    height_ = *height;
    inwards_ = parameters_.number(Measure::Inside) == Interval::exactly(1) ? 1 : -1;
    const auto depths = threadDepths(parameters_);
    const double starts = knownOr(parameters_, Measure::Count, 1);
    toStart();
    for (double start = 0; start < std::max(1.0, std::min(starts, double(mostSteps))); ++start) {
      for (const double depth : depths)
        pass(Interval::exactly(depth));
      if (depths.empty()) // how it gets there is not known, the last pass is
        pass(height_);
    }
  }

private:
  /// Z and X of a place, X as the coordinate of the thread's crest.
  struct ThreadPlace {
    Interval z, x;
  };

  void readPlaces() {
    ConditionContext context{executed_.dialect, executed_.machine, executed_.block, {},
                             executed_.after,
                             /*keptWords=*/true};
    const Interval count = levelOf(cycle_.count, cycle_, context),
                   factor = parameters_.lengthFactor();
    if (!count.isConstant() || !factor.isConstant())
      return;
    // Whether coordinates of X are radii is not known where the program does not say it.
    const bool stated =
        !(executed_.after.active(executed_.dialect, StandardGroup::Diameter) & groupUnset);
    for (; context.index < std::min(count.value(), double(mostSteps)); ++context.index) {
      const Interval z = levelOf(cycle_.places[0], cycle_, context),
                     diameter = levelOf(cycle_.places[1], cycle_, context);
      places_.push_back(
          {z * factor.value(), stated ? diameter * (factor.value() / 2) : Interval::unknown()});
    }
  }

  /// The control withdraws to a diameter of its own.
  void toStart() {
    at_[size_t(Axis::Z)] = feedsStraightIn(parameters_) ? places_.front().z : Interval::unknown();
    go(MoveKind::Rapid, Axis::X, Interval::unknown());
  }

  void pass(const Interval &depth) {
    const Interval below = depth * inwards_;
    go(MoveKind::Rapid, Axis::X, places_.front().x + below);
    for (size_t i = 1; i < places_.size(); ++i) {
      at_[size_t(Axis::Z)] = places_[i].z;
      Move &move = go(MoveKind::Thread, Axis::X, places_[i].x + below);
      move.feed = parameters_.length(Measure::Lead, double(i - 1)).value_or(Interval::unknown());
      move.feedMode = Action::FeedPerRevolution;
    }
    go(MoveKind::Rapid, Axis::X, Interval::unknown());
    toStart();
  }

  void lost() {
    at_[size_t(Axis::Z)] = Interval::unknown();
    go(MoveKind::Rapid, Axis::X, Interval::unknown());
  }

  const CycleParameters parameters_;
  llvm::SmallVector<ThreadPlace, 4> places_;
  Interval height_;     ///< of the thread
  double inwards_ = -1; ///< sign of the path into the work along X
};

} // namespace

void appendThreadChainMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                            llvm::SmallVectorImpl<Move> &moves) {
  ThreadChainMoves(executed, cycle, moves).run();
}

} // namespace ncvet
