// A straight plunge along the tool runs at the feed of the cuts in the plane.
#include "analyzer/rule/rule.h"
#include "formats/text/number_text.h"
#include "interp/state/modes.h"

namespace ncvet {
namespace {

struct FeedPlungeTooFastMemory {
  SourceRange plunge; ///< the last plunge, until the tool moves in the plane
  Interval feed;      ///< its feed
};

class FeedPlungeTooFast final : public StatefulRule<FeedPlungeTooFastMemory> {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().isLathe())
      return;
    top_ = to.machine().stock && to.machine().stock->max[2] ? *to.machine().stock->max[2]
                                                            : to.machine().number("stockTopZ");
    least_ = to.number("least", 0.5);
    to.on(EventKind::Motion);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    constexpr auto along = uint16_t(1u << unsigned(Axis::Z));
    constexpr auto plane = uint16_t(1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y));
    if (event.motion == MotionKind::Feed && event.axes == along && plunges(ctx)) {
      memory().plunge = ctx.blockRange();
      memory().feed = ctx.after().feed.get();
      return;
    }
    const SourceRange plunge = std::exchange(memory().plunge, {});
    const bool cuts = isFeed(event.motion);
    const Interval &feed = ctx.after().feed.get();
    if (!plunge.end || !cuts || !(event.axes & plane) || (event.axes & along) ||
        !feed.isConstant() || feed.value() <= 0 || feed.value() != memory().feed.value())
      return;
    if (auto finding = ctx.report(plunge, event.certain))
      finding
          .message("the tool plunges at F{0}, the feed with which it then cuts sideways",
                   shortNumber(feed.value()))
          .note(ctx.blockRange(), "the cut in the plane");
  }

private:
  /// Whether the move goes straight down into the work with a tool that is not made for it.
  bool plunges(const RuleContext &ctx) const {
    const MachineState &before = ctx.before(), &after = ctx.after();
    const Interval &from = before.at(Axis::Z), &to = after.at(Axis::Z);
    if (!from.isConstant() || !to.isConstant() || after.may(Fact::UnknownCode) ||
        toolAxis(ctx.dialect(), after) != Axis::Z || !after.feed.get().isConstant() ||
        before.inMachineCoordinates(Axis::Z))
      return false;
    const auto tool = ctx.machine().tools.find(after.tool.get());
    const llvm::StringRef kind =
        tool == ctx.machine().tools.end() ? llvm::StringRef() : tool->second.kind;
    return to.value() < top_.value_or(0) && from.value() - to.value() >= least_ &&
           (kind.empty() || kind == "endmill" || kind == "bullnose" || kind == "facemill");
  }

  std::optional<double> top_; ///< of the stock
  double least_ = 0.5;        ///< mm; shallower ones do no harm
};

} // namespace
NCVET_RULE(FeedPlungeTooFast, feed_plunge_too_fast)
} // namespace ncvet
