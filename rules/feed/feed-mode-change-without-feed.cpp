// The feed's unit was changed, and the next feed move has no F of its own.
#include "analyzer/facts/called_blocks.h"
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/project.h"
#include "analyzer/program/wanted_blocks.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "analyzer/rule/text_answers.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct FeedModeChangeWithoutFeedMemory {
  SourceRange tap{}; ///< block of the last tapped hole
  uint32_t reported = ~0u;
  std::pair<Origin, Origin> acrossCalls; ///< F and unit of the last report of two programs
};

class FeedModeChangeWithoutFeed final : public StatefulRule<FeedModeChangeWithoutFeedMemory> {
public:
  void listen(Subscriptions &to) override {
    const bool counts = to.dialect().facts->feed.newAfterModeChange;
    afterInverse_ = !counts && firstCodeWith(to.dialect(), Action::FeedInverseTime);
    if (to.dialect().group(StandardGroup::FeedMode) != noGroup && (counts || afterInverse_))
      to.onChange({EventKind::Motion, EventKind::CycleRun});
    const GroupIndex modes = to.dialect().group(StandardGroup::FeedMode);
    forgets_ = modes != noGroup && to.dialect().groups[modes].forgetsFeed;
    afterTap_ = to.dialect().facts->cycles.tapLeavesFeed;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (afterInverse_ && !ctx.after().must(Fact::FeedCarried))
      return sleepInShape();
    if (event.kind == EventKind::CycleRun && !afterTap_)
      return hole(event, ctx);
    if (event.kind == EventKind::CycleRun) {
      if (event.code == noCode)
        return;
      if (taps(ctx.code(event).cycle))
        tapped(ctx);
      else if (ctx.code(event).group != noGroup) // a call has a feed of its own
        pitchLeftOn(event, ctx);
      return;
    }
    if (afterTap_)
      pitchLeftOn(event, ctx);
    const bool feeds = isFeed(event.motion);
    if (!feeds || event.code == noCode)
      return;
    if (forgets_)
      return feedForgotten(event, ctx);
    carried(event, ctx);
  }

private:
  /// Further holes of a cycle follow the block that switched the unit on.
  void tapped(const RuleContext &ctx) const {
    const Origin since = ctx.after().originOf(ctx.dialect(), StandardGroup::FeedMode);
    SourceRange &tap = memory().tap;
    if (tap.end == 0 || !since.known() || since.file != tap.file || since.begin < tap.begin ||
        since.begin >= tap.end)
      tap = ctx.blockRange();
  }

  /// A hole is made at feed too; that of a tap goes with its pitch.
  void hole(const Event &event, RuleContext &ctx) const {
    if (event.code == noCode || forgets_ || !event.axes)
      return;
    const CodeInfo &code = ctx.code(event);
    if (code.needsFeed && makesHole(code.cycle) && !taps(code.cycle))
      carried(event, ctx);
  }

  /// F was programmed for the other unit.
  void carried(const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    if (!state.must(Fact::FeedSet) || state.may(Fact::UnknownCode))
      return;
    const Origin mode = state.originOf(ctx.dialect(), StandardGroup::FeedMode);
    const Origin &feed = state.origin.of(StatePart::Feed);
    if (!mode.known() || !feed.known())
      return;
    if (mode.file != feed.file || mode.file != ctx.source().id() ||
        !areOfOneProgram(mode, feed, ctx))
      return ofOtherProgram(event, mode, feed, ctx);
    if (!state.must(Fact::FeedCarried) || feed.begin > mode.begin || !changed(mode, feed, ctx) ||
        mode.begin == memory().reported)
      return;
    memory().reported = mode.begin;
    report(event, mode, feed, ctx);
  }

  static void report(const Event &event, const Origin &mode, const Origin &feed, RuleContext &ctx) {
    const CodeInfo *code = ctx.after().activeCode(ctx.dialect(), StandardGroup::FeedMode);
    if (auto finding = event.word ? ctx.report(event) : ctx.report(ctx.blockRange(), event.certain))
      finding
          .message("this move feeds with the F of before `{0}`: the number now counts in another "
                   "unit",
                   code ? code->name : "the change")
          .note(mode, "the unit changes here")
          .note(feed, "the feed is programmed here");
  }

  /// Of two places of the current file: they are in its current program.
  static bool areOfOneProgram(const Origin &mode, const Origin &feed, const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    return isIn(ctx, mode, program) && isIn(ctx, feed, program);
  }

  /// F, the unit and the move are not all in one program: one program called the other. F counts in
  /// the unit that its own program had stated before it.
  void ofOtherProgram(const Event &event, const Origin &mode, const Origin &feed,
                      RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const CodeInfo *const now = state.activeCode(ctx.dialect(), StandardGroup::FeedMode);
    if (!now || state.may(Fact::FeedIsLead) ||
        (!state.must(Fact::FeedCarried) && isOfRunningProgram(feed, ctx)))
      return;
    const CodeIndex then = unitOf(feed, ctx);
    if (then == noCode || !countsAnew(ctx.dialect(), then, codeIndex(*now, ctx.dialect())) ||
        memory().acrossCalls == std::pair(feed, mode))
      return;
    memory().acrossCalls = {feed, mode};
    report(event, mode, feed, ctx);
  }

  /// Whether the place is in the current program or in one that has called it. What another one has
  /// left was programmed under its own unit, which its return may have taken back.
  static bool isOfRunningProgram(const Origin &place, const RuleContext &ctx) {
    if (isIn(ctx, place, ctx.index().programAt(ctx.block().begin)))
      return true;
    for (const CallSite *call = ctx.caller(); call && call->unit; call = call->before)
      if (place.file == call->unit->source.id() && place.begin >= call->program->begin &&
          place.begin < call->program->end)
        return true;
    return false;
  }

  static CodeIndex codeIndex(const CodeInfo &code, const Dialect &dialect) {
    return CodeIndex(&code - dialect.codes.data());
  }

  /// A block that states the unit of the feed.
  struct Stated {
    uint32_t block; ///< its begin
    CodeIndex unit; ///< `noCode`: a program that was called before it may have stated another one
  };

  /// What the text of a program states of the unit, in its order.
  const std::vector<Stated> &statedIn(FileId file, const ProgramInfo &program,
                                      const RuleContext &ctx) const {
    const FileIndex &index = ctx.indexOf(file);
    index.reader(); // all of the program's text counts, read now or before
    const auto wants = [&](const TextPiece &piece) {
      return !piece.isPlain || llvm::any_of(piece.codes, [&](CodeIndex code) {
        return stated(ctx.dialect(), code).has_value();
      });
    };
    return units_.of({file, program.body}, [&] {
      std::vector<Stated> units;
      for (const Block &block : blocksWhere(index, program, wants)) {
        if (entersProgram(block))
          units.push_back({block.next, noCode});
        for (const Word &word : block.words)
          if (const auto unit = stated(ctx.dialect(), word))
            units.push_back({block.begin, *unit});
      }
      return units;
    });
  }

  /// The unit that the program of `feed` had stated in its text up to the block of F. A main
  /// program that had stated none began with that of the table; `noCode`: it is that of a caller or
  /// of a called program.
  CodeIndex unitOf(const Origin &feed, const RuleContext &ctx) const {
    const ProgramInfo &program = ctx.indexOf(feed.file).programAt(feed.begin);
    const std::vector<Stated> &all = statedIn(feed.file, program, ctx);
    const auto after =
        llvm::partition_point(all, [&](const Stated &one) { return one.block <= feed.begin; });
    if (after != all.begin())
      return std::prev(after)->unit;
    if (!isOfRunningProgram(feed, ctx))
      return unitBeforeCall(ctx);
    return isMain(program, ctx) ? initial(ctx.dialect()) : noCode;
  }

  /// The unit that the current program had stated before the one call that it has made since.
  CodeIndex unitBeforeCall(const RuleContext &ctx) const {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    const std::vector<Stated> &all = statedIn(ctx.source().id(), program, ctx);
    auto last = llvm::partition_point(
        all, [&](const Stated &one) { return one.block <= ctx.block().begin; });
    if (last == all.begin() || (--last)->unit != noCode)
      return noCode;
    if (last == all.begin())
      return isMain(program, ctx) ? initial(ctx.dialect()) : noCode;
    return std::prev(last)->unit;
  }

  static bool isMain(const ProgramInfo &program, const RuleContext &ctx) {
    const CallSite *first = ctx.caller();
    while (first && first->before)
      first = first->before;
    return first ? first->program == &program
                 : &ctx.index().programAt(ctx.block().begin) == &program;
  }

  /// The control forgets F at the code of the feed's unit, be it the one in force.
  void feedForgotten(const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    if (!ctx.code(event).needsFeed || state.must(Fact::FeedSet) || state.may(Fact::UnknownCode))
      return;
    const CodeInfo *code = state.activeCode(ctx.dialect(), StandardGroup::FeedMode);
    const Origin mode = state.originOf(ctx.dialect(), StandardGroup::FeedMode);
    if (!code || !mode.known() || !state.origin.of(StatePart::Feed).known() ||
        mode.begin == memory().reported)
      return;
    const Origin &feed = state.origin.of(StatePart::Feed);
    if (feed.file == mode.file && feed.begin > mode.begin)
      return; // another way has programmed it: on this one it was never there
    memory().reported = mode.begin;
    if (auto finding = ctx.report(event, event.certain && !state.may(Fact::FeedSet)))
      finding.message("this move has no feed: `{0}` has forgotten the F of before it", code->name)
          .note(mode, "the feed is forgotten here")
          .note(state.origin.of(StatePart::Feed), "the feed is programmed here");
  }

  /// The feed per revolution that the block of a tapping cycle switched on is still in force.
  void pitchLeftOn(const Event &event, RuleContext &ctx) const {
    const bool drills = event.kind == EventKind::CycleRun;
    const bool feeds = drills || isFeed(event.motion);
    const MachineState &state = ctx.after();
    if (memory().tap.end == 0)
      return;
    const CodeInfo *mode = state.activeCode(ctx.dialect(), StandardGroup::FeedMode);
    const Origin since = state.originOf(ctx.dialect(), StandardGroup::FeedMode);
    if (!feeds || !mode || mode->action != Action::FeedPerRevolution ||
        (!drills && state.cycleActive(ctx.dialect()) != Truth::No) || !since.known() ||
        since.file != memory().tap.file || since.begin < memory().tap.begin ||
        since.begin >= memory().tap.end)
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` of the tapping cycle is still in force: this {1} feeds per revolution",
                   mode->name, drills ? "cycle" : "move")
          .note(since, "it was switched on for tapping");
    memory().tap = {};
  }

  /// By program: those of its text.
  TextAnswers<std::pair<FileId, uint32_t>, std::vector<Stated>> units_;
  bool afterTap_ = false;
  bool afterInverse_ = false; ///< only where F was the time of a move
  bool forgets_ = false;      ///< see `GroupInfo::forgetsFeed`

  /// Whether F was programmed under another unit than that of the code at `mode`, by the text.
  bool changed(const Origin &mode, const Origin &feed, const RuleContext &ctx) const {
    const Dialect &dialect = ctx.dialect();
    Block block;
    readBlockOf(ctx, mode, block);
    const auto *const word =
        llvm::find_if(block.words, [&](const Word &one) { return one.offset == mode.begin; });
    const CodeIndex code = word == block.words.end() ? noCode : codeOf(dialect, *word);
    if (code == noCode)
      return false;
    do
      for (const Word &before : llvm::reverse(block.words))
        if (block.begin <= feed.begin && before.offset < mode.begin)
          if (const auto last = stated(dialect, before))
            return countsAnew(dialect, *last, code);
    while (readBack(ctx, block));
    const CodeIndex first = initial(dialect);
    return first != noCode && countsAnew(dialect, first, code);
  }

  /// What holds at the start counts as stated where the table knows it.
  static CodeIndex initial(const Dialect &dialect) {
    const GroupInfo &modes = dialect.groups[dialect.group(StandardGroup::FeedMode)];
    return modes.initial < modes.members.size() ? modes.members[modes.initial] : noCode;
  }

  /// The unit of the feed that a word states, by its own code or by one that resets all.
  static std::optional<CodeIndex> stated(const Dialect &dialect, const Word &word) {
    return stated(dialect, codeOf(dialect, word));
  }
  static std::optional<CodeIndex> stated(const Dialect &dialect, CodeIndex code) {
    if (code == noCode)
      return std::nullopt;
    if (dialect.codes[code].group == dialect.group(StandardGroup::FeedMode))
      return code;
    const CodeIndex first = initial(dialect);
    return dialect.codes[code].action == Action::Reset && first != noCode ? std::optional(first)
                                                                          : std::nullopt;
  }

  /// An F that was the time of a move is no feed afterwards, on any control.
  bool countsAnew(const Dialect &dialect, CodeIndex before, CodeIndex now) const {
    return otherUnit(dialect, before, now) &&
           (!afterInverse_ || dialect.codes[before].action == Action::FeedInverseTime);
  }

  /// Whether the number of F counts otherwise under `b` than under `a`. Where the table says which
  /// codes have one unit, a code of which it says nothing may have any.
  static bool otherUnit(const Dialect &dialect, CodeIndex a, CodeIndex b) {
    const GroupInfo &group = dialect.groups[dialect.group(StandardGroup::FeedMode)];
    const bool told = llvm::any_of(group.members, [&](CodeIndex member) {
      return member != noCode && !dialect.codes[member].family.empty();
    });
    const std::string &first = dialect.codes[a].family, &second = dialect.codes[b].family;
    return told ? !first.empty() && !second.empty() && first != second : a != b;
  }
};

} // namespace
NCVET_RULE(FeedModeChangeWithoutFeed, feed_mode_change_without_feed)
} // namespace ncvet
