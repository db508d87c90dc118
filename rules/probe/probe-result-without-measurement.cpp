// A check of the skip signal without a skip move before it.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ProbeResultWithoutMeasurement final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onAction({Action::SkipCheck}); }

  void on(const Event &event, RuleContext &ctx) override {
    if (ctx.before().may(Fact::SkipMoveDone) || ctx.after().may(Fact::SkipMoveDone))
      return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}` asks about the signal of a skip move, and none was made",
                      ctx.text(*event.word));
  }
};

} // namespace
NCVET_RULE(ProbeResultWithoutMeasurement, probe_result_without_measurement)
} // namespace ncvet
