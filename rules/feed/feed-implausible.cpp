// A feed whose size belongs to the other feed unit, or with which nothing cuts.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/report_once.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/text/number_text.h"
#include "interp/value/units.h"

namespace ncvet {
namespace {

struct FeedImplausibleMemory {
  OncePerCause once;
  SourceRange perTurn{}; ///< the last feed of such a size, where no mode was said
};

class FeedImplausible final : public StatefulRule<FeedImplausibleMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::FeedWord, EventKind::Motion, EventKind::CycleRun});
    perMinuteBelow_ = to.number("perMinuteBelow", 1);
    statedMode_ = to.flag("statedMode");
    perMinuteAbove_ = to.number("perMinuteAbove", 60'000);
    perRevolutionBelow_ = to.number("perRevolutionBelow", 0.008);
    perRevolutionAbove_ = to.number("perRevolutionAbove", 5);
    roughingAbove_ = to.number("roughingAbove", 1.5);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &state = ctx.after();
    const bool carried = event.kind != EventKind::FeedWord;
    // An F that was fit for its mode may be unfit for the one that is in force at the cut.
    if (carried && (!cuts(event, ctx) || ctx.block().has(letterAddress('F')) ||
                    !ctx.after().must(Fact::FeedCarried)))
      return sleepInShape();
    const Interval value = carried ? state.feed.get() : event.feed();
    if (!value.isConstant() || value.value() <= 0 || state.may(Fact::FeedIsLead) || isLead(ctx))
      return sleepInShape();
    const CodeInfo *mode = state.activeCode(ctx.dialect(), StandardGroup::FeedMode);
    // In inches it is still more, and per revolution too.
    if (!carried && value.value() > perMinuteAbove_ &&
        (!mode || mode->action == Action::FeedPerMinute))
      return tooMuch(event, ctx);
    if (!mode && !carried && !ctx.dialect().isLathe() &&
        value.value() * millimetresPerInch < perMinuteBelow_ && isOfMill(ctx))
      return creeps(event, ctx);
    if (!mode)
      return carried ? sleepInShape() : unlikeBefore(event, ctx);
    const Truth inch = state.isActive(ctx.dialect(), StandardGroup::Units, {Action::Inch});
    // Where something was set is looked at by those alone whom it may concern.
    const auto unitsSaid = [&] {
      return state.originOf(ctx.dialect(), StandardGroup::Units).known();
    };
    if (inch == Truth::Unknown && unitsSaid())
      return;
    const double feed = value.value() * (inch == Truth::Yes ? millimetresPerInch : 1);
    const bool tooSlow = mode->action == Action::FeedPerMinute && feed < perMinuteBelow_;
    const bool perTurn = isPerTurn(*mode, carried);
    const bool tooFast = perTurn && feed > perRevolutionAbove_;
    if (mode->action == Action::FeedPerRevolution && !carried && feed < perRevolutionBelow_ &&
        feed * (unitsSaid() ? 1 : millimetresPerInch) < perRevolutionBelow_)
      return tooLittle(event, ctx);
    if (perTurn && !tooFast && !carried && feed > roughingAbove_ && isOfContour(ctx))
      return tooMuchForContour(event, ctx);
    if (!tooSlow && !tooFast)
      return sleepInShape();
    if (carried && !isCarried(ctx))
      return;
    if (mode->action == Action::ConstantSpeed && isStatedTwice(ctx))
      return;
    if (statedMode_ && !state.originOf(ctx.dialect(), StandardGroup::FeedMode).known())
      return; // data of the machine say which mode it begins with
    if (carried &&
        !memory().once.speaks(state.originOf(ctx.dialect(), StandardGroup::FeedMode), ctx))
      return;
    const std::string written =
        carried ? "F" + shortNumber(value.value()) : ctx.text(*event.word).str();
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` under `{1}` is a feed per {2}: its size is that of a feed per {3}",
                   written, mode->name, tooSlow ? "minute" : "revolution",
                   tooSlow ? "revolution" : "minute")
          .note(state.originOf(ctx.dialect(), StandardGroup::FeedMode),
                "`" + mode->name + "` becomes active here")
          .note(carried ? state.origin.of(StatePart::Feed) : Origin(),
                "the feed is programmed here");
  }

private:
  /// The codes of the speed are modes of the feed per revolution where they share its group.
  static bool isPerTurn(const CodeInfo &mode, bool carried) {
    return mode.action == Action::FeedPerRevolution ||
           (!carried &&
            (mode.action == Action::SurfaceSpeed ||
             (mode.action == Action::ConstantSpeed && mode.family == "per-revolution")));
  }

  /// `G94 G97 S3000`: of two codes of the mode in one block, as posts write it, the first is meant.
  static bool isStatedTwice(const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    Block block;
    readBlockOf(ctx, ctx.after().originOf(dialect, StandardGroup::FeedMode), block);
    return llvm::count_if(codesOf(dialect, block), [&](CodeIndex code) {
             return dialect.codes[code].group == dialect.group(StandardGroup::FeedMode);
           }) > 1;
  }

  /// On a lathe whose program says no mode: a feed that is hundreds of times as great as one that
  /// has cut before belongs to the other mode.
  void unlikeBefore(const Event &event, RuleContext &ctx) const {
    constexpr double ofTurn = 0.8;  // at most, whatever the unit
    constexpr double ofMinute = 60; // at least
    const double feed = event.feed().value();
    if (!ctx.dialect().isLathe() || !ctx.block().hasAny(ctx.dialect().axisWords))
      return;
    if (feed <= ofTurn) {
      memory().perTurn = ctx.range(*event.word);
      return;
    }
    const SourceRange before = memory().perTurn;
    if (feed < ofMinute || before.empty() || before.file != ctx.source().id())
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` after `{1}`, and no code changes the mode: one of them is a feed per "
                   "minute, the other one per revolution",
                   ctx.text(*event.word), ctx.text(before))
          .note(before, "this feed is per revolution by its size");
  }

  static void tooMuch(const Event &event, RuleContext &ctx) {
    if (auto finding = ctx.report(event))
      finding.message("`{0}` is a feed of {1}: no machine cuts so fast", ctx.text(*event.word),
                      formatted("{0}", llvm::format("%.0f", event.feed().value())));
  }

  /// The block roughs or finishes a contour by turning.
  static bool isOfContour(const RuleContext &ctx) {
    return llvm::any_of(ctx.codes(), [&](const CodeUse &use) {
      const CycleKind kind = ctx.code(use).cycle;
      return kind == CycleKind::RoughTurn || kind == CycleKind::RoughFace ||
             kind == CycleKind::Finish;
    });
  }

  static void tooMuchForContour(const Event &event, RuleContext &ctx) {
    if (auto finding = ctx.report(event))
      finding.message("`{0}` per revolution along a contour: no tool turns with so much",
                      ctx.text(*event.word));
  }

  static void tooLittle(const Event &event, RuleContext &ctx) {
    if (auto finding = ctx.report(event))
      finding.message("`{0}` per revolution rubs and does not cut: was a digit or the point lost?",
                      ctx.text(*event.word));
  }

  /// A mill begins with the feed per minute, where nothing says otherwise.
  static void creeps(const Event &event, RuleContext &ctx) {
    if (auto finding = ctx.report(event))
      finding.message(
          "`{0}` is a feed per minute here, as no code says otherwise: its size is that "
          "of a feed per revolution",
          ctx.text(*event.word));
  }

  /// Nothing said so far speaks for a lathe, and the block moves.
  static bool isOfMill(const RuleContext &ctx) {
    const GroupIndex feed = ctx.dialect().group(StandardGroup::FeedMode);
    const GroupIndex speed = ctx.dialect().group(StandardGroup::SpeedMode);
    return feed != noGroup && ctx.block().hasAny(ctx.dialect().axisWords) &&
           ctx.after().at(Axis::Y).isConstant() &&
           (speed == noGroup || ctx.after().group(speed) == groupUnset);
  }

  /// A move at feed, or a hole that is drilled with it.
  static bool cuts(const Event &event, const RuleContext &ctx) {
    if (event.code == noCode || event.kind == EventKind::Motion)
      return event.code != noCode && isFeed(event.motion);
    const CodeInfo &code = ctx.code(event);
    // A call has a feed of its own.
    return code.group != noGroup && code.needsFeed && makesHole(code.cycle) && !taps(code.cycle);
  }

  /// The mode was switched after the F.
  static bool isCarried(RuleContext &ctx) {
    if (!ctx.after().must(Fact::FeedCarried) || ctx.after().may(Fact::UnknownCode))
      return false;
    const Origin &feed = ctx.after().origin.of(StatePart::Feed);
    const Origin mode = ctx.after().originOf(ctx.dialect(), StandardGroup::FeedMode);
    return feed.known() && mode.known();
  }

  /// The F of a threading or tapping block may be a lead.
  static bool isLead(RuleContext &ctx) {
    for (const CodeUse &use : ctx.codes())
      for (const WordSpec &spec : ctx.code(use).words)
        if (spec.role == Role::Lead && (spec.any & maskOf('F')))
          return true;
    return false;
  }

  bool statedMode_ = false;   ///< only under a mode that the program has
  double perMinuteBelow_ = 1; // mm/min
  double perMinuteAbove_ = 60'000;
  double perRevolutionBelow_ = 0.008; // mm
  double perRevolutionAbove_ = 5;     // mm
  double roughingAbove_ = 1.5;        // mm
};

} // namespace
NCVET_RULE(FeedImplausible, feed_implausible)
} // namespace ncvet
