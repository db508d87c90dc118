// A rapid move in the plane while the tool is still at cutting depth.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/length_text.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/measuring_tool.h"
#include "analyzer/facts/turned_shape.h"
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"
#include "interp/geometry/obstacle.h"

#include <array>
#include <cmath>

namespace ncvet {
namespace {

class MotionRapidTraverseAtDepth final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onMoves({MotionKind::Rapid});
    leaves_ = to.dialect().facts->compensation.exitByRapid;
    turns_ = to.dialect().facts->coordinates.turnsMoveAlongWork;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.inMachineCoordinates() || !event.certain)
      return;
    if (ctx.dialect().isLathe() || turnsWork(ctx.dialect(), ctx.after()))
      return alongTurned(event, ctx);
    const MachineState &before = ctx.before(), &after = ctx.after();
    constexpr Axis tool = Axis::Z; // arcs in G18 and G19 do not turn the spindle
    constexpr uint16_t plane = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y);
    constexpr uint16_t rotary =
        1u << unsigned(Axis::A) | 1u << unsigned(Axis::B) | 1u << unsigned(Axis::C);
    // In a plane of a rotary axis the turn is a move along the developed work.
    if (turns_ && (event.axes & rotary & ~planeAxes(ctx.dialect(), after)) &&
        before.must(Fact::CutSinceTool) && !before.may(Fact::AwayFromPart) &&
        !before.may(Fact::UnknownCode))
      if (auto finding = ctx.report(event))
        finding.message("a rotary axis turns at rapid after a cut: the tool was not taken away "
                        "in between");
    if (!(event.axes & plane) || staysInPlane(before, after))
      return;
    if (throughObstacle(event, ctx) || (leaves_ && ctx.find({Action::CompensationOff})) ||
        !before.fedFrom.get().isConstant())
      return;
    const Interval &from = before.at(tool), &to = after.at(tool);
    const double level = before.fedFrom.get().value();
    // Down in the work at both ends of the move.
    if (!from.isConstant() || !to.isConstant() || from.value() >= level || to.value() >= level)
      return;
    // After a cut, or lifted from it by too little.
    if (before.must(Fact::AwayFromPart) && (to.value() >= 0 || staysWhereItHasCut(after)))
      return;
    // It touches, and cuts nothing; or a post-processor feeds it on the way up.
    if (toolMeasures(ctx, measuring_) || liftsOff(before, after) ||
        (from.value() > 0 && roseByFeed(ctx)))
      return;
    if (auto finding = ctx.report(event, before.is(Fact::AwayFromPart) != Truth::Unknown)) {
      finding.message("rapid in the plane at depth {0}: the tool was fed in from {1}",
                      placeText(ctx, from.value()), placeText(ctx, level));
      if (comesFromCall(ctx) || isWithinContour(ctx) || isFedToSameDepth(ctx))
        finding.severity(Severity::Warning);
    }
  }

private:
  /// A tool with one edge is taken off the wall of its bore, with the spindle oriented.
  static bool liftsOff(const MachineState &before, const MachineState &after) {
    constexpr uint8_t turning = spindleCw | spindleCcw;
    constexpr double far = 2; // mm
    const double x = after.at(Axis::X).lo - before.at(Axis::X).lo,
                 y = after.at(Axis::Y).lo - before.at(Axis::Y).lo;
    return !(before.spindle & turning) && before.at(Axis::X).isConstant() &&
           before.at(Axis::Y).isConstant() && after.at(Axis::X).isConstant() &&
           after.at(Axis::Y).isConstant() && x * x + y * y <= far * far;
  }

  /// The work turns: along Z out of a groove, or on along the contour with the nose compensated.
  void alongTurned(const Event &event, RuleContext &ctx) const {
    constexpr uint16_t z = 1u << unsigned(Axis::Z);
    if (!(event.axes & z) || ctx.before().profile != ProfileMode::Off ||
        ctx.before().is(Fact::AwayFromPart) != Truth::No || ctx.before().may(Fact::UnknownCode))
      return;
    if (isWithinTurned(ctx)) {
      if (auto finding = ctx.report(event))
        finding.severity(Severity::Warning)
            .message("this rapid move is inside of a compensated contour, which goes on with a cut "
                     "after it: the tool goes along the work at full speed");
      return;
    }
    if (event.axes != z || !rapidOutOfGroove(shapes_, ctx))
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("the tool goes along Z at rapid from the bottom of a groove: it was not taken "
                   "out in X, and goes through the wall");
  }

  /// Towards the chuck at rapid after a cut, and the next cut follows without a way back.
  static bool isWithinTurned(const RuleContext &ctx) {
    constexpr unsigned furthest = 3; // blocks
    const MachineState &before = ctx.before(), &after = ctx.after();
    const auto move = turnedMove(ctx);
    if (!move || before.compensation != phaseOn || after.compensation != phaseOn ||
        move->toZ >= move->fromZ)
      return false;
    const bool outside =
        after.activeAction(ctx.dialect(), StandardGroup::Compensation) == Action::CompensationRight;
    double x = move->toX;
    if (outside ? x < move->fromX : x > move->fromX)
      return false;
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < furthest && ahead.next(next); ++i) {
      const Word *const word = next.find(letterAddress('X')), *const z =
                                                                  next.find(letterAddress('Z'));
      if (!next.items.empty() || next.hasAny(ctx.dialect().incrementWords) ||
          next.has(letterAddress('T')) || (word && !word->isNumber()) || (z && !z->isNumber()) ||
          (word && (outside ? word->value() < x : word->value() > x)) ||
          (z && z->value() > move->toZ) ||
          findCode(ctx.dialect(), next,
                   {Action::CompensationOff, Action::MachineMove, Action::ReferenceReturn,
                    Action::Cycle, Action::Incremental}))
        return false;
      x = word ? word->value() : x;
      if (findCode(ctx.dialect(), next, {Action::Linear, Action::ArcCw, Action::ArcCcw}))
        return word || z;
    }
    return false;
  }

  /// Radius compensation is on, and the next move goes on along the contour: G00 for G01.
  static bool isWithinContour(const RuleContext &ctx) {
    constexpr uint16_t plane = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y);
    if (ctx.before().compensation != phaseOn || ctx.after().compensation != phaseOn ||
        ctx.before().is(Fact::AwayFromPart) != Truth::No)
      return false;
    BlocksAhead ahead(ctx);
    Block next;
    return ahead.next(next) && (axesOf(ctx.dialect(), next) & plane) &&
           !(axesOf(ctx.dialect(), next) >> unsigned(Axis::Z) & 1) &&
           !findCode(ctx.dialect(), next, {Action::CompensationOff}) &&
           findCode(ctx.dialect(), next, {Action::Linear, Action::ArcCw, Action::ArcCcw});
  }

  /// The tool is then fed along Z to where it is already: the program takes it to be up, and its
  /// retract is missing.
  static bool isFedToSameDepth(const RuleContext &ctx) {
    constexpr unsigned furthest = 3; // blocks
    const MachineState &after = ctx.after();
    const Interval &depth = after.at(Axis::Z);
    const auto unit = millimetresPer(ctx.dialect(), after);
    if (!unit || !depth.isConstant() || depth.value() >= 0 || staysWhereItHasCut(after) ||
        !after.frames.empty() ||
        after.isActive(ctx.dialect(), StandardGroup::Distance, {Action::Absolute}) != Truth::Yes)
      return false;
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < furthest && ahead.next(next); ++i)
      if (const Word *const z = next.find(letterAddress('Z')))
        return z->isNumber() && std::fabs(z->value() * *unit - depth.value()) < 1e-6 &&
               axesOf(ctx.dialect(), next) == 1u << unsigned(Axis::Z) &&
               findCode(ctx.dialect(), next, {Action::Linear});
    return false;
  }

  /// The block before leads up along Z by a feed move.
  static bool roseByFeed(const RuleContext &ctx) {
    constexpr uint16_t alongZ = 1u << unsigned(Axis::Z);
    constexpr unsigned furthest = 8; // blocks
    Block block;
    if (!readPrevious(ctx, block) || axesOf(ctx.dialect(), block) != alongZ)
      return false;
    const Word *const to = block.find(letterAddress('Z'));
    if (!to || !to->isNumber())
      return false;
    const double height = to->value();
    for (unsigned i = 0; i < furthest && readBack(ctx, block); ++i)
      if (const Word *const from = block.find(letterAddress('Z')))
        return from->isNumber() && from->value() < height;
    return false;
  }

  /// A called program has left the tool down there, and the move leads out of what it has cut.
  static bool comesFromCall(const RuleContext &ctx) {
    Block block;
    return readPrevious(ctx, block) && findCode(ctx.dialect(), block, {Action::CallProgram}) &&
           ctx.before().is(Fact::AwayFromPart) == Truth::No && !staysWhereItHasCut(ctx.after());
  }

  /// Through a clamp, or through stock into which nothing has cut yet. A path that leads down is
  /// another rule's.
  static bool throughObstacle(const Event &event, RuleContext &ctx) {
    const MachineProfile &machine = ctx.machine();
    const MachineState &before = ctx.before(), &after = ctx.after();
    if ((machine.clamps.empty() && !machine.stock) || !after.frames.empty() || before.machineAxes ||
        after.machineAxes || before.may(Fact::UnknownCode) ||
        after.at(Axis::Z).hi < before.at(Axis::Z).lo)
      return false;
    const bool clamp = llvm::any_of(machine.clamps, [&](const Stock &box) {
      return leadsThrough(box, before.position, after.position) == Truth::Yes;
    });
    const bool stock = machine.stock && !before.may(Fact::Cut) && ctx.callDepth() == 0 &&
                       leadsThrough(*machine.stock, before.position, after.position) == Truth::Yes;
    if (!clamp && !stock)
      return false;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Error)
          .message(clamp ? "rapid in the plane through a clamp of the machine profile"
                         : "rapid in the plane through the stock: nothing has been cut yet");
    return true;
  }

  /// The move ends inside the box of what this tool has cut, or it is not known.
  static bool staysWhereItHasCut(const MachineState &after) {
    constexpr double beside = 1; // mm
    const auto cut = after.cutArea.get();
    return llvm::all_of(std::array{0, 1}, [&](int axis) {
      const Interval &area = cut[axis], &to = after.position[axis];
      return !area.isBounded() || !to.isConstant() ||
             (to.value() >= area.lo - beside && to.value() <= area.hi + beside);
    });
  }

  /// The tool is there already: post-processors repeat the point at which the next pass begins.
  static bool staysInPlane(const MachineState &before, const MachineState &after) {
    return llvm::all_of(std::array{Axis::X, Axis::Y}, [&](Axis axis) {
      const Interval &from = before.at(axis), &to = after.at(axis);
      return from.isConstant() && to.isConstant() && from.value() == to.value();
    });
  }

  TurnedShapes shapes_;
  MeasuringTools measuring_;
  bool leaves_ = false; ///< a contour is left at rapid
  bool turns_ = false;  ///< turns of rotary axes are looked at
};

} // namespace
NCVET_RULE(MotionRapidTraverseAtDepth, motion_rapid_traverse_at_depth)
} // namespace ncvet
