// The passes of thread cycles, one after the other down to the depth of the thread.
#include "interp/cycles/cycle_moves.h"
#include "interp/cycles/cycle_writer.h"
#include "interp/cycles/thread_depths.h"
#include "interp/evaluate/cycle_parameters.h"
#include "interp/geometry/direction.h"

#include <cmath>

namespace ncvet {

namespace {

class ThreadMoves : private CycleWriter {
public:
  ThreadMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
              llvm::SmallVectorImpl<Move> &moves)
      : CycleWriter(executed, cycle, moves), parameters_(executed, cycle), start_(at_),
        unit_(executed.dialect.lengthsPerUnit(Axis::X)) {}

  /// A cycle that cuts all passes; false for a parameter block.
  bool run() {
    const auto x = leadsTo(Axis::X), z = leadsTo(Axis::Z);
    if (!x && !z)
      return false;
    root_ = x.value_or(start_[size_t(Axis::X)]);
    end_ = z.value_or(start_[size_t(Axis::Z)]);
    taper_ = parameters_.length(Role::Taper).value_or(Interval::exactly(0)) * unit_;
    readLead();
    passes();
    return true;
  }
  /// A cycle that cuts one pass.
  void runOnce() {
    root_ = leadsTo(Axis::X).value_or(start_[size_t(Axis::X)]);
    end_ = leadsTo(Axis::Z).value_or(start_[size_t(Axis::Z)]);
    taper_ = parameters_.length(Role::Taper).value_or(Interval::exactly(0)) * unit_;
    readLead();
    pass(root_, start_[size_t(Axis::Z)]);
  }

private:
  Interval &atX() { return at_[size_t(Axis::X)]; }
  Interval &atZ() { return at_[size_t(Axis::Z)]; }
  const Interval &startX() const { return start_[size_t(Axis::X)]; }
  const Interval &startZ() const { return start_[size_t(Axis::Z)]; }

  std::optional<Interval> leadsTo(Axis axis) const {
    for (const WordSpec &spec : cycle_.words)
      if ((spec.role == Role::Target || spec.role == Role::Depth) && namesAxis(spec, axis))
        if (const auto value = words_.value(spec))
          return words_.isIncrement(spec) ? start_[size_t(axis)] + *value : *value;
    return std::nullopt;
  }
  /// F is the lead; what another word gives is not known in millimetres.
  void readLead() {
    Move probe;
    setFeed(executed_.dialect, executed_.after, probe);
    lead_ = probe.feed;
    const WordSpec *spec = words_.spec(Role::Lead);
    const Word *word = spec ? wordFor(executed_.block, *spec) : nullptr;
    if (word && word->address != letterAddress('F'))
      lead_ = Interval::unknown();
  }
  void passes() {
    const auto height = parameters_.length(Measure::Height, Role::Height);
    const auto list = threadDepths(parameters_);
    if (list.empty() || !root_.isConstant() || !startX().isConstant())
      return pass(root_, Interval::unknown());
    const double in = root_.value() < startX().value() ? -1 : 1;
    const Interval from = feedsStraightIn(parameters_) ? startZ() : Interval::unknown();
    for (const double depth : list)
      pass(root_ - Interval::exactly(in * (height->value() - depth) * unit_), from);
  }

  /// In to a diameter, along the thread and out of it, back.
  void pass(const Interval &x, const Interval &from) {
    atX() = x + taper_;
    atZ() = from;
    go(MoveKind::Rapid);
    const Interval runOut = runOutLength();
    if (runOut == Interval::exactly(0)) {
      atX() = x;
      thread(end_);
    } else {
      outOfThread(x, runOut);
    }
    atX() = startX();
    go(MoveKind::Rapid);
    at_ = start_;
    go(MoveKind::Rapid);
  }
  void thread(const Interval &z) {
    atZ() = z;
    go(MoveKind::Thread).feed = lead_;
  }
  Interval runOutLength() const {
    const auto leads = parameters_.number(Measure::RunOut);
    if (!leads)
      return Interval::exactly(0);
    return leads->isConstant() && lead_.isConstant()
               ? Interval::exactly(leads->value() * lead_.value())
               : Interval::unknown();
  }
  /// The last part of the thread leads out of it, at an angle to the axis.
  void outOfThread(const Interval &x, const Interval &runOut) {
    const double angle = knownOr(parameters_, Measure::RunOutAngle, 45);
    if (!runOut.isConstant() || !x.isConstant() || !end_.isConstant() || !startZ().isConstant() ||
        !startX().isConstant() || !(angle > 0 && angle < 90)) {
      atX() = Interval::unknown();
      thread(runOut.isConstant() ? end_ : Interval::unknown());
      return;
    }
    const double way = end_.value() - startZ().value(), sign = way < 0 ? -1 : 1;
    const double length = std::min(runOut.value(), std::fabs(way));
    const Interval cone = taper_ * (way == 0 ? 0 : length / std::fabs(way));
    atX() = x + cone;
    thread(Interval::exactly(end_.value() - sign * length));
    const double out = startX().value() < x.value() ? -1 : 1;
    const double most = std::fabs(startX().value() - x.value());
    atX() = x + Interval::exactly(out * std::min(most, length * tangentOf(angle) * unit_));
    thread(end_);
  }

  const CycleParameters parameters_;
  const Place start_;
  const double unit_; ///< what X counts for a millimetre
  Interval root_, end_, taper_, lead_;
};

} // namespace

bool appendThreadMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                       llvm::SmallVectorImpl<Move> &moves) {
  ThreadMoves thread(executed, cycle, moves);
  if (cycle.cycle == CycleKind::ThreadPass) {
    thread.runOnce();
    return true;
  }
  return cycle.cycle == CycleKind::ThreadMulti && thread.run();
}

} // namespace ncvet
