// A chamfer or rounding where the control does not allow one.
#include "analyzer/facts/corner_words.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class ContourCornerNotAllowed final : public Rule {
public:
  void listen(Subscriptions &to) override {
    corners_ = cornerAddresses(to.dialect());
    axisParallel_ = to.dialect().facts->corners.axisParallel;
    between_ = to.dialect().facts->corners.idleBlocksBetween ? blocksBetweenMoves : 0;
    plainInRapid_ = to.flag("plainInRapid", true);
    if (corners_.corner())
      to.onChange({EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const Block &block = ctx.block();
    const Word *word = block.findAny(corners_.corner());
    if (!word)
      return sleepInShape();
    const bool plain = corners_.plain & maskOf(word->address);
    if (plain && event.motion != MotionKind::Feed && event.motion != MotionKind::Rapid)
      return sleepInShape();
    if (!event.certain || event.inMachineCoordinates() ||
        ctx.before().profile == ProfileMode::Recorded || !asksForCorner(ctx, *word))
      return;
    if (event.motion == MotionKind::Rapid) {
      if (takenByOther(ctx, maskOf(word->address)) || (plain && !plainInRapid_))
        return;
      if (auto finding = ctx.report(*word))
        finding.message("`{0}` asks for a corner in a rapid move: corners lie between feed moves",
                        ctx.text(*word));
      return;
    }
    if (plain) {
      if (event.motion == MotionKind::Feed && !takenByOther(ctx, corners_.plain))
        plainCorner(event, *word, ctx);
      return;
    }
    commaCorner(event, *word, ctx);
  }

private:
  /// Plain letters: between two moves along X and along Z, one after the other.
  void plainCorner(const Event &event, const Word &word, RuleContext &ctx) const {
    constexpr uint16_t x = 1u << unsigned(Axis::X), z = 1u << unsigned(Axis::Z);
    const uint16_t axes = event.axes & (x | z);
    // With an angle the block is a line by angle, which may be anything.
    if (ctx.block().hasAny(corners_.angle))
      return;
    if (axes == (x | z)) {
      if (!axisParallel_)
        return;
      if (auto finding = ctx.report(word))
        finding.message(
            "`{0}` asks for a corner at the end of a slanting line: both moves have to run "
            "along one axis",
            ctx.text(word));
      return;
    }
    const uint16_t plane = ctx.after().active(ctx.dialect(), StandardGroup::Plane) == groupUnset
                               ? x | z
                               : planeAxes(ctx.dialect(), ctx.after());
    if (axes && !(axes & plane)) {
      outsidePlane(word, ctx);
      return;
    }
    BlocksAhead ahead(ctx);
    Block next;
    bool passed = false;
    if (!readNeighbour(ctx, ahead, next, between_, passed))
      return;
    const uint16_t then = axesOf(ctx, next) & (x | z);
    if (passed && !(then & plane))
      return; // another rule says that no move follows
    if (then == 0 || hasOtherAction(ctx, next) || statesPlane(ctx, next))
      return;
    if (findCode(ctx.dialect(), next, {Action::Rapid})) {
      if (auto finding = ctx.report(word))
        finding.message(
            "`{0}` asks for a corner before a rapid move: corners lie between feed moves",
            ctx.text(word));
      return;
    }
    if (!(then & plane)) {
      leavesPlane(word, ctx);
      return;
    }
    if (then != axes && (then != (x | z) || !axisParallel_))
      return;
    if (auto finding = ctx.report(word))
      finding
          .message(then == axes
                       ? "`{0}` asks for a corner, but the next move goes on along the same axis"
                       : "`{0}` asks for a corner before a slanting line: both moves have to "
                         "run along one axis",
                   ctx.text(word))
          .note(ahead.range(next), "the next move");
  }

  /// `,R` and `,C`: between two feed moves in the selected plane.
  void commaCorner(const Event &event, const Word &word, RuleContext &ctx) const {
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    constexpr uint16_t linear =
        1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y) | 1u << unsigned(Axis::Z);
    if ((event.axes & linear) && !(event.axes & plane) &&
        ctx.after().active(ctx.dialect(), StandardGroup::Plane) != groupUnset) {
      outsidePlane(word, ctx);
      return;
    }
    BlocksAhead ahead(ctx);
    Block next;
    bool passed = false;
    if (!readNeighbour(ctx, ahead, next, blocksBetweenMoves, passed))
      return;
    if (passed && axesOf(ctx, next) && !(axesOf(ctx, next) & plane))
      return; // another rule says that no move follows in the plane
    const CodeInfo *arc = findCode(ctx.dialect(), next, {Action::ArcCw, Action::ArcCcw});
    if (ctx.dialect().addresses[word.address].linesOnly && (arc || isArc(event.motion))) {
      if (auto finding = ctx.report(word))
        finding.message("`{0}` asks for a chamfer beside an arc: it lies between two lines",
                        ctx.text(word));
      return;
    }
    const CodeInfo *rapid = findCode(ctx.dialect(), next, {Action::Rapid});
    const CodeInfo *cycle = findCode(ctx.dialect(), next, {Action::Cycle});
    const uint16_t then = axesOf(ctx, next);
    if (rapid && (then & linear)) {
      if (auto finding = ctx.report(word))
        finding.message(
            "`{0}` asks for a corner before a rapid move: corners lie between feed moves",
            ctx.text(word));
      return;
    }
    if (cycle) {
      if (auto finding = ctx.report(word))
        finding.message("`{0}` asks for a corner before `{1}`: corners lie between feed moves",
                        ctx.text(word), cycle->name);
      return;
    }
    if (hasOtherAction(ctx, next) || statesPlane(ctx, next))
      return;
    if ((then & linear) && !(then & plane))
      leavesPlane(word, ctx);
  }

  static void outsidePlane(const Word &word, RuleContext &ctx) {
    if (auto finding = ctx.report(word))
      finding.message("`{0}` asks for a corner in a move outside of the selected plane",
                      ctx.text(word));
  }

  static void leavesPlane(const Word &word, RuleContext &ctx) {
    if (auto finding = ctx.report(word))
      finding.message("`{0}` asks for a corner, but the next move leaves the selected plane",
                      ctx.text(word));
  }

  static bool statesPlane(const RuleContext &ctx, const Block &next) {
    return findCode(ctx.dialect(), next, {Action::PlaneXY, Action::PlaneZX, Action::PlaneYZ});
  }

  /// The axis words of the next block are not those of a move.
  static bool hasOtherAction(const RuleContext &ctx, const Block &next) {
    for (const CodeIndex index : codesOf(ctx.dialect(), next)) {
      const CodeInfo &code = ctx.dialect().codes[index];
      if (code.exclusive || code.action == Action::MachineMove ||
          code.action == Action::ReferenceReturn || code.action == Action::LocalShift ||
          code.action == Action::PresetPosition || code.action == Action::Dwell)
        return true;
    }
    return false;
  }

  CornerAddresses corners_;
  bool plainInRapid_ = true; ///< false: C and R of a rapid move are no corner words
  bool axisParallel_ = false;
  unsigned between_ = 0; ///< blocks without a move that plain corners pass over
};

} // namespace
NCVET_RULE(ContourCornerNotAllowed, contour_corner_not_allowed)
} // namespace ncvet
