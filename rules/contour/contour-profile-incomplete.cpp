// A contour that has a start and no element, or that nothing mills along.
#include "analyzer/rule/switch_left_on.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct ContourProfileIncompleteMemory {
  bool begun = false;    ///< a profile is being recorded
  bool attached = false; ///< one of its moves is compensated
  bool detached = false; ///< it was said that nothing takes the compensation off
  unsigned pieces = 0;
  unsigned depth = 0; ///< calls around the code that begins it
  SourceRange begin;
};

class ContourProfileIncomplete final
    : public StatefulRule<ContourProfileIncompleteMemory, LeftOnRule> {
public:
  ContourProfileIncomplete() : StatefulRule("contour-profile-incomplete") {}

  void listen(Subscriptions &to) override {
    LeftOnRule::listen(to);
    to.on(EventKind::Return);
    to.onCode([this](const CodeInfo &code) {
      records_ |= code.action == Action::ProfileBegin;
      return code.action == Action::ProfileBegin || code.action == Action::ProfileRun;
    });
    feeds_ = to.dialect().facts->compensation.onlyForContours;
    if (feeds_)
      to.onAction({Action::CompensationOff});
    if (records_)
      to.on(EventKind::Motion);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Motion) {
      record(event, ctx);
      return;
    }
    if (event.kind == EventKind::Code) {
      atCode(event, ctx);
      return LeftOnRule::on(event, ctx);
    }
    if (event.kind != EventKind::Return)
      return LeftOnRule::on(event, ctx);
    // What the profile's program calls gives pieces of it: the profile goes on after the call.
    if (memory().begun && ctx.before().profile == ProfileMode::Recorded &&
        ctx.callDepth() > memory().depth + 1)
      return;
    if (records_ && ctx.before().profile == ProfileMode::Recorded && memory().pieces &&
        !memory().attached && !ctx.before().may(Fact::UnknownCode)) {
      memory().attached = true; // said once
      if (auto finding = ctx.report(event))
        finding.message("this recorded profile has no attach: it begins with a compensation code, "
                        "and ends with the one that takes it off");
    }
    if (records_)
      leftAttached(event, ctx);
    if (!ctx.before().must(Fact::InContour) || ctx.before().may(Fact::Cut))
      return;
    if (auto finding = ctx.report(event))
      finding.message("the contour ends here without an element after its start: there is nothing "
                      "to mill along");
  }

private:
  /// A piece of a profile that is recorded.
  void record(const Event &event, RuleContext &ctx) const {
    if (ctx.before().profile != ProfileMode::Recorded || !event.axes)
      return;
    ++memory().pieces;
    memory().attached |=
        ctx.before().compensation != phaseOff || ctx.after().compensation != phaseOff;
  }

  /// What is attached to a recorded profile is taken off at its end.
  void leftAttached(const Event &event, RuleContext &ctx) const {
    const MachineState &before = ctx.before();
    // The last block may take it off and return.
    if (before.profile != ProfileMode::Recorded || !memory().pieces ||
        before.compensation != phaseOn || ctx.after().compensation != phaseOn ||
        before.may(Fact::UnknownCode) || memory().detached)
      return;
    memory().detached = true; // said once
    if (auto finding = ctx.report(event))
      finding.message("this recorded profile has no detach: what a compensation code has attached "
                      "is taken off at its end");
  }

  void atCode(const Event &event, RuleContext &ctx) const {
    const Action action = ctx.code(event).action;
    if (action == Action::CompensationOff)
      return withoutPiece(event, ctx);
    if (memory().begun)
      leftAttached(event, ctx);
    if (memory().begun && ctx.before().profile == ProfileMode::Recorded && !memory().pieces &&
        ctx.callDepth() == memory().depth && !ctx.before().may(Fact::UnknownCode))
      if (auto finding = ctx.report(event))
        finding
            .message("there is no profile between `{0}` and `{1}`", ctx.text(memory().begin),
                     ctx.text(*event.word))
            .note(memory().begin, "the profile would begin here");
    memory().begun = action == Action::ProfileBegin;
    memory().begin = ctx.range(*event.word);
    memory().depth = ctx.callDepth();
    memory().pieces = 0;
    memory().attached = memory().detached = false;
  }

  /// Switched on and off again without a piece of a contour in between.
  static void withoutPiece(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    if (before.compensation != phaseOn || before.may(Fact::CompensatedCut) ||
        before.may(Fact::UnknownCode))
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` takes compensation off before a piece of a contour was made",
                   ctx.code(event).name)
          .note(before.origin.of(StatePart::Compensation), "it is switched on here");
  }

  bool records_ = false; ///< the control records profiles that a later code runs
  bool feeds_ = false;   ///< compensation without a contour is looked at
};

} // namespace
NCVET_RULE(ContourProfileIncomplete, contour_profile_incomplete)
} // namespace ncvet
