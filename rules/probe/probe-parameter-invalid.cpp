// A measuring cycle with values that it cannot work with.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ProbeParameterInvalid final : public Rule {
public:
  /// The tables say the rest; what they say is reported for it.
  void listen(Subscriptions &to) override {
    for (const CodeInfo &code : to.dialect().codes)
      if (isEnd(code, to.dialect()))
        ends_ = true;
    if (!ends_)
      return;
    to.onCode([&](const CodeInfo &code) { return isEnd(code, to.dialect()); });
    to.onMoves({MotionKind::Feed, MotionKind::ArcCw, MotionKind::ArcCcw});
  }

  /// Behind the series the feed of measuring may still be in force.
  void on(const Event &event, RuleContext &ctx) override {
    const Origin &feed = ctx.after().origin.of(StatePart::Feed);
    if (event.kind == EventKind::Code) {
      end_ = ctx.range(*event.word);
      feed_ = feed;
      return;
    }
    if (!end_.end || event.code == noCode || event.number || ctx.block().begin < end_.begin)
      return;
    if (feed.known() && feed.begin == feed_.begin && feed.file == feed_.file &&
        !ctx.block().has(letterAddress('F')) && !ctx.before().may(Fact::UnknownCode))
      if (auto finding = ctx.report(ctx.blockRange()))
        finding.severity(Severity::Warning)
            .message("this move feeds with an F from before the end of measuring: what holds "
                     "behind it is not stated")
            .note(end_, "the series ends here");
    end_ = {};
  }
  void remember(RuleMemory &memory) const override { memory(end_, feed_); }

private:
  /// A code that ends a series of measurements.
  static bool isEnd(const CodeInfo &code, const Dialect &dialect) {
    return code.effect.index < dialect.switches.size() && !code.effect.on &&
           dialect.switches[code.effect.index].leftOn == "probe-series-unbalanced";
  }

  bool ends_ = false;
  SourceRange end_; ///< of the series; used up by the next feed move
  Origin feed_;     ///< the feed of that moment
};

} // namespace
NCVET_RULE(ProbeParameterInvalid, probe_parameter_invalid)
} // namespace ncvet
