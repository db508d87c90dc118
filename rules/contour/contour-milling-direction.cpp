// Contours to look at again: conventional milling, and arcs that a drawing shows mirrored.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class ContourMillingDirection final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().isLathe())
      to.on({EventKind::Motion, EventKind::CompensationMove});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || !event.certain)
      return;
    if (event.kind == EventKind::Motion)
      return seenFrom(event, ctx);
    side(event, ctx);
    sideSeenFrom(event, ctx);
  }

private:
  /// The tool's side and the spindle's direction tell climb from conventional milling.
  static void side(const Event &event, RuleContext &ctx) {
    const Action action = ctx.code(event).action;
    const uint8_t spindle = ctx.after().spindle;
    const bool conventional = (action == Action::CompensationRight && spindle == spindleCw) ||
                              (action == Action::CompensationLeft && spindle == spindleCcw);
    if (!conventional)
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message("`{0}` with this direction of the spindle is conventional milling: each tooth "
                   "begins at the finished surface",
                   ctx.code(event).name)
          .note(ctx.after().origin.of(StatePart::Spindle), "the spindle is switched on here");
  }

  /// So is the side of the path.
  static void sideSeenFrom(const Event &event, RuleContext &ctx) {
    const Action action = ctx.code(event).action;
    const CodeUse *use = ctx.find({Action::CompensationLeft, Action::CompensationRight});
    if ((action != Action::CompensationLeft && action != Action::CompensationRight) ||
        ctx.after().activeAction(ctx.dialect(), StandardGroup::Plane) != Action::PlaneZX)
      return;
    if (auto finding = use ? ctx.report(*use->word) : ctx.report(event))
      finding.message("`{0}` in the ZX plane is seen from +Y: a drawing with X to the right shows "
                      "the tool on the other side",
                      ctx.code(event).name);
  }

  /// Arcs of ZX are seen along Y from its positive end: Z points up and X to the left there.
  static void seenFrom(const Event &event, RuleContext &ctx) {
    if (!isArc(event.motion) ||
        ctx.after().activeAction(ctx.dialect(), StandardGroup::Plane) != Action::PlaneZX)
      return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}` in the ZX plane is seen from +Y: a drawing with X to the right shows "
                      "this arc turning the other way",
                      ctx.code(event).name);
  }
};

} // namespace
NCVET_RULE(ContourMillingDirection, contour_milling_direction)
} // namespace ncvet
