// A feed is programmed before the program has said what it is measured in.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

struct ProgramSafeStartMissingMemory {
  bool moved = false;
  bool turned = false;
};

class ProgramSafeStartMissing final : public StatefulRule<ProgramSafeStartMissingMemory> {
public:
  void listen(Subscriptions &to) override {
    if (to.flag("feedMode", true) && to.dialect().group(StandardGroup::FeedMode) != noGroup)
      to.on(EventKind::FeedWord);
    const auto watch = [&](const char *name, StandardGroup which) {
      if (to.flag(name) && to.dialect().group(which) != noGroup)
        wanted_.push_back(which);
    };
    watch("distance", StandardGroup::Distance);
    watch("units", StandardGroup::Units);
    watch("feedModeAtMove", StandardGroup::FeedMode);
    watch("workOffset", StandardGroup::WorkOffset);
    watch("planeAtMove", StandardGroup::Plane);
    plane_ = to.flag("plane");
    if (!wanted_.empty())
      to.onChange({EventKind::Motion, EventKind::CycleRun});
    if (plane_)
      to.on({EventKind::CompensationMove, EventKind::CycleRun, EventKind::CycleStart});
    if (plane_)
      to.onMoves({MotionKind::Rapid, MotionKind::Feed, MotionKind::ArcCw, MotionKind::ArcCcw});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind != EventKind::FeedWord)
      return atUse(event, ctx);
    const GroupIndex group = ctx.dialect().group(StandardGroup::FeedMode);
    // A thread's F is a lead whatever the mode; the first F says it once for the program.
    if (ctx.after().must(Fact::FeedIsLead) || ctx.before().must(Fact::FeedSet) ||
        ctx.after().isStated(group) || ctx.before().may(Fact::UnknownCode))
      return;
    if (auto finding = ctx.report(event, event.certain && !(ctx.after().mayBeStated(group))))
      finding.message("`{0}` comes before the program states {1}: its unit is what the machine "
                      "was left in",
                      ctx.text(*event.word), modes(ctx.dialect(), group));
  }

private:
  /// The first move asks for dimensions and units, the first arc, cycle or compensation for a
  /// plane.
  void atUse(const Event &event, RuleContext &ctx) const {
    if (ctx.callDepth() > 0 || ctx.before().may(Fact::UnknownCode) ||
        ctx.before().profile != ProfileMode::Off)
      return;
    // A cycle may make the first move of all.
    if ((event.kind == EventKind::Motion || event.kind == EventKind::CycleRun) && !memory().moved) {
      memory().moved = true;
      ask(wanted_, event, ctx);
    }
    const bool turns = event.kind != EventKind::Motion || isArc(event.motion) ||
                       (event.code != noCode && ctx.code(event).action == Action::CurveFeed);
    if (!plane_ || !turns || memory().turned)
      return;
    memory().turned = true;
    ask({StandardGroup::Plane}, event, ctx);
  }

  /// One finding for all modes that are not stated.
  static void ask(llvm::ArrayRef<StandardGroup> asked, const Event &event, RuleContext &ctx) {
    std::string missing;
    for (const StandardGroup which : asked) {
      const GroupIndex group = ctx.dialect().group(which);
      // What the machine profile says that the control sets before every program is stated.
      const bool set = ctx.machine().option("priorityBlock") && group != noGroup &&
                       ctx.dialect().groups[group].initial != 0xFF;
      if (group != noGroup && !set && !(ctx.after().mayBeStated(group)))
        missing += (missing.empty() ? "" : "; ") + modes(ctx.dialect(), group);
    }
    if (missing.empty())
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Style)
          .message("the program has not stated {0} before this block: it is what the machine was "
                   "left in",
                   missing);
  }

  std::vector<StandardGroup> wanted_;
  bool plane_ = false;

  static std::string modes(const Dialect &dialect, GroupIndex group) {
    constexpr size_t readable = 4;
    std::string text;
    const auto &members = dialect.groups[group].members;
    const bool all = members.size() <= readable;
    const size_t shown = all ? members.size() : readable - 1;
    for (size_t i = 0; i < shown; ++i) {
      if (i)
        text += all && i + 1 == shown ? " or " : ", ";
      text += "`" + dialect.codes[members[i]].name + "`";
    }
    return all ? text
               : text + " or another code of this group (" + dialect.groups[group].title + ")";
  }
};

} // namespace
NCVET_RULE(ProgramSafeStartMissing, program_safe_start_missing)
} // namespace ncvet
