// A contour that has a start and no element.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ContourProfileIncomplete final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Return); }

  void on(const Event &event, RuleContext &ctx) override {
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
