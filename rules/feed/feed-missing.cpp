// A feed move or cutting cycle runs without a feed ever having been programmed.
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/silent_program.h"
#include "analyzer/rule/report_once.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct FeedMissingMemory {
  OncePerCause once;
  OncePerCause onceOfMode;
  bool unread = false; ///< a block that cannot be read may have given the feed
};

class FeedMissing final : public StatefulRule<FeedMissingMemory> {
public:
  void listen(Subscriptions &to) override {
    inverseEach_ = to.dialect().facts->feed.inverseTimeInEachBlock;
    turns_ = to.dialect().isLathe();
    to.onChange({EventKind::CycleRun, EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (inverseEach_ && lacksItsTime(event, ctx))
      return;
    const bool isSet = ctx.after().must(Fact::FeedSet) || memory().unread;
    if (!isSet && !ctx.block().issues.empty() && mayNameFeed(ctx))
      memory().unread = true;
    if (event.code == noCode || (isSet && !turns_) ||
        ctx.block().hasAny(ctx.dialect().blockFeedWords) || // a feed of its own block
        ctx.before().must(Fact::InContour) ||               // it has feeds of its own
        ctx.before().profile == ProfileMode::Recorded ||    // so has the cycle that reads it
        !ctx.block().issues.empty() ||                      // what it does cannot be read
        ctx.after().may(Fact::UnknownCode)) {
      return sleepInShape();
    }
    const CodeInfo &code = cutting(event, ctx);
    if (isSet)
      return leadAsFeed(event, code, ctx);
    // A modal cycle without axis words sets modes only.
    if (event.kind == EventKind::CycleRun && !event.axes && ctx.code(event).group != noGroup &&
        !code.firesOnEveryBlock)
      return;
    if (!code.needsFeed ||
        (event.kind == EventKind::Motion &&
         (event.motion == MotionKind::Reference || event.motion == MotionKind::Rapid)))
      return;
    if (event.kind == EventKind::CycleRun && hasOwnFeed(code, ctx)) {
      if (!ctx.after().may(Fact::FeedSet) &&
          memory().once.speaks(ctx.after().origin.of(StatePart::Cycle), ctx))
        if (auto finding = ctx.report(event, event.certain))
          finding.severity(Severity::Style)
              .message("`{0}` lives on the feed of another call's parameters: the program has no F",
                       code.name);
      return;
    }
    if (event.kind == EventKind::Motion && namesAxesAlone(ctx.dialect(), ctx.block()))
      return;
    // Only the first cut: it is the same mistake in all that follow. Where the program has no feed
    // at all and codes that only the builder knows, these may set the conditions.
    if (!memory().once.speaks(ctx.after().origin.of(StatePart::Feed), ctx) ||
        (hasBuilderCodes(ctx) && namesNoFeed(ctx)))
      return;
    if (movesByName(ctx))
      return;
    const bool certain = event.certain && !ctx.after().may(Fact::FeedSet);
    auto finding = ctx.report(event, certain);
    if (!finding)
      return;
    finding.message("`{0}` cuts, but no feed was programmed", code.name);
    if (event.kind == EventKind::Motion && !ctx.find({code.action}))
      finding.note(ctx.after().originOf(ctx.dialect(), StandardGroup::Motion),
                   "`" + code.name + "` becomes active here");
  }

private:
  /// `DEF INT A`, `A=5`: whether that is a value or a move nobody knows.
  static bool movesByName(const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    return llvm::any_of(ctx.block().words, [&](const Word &word) {
      const llvm::StringRef letter = ctx.text(word).take_front(1);
      const bool isAxis = ctx.dialect().axisWords & maskOf(word.address);
      return isAxis && ctx.index().definition(program, letter);
    });
  }

  /// What runs: at the places of a pattern that is the cycle in force.
  static const CodeInfo &cutting(const Event &event, const RuleContext &ctx) {
    const CodeInfo &code = ctx.code(event);
    const CodeInfo *const active = code.cycle == CycleKind::Pattern
                                       ? ctx.after().activeCode(ctx.dialect(), StandardGroup::Cycle)
                                       : nullptr;
    return active && active->action == Action::Cycle ? *active : code;
  }

  /// A part of the block that is no word holds an F and its value.
  static bool mayNameFeed(const RuleContext &ctx) {
    return llvm::any_of(ctx.block().issues, [&](const SyntaxIssue &issue) {
      const llvm::StringRef text = ctx.text(ctx.range(issue));
      const size_t at = text.find_last_of("Ff");
      return at != llvm::StringRef::npos && at + 1 < text.size() &&
             (llvm::isDigit(text[at + 1]) || text[at + 1] == '.' || text[at + 1] == '#');
    });
  }

  /// Turning goes on at the F of a thread, which is its lead and no feed for a cut.
  void leadAsFeed(const Event &event, const CodeInfo &code, RuleContext &ctx) const {
    const MachineState &after = ctx.after();
    const bool cuts = event.kind == EventKind::CycleRun
                          ? !cutsThread(code.cycle) && ctx.codeWord(event)
                          : isFeed(event.motion);
    if (!cuts || !code.needsFeed || event.inMachineCoordinates() ||
        after.profile == ProfileMode::Recorded || !after.must(Fact::FeedIsLead)) {
      return sleepInShape();
    }
    const Origin &lead = after.origin.of(StatePart::Feed); // read only here: it changes with each F
    if (!memory().once.speaks(lead, ctx))
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding.severity(Severity::Warning)
          .message(
              "`{0}` cuts with the lead of the thread as its feed: no feed was programmed after "
              "it",
              code.name)
          .note(lead, "the lead is given here");
  }

  /// A move with inverse time feed has the time of its own path, or none: the F of another block
  /// does not count for it. True when that is said.
  bool lacksItsTime(const Event &event, RuleContext &ctx) const {
    const bool feeds = isFeed(event.motion);
    const MachineState &state = ctx.after();
    if (event.kind != EventKind::Motion || !feeds || event.code == noCode ||
        state.activeAction(ctx.dialect(), StandardGroup::FeedMode) != Action::FeedInverseTime ||
        !ctx.code(event).needsFeed || ctx.block().has(letterAddress('F')) ||
        state.may(Fact::UnknownCode))
      return false;
    const Origin mode = state.originOf(ctx.dialect(), StandardGroup::FeedMode);
    if (!memory().onceOfMode.speaks(mode, ctx))
      return true;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` has no F in its block, and needs one with inverse time feed",
                   ctx.code(event).name)
          .note(mode, "inverse time feed is switched on here");
    return true;
  }

  /// A feed among the cycle's own words, or among the variables that it reads.
  static bool hasOwnFeed(const CodeInfo &code, const RuleContext &ctx) {
    return llvm::any_of(code.words, [&](const WordSpec &spec) {
      return spec.role == Role::Feed && spec.variable &&
             (wordFor(ctx.block(), spec) || givenBefore(spec, ctx.before()) != Truth::No);
    });
  }

  bool inverseEach_ = false; ///< inverse time feed wants F in each block that moves
  bool turns_ = false;       ///< a lathe: the F of a thread is its lead
};

} // namespace
NCVET_RULE(FeedMissing, feed_missing)
} // namespace ncvet
