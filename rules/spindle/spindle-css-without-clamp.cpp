// Constant surface speed without a limit of the spindle's speed.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class SpindleCssWithoutClamp final : public Rule {
public:
  void listen(Subscriptions &to) override {
    // A control that has no such limit cannot be asked for one.
    limit_ = "";
    for (const CodeInfo &code : to.dialect().codes)
      if (code.action == Action::SpeedLimit && limit_.empty())
        limit_ = code.name;
    if (!limit_.empty() || to.dialect().speedLimitWords)
      to.onAction({Action::SurfaceSpeed});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &state = ctx.after();
    if (state.must(Fact::SpeedLimitSet) ||
        (state.may(Fact::SpeedLimitSet) && state.may(Fact::UnknownCode)))
      return;
    // Reported where the mode is switched on, not where it is said again.
    if (ctx.before().activeAction(ctx.dialect(), StandardGroup::SpeedMode) == Action::SurfaceSpeed)
      return;
    const bool certain = !state.may(Fact::SpeedLimitSet) && !state.may(Fact::UnknownCode);
    if (auto finding = ctx.report(event, certain)) {
      finding.message(
          "`{0}` without a speed limit: near the centre the spindle runs up to its maximum",
          ctx.code(event).name);
      if (const auto most = ctx.machine().spindleMax; most && !limit_.empty()) {
        const std::string block = llvm::formatv("{0} S{1:f0}", limit_, *most).str();
        finding.fix(FixSafety::Unsafe, "insert `" + block + "` before this block",
                    ctx.insertBlockBefore(block));
      }
    }
  }

private:
  std::string limit_;
};

} // namespace
NCVET_RULE(SpindleCssWithoutClamp, spindle_css_without_clamp)
} // namespace ncvet
