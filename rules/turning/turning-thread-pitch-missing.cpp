// A thread is cut with a feed that was not given as its pitch.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/word_checks.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class TurningThreadPitchMissing final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::CycleRun, EventKind::Motion});
    to.onCode([](const CodeInfo &code) { return addressesOf(code, Role::Lead) != 0; });
    newThread_ = to.dialect().facts->turning.newThreadNeedsLead;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || ctx.before().profile == ProfileMode::Recorded)
      return;
    if (event.kind == EventKind::Code) {
      reportWordRanges(ctx, event, [](const CodeInfo &of, const WordSpec &spec, Breach) {
        return topicOf(of, spec) == WordTopic::Lead;
      });
      return;
    }
    const CodeInfo &code = ctx.code(event);
    const bool thread = event.kind == EventKind::CycleRun ? cutsThread(code.cycle)
                                                          : event.motion == MotionKind::Thread;
    if (!thread)
      return sleepInShape();
    const AddressMask lead = addressesOf(code, Role::Lead);
    if (!lead || ctx.block().hasAny(lead) || ctx.before().may(Fact::UnknownCode))
      return;
    const MachineState &before = ctx.before();
    if (before.must(Fact::FeedIsLead) && before.must(Fact::FeedSet)) {
      if (newThread_)
        another(event, code, lead, ctx);
      return;
    }
    const Origin &feed = before.origin.of(StatePart::Feed);
    if (before.must(Fact::FeedSet) && (isUnusedSince(feed, ctx) || isOfThread(feed, ctx)))
      return;
    const Word *word = ctx.codeWord(event);
    if (!word && isOfRow(code, feed, ctx))
      return;
    const bool certain = event.certain && !before.may(Fact::FeedIsLead);
    if (auto finding = ctx.report(word ? ctx.range(*word) : ctx.blockRange(), certain)) {
      if (before.must(Fact::FeedSet)) // nothing stops: it may even be the pitch
        finding.severity(Severity::Warning)
            .message("`{0}` cuts a thread without {1} of its own: the feed of line {2} becomes the "
                     "pitch",
                     code.name, ctx.dialect().alternatives(lead),
                     lineOf(ctx, before.origin.of(StatePart::Feed)));
      else
        finding.message("`{0}` cuts a thread, and its pitch {1} is not given", code.name,
                        ctx.dialect().alternatives(lead));
      finding.note(before.origin.of(StatePart::Feed), "the feed in force is set here");
    }
  }

private:
  /// The feed is in the block of a thread: it was its lead, whatever was called since.
  static bool isOfThread(const Origin &feed, const RuleContext &ctx) {
    if (!feed.known() || !isHere(ctx, feed))
      return false;
    Block block;
    ctx.index().read(ctx.source().lines().lineBegin(feed.begin), block);
    return llvm::any_of(codesOf(ctx.dialect(), block), [&](CodeIndex index) {
      const CodeInfo &code = ctx.dialect().codes[index];
      return code.action == Action::Thread || cutsThread(code.cycle);
    });
  }

  /// `X28.4 F1.5` among the passes of `G92`: a further block of the same cycle has given it.
  static bool isOfRow(const CodeInfo &code, const Origin &feed, const RuleContext &ctx) {
    const Origin &cycle = ctx.before().origin.of(StatePart::Cycle);
    return cutsThread(code.cycle) && cycle.known() && feed.known() && cycle.file == feed.file &&
           cycle.begin < feed.begin;
  }

  /// `G00 X19. Z6. F1.5` and then the thread: nothing but it can be meant by the feed.
  static bool isUnusedSince(const Origin &feed, RuleContext &ctx) {
    constexpr unsigned furthest = 10; // blocks
    if (!feed.known() || !isHere(ctx, feed) || feed.begin >= ctx.block().begin)
      return false;
    Block block;
    ctx.index().read(ctx.source().lines().lineBegin(feed.begin), block);
    if (!findCode(ctx.dialect(), block, {Action::Rapid}))
      return false;
    for (unsigned i = 0; i < furthest && readOn(ctx.index(), block); ++i) {
      if (block.begin >= ctx.block().begin)
        return true;
      if (!block.items.empty())
        return false;
      for (const CodeIndex code : codesOf(ctx.dialect(), block))
        if (isMotion(ctx.dialect().codes[code].action) &&
            ctx.dialect().codes[code].action != Action::Rapid)
          return false;
    }
    return false;
  }

  /// After a move that cuts no thread, a stroke to another end than that of the thread whose lead
  /// is in force begins a thread of its own.
  static void another(const Event &event, const CodeInfo &code, AddressMask lead,
                      RuleContext &ctx) {
    const MachineState &before = ctx.before();
    const CodeInfo *motion = before.activeCode(ctx.dialect(), StandardGroup::Motion);
    const Word *own = ctx.codeWord(event);
    if (!own || !event.certain || !motion || motion->action == Action::Thread ||
        cutsThread(motion->cycle))
      return;
    const Origin &feed = before.origin.of(StatePart::Feed);
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    if (!feed.known() || feed.file != ctx.source().id() || feed.begin < program.begin ||
        feed.begin >= ctx.block().begin)
      return;
    Block first;
    ctx.index().read(ctx.source().lines().lineBegin(feed.begin), first);
    const Word *was = first.find('Z'), *is = ctx.block().find('Z');
    // Chained strokes have several ends: any of them may be this one.
    Block next = first;
    constexpr unsigned longestChain = 20;
    for (unsigned i = 0; was && is && i < longestChain; ++i) {
      if (!was->isNumber() || !is->isNumber() || was->value() == is->value())
        return;
      do {
        if (!readOn(ctx.index(), next) || !next.items.empty() || next.begin >= ctx.block().begin)
          return report(code, *own, lead, feed, ctx);
        if (findCode(ctx.dialect(), next, {Action::Rapid, Action::Linear}))
          return report(code, *own, lead, feed, ctx);
      } while (!next.has(letterAddress('Z')) && !next.has(letterAddress('W')));
      was = next.find('Z');
    }
  }

  static void report(const CodeInfo &code, const Word &own, AddressMask lead, const Origin &feed,
                     RuleContext &ctx) {
    if (auto finding = ctx.report(own))
      finding
          .message("`{0}` cuts to another end than the thread of line {1}, and its own {2} is not "
                   "given",
                   code.name, lineOf(ctx, feed), ctx.dialect().alternatives(lead))
          .note(feed, "the lead in force is given here");
  }

  bool newThread_ = false; ///< a thread with another end in Z wants a lead of its own
};

} // namespace
NCVET_RULE(TurningThreadPitchMissing, turning_thread_pitch_missing)
} // namespace ncvet
