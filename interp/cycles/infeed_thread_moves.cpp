// The motions of a cycle that threads pass by pass beside a line along Z.
#include "interp/cycles/cycle_moves.h"
#include "interp/cycles/cycle_writer.h"
#include "interp/geometry/direction.h"

namespace ncvet {

namespace {

class InfeedThreadMoves : private CycleWriter {
public:
  InfeedThreadMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                    llvm::SmallVectorImpl<Move> &moves)
      : CycleWriter(executed, cycle, moves) {}

  void run() {
    const auto peak = number(Role::Retract), first = number(Role::FirstCut),
               depth = number(Role::Height), lead = number(Role::Lead);
    const Interval x = at_[0], z = at_[2], end = executed_.after.at(Axis::Z);
    if (peak && first && depth && lead && x.isConstant() && z.isConstant() && end.isConstant() &&
        *first > 0) {
      const Interval share =
          shareOfDiameter(executed_.dialect, executed_.after, Axis::X, Truth::No);
      if (!share.isConstant())
        return leave();
      inwards_ = *peak > 0 ? 1 : -1;
      peak_ = std::fabs(*peak) * share.value();
      first_ = *first * share.value();
      depth_ = std::fabs(*depth) * share.value();
      x_ = x.value();
      z_ = z.value();
      readForm(end.value());
      passes();
    }
    leave();
  }

private:
  /// To where the cycle leaves the tool.
  void leave() {
    at_ = executed_.after.position;
    go(MoveKind::Rapid);
  }

  std::optional<double> number(Role role) const {
    const auto value = words_.value(role);
    return value && value->isConstant() ? std::optional(value->value()) : std::nullopt;
  }

  void readForm(double end) {
    const double direction = end > z_ ? -1 : 1;
    slope_ = direction * tangentOf(number(Role::Angle).value_or(0));
    end_ = end + depth_ * slope_;
    const int ends = int(number(Role::ThreadForm).value_or(0));
    const double taper = direction * std::max(0.0, number(Role::Taper).value_or(0));
    entry_ = ends & 1 ? taper : 0;
    exit_ = ends & 2 ? taper : 0;
    tapersIn_ = ends & 1;
    tapersOut_ = ends & 2;
  }

  /// Deeper and deeper, then at full depth as often as the springing of the tool asks for.
  void passes() {
    const double degression = std::max(1.0, number(Role::Ratio).value_or(1));
    double depth = first_;
    for (unsigned count = 2; depth < depth_ - tolerance && count < mostSteps; ++count) {
      pass(depth);
      depth = first_ * std::pow(count, 1 / degression);
    }
    const double springs = std::min(number(Role::PassCount).value_or(0), double(mostSteps));
    for (double i = 0; i <= springs; ++i)
      pass(depth_);
  }

  /// One pass at `depth` below the thread's peak: in, along, out.
  void pass(double depth) {
    const double shift = depth * slope_, bottom = peak_ + depth;
    const double clear = depth - depth_; // above the line on which the cycle began
    const double begin = z_ - shift, end = end_ - shift;
    to(MoveKind::Rapid, clear, begin);
    if (tapersIn_) {
      to(MoveKind::Thread, bottom - depth_, begin);
      to(MoveKind::Thread, bottom, begin - entry_);
    } else {
      to(MoveKind::Rapid, bottom, begin);
    }
    if (tapersOut_) {
      to(MoveKind::Thread, bottom, end + exit_);
      to(MoveKind::Thread, bottom - depth_, end);
    } else {
      to(MoveKind::Thread, bottom, end);
    }
    to(MoveKind::Rapid, clear, end);
  }
  void to(MoveKind kind, double inwards, double z) {
    at_[0] = Interval::exactly(x_ + inwards_ * inwards);
    at_[2] = Interval::exactly(z);
    Move &move = go(kind);
    if (kind == MoveKind::Thread)
      if (const auto lead = words_.value(Role::Lead))
        move.feed = *lead;
  }

  double inwards_ = 1;                      ///< sign of the path into the work along X
  double peak_ = 0, first_ = 0, depth_ = 0; ///< from the line, of the first pass, of the thread
  double x_ = 0, z_ = 0, end_ = 0;          ///< where the line begins, and its end in Z
  double slope_ = 0;                        ///< way along Z for each depth
  double entry_ = 0, exit_ = 0;             ///< lengths of the tapered ends along Z, with sign
  bool tapersIn_ = false, tapersOut_ = false;
};

} // namespace

void appendInfeedThreadMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                             llvm::SmallVectorImpl<Move> &moves) {
  InfeedThreadMoves(executed, cycle, moves).run();
}

} // namespace ncvet
