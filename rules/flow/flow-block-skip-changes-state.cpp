// What runs after a skippable block depends on the skip switch.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/mode_reliance.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class FlowBlockSkipChangesState final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::Block});
    atCause_ = to.dialect().facts->program.skipKeepsModes;
    inside_ = to.flag("inside");
    words_ = to.flag("words");
    watched_ = groupMask(to.dialect(),
                         {StandardGroup::Motion, StandardGroup::Distance, StandardGroup::Plane,
                          StandardGroup::Units, StandardGroup::Compensation,
                          StandardGroup::LengthOffset, StandardGroup::WorkOffset,
                          StandardGroup::FeedMode, StandardGroup::SpeedMode, StandardGroup::Cycle});
    if (atCause_) // the next motion code is in most blocks
      watched_ &= ~groupMask(to.dialect(), {StandardGroup::Motion});
  }

  void on(const Event &, RuleContext &ctx) const override {
    if (ctx.block().skip < 0)
      return sleepInShape();
    if ((inside_ && skipsRest(ctx)) || choosesCompensation(ctx))
      return;
    const MachineState &before = ctx.before(), &after = ctx.after();
    ModeChanges changes;
    for (unsigned i = 0; i < ctx.dialect().groups.size(); ++i)
      if ((watched_ >> i & 1) && before.group(i) != after.group(i))
        changes.groups |= uint64_t(1) << i;
    if (!atCause_)
      takeOutOfRun(changes, ctx);
    // Another offset under the same code: `/G43 Z30 H02`.
    if (before.lengthOffset > 0 && after.lengthOffset > 0 &&
        before.lengthOffset != after.lengthOffset)
      changes.groups |= groupMask(ctx.dialect(), {StandardGroup::LengthOffset});
    changes.tool = before.tool != after.tool && before.tool != notSet;
    const uint8_t was = before.spindle, is = after.spindle;
    const bool turned = was == spindleCw || was == spindleCcw,
               turns = is == spindleCw || is == spindleCcw;
    // Where every change counts, so does a stop.
    if (was != is && ((turned || was == spindleOff) && (turns || (atCause_ && is == spindleOff))))
      changes.groups |= groupMask(ctx.dialect(), {StandardGroup::Spindle});
    if (atCause_ && !changes.any() && !(before.frames == after.frames)) {
      if (auto finding = ctx.report(ctx.blockRange()))
        finding.text("this shift of the coordinates is in a block that can be skipped: a key at "
                     "the panel decides what holds after it");
      return;
    }
    if (words_ && ctx.block().hasLabel())
      if (auto finding = ctx.report(
              SourceRange{ctx.source().id(), ctx.block().labelBegin, ctx.block().labelEnd}))
        finding.message("the label `{0}` is in a block that can be skipped",
                        ctx.source().text(ctx.block().labelBegin, ctx.block().labelEnd));
    if (!changes.any()) {
      if (words_)
        words(ctx);
      return;
    }
    if (atCause_) {
      if (auto finding = ctx.report(ctx.blockRange()))
        finding.message("this change of {0} is in a block that can be skipped: a key at the "
                        "panel decides what holds after it",
                        titleOf(changes, ctx.dialect()));
      return;
    }
    SourceRange user;
    const ModeChanges relied = firstReliance(ctx, changes, user);
    if (!relied.any()) {
      if (words_)
        words(ctx);
      return;
    }
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message("with the skip switch on, the program goes on without this change of {0}",
                   titleOf(relied, ctx.dialect()))
          .note(user, "this block depends on the switch");
  }

private:
  /// `/ G41`, and nothing else: the switch is there to run the path with compensation or without.
  bool choosesCompensation(const RuleContext &ctx) const {
    return !atCause_ && !ctx.asked() && !ctx.codes().empty() &&
           ctx.block().words.size() == ctx.codes().size() + ctx.block().has(letterAddress('D')) &&
           llvm::all_of(ctx.codes(), [&](const CodeUse &use) {
             const Action action = ctx.code(use).action;
             return action == Action::CompensationLeft || action == Action::CompensationRight;
           });
  }

  bool inside_ = false; ///< a skip mark after words skips the rest of its block

  /// Blocks of one switch that follow each other are left out together: takes out what one of them
  /// that comes after sets otherwise, and what is now as it was before the first of them.
  static void takeOutOfRun(ModeChanges &changes, const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    for (GroupIndex group = 0; group < dialect.groups.size(); ++group) {
      const uint64_t active = ctx.after().group(group);
      if (!(changes.groups >> group & 1) || !llvm::isPowerOf2_64(active))
        continue;
      const size_t member = llvm::countTrailingZeros(active);
      const CodeIndex now = dialect.groups[group].members[member];
      if (lastOfRun(group, now, ctx) != now || beforeRun(group, ctx) == now)
        changes.groups &= ~(uint64_t(1) << group);
    }
  }

  /// The last code of the group in the block; none: it has none.
  static CodeIndex statedIn(const Block &block, GroupIndex group, const Dialect &dialect) {
    CodeIndex stated = noCode;
    for (const CodeIndex code : codesOf(dialect, block))
      if (dialect.codes[code].group == group)
        stated = code;
    return stated;
  }

  /// The code of the group that holds after the last of the blocks that are skipped with this one.
  static CodeIndex lastOfRun(GroupIndex group, CodeIndex now, const RuleContext &ctx) {
    Block next = ctx.block();
    while (readOn(ctx.index(), next) && next.skip == ctx.block().skip)
      if (const CodeIndex stated = statedIn(next, group, ctx.dialect()); stated != noCode)
        now = stated;
    return now;
  }

  /// The code of the group that the text states before the first of them; none: not near.
  static CodeIndex beforeRun(GroupIndex group, const RuleContext &ctx) {
    constexpr unsigned furthest = 60; // blocks
    Block block;
    bool more = readPrevious(ctx, block);
    for (unsigned i = 0; more && i < furthest; ++i, more = readBack(ctx, block))
      if (block.skip != ctx.block().skip)
        if (const CodeIndex stated = statedIn(block, group, ctx.dialect()); stated != noCode)
          return stated;
    return noCode;
  }

  /// `G00 X10. /Y20.`: what is before the mark runs in any case. Reports it.
  static bool skipsRest(RuleContext &ctx) {
    const Block &block = ctx.block();
    if (block.words.empty())
      return false;
    const uint32_t first = block.words.front().offset;
    const llvm::StringRef text = ctx.source().text(block.begin, block.end);
    if (text.take_front(first - block.begin).contains('/'))
      return false;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding.severity(Severity::Style)
          .message("a skip mark after other words skips the rest of the block alone");
    return true;
  }

  /// A feed, a speed, an edge or a frame that a later block works with.
  static void words(RuleContext &ctx) {
    const MachineState &before = ctx.before(), &after = ctx.after();
    const Block &block = ctx.block();
    const auto changed = [&](char letter) {
      switch (letter) {
      case 'F':
        return !(before.feed == after.feed) || !before.must(Fact::FeedSet);
      case 'S':
        return !(before.speed == after.speed) || !before.must(Fact::SpeedSet);
      case 'T':
        return before.preselected != after.preselected;
      default:
        return before.radiusOffset != after.radiusOffset;
      }
    };
    const auto report = [&](const char *what) {
      if (auto finding = ctx.report(ctx.blockRange()))
        finding.message("this change of {0} is in a block that can be skipped: a key at the "
                        "panel decides what holds after it",
                        what);
    };
    if (before.switches.may != after.switches.may &&
        (ctx.find({Action::FrameSet, Action::FrameAdd, Action::FrameClear})))
      return report("the frame");
    if (ctx.find({Action::Dwell})) // a time
      return;
    const std::pair<char, const char *> values[] = {
        {'D', "the tool's edge"}, {'F', "the feed"}, {'S', "the speed"}, {'T', "the tool"}};
    for (const auto &[letter, what] : values)
      if (block.has(letterAddress(letter)) && changed(letter) && worksWith(letter, ctx))
        return report(what);
  }

  /// Whether a later block works with the value before one gives it anew.
  static bool worksWith(char letter, RuleContext &ctx) {
    constexpr unsigned lookAhead = 20;
    BlocksAhead ahead(ctx);
    Block next;
    bool more = ahead.next(next);
    for (unsigned i = 0; more && i < lookAhead; ++i, more = ahead.next(next)) {
      const CodeUseMask codes = lookAt(next, ctx);
      if (codes.ends || next.has(letterAddress(letter)) ||
          (letter != 'T' && next.has(letterAddress('T'))))
        return false;
      if (next.skip >= 0) // may be skipped with it
        continue;
      if (letter == 'T' ? codes.changes : letter == 'S' && codes.turns)
        return true;
      if (letter != 'T' && next.hasAny(ctx.dialect().axisWords) && !(letter == 'F' && codes.rapid))
        return true;
    }
    return false;
  }

  struct CodeUseMask {
    bool ends = false, changes = false, turns = false, rapid = false;
  };
  static CodeUseMask lookAt(const Block &block, const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    CodeUseMask found;
    found.ends =
        findCode(dialect, block, {Action::ProgramEnd, Action::ProgramEndRewind, Action::Return});
    found.changes = findCode(dialect, block, {Action::ToolChange});
    found.turns = findCode(dialect, block, {Action::SpindleCw, Action::SpindleCcw});
    found.rapid = findCode(dialect, block, {Action::Rapid}) ||
                  (!findCode(dialect, block, {Action::Linear, Action::ArcCw, Action::ArcCcw}) &&
                   ctx.after().activeAction(dialect, StandardGroup::Motion) == Action::Rapid);
    return found;
  }

  uint64_t watched_ = 0;
  bool atCause_ = false; ///< whether or not a later block relies on it
  bool words_ = false;   ///< values of words count as well
};

} // namespace
NCVET_RULE(FlowBlockSkipChangesState, flow_block_skip_changes_state)
} // namespace ncvet
