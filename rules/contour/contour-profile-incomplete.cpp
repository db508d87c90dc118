// A contour that has a start and no element, or that nothing mills along.
#include "analyzer/left_on.h"

namespace ncvet {
namespace {

class ContourProfileIncomplete final : public LeftOnRule {
public:
  ContourProfileIncomplete() : LeftOnRule("contour-profile-incomplete") {}

  void listen(Subscriptions &to) override {
    LeftOnRule::listen(to);
    to.on(EventKind::Return);
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind != EventKind::Return)
      return LeftOnRule::on(event, ctx);
    if (!ctx.before().must(Fact::InContour) || ctx.before().may(Fact::Cut))
      return;
    if (auto finding = ctx.report(event))
      finding.message("the contour ends here without an element behind its start: there is nothing "
                      "to mill along");
  }
};

} // namespace
NCVET_RULE(ContourProfileIncomplete, contour_profile_incomplete)
} // namespace ncvet
