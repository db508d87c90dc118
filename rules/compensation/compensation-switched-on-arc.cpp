// Compensation that an arc has to build up or take away.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class CompensationSwitchedOnArc final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CompensationMove);
    offOnly_ = to.flag("offOnly");
    entryArcs_ = to.dialect().facts->compensation.entryByArc;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || event.by == noCode)
      return;
    const CodeInfo &motion = ctx.dialect().codes[event.by];
    if (!isArc(motion.action) && !isCurve(motion.action))
      return;
    const CodeInfo &code = ctx.code(event);
    const bool off = code.action == Action::CompensationOff;
    if (offOnly_ && !off && !ctx.asked())
      return;
    const CodeUse *arc =
        ctx.find({Action::ArcCw, Action::ArcCcw, Action::CurveThrough, Action::CurveTangent});
    auto finding =
        arc ? ctx.report(*arc->word, event.certain) : ctx.report(ctx.blockRange(), event.certain);
    if (!finding)
      return;
    if (entryArcs_ && !off)
      finding.severity(Severity::Warning)
          .message("compensation is switched on by `{0}` in an arc (`{1}`): the tool's centre, not "
                   "its edge, is at the start of the arc, and the control changes it",
                   code.name, motion.name);
    else
      finding.message(
          "compensation is switched {0} by `{1}` in an arc (`{2}`): the control needs a "
          "straight move for it and stops with an alarm",
          off ? "off" : "on", code.name, motion.name);
    const CodeUse *here =
        ctx.find({Action::CompensationLeft, Action::CompensationRight, Action::CompensationOff});
    if (!here)
      finding.note(ctx.after().originOf(ctx.dialect(), StandardGroup::Compensation),
                   "`" + code.name + "` is read here and waits for a move in the plane");
    if (!arc)
      finding.note(ctx.after().originOf(ctx.dialect(), StandardGroup::Motion),
                   "`" + motion.name + "` becomes active here and is still in force");
  }

private:
  /// An arc that is not given by its centre.
  static bool isCurve(Action action) {
    return action == Action::CurveThrough || action == Action::CurveTangent;
  }

  bool offOnly_ = false;   ///< an arc may build compensation up, and nothing changes it
  bool entryArcs_ = false; ///< an arc may build compensation up
};

} // namespace
NCVET_RULE(CompensationSwitchedOnArc, compensation_switched_on_arc)
} // namespace ncvet
