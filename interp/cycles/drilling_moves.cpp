// The motions of cycles that make holes, by the shape that the table gives each.
#include "interp/cycles/cycle_moves.h"
#include "interp/cycles/cycle_writer.h"
#include "interp/evaluate/cycle_parameters.h"
#include "interp/evaluate/formula.h"

#include <cmath>

namespace ncvet {

namespace {

bool same(const Interval &a, const Interval &b) { return a.isConstant() && a == b; }

class DrillingMoves : private CycleWriter {
public:
  DrillingMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                llvm::SmallVectorImpl<Move> &moves)
      : CycleWriter(executed, cycle, moves), parameters_(executed, cycle),
        tool_(toolAxis(executed.dialect, executed.after)) {}

  /// The cycle's motions at each place to which the block takes it; where the tool is when the
  /// cycle is called.
  void run() {
    const auto tool = size_t(tool_);
    const Interval approach = approachLevel(), bottom = bottomLevel(approach);
    if (executed_.outcome.holes.empty())
      return drill(approach, bottom);
    const bool rises = executed_.dialect.drilling.risesFirst;
    if (const Interval start = startLevel();
        rises && start.isConstant() && approach.isConstant() && start.value() < approach.value())
      toLevel(MoveKind::Rapid, approach);
    for (const Place &hole : executed_.outcome.holes) {
      Place place = hole;
      place[tool] = rises ? levelAcross(approach) : at_[tool];
      const bool moves = !std::equal(place.begin(), place.end(), at_.begin());
      at_ = place;
      machineAxes_ = (executed_.after.machineAxes & ~(1u << tool)) | (machineAxes_ & (1u << tool));
      if (moves)
        go(MoveKind::Rapid);
      drill(approach, bottom);
    }
  }

private:
  /// Level of the path to a hole, for a control that rises: the present one, or where that is not
  /// above the approach the one to which it withdraws.
  Interval levelAcross(const Interval &approach) const {
    const Interval &present = at_[size_t(tool_)];
    if (!present.isConstant() || !approach.isConstant())
      return Interval::unknown();
    return present.value() > approach.value() ? present : executed_.after.at(tool_);
  }
  void toLevel(MoveKind kind, const Interval &level) {
    if (!same(at_[size_t(tool_)], level))
      go(kind, tool_, level);
  }
  void spindle(uint8_t state) {
    Move &move = go(MoveKind::Spindle);
    move.spindle = state;
    move.value = executed_.after.speed;
  }
  void dwell() {
    if (const auto time = parameters_.number(Measure::Dwell)) {
      if (*time != Interval::exactly(0))
        stay(*time);
      return;
    }
    for (const Role role : {Role::Dwell, Role::Time})
      if (const auto time = words_.value(role)) {
        go(MoveKind::Dwell).value =
            executed_.dialect.dwellInMilliseconds && dwellIsWhole() ? *time * 0.001 : *time;
        return;
      }
  }
  /// Seconds, or turns of the spindle below zero.
  void stay(const Interval &time) {
    go(MoveKind::Dwell).value = time.lo >= 0 ? time : Interval::unknown();
  }
  bool dwellIsWhole() const {
    const WordSpec *spec = words_.spec(Role::Dwell);
    const Word *word = spec ? wordFor(executed_.block, *spec) : nullptr;
    return !word || !word->has(wordPoint);
  }

  bool incremental() const {
    return executed_.after.isActive(executed_.dialect, StandardGroup::Distance,
                                    {Action::Incremental}) == Truth::Yes;
  }
  /// Level from which the tool is fed.
  Interval approachLevel() const {
    if (!cycle_.approach.empty())
      return formula(cycle_.approach);
    const auto level = words_.value(Role::Retract);
    if (!level)
      return startLevel();
    const WordSpec *spec = words_.spec(Role::Retract);
    return incremental() && !spec->variable && !spec->position ? startLevel() + *level : *level;
  }
  /// Level at which the tool was when the cycle became active.
  Interval startLevel() const {
    const Interval &level = executed_.after.initialLevel;
    return level.isUnknown() ? executed_.before.at(tool_) : level;
  }
  Interval bottomLevel(const Interval &approach) const {
    if (!cycle_.bottom.empty())
      return formula(cycle_.bottom);
    const auto spec = depthSpec();
    const auto depth = spec ? words_.value(*spec) : std::nullopt;
    if (!depth)
      return Interval::unknown();
    const bool relative =
        words_.isIncrement(*spec) || (incremental() && !spec->variable && !spec->position);
    return relative ? approach + *depth : *depth;
  }
  /// The cycle's depth: in another plane it is given along another axis.
  std::optional<WordSpec> depthSpec() const {
    const WordSpec *spec = words_.spec(Role::Depth);
    if (!spec)
      return std::nullopt;
    WordSpec depth = *spec;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
      if (const auto letter = AddressId(letterAddress('X') + size_t(axis));
          depth.any == maskOf(letter) && axis != tool_)
        depth.any = maskOf(AddressId(letterAddress('X') + size_t(tool_)));
    return depth;
  }
  Interval formula(const Formula &what) const {
    return levelOf(what, cycle_,
                   {executed_.dialect,
                    executed_.machine,
                    executed_.block,
                    {},
                    executed_.after,
                    /*keptWords=*/true});
  }

  /// The other direction, where the spindle turns in a known one.
  static uint8_t reversed(uint8_t turning) {
    return turning == spindleCw    ? uint8_t(spindleCcw)
           : turning == spindleCcw ? uint8_t(spindleCw)
                                   : turning;
  }

  void drill(const Interval &approach, const Interval &bottom) {
    const Interval withdraw = executed_.after.at(tool_);
    const bool feedsOut = executed_.dialect.drilling.feedsOutToLevel;
    const bool counterbores = words_.spec(Role::Counterbore);
    if (cycle_.cycle != CycleKind::BackBore || counterbores)
      toLevel(MoveKind::Rapid, approach);
    const uint8_t turning = executed_.before.spindle;
    switch (cycle_.cycle) {
    case CycleKind::Peck:
    case CycleKind::ChipBreak:
      peck(approach, bottom);
      dwell();
      break;
    case CycleKind::Tap:
    case CycleKind::TapLeft:
    case CycleKind::RigidTap:
    case CycleKind::RigidTapLeft:
      toLevel(MoveKind::Linear, bottom);
      dwell();
      spindle(reversed(turning));
      toLevel(MoveKind::Linear, feedsOut ? withdraw : approach);
      spindle(turning);
      break;
    case CycleKind::Ream:
      toLevel(MoveKind::Linear, bottom);
      dwell();
      toLevel(MoveKind::Linear, approach);
      break;
    case CycleKind::ReamDwell:
      toLevel(MoveKind::Linear, bottom);
      dwell();
      toLevel(MoveKind::Linear, feedsOut ? withdraw : approach);
      break;
    case CycleKind::BoreStop:
    case CycleKind::BoreManual:
    case CycleKind::BoreDwellManual:
      toLevel(MoveKind::Linear, bottom);
      dwell();
      spindle(spindleOff);
      toLevel(MoveKind::Rapid, withdraw);
      spindle(turning);
      return;
    case CycleKind::FineBore:
      toLevel(MoveKind::Linear, bottom);
      dwell();
      spindle(spindleOriented);
      shift(1);
      toLevel(MoveKind::Rapid, withdraw);
      shift(-1);
      spindle(turning);
      return;
    case CycleKind::BackBore:
      return counterbores ? counterbore(bottom, turning) : backBore(approach, bottom, turning);
    default:
      toLevel(MoveKind::Linear, bottom);
      dwell();
      break;
    }
    toLevel(MoveKind::Rapid, withdraw);
  }

  static Axis axisOfShift(const WordSpec &spec) {
    return spec.any & maskOf('I')   ? Axis::X
           : spec.any & maskOf('J') ? Axis::Y
           : spec.any & maskOf('K') ? Axis::Z
                                    : Axis::Count;
  }

  /// Aside with the oriented tool, so that its edge does not touch the bore.
  void shift(double sign) {
    bool moves = false;
    for (const WordSpec &spec : cycle_.words) {
      if (spec.role != Role::Shift && spec.role != Role::Counterbore)
        continue;
      const auto by = words_.value(spec);
      if (!by)
        continue;
      const Axis axis = axisOfShift(spec);
      if (axis == tool_)
        continue;
      if (axis != Axis::Count) {
        at_[size_t(axis)] = at_[size_t(axis)] + *by * sign;
      } else { // the machine's setting has the direction
        const uint16_t plane = planeAxes(executed_.dialect, executed_.after);
        for (unsigned i = 0; i < axisCount; ++i)
          if (plane >> i & 1)
            at_[i] = sign > 0 ? Interval::unknown() : executed_.after.position[i];
      }
      moves = true;
    }
    if (moves)
      go(MoveKind::Rapid);
  }

  /// Down beside the bore's axis, then fed up from below as far as the word of the tool axis says,
  /// and down again.
  void counterbore(const Interval &bottom, uint8_t turning) {
    Interval top;
    for (const WordSpec &spec : cycle_.words)
      if ((spec.role == Role::Shift || spec.role == Role::Counterbore) &&
          axisOfShift(spec) == tool_)
        if (const auto word = words_.value(spec))
          top = incremental() ? bottom + *word : *word;
    besideAxis(bottom, turning);
    toLevel(MoveKind::Linear, top);
    toLevel(MoveKind::Linear, bottom);
    dwell();
    besideAxis(executed_.after.at(tool_), turning);
  }

  /// From below: through the bore beside its axis, then fed up.
  void backBore(const Interval &below, const Interval &top, uint8_t turning) {
    besideAxis(below, turning);
    toLevel(MoveKind::Linear, top);
    dwell();
    besideAxis(executed_.after.at(tool_), turning);
  }

  /// Through the bore beside its axis: the edge is turned away from the wall on the way.
  void besideAxis(const Interval &level, uint8_t turning) {
    spindle(spindleOriented);
    shift(1);
    toLevel(MoveKind::Rapid, level);
    shift(-1);
    spindle(turning);
  }

  /// The first peck: its level, and the depth from which the later ones take their measure.
  struct FirstPeck {
    double level = 0, depth = 0;
  };
  std::optional<FirstPeck> firstPeck(double approach, double sign) const {
    const auto level = parameters_.length(Measure::FirstDepth);
    const auto top = parameters_.length(Measure::Top);
    if (level && top)
      return level->isConstant() && top->isConstant()
                 ? std::optional(
                       FirstPeck{level->value(), std::fabs(level->value() - top->value())})
                 : std::nullopt;
    const auto step = words_.value(Role::Peck);
    const auto first = words_.value(Role::PeckFirst);
    if ((!step && !first) || (step && !step->isConstant()) || (first && !first->isConstant()))
      return std::nullopt;
    const double depth = std::fabs(first ? first->value() : step->value());
    return FirstPeck{approach + sign * depth, depth};
  }

  /// Depths of the passes, one below the other. Without a known step only the last one.
  void peck(const Interval &approach, const Interval &bottom) {
    const bool known = approach.isConstant() && bottom.isConstant();
    const double end = known ? bottom.value() : 0;
    const double sign = known && end < approach.value() ? -1 : 1;
    const auto first = known ? firstPeck(approach.value(), sign) : std::nullopt;
    if (!first)
      return toLevel(MoveKind::Linear, bottom);
    double level = first->level, length = first->depth;
    const double slack = executed_.dialect.drilling.pecksExactly ? 0 : tolerance;
    for (unsigned pass = 0; pass < mostSteps && length > tolerance; ++pass) {
      if ((end - level) * sign <= slack)
        break;
      toLevel(MoveKind::Linear, Interval::exactly(level));
      lift(approach, level, sign);
      length = nextPeck(length);
      level += sign * length;
    }
    toLevel(MoveKind::Linear, bottom);
  }
  /// Between two passes: out of the hole and back to a little above the bottom, or only a little
  /// up.
  void lift(const Interval &approach, double level, double sign) {
    const auto word = words_.value(Role::PeckClearance);
    const auto clearance = word ? word : parameters_.length(Measure::Retract);
    const Interval above =
        clearance ? Interval::exactly(level) + *clearance * -sign : Interval::unknown();
    if (cycle_.cycle == CycleKind::Peck && !liftsOnly()) {
      toLevel(MoveKind::Rapid, approach);
      if (const auto time = parameters_.number(Measure::DwellTop);
          time && *time != Interval::exactly(0))
        stay(*time);
    }
    toLevel(MoveKind::Rapid, above);
  }
  /// The cycle's method says that the chip is broken only.
  bool liftsOnly() const {
    if (const auto breaks = parameters_.number(Measure::ChipBreak))
      return *breaks != Interval::exactly(0);
    const auto method = words_.value(Role::Method);
    return method && method->isConstant() && method->value() == 1;
  }
  /// Zero when it is not known.
  double nextPeck(double length) const {
    const auto step = words_.value(Role::Peck);
    const auto measure = parameters_.length(Measure::Reduction),
               least = words_.value(Role::PeckLeast);
    const auto by = measure ? measure : words_.value(Role::PeckStep);
    if (by && !by->isConstant())
      return 0;
    if (by) { // less by so much, down to the least one, or to so much itself
      const double smaller = std::fabs(by->value());
      return std::max(length - smaller, least && least->isConstant() ? least->value() : smaller);
    }
    const bool afterFirst = words_.value(Role::PeckFirst).has_value();
    return afterFirst && step && step->isConstant() ? std::fabs(step->value()) : length;
  }

  const CycleParameters parameters_;
  const Axis tool_;
};

} // namespace

void appendDrillingMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                         llvm::SmallVectorImpl<Move> &moves) {
  DrillingMoves(executed, cycle, moves).run();
}

} // namespace ncvet
