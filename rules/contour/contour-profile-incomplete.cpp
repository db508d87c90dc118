// A contour that has a start and no element, or that nothing mills along.
#include "analyzer/rule/switch_left_on.h"

namespace ncvet {
namespace {

class ContourProfileIncomplete final : public LeftOnRule {
public:
  ContourProfileIncomplete() : LeftOnRule("contour-profile-incomplete") {}

  void listen(Subscriptions &to) override {
    LeftOnRule::listen(to);
    to.on(EventKind::Return);
    to.onCode([this](const CodeInfo &code) {
      records_ |= code.action == Action::ProfileBegin;
      return code.action == Action::ProfileBegin || code.action == Action::ProfileRun;
    });
    feeds_ = to.option("withoutPiece", 0) != 0;
    if (feeds_)
      to.onAction({Action::CompensationOff});
    if (records_)
      to.on(EventKind::Motion);
  }

  void on(const Event &event, RuleContext &ctx) override {
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
    // What the profile's program calls gives pieces of it: the profile goes on behind the call.
    if (begun_ && ctx.before().profile == 1 && ctx.callDepth() > depth_ + 1)
      return;
    if (records_ && ctx.before().profile == 1 && pieces_ && !attached_ &&
        !ctx.before().may(Fact::UnknownCode)) {
      attached_ = true; // said once
      if (auto finding = ctx.report(event))
        finding.message("this recorded profile has no attach: it begins with a compensation code, "
                        "and ends with the one that takes it off");
    }
    if (records_)
      leftAttached(event, ctx);
    if (!ctx.before().must(Fact::InContour) || ctx.before().may(Fact::Cut))
      return;
    if (auto finding = ctx.report(event))
      finding.message("the contour ends here without an element behind its start: there is nothing "
                      "to mill along");
  }
  void remember(RuleMemory &memory) const override {
    memory(begun_, attached_, detached_, pieces_, depth_, begin_);
  }

private:
  /// A piece of a profile that is recorded.
  void record(const Event &event, RuleContext &ctx) {
    if (ctx.before().profile != 1 || !event.axes)
      return;
    ++pieces_;
    attached_ |= ctx.before().compensation != phaseOff || ctx.after().compensation != phaseOff;
  }

  /// What is attached to a recorded profile is taken off at its end.
  void leftAttached(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    // The last block may take it off and return.
    if (before.profile != 1 || !pieces_ || before.compensation != phaseOn ||
        ctx.after().compensation != phaseOn || before.may(Fact::UnknownCode) || detached_)
      return;
    detached_ = true; // said once
    if (auto finding = ctx.report(event))
      finding.message("this recorded profile has no detach: what a compensation code has attached "
                      "is taken off at its end");
  }

  void atCode(const Event &event, RuleContext &ctx) {
    const Action action = ctx.code(event).action;
    if (action == Action::CompensationOff)
      return withoutPiece(event, ctx);
    if (begun_)
      leftAttached(event, ctx);
    if (begun_ && ctx.before().profile == 1 && !pieces_ && ctx.callDepth() == depth_ &&
        !ctx.before().may(Fact::UnknownCode))
      if (auto finding = ctx.report(event))
        finding
            .message("no profile stands between `{0}` and `{1}`", ctx.text(begin_),
                     ctx.text(*event.word))
            .note(begin_, "the profile would begin here");
    begun_ = action == Action::ProfileBegin;
    begin_ = ctx.range(*event.word);
    depth_ = ctx.callDepth();
    pieces_ = 0;
    attached_ = detached_ = false;
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

  bool records_ = false;  ///< the control records profiles that a later code runs
  bool feeds_ = false;    ///< compensation without a contour is looked at
  bool begun_ = false;    ///< a profile is being recorded
  bool attached_ = false; ///< one of its moves is compensated
  bool detached_ = false; ///< it was said that nothing takes the compensation off
  unsigned pieces_ = 0;
  unsigned depth_ = 0; ///< calls around the code that begins it
  SourceRange begin_;
};

} // namespace
NCVET_RULE(ContourProfileIncomplete, contour_profile_incomplete)
} // namespace ncvet
