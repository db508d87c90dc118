// A return from the reference point has no intermediate point to pass.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class MotionReferenceViaPoint final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onAction({Action::ReferenceFrom}); }

  void on(const Event &event, RuleContext &ctx) const override {
    if (ctx.before().must(Fact::ReferenceReturned))
      return;
    if (auto finding = ctx.report(event, !ctx.before().may(Fact::ReferenceReturned)))
      finding.message("`{0}` goes by the point that a reference return stored, and none was made",
                      ctx.text(*event.word));
  }
};

} // namespace
NCVET_RULE(MotionReferenceViaPoint, motion_reference_via_point)
} // namespace ncvet
