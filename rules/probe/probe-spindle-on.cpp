// The spindle turns while a probe touches.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class ProbeSpindleOn final : public Rule {
public:
  /// The tables say when.
  void listen(Subscriptions &to) override {
    knownSpeed_ = to.flag("knownSpeed");
    to.onNotices(id);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (!knownSpeed_ || ctx.before().speed->isConstant())
      ctx.reportNotices(id, event);
  }

private:
  static constexpr llvm::StringLiteral id{"probe-spindle-on"};
  bool knownSpeed_ = false; ///< a speed that is computed is meant for measuring
};

} // namespace
NCVET_RULE(ProbeSpindleOn, probe_spindle_on)
} // namespace ncvet
