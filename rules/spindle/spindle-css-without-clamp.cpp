// Constant surface speed without a limit of the spindle's speed.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/wanted_blocks.h"
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class SpindleCssWithoutClamp final : public Rule {
public:
  void listen(Subscriptions &to) override {
    // A control that has no such limit cannot be asked for one.
    limit_ = "";
    limitFollows_ = to.flag("limitFollows");
    for (const CodeInfo &code : to.dialect().codes)
      if (code.action == Action::SpeedLimit && limit_.empty())
        limit_ = code.name;
    for (const std::string &name : to.dialect().facts->spindle.limitVariables)
      variables_.push_back(variableKey(name));
    if (!limit_.empty() || to.dialect().speedLimitWords)
      to.onAction({Action::SurfaceSpeed});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &state = ctx.after();
    if (state.must(Fact::SpeedLimitSet) ||
        (state.may(Fact::SpeedLimitSet) && state.may(Fact::UnknownCode)))
      return;
    for (const uint64_t variable : variables_)
      if (state.commons.given(variable) != Truth::No)
        return;
    // Reported where the mode is switched on, not where it is said again.
    if (ctx.before().activeAction(ctx.dialect(), StandardGroup::SpeedMode) == Action::SurfaceSpeed)
      return;
    if (limitFollows_ && comesAtOnce(ctx))
      return;
    const bool certain = !state.may(Fact::SpeedLimitSet) && !state.may(Fact::UnknownCode);
    if (auto finding = ctx.report(event, certain)) {
      if (limitFollows_ && isLimitedLater(ctx))
        finding.severity(Severity::Warning);
      finding.message(
          "`{0}` without a speed limit: near the centre the spindle runs up to its maximum",
          ctx.code(event).name);
      if (const auto most = ctx.machine().spindleMax; most && !limit_.empty()) {
        const std::string block = formatted("{0} S{1:f0}", limit_, *most);
        finding.fix(FixSafety::Unsafe, "insert `" + block + "` before this block",
                    ctx.insertBlockBefore(block));
      }
    }
  }

private:
  static bool limits(const Block &block, const RuleContext &ctx) {
    return block.has(letterAddress('S')) &&
           findReading(ctx.dialect(), block,
                       [](const CodeInfo &code) { return code.action == Action::SpeedLimit; });
  }

  /// The program limits the speed for one of its later tools: no setting of the machine does it.
  static bool isLimitedLater(const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &block :
         blocksWith(ctx.index(), program, maskOf(letterAddress('S')), ctx.block().next))
      if (limits(block, ctx))
        return true;
    return false;
  }

  /// The limit is in one of the next blocks, and nothing moves before it.
  static bool comesAtOnce(const RuleContext &ctx) {
    constexpr unsigned furthest = 3; // blocks
    return comesInTime(
        ctx, furthest, [&](const Block &next) { return limits(next, ctx); },
        [&](const Block &next) { return namesAxes(ctx.dialect(), next); });
  }

  std::string limit_;
  bool limitFollows_ = false;                ///< the limit may come in one of the next blocks
  llvm::SmallVector<uint64_t, 2> variables_; ///< keys of those that hold a limit
};

} // namespace
NCVET_RULE(SpindleCssWithoutClamp, spindle_css_without_clamp)
} // namespace ncvet
