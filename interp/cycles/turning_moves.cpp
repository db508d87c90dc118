// The motions of turning cycles: single passes, and grooves.
#include "interp/cycles/cycle_moves.h"
#include "interp/cycles/cycle_writer.h"
#include "interp/evaluate/cycle_parameters.h"

#include <cmath>

namespace ncvet {

namespace {

class TurningMoves : private CycleWriter {
public:
  TurningMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
               llvm::SmallVectorImpl<Move> &moves)
      : CycleWriter(executed, cycle, moves) {}

  bool run() {
    switch (cycle_.cycle) {
    case CycleKind::TurnPass:
    case CycleKind::FacePass:
      pass();
      return true;
    case CycleKind::GrooveFace:
      grooves(Axis::Z, Axis::X);
      return true;
    case CycleKind::GrooveRadial:
      grooves(Axis::X, Axis::Z);
      return true;
    default:
      return false;
    }
  }

private:
  /// One pass of turning or facing: in, along, out, back.
  void pass() {
    const bool facing = cycle_.cycle == CycleKind::FacePass;
    const Place start = at_;
    const auto target = [&](Axis axis) {
      for (const WordSpec &spec : cycle_.words) {
        if (spec.role == Role::Taper || !namesAxis(spec, axis))
          continue;
        const auto value = words_.value(spec);
        if (value)
          return words_.isIncrement(spec) ? start[size_t(axis)] + *value : *value;
      }
      return start[size_t(axis)];
    };
    const Interval x = target(Axis::X), z = target(Axis::Z);
    const auto taper = words_.value(Role::Taper).value_or(Interval::exactly(0));
    Interval &atX = at_[size_t(Axis::X)], &atZ = at_[size_t(Axis::Z)];
    if (facing)
      atZ = z + taper;
    else
      atX = x + taper * 2;
    go(MoveKind::Rapid);
    atX = x;
    atZ = z;
    go(MoveKind::Linear);
    (facing ? atZ : atX) = start[size_t(facing ? Axis::Z : Axis::X)];
    go(MoveKind::Linear);
    at_ = start;
    go(MoveKind::Rapid);
  }
  /// Where the cycle's word leads along an axis, from `start`.
  std::optional<Interval> leadsTo(Axis axis, const Interval &start) const {
    for (const WordSpec &spec : cycle_.words)
      if ((spec.role == Role::Target || spec.role == Role::Depth) && namesAxis(spec, axis))
        if (const Word *word = wordFor(executed_.block, spec); word && names(*word, axis))
          if (const auto value = words_.value(spec))
            return words_.isIncrement(spec) ? start + *value : *value;
    return std::nullopt;
  }
  bool names(const Word &word, Axis axis) const {
    return executed_.dialect.addresses[word.address].axis == axis;
  }

  /// Grooves side by side, each cut in steps: `along` is the axis of the cut, `across` that from
  /// one groove to the next. The tool ends where it began.
  void grooves(Axis along, Axis across) {
    const Place start = at_;
    const auto bottom = leadsTo(along, start[size_t(along)]);
    const auto last = leadsTo(across, start[size_t(across)]);
    const auto stepWord = words_.value(Role::Step);
    const double unit = executed_.dialect.lengthsPerUnit(across);
    const Interval step = (stepWord ? *stepWord : Interval::exactly(0)) * unit;
    if (!bottom) // the parameter block of a form of two
      return;
    const bool known =
        start[size_t(across)].isConstant() && (!last || last->isConstant()) && step.isConstant();
    double place = known ? start[size_t(across)].value() : 0;
    const double end = known && last ? last->value() : place, way = end - place;
    const double by = std::copysign(step.isConstant() ? std::fabs(step.value()) : 0, way);
    for (unsigned groove = 0; groove < mostSteps; ++groove) {
      cutGroove(along, start[size_t(along)], *bottom);
      relieve(across, start[size_t(across)], last);
      at_[size_t(along)] = start[size_t(along)];
      go(MoveKind::Rapid);
      if (!known || std::fabs(end - place) < tolerance || way == 0)
        break;
      place = by == 0 || std::fabs(end - place) < std::fabs(by) ? end : place + by;
      at_[size_t(across)] = Interval::exactly(place);
      go(MoveKind::Rapid);
    }
    at_[size_t(across)] = start[size_t(across)];
    go(MoveKind::Rapid);
  }
  /// Down in steps, back a little after each to break the chip.
  void cutGroove(Axis along, const Interval &top, const Interval &bottom) {
    const double unit = executed_.dialect.lengthsPerUnit(along);
    const auto stepWord = words_.value(Role::CutDepth);
    Interval &at = at_[size_t(along)];
    if (stepWord && stepWord->isConstant() && top.isConstant() && bottom.isConstant()) {
      const double length = std::fabs(stepWord->value()) * unit;
      const double sign = bottom.value() < top.value() ? -1 : 1;
      double level = top.value();
      for (unsigned pass = 0; pass < mostSteps && length > tolerance; ++pass) {
        level += sign * length;
        if ((bottom.value() - level) * sign <= tolerance)
          break;
        at = Interval::exactly(level);
        go(MoveKind::Linear);
        at = at + chipBreak() * (-sign * unit);
        go(MoveKind::Rapid);
      }
    }
    at = bottom;
    go(MoveKind::Linear);
  }
  /// At the bottom away from the wall, against the direction in which the grooves follow.
  void relieve(Axis across, const Interval &first, const std::optional<Interval> &last) {
    const auto relief = words_.value(Role::Relief);
    if (!relief || *relief == Interval::exactly(0) || !last)
      return;
    const bool known = first.isConstant() && last->isConstant();
    const double unit = executed_.dialect.lengthsPerUnit(across);
    const double sign = !known ? 0 : first.value() < last->value() ? -1 : 1;
    Interval &at = at_[size_t(across)];
    at = known ? at + *relief * (sign * unit) : Interval::unknown();
    go(MoveKind::Rapid);
  }
  /// How far the tool goes back to break the chip.
  Interval chipBreak() const {
    return CycleParameters(executed_, cycle_)
        .length(Measure::Retract, Role::Retract)
        .value_or(Interval::unknown());
  }
};

} // namespace

bool appendTurningMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                        llvm::SmallVectorImpl<Move> &moves) {
  return TurningMoves(executed, cycle, moves).run();
}

} // namespace ncvet
