// Feed and speed of a tapping cycle do not give the pitch.
#include "analyzer/facts/drill_parts.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/named_thread.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/project.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "analyzer/rule/text_answers.h"

#include <cmath>
#include <map>

namespace ncvet {
namespace {

struct CycleTapFeedMismatchMemory {
  SourceRange last{}; ///< where the cycle of the last hole became active
  double feed = 0;    ///< those of that hole: mm, 1/min
  double speed = 0;   ///< those of that hole: mm, 1/min
  double was = 0;     ///< pitch of that hole, where this one differs; else 0
  /// By tool, which is told by where it was changed: the lead that a comment names for it.
  Aside<std::map<std::pair<FileId, uint32_t>, std::optional<double>>> leads;
};

class CycleTapFeedMismatch final : public StatefulRule<CycleTapFeedMismatchMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    to.onNotices(id);
    leastPitch_ = to.number("leastPitch", 0.05);
    greatestPitch_ = to.number("greatestPitch", 12);
    leads_ = to.flag("leads");
    to.onCode([](const CodeInfo &code) { return isRigidTapping(code) || comesBack(code); });
    parts_ = drillParts(to.dialect(), to.machine());
    if (!parts_.empty())
      to.onCode([](const CodeInfo &code) { return makesHole(code.cycle) && code.arguments; });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code)
      return atCode(event, ctx);
    // A cycle that takes speed and lead among its own words does without F.
    if (event.code == noCode || !taps(ctx.code(event).cycle) || !ctx.code(event).needsFeed)
      return sleepInShape();
    const Dialect &dialect = ctx.dialect();
    const MachineState &state = ctx.after();
    const CodeInfo &code = ctx.code(event);
    const auto unit = millimetresPer(dialect, state);
    if (!unit || !state.feed->isConstant() || !state.must(Fact::FeedSet))
      return;
    // A mill whose program states no unit feeds per minute, and such a number is no pitch.
    const bool unstated = state.active(dialect, StandardGroup::FeedMode) == groupUnset;
    if (unstated && (dialect.isLathe() || (state.feed->value() * *unit <= greatestPitch_ &&
                                           !isNeither(state.feed->value() * *unit, ctx))))
      return;
    const Word *word = ctx.block().find('F');
    if (!word)
      word = ctx.block().find('S');
    const bool changed = changesPitch(event, *unit, ctx);
    const Word *named = ctx.codeWord(event);
    const bool stated = word || changed || !ctx.before().may(Fact::CycleRan) || named;
    if (!stated)
      return;
    Tapping tapping{code, *unit, state.feed->value() * *unit, {}, named != nullptr, {}, false};
    if (const auto tool = ctx.machine().tools.find(state.tool); tool != ctx.machine().tools.end())
      tapping.pitch = tool->second.pitch;
    if (leads_ && !tapping.pitch && (named || word)) {
      tapping.pitch = leadOfComment(ctx);
      tapping.told = tapping.pitch.has_value();
      // Without a code for the units they may be inches, of the feed at least.
      if (tapping.told && unitsOpen(ctx)) {
        const double feed = tapping.feed * inchInMillimetres;
        const double turns = hasSpeed(ctx) ? ctx.after().speed->value() : 1;
        if (std::fabs(feed - *tapping.pitch) < 0.02 * *tapping.pitch ||
            std::fabs(feed / turns - *tapping.pitch) < 0.02 * *tapping.pitch)
          return;
      }
    }
    tapping.at = word ? ctx.range(*word) : named ? ctx.range(*named) : ctx.blockRange();
    const Action mode = state.activeAction(dialect, StandardGroup::FeedMode);
    if (unstated && hasSpeed(ctx)) {
      // Neither by the minute nor by the turn.
      const bool fitsNone = isNeither(tapping.feed, ctx) ||
                            (tapping.pitch && tapping.isOff(tapping.feed, 0, 0) &&
                             tapping.isOff(tapping.feed / state.speed->value(), 0, 0));
      if (!fitsNone || !perMinute(event, tapping, ctx))
        laterHole(event, tapping, ctx);
    } else if (mode == Action::FeedPerRevolution)
      perRevolution(event, tapping, ctx);
    else if (mode == Action::FeedPerMinute && state.liveTool != spindleOff)
      drivenPerMinute(event, tapping, ctx);
    else if (mode == Action::FeedPerMinute && hasSpeed(ctx) && !perMinute(event, tapping, ctx))
      laterHole(event, tapping, ctx);
  }

private:
  static constexpr llvm::StringLiteral id{"cycle-tap-feed-mismatch"};

  void atCode(const Event &event, RuleContext &ctx) const {
    ctx.reportNotices(id, event);
    if (isRigidTapping(ctx.code(event)))
      return wayBack(event, ctx);
    if (comesBack(ctx.code(event)))
      return ofLead(event, ctx);
    return ofPart(event, ctx);
  }

  /// In and out are codes of their own, and each has the lead.
  static bool isRigidTapping(const CodeInfo &code) {
    return code.action == Action::Thread && code.leavesNoSpeed;
  }

  /// `G33.1`: one code for the way in and out, with the lead.
  static bool comesBack(const CodeInfo &code) {
    return code.action == Action::Thread && code.returns;
  }

  void ofLead(const Event &event, RuleContext &ctx) const {
    const Word *const word = wordOf(ctx.block(), ctx.code(event), Role::Lead);
    const auto unit = millimetresPer(ctx.dialect(), ctx.after());
    if (!leads_ || !word || !unit || unitsOpen(ctx))
      return;
    const Interval lead = ctx.value(*word);
    const auto named = lead.isConstant() ? leadOfComment(ctx) : std::nullopt;
    if (!named || std::fabs(lead.value() * *unit - *named) <= 0.02 * *named)
      return;
    if (auto finding = ctx.report(*word, event.certain))
      finding.severity(Severity::Warning)
          .message("`{0}` of `{1}` taps another pitch than that of the tap, which has {2}",
                   ctx.text(*word), ctx.code(event).name, text(*named / *unit));
  }

  /// Out of the hole with another lead than into it.
  static void wayBack(const Event &event, RuleContext &ctx) {
    Block before;
    if (!readPrevious(ctx, before))
      return;
    const CodeInfo *const into = findCode(ctx.dialect(), before, {Action::Thread});
    if (!into || !isRigidTapping(*into) || into == &ctx.code(event))
      return;
    for (const char letter : {'I', 'J', 'K'}) {
      const Word *const out = ctx.block().find(letterAddress(letter));
      const Word *const in = before.find(letterAddress(letter));
      if (!out || !in || !out->isNumber() || !in->isNumber() ||
          std::fabs(out->value()) == std::fabs(in->value()))
        continue;
      if (auto finding = ctx.report(*out, event.certain))
        finding.message("`{0}` leads the tap out of the hole, and the block before has led it in "
                        "with `{1}`: the thread is torn",
                        ctx.text(*out), ctx.source().text(in->offset, before.endOf(*in)));
      return;
    }
  }

  /// A feed that is no usual pitch, whether it counts by the minute or by the turn.
  bool isNeither(double feed, const RuleContext &ctx) const {
    constexpr double coarsest = 6; // mm a turn, of threads that are tapped
    if (feed <= coarsest || !hasSpeed(ctx))
      return false;
    const double cuts = feed / ctx.after().speed->value();
    return cuts < leastPitch_ || (feed > greatestPitch_ && cuts > greatestPitch_);
  }

  struct Tapping {
    const CodeInfo &code;
    double unit;                 ///< mm
    double feed;                 ///< mm a minute or revolution
    std::optional<double> pitch; ///< mm, of the tap in use, where the machine knows it
    bool named;                  ///< the block has the code of the cycle
    SourceRange at;              ///< what is reported
    bool told = false;           ///< a comment gives the pitch

    /// Another pitch than that of the tap, or than any tap has.
    bool isOff(double cuts, double least, double greatest) const {
      return pitch ? std::fabs(cuts - *pitch) > 0.02 * *pitch : cuts < least || cuts > greatest;
    }
  };

  /// A comment that names the lead of a thread.
  struct Named {
    uint32_t begin, end; ///< of the comment
    uint32_t next;       ///< after its block
    double lead;         ///< mm
  };
  /// Those of the blocks of a program before the one at `end`.
  struct NamedBefore {
    uint32_t end = 0; ///< 0: nothing is read
    std::vector<Named> all;
  };

  /// The lead of the thread that a comment of the tool names, in millimetres: one since the tool
  /// was changed, or one that names the tool.
  std::optional<double> readLead(const RuleContext &ctx) const {
    constexpr uint32_t readable = 1u << 20;
    // The tool was changed in this program, or in one that has called it: its comments name it.
    const Origin &tool = ctx.after().origin.of(StatePart::Tool);
    const FileUnit *unit = &ctx.unit();
    const ProgramInfo *program = &ctx.index().programAt(ctx.block().begin);
    uint32_t end = ctx.block().next;
    const auto isOfTool = [&] {
      return tool.file == unit->source.id() && tool.begin >= program->begin &&
             tool.begin < program->end;
    };
    for (const CallSite *caller = ctx.caller(); caller && caller->unit && !isOfTool();
         caller = caller->before) {
      unit = caller->unit;
      program = caller->program;
      end = caller->next;
    }
    const uint32_t since = tool.known() && isOfTool() ? tool.begin : 0;
    const std::string own = "T" + std::to_string(ctx.after().tool);
    std::optional<double> lead;
    if (end - program->begin > readable)
      return lead;
    for (const Named &named : namedBefore(*unit, *program, end)) {
      if (named.next > end)
        break;
      const llvm::StringRef text = unit->source.text(named.begin, named.end).ltrim("( ");
      const bool ofTool =
          text.startswith(own) && !(text.size() > own.size() && llvm::isDigit(text[own.size()]));
      if (named.next >= since || ofTool)
        lead = named.lead;
    }
    return lead;
  }

  /// Those of the program before `end`: each block is read once.
  llvm::ArrayRef<Named> namedBefore(const FileUnit &unit, const ProgramInfo &program,
                                    uint32_t end) const {
    unit.index.reader(); // the program is looked through, now or before
    NamedBefore &known = named_.growing({unit.source.id(), program.begin});
    for (const Block &block : blocks(unit.index, std::max(known.end, program.begin), end)) {
      for (const Comment &comment : block.comments)
        if (const auto lead = namedLead(unit.source.text(comment.begin, comment.end).ltrim("( ")))
          known.all.push_back({comment.begin, comment.end, block.next, *lead});
      known.end = block.next;
    }
    return known.all;
  }

  /// The same, read at the first tapped hole of each tool.
  std::optional<double> leadOfComment(const RuleContext &ctx) const {
    const Origin &tool = ctx.after().origin.of(StatePart::Tool);
    const auto [known, fresh] = memory().leads.look().try_emplace({tool.file, tool.begin});
    if (fresh)
      known->second = readLead(ctx);
    return known->second;
  }

  /// No code of the program says in which units it counts.
  static bool unitsOpen(const RuleContext &ctx) {
    const GroupIndex units = ctx.dialect().group(StandardGroup::Units);
    return units == noGroup || !ctx.after().isStated(units);
  }

  /// Feed and speed give a lead that no tap has.
  bool unusual(const Event &event, const Tapping &tapping, double cuts, RuleContext &ctx) const {
    if (!leads_ || tapping.pitch || (!tapping.named && !ctx.block().has(letterAddress('F'))) ||
        isUsualLead(cuts) || (unitsOpen(ctx) && isUsualLead(cuts * inchInMillimetres)))
      return false;
    if (auto finding = ctx.report(tapping.at, event.certain))
      finding.severity(Severity::Warning)
          .message("`{0}` taps a pitch of {1}, which no usual tap has: F is speed times pitch",
                   tapping.code.name, text(cuts / tapping.unit))
          .note(ctx.after().origin.of(StatePart::Feed), "the feed is set here");
    return true;
  }

  bool leads_ = false; ///< comments name threads, and taps have usual leads
  TextAnswers<std::pair<FileId, uint32_t>, NamedBefore> named_; ///< by file and program

  void perRevolution(const Event &event, const Tapping &tapping, RuleContext &ctx) const {
    const auto &[code, unit, feed, pitch, named, at, told] = tapping;
    if (!tapping.isOff(feed, -HUGE_VAL, greatestPitch_)) {
      unusual(event, tapping, feed, ctx);
      return;
    }
    auto finding = ctx.report(at, event.certain);
    if (!finding)
      return;
    if (pitch)
      finding
          .message("`{0}` with F{1} per revolution taps a pitch of {1}, but the tap has {2}",
                   code.name, text(feed / unit), text(*pitch / unit))
          .severity(told ? std::optional(Severity::Warning) : std::nullopt);
    else
      finding.message("`{0}` with F{1} under feed per revolution: that is no pitch, it looks "
                      "like a feed per minute",
                      code.name, text(feed / unit));
    finding.note(ctx.after().origin.of(StatePart::Feed), "the feed is set here");
  }

  /// S is not the speed of a driven tool, but none taps as slowly as a pitch for a feed would have
  /// it.
  void drivenPerMinute(const Event &event, const Tapping &tapping, RuleContext &ctx) const {
    constexpr double slowest = 50; // turns a minute
    if (tapping.feed >= leastPitch_ * slowest)
      return;
    if (auto finding = ctx.report(tapping.at, event.certain))
      finding
          .message(
              "`{0}` with F{1} per minute: F is speed times pitch here, and looks like a pitch",
              tapping.code.name, text(tapping.feed / tapping.unit))
          .note(ctx.after().origin.of(StatePart::Feed), "the feed is set here");
  }

  /// The spindle turns at a known speed.
  static bool hasSpeed(const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const MachineState &state = ctx.after();
    return state.speed->isConstant() && state.speed->value() > 0 &&
           (dialect.group(StandardGroup::SpeedMode) == noGroup ||
            state.activeAction(dialect, StandardGroup::SpeedMode) != Action::SurfaceSpeed);
  }

  /// False when the feed per minute gives the pitch.
  bool perMinute(const Event &event, const Tapping &tapping, RuleContext &ctx) const {
    const auto &[code, unit, feed, pitch, named, at, told] = tapping;
    const double speed = ctx.after().speed->value(), cuts = feed / speed;
    if (!tapping.isOff(cuts, leastPitch_, greatestPitch_))
      return unusual(event, tapping, cuts, ctx);
    auto finding = ctx.report(at, event.certain);
    if (!finding)
      return true;
    if (pitch)
      finding
          .message("`{0}` with F{1} and S{2} taps a pitch of {3}, but the tap has {4}: its "
                   "feed per minute is F{5}",
                   code.name, text(feed / unit), text(speed), text(cuts / unit),
                   text(*pitch / unit), text(*pitch / unit * speed))
          .severity(told ? std::optional(Severity::Warning) : std::nullopt);
    else
      finding.message("`{0}` with F{1} per minute and S{2} taps a pitch of {3}: F is speed times "
                      "pitch here",
                      code.name, text(feed / unit), text(speed), text(cuts / unit));
    finding.note(ctx.after().origin.of(StatePart::Speed), "the speed is set here");
    return true;
  }

  /// A later hole with another speed, but the old feed.
  void laterHole(const Event &event, const Tapping &tapping, RuleContext &ctx) const {
    const MachineState &before = ctx.before();
    const double was = memory().was, cuts = tapping.feed / ctx.after().speed->value();
    if (tapping.pitch || tapping.named || was <= 0 || !before.must(Fact::CycleRan) ||
        std::fabs(was - cuts) <= 0.005 * was)
      return;
    const CodeInfo &code = tapping.code;
    if (auto finding = ctx.report(tapping.at, event.certain))
      finding
          .message(
              "`{0}` taps a pitch of {1} from here on, before it was {2}: F and S have to change "
              "together",
              code.name, text(cuts / tapping.unit), text(was / tapping.unit))
          .note(before.origin.of(StatePart::Cycle), code.name + " becomes active here");
  }

  /// A call whose part is a tapping cycle: its feed is the pitch.
  void ofPart(const Event &event, RuleContext &ctx) const {
    const CodeIndex part = codeOfPart(parts_, ctx.code(event), ctx);
    if (part == noCode || !taps(ctx.dialect().codes[part].cycle))
      return;
    for (const WordSpec &spec : ctx.dialect().codes[part].words) {
      if (spec.role != Role::Feed || !spec.variable)
        continue;
      const Word *feed = assignmentOf(ctx.block(), spec.variable);
      if (!feed && spec.orVariable)
        feed = assignmentOf(ctx.block(), spec.orVariable);
      const Interval value = feed ? ctx.value(*feed) : Interval::unknown();
      if (!value.isConstant() || value.value() <= greatestPitch_)
        continue;
      if (auto finding = ctx.report(*feed))
        finding.message("`{0}` in a part that taps (`{1}`) is a feed per revolution: that is no "
                        "pitch, it looks like a feed per minute",
                        ctx.text(*feed), ctx.dialect().codes[part].name);
    }
  }

  std::map<std::string, CodeIndex> parts_; ///< of the dialogs
  /// Whether F or S has become another one since the hole before, in a block between the two.
  bool changesPitch(const Event &event, double unit, const RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const Origin &cycle = state.origin.of(StatePart::Cycle);
    const SourceRange here = cycle.known() ? cycle.range() : SourceRange{};
    const double feed = state.feed->value() * unit;
    const double speed = state.speed->isConstant() ? state.speed->value() : 0;
    const bool changed = event.certain && !here.empty() && here == memory().last && speed > 0 &&
                         memory().speed > 0 && (feed != memory().feed || speed != memory().speed);
    memory().was = changed ? memory().feed / memory().speed : 0;
    memory().last = here;
    memory().feed = feed;
    memory().speed = speed;
    return changed;
  }
  static std::string text(double value) { return formatted("{0}", llvm::format("%.4g", value)); }
  double leastPitch_ = 0.05;
  double greatestPitch_ = 12;
};

} // namespace
NCVET_RULE(CycleTapFeedMismatch, cycle_tap_feed_mismatch)
} // namespace ncvet
