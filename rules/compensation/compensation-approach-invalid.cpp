// Corner and vector codes of compensation (G38, G39) where they cannot work.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct CompensationApproachInvalidMemory {
  SourceRange approach; ///< the last soft one that no retract has answered
};

class CompensationApproachInvalid final : public StatefulRule<CompensationApproachInvalidMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onAction({Action::CompensationKeep, Action::CompensationCorner, Action::CompensationOff,
                 Action::SoftApproach, Action::SoftRetract});
    to.onNotices(id);
    elements_ = to.dialect().facts->compensation.approachByElement;
    if (elements_)
      to.onAction({Action::CompensationLeft, Action::CompensationRight});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const CodeInfo &code = ctx.code(event);
    ctx.reportNotices(id, event);
    pairs(event, code, ctx);
    if (elements_ &&
        (code.action == Action::CompensationLeft || code.action == Action::CompensationRight))
      return normal(event, ctx);
    if (code.action != Action::CompensationKeep && code.action != Action::CompensationCorner)
      return;
    const Truth active = ctx.after().compensationActive(ctx.dialect());
    if (active == Truth::No) {
      if (auto finding = ctx.report(event, !ctx.after().may(Fact::UnknownCode)))
        finding.message("`{0}` without radius compensation: the control stops with an alarm",
                        code.name);
      return;
    }
    if (code.action == Action::CompensationKeep)
      keep(code, event, ctx);
    else
      corner(code, event, ctx);
  }

private:
  static constexpr llvm::StringLiteral id{"compensation-approach-invalid"};

  /// What the tool has approached softly it leaves softly as well.
  void pairs(const Event &event, const CodeInfo &code, RuleContext &ctx) const {
    if (code.action == Action::SoftApproach) {
      memory().approach = ctx.range(*event.word);
    } else if (code.action == Action::SoftRetract) {
      memory().approach = {};
    } else if (code.action == Action::CompensationOff && memory().approach.end) {
      const bool leaves = llvm::any_of(ctx.codes(), [&](const CodeUse &use) {
        return ctx.code(use).action == Action::SoftRetract;
      });
      if (!leaves && !ctx.before().may(Fact::UnknownCode) &&
          ctx.before().compensationActive(ctx.dialect()) == Truth::Yes)
        if (auto finding = ctx.report(event))
          finding.severity(Severity::Warning)
              .message(
                  "`{0}` ends a contour that was approached softly, and no soft retract leaves "
                  "it: the tool marks the part here",
                  code.name)
              .note(memory().approach, "the approach");
      memory().approach = {};
    }
  }

  /// `G41 K`: the approach is normal to the element that the next block gives.
  static void normal(const Event &event, RuleContext &ctx) {
    const Word *flag = nullptr;
    for (const Word &word : ctx.block().words)
      if (word.has(wordNoValue) && word.offset > event.word->offset &&
          ctx.dialect().addresses[word.address].kind == AddressKind::Parameter)
        flag = &word;
    if (!flag || axesOf(ctx.dialect(), ctx.block()) ||
        ctx.block().hasAny(ctx.dialect().elementWords))
      return;
    BlocksAhead ahead(ctx);
    Block next;
    const bool more = ahead.next(next);
    if ((!more && !ahead.isOver()) ||
        (more && (next.hasAny(ctx.dialect().elementWords | ctx.dialect().lineAngleWords |
                              lettersMask("IJR")) ||
                  !next.items.empty())))
      return;
    const bool point = more && next.hasAny(ctx.dialect().axisWords);
    if (auto finding = ctx.report(event))
      finding.message(point ? "`{0} {1}` approaches an element, and the next block gives a point "
                              "only: the direction to it is not told"
                            : "`{0} {1}` approaches an element, and the next block gives none",
                      ctx.code(event).name, ctx.text(*flag));
  }

  bool elements_ = false; ///< a bare word asks for an element after it
  static void keep(const CodeInfo &code, const Event &event, RuleContext &ctx) {
    const CodeInfo *motion = ctx.after().activeCode(ctx.dialect(), StandardGroup::Motion);
    if (!motion || !isArc(motion->action))
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` under `{1}`: the vector can be kept on straight moves only, the control "
                   "stops with an alarm",
                   code.name, motion->name)
          .note(ctx.after().originOf(ctx.dialect(), StandardGroup::Motion),
                "`" + motion->name + "` becomes active here");
  }

  static void corner(const CodeInfo &code, const Event &event, RuleContext &ctx) {
    const AddressMask own = lettersMask("GIJK");
    for (const Word &word : ctx.block().words) {
      const bool foreign = !(own & maskOf(word.address)) ||
                           (word.address == letterAddress('G') && &word != event.word);
      if (!foreign)
        continue;
      if (auto finding = ctx.report(event))
        finding.message("`{0}` needs its own block, with I, J and K only; here it is with "
                        "`{1}`",
                        code.name, ctx.text(word));
      return;
    }
  }
};

} // namespace
NCVET_RULE(CompensationApproachInvalid, compensation_approach_invalid)
} // namespace ncvet
