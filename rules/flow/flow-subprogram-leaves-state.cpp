// A called program leaves a mode changed that the caller relies on.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/mode_reliance.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/callers.h"
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {
namespace {

class FlowSubprogramLeavesState final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CallReturned);
    if (to.flag("alone"))
      to.on({EventKind::Return, EventKind::ProgramEnd, EventKind::FlowIssue});
    atCause_ = to.flag("atCause");
    atCall_ = to.dialect().facts->program.modesOutliveReturn;
    watched_ = groupMask(to.dialect(),
                         {StandardGroup::Distance, StandardGroup::Plane, StandardGroup::Units,
                          StandardGroup::WorkOffset, StandardGroup::FeedMode, StandardGroup::Polar,
                          StandardGroup::Rotation, StandardGroup::Scaling});
    // A program that begins with a reset has stated the dimensions.
    if (atCause_ || atCall_)
      initial_ = groupMask(to.dialect(), {StandardGroup::Distance});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind != EventKind::CallReturned)
      return alone(event, ctx);
    const MachineState &before = ctx.before(), &after = ctx.after();
    if (after.may(Fact::UnknownCode) && !before.may(Fact::UnknownCode))
      return;
    ModeChanges changes;
    // A mode that the caller had not stated yet may well be set up by the call.
    for (unsigned i = 0; i < ctx.dialect().groups.size(); ++i)
      if ((watched_ >> i & 1) && ((before.isStated(i)) || (initial_ >> i & 1)) &&
          !(before.group(i) & (after.group(i) | groupUnset)))
        changes.groups |= uint64_t(1) << i;
    if (!changes.any() && atCall_)
      return leavesOn(ctx) ? void() : framesAtCall(ctx);
    if (!changes.any())
      return;
    if (atCall_)
      return atCall(changes, ctx);
    if (atCause_)
      return atCause(changes, ctx);
    SourceRange user;
    const ModeChanges relied = firstReliance(ctx, changes, user);
    if (!relied.any())
      return;
    unsigned group = 0;
    while (!(relied.groups >> group & 1))
      ++group;
    const bool distances =
        GroupIndex(group) == ctx.dialect().group(StandardGroup::Distance) &&
        after.isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental}) == Truth::Yes;
    auto finding = ctx.report(user);
    if (!finding)
      return;
    if (distances)
      finding.severity(Severity::Warning)
          .message("the coordinates here are distances: the called program has made them so, and "
                   "not set it back")
          .note(after.origin.ofGroup(group), "set here")
          .note(ctx.blockRange(), "called here");
    else
      finding
          .message("the {0} here was set by the called program", ctx.dialect().groups[group].title)
          .note(after.origin.ofGroup(group), "set here and not set back")
          .note(ctx.blockRange(), "called here");
  }

private:
  /// A file that says itself to be a subprogram, run without a caller: what it has switched on
  /// itself, away from the state of power-on, is on when it returns.
  void alone(const Event &event, RuleContext &ctx) const {
    const bool out = event.kind == EventKind::FlowIssue;
    const SourceRange where = out          ? ctx.flowRange()
                              : event.word ? ctx.range(*event.word)
                                           : ctx.blockRange();
    const ProgramInfo &program = ctx.index().programAt(where.begin);
    if (ctx.callDepth() > 0 || program.kind != ProgramKind::Subprogram ||
        (out && event.flowIssue() != FlowIssue::MainRunsOut) || givesBack(program, ctx))
      return;
    const Dialect &dialect = ctx.dialect();
    const MachineState &state = ctx.after();
    // What a program that it calls has left on is told at that call.
    const auto own = [&](const Origin &origin) { return isIn(ctx, origin, program); };
    llvm::SmallVector<std::string, 2> left;
    llvm::SmallVector<Origin, 2> origins;
    for (unsigned i = 0; i < dialect.groups.size(); ++i) {
      const GroupInfo &group = dialect.groups[i];
      if (!(watched_ >> i & 1) || GroupIndex(i) == dialect.group(StandardGroup::WorkOffset) ||
          group.initial == 0xFF || !own(state.origin.ofGroup(i)) ||
          (GroupIndex(i) == dialect.group(StandardGroup::Distance) &&
           saysEachTime(ctx.index(), program, ctx)))
        continue;
      for (size_t member = 0; member < group.members.size(); ++member)
        if (member != group.initial && state.group(i) == uint64_t(1) << member) {
          left.push_back("`" + dialect.codes[group.members[member]].name + "`");
          origins.push_back(state.origin.ofGroup(i));
        }
    }
    // At a program's end the rule of the frames speaks.
    for (unsigned i = 0; event.kind != EventKind::ProgramEnd && i < dialect.switches.size(); ++i)
      if (dialect.switches[i].leftOn == "coordinate-frame-left-on" && state.switchMustBeOn(i) &&
          own(state.origin.ofSwitch(i))) {
        left.push_back(dialect.switches[i].title);
        origins.push_back(state.origin.ofSwitch(i));
      }
    // What a caller in sight goes on with is told where it is set.
    if (left.empty() || (atCause_ && !callersOf(ctx.unit(), program).places.empty()))
      return;
    auto finding = ctx.report(where, event.certain);
    if (!finding)
      return;
    finding.message("the program returns with {0} on, which it has switched on itself: its caller "
                    "goes on with it",
                    llvm::join(left, " and "));
    for (const Origin &origin : origins)
      finding.note(origin, "switched on here");
  }

  /// Whether each move of the program says itself whether it is absolute or incremental, and either
  /// some are the one and some the other or they are several: whoever writes so relies on no mode
  /// that is left on.
  static bool saysEachTime(const FileIndex &index, const ProgramInfo &program,
                           const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    constexpr unsigned habit = 4; // moves
    unsigned absolute = 0, incremental = 0;
    for (const Block &block : blocks(index, program.body, program.end)) {
      if ((!axesOf(dialect, block) && !findCode(dialect, block, {Action::Rapid, Action::Linear})) ||
          findCode(dialect, block, {Action::MachineMove}))
        continue;
      const bool isAbsolute = findCode(dialect, block, {Action::Absolute}) != nullptr;
      const bool isIncremental = findCode(dialect, block, {Action::Incremental}) != nullptr;
      if (isAbsolute == isIncremental)
        return false;
      absolute += isAbsolute;
      incremental += isIncremental;
    }
    return (absolute && incremental) || incremental >= habit;
  }

  static bool saysEachTime(const SourceRange &where, const RuleContext &ctx) {
    const FileIndex &index = ctx.indexOf(where.file);
    return saysEachTime(index, index.programAt(where.begin), ctx);
  }

  static bool isReliedOn(const ModeChanges &changes, const RuleContext &ctx) {
    SourceRange user;
    return firstReliance(ctx, changes, user).any();
  }

  /// `SAVE`: the caller gets its modes back.
  static bool givesBack(const ProgramInfo &program, const RuleContext &ctx) {
    const Block head = headOf(ctx.index(), program);
    return llvm::any_of(head.items, [](const Item &item) { return item.restores; });
  }

  /// Reported at the call that brings the change, whether or not the caller notices.
  static void atCall(const ModeChanges &changes, RuleContext &ctx) {
    for (unsigned i = 0; i < ctx.dialect().groups.size(); ++i) {
      if (!(changes.groups >> i & 1))
        continue;
      if (auto finding = ctx.report(ctx.blockRange()))
        finding
            .message("the called program comes back with another state of {0}: the caller goes on "
                     "with it",
                     ctx.dialect().groups[i].title)
            .note(ctx.after().origin.ofGroup(i), "it is set here and not set back");
      return;
    }
  }

  /// Compensation or a cycle that was off where the program was called, and that the caller does
  /// not end at once.
  static bool leavesOn(RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const MachineState &before = ctx.before(), &after = ctx.after();
    const auto left = [&](StandardGroup which, Truth was, Truth is, Action end, const char *what) {
      if (was != Truth::No || is != Truth::Yes)
        return false;
      BlocksAhead ahead = BlocksAhead::afterCall(ctx);
      Block next;
      if (ahead.nextAtWork(next) && findCode(dialect, next, {end, Action::Reset}))
        return false;
      if (auto finding = ctx.report(ctx.blockRange()))
        finding
            .message("the called program comes back with {0} on: the caller goes on with it", what)
            .note(after.originOf(dialect, which), "it is switched on here and not off");
      return true;
    };
    return left(StandardGroup::Compensation, before.compensationActive(dialect),
                after.compensationActive(dialect), Action::CompensationOff,
                "radius compensation") ||
           left(StandardGroup::Cycle, before.cycleActive(dialect), after.cycleActive(dialect),
                Action::CycleCancel, "a cycle");
  }

  /// A mirror, shift or rotation that was not on where the program was called.
  static void framesAtCall(RuleContext &ctx) {
    const MachineState &before = ctx.before(), &after = ctx.after();
    for (unsigned i = 0; i < ctx.dialect().switches.size(); ++i) {
      const SwitchInfo &info = ctx.dialect().switches[i];
      if (info.leftOn != "coordinate-frame-left-on" || before.switchMayBeOn(i) ||
          !after.switchMustBeOn(i))
        continue;
      if (auto finding = ctx.report(ctx.blockRange()))
        finding
            .message("the called program comes back with {0} on: the caller goes on with it",
                     info.title)
            .note(after.origin.ofSwitch(i), "it is switched on here and not off");
      return;
    }
  }

  bool atCall_ = false;
  /// Reported where the called program changes the mode, whether or not the caller notices.
  static void atCause(const ModeChanges &changes, RuleContext &ctx) {
    for (unsigned i = 0; i < ctx.dialect().groups.size(); ++i) {
      const Origin &origin = ctx.after().origin.ofGroup(i);
      if (!(changes.groups >> i & 1) || !origin.known() ||
          (GroupIndex(i) == ctx.dialect().group(StandardGroup::Distance) &&
           saysEachTime(origin.range(), ctx) && !isReliedOn(changes, ctx)))
        continue;
      const bool distances = GroupIndex(i) == ctx.dialect().group(StandardGroup::Distance) &&
                             ctx.after().isActive(ctx.dialect(), StandardGroup::Distance,
                                                  {Action::Incremental}) == Truth::Yes;
      auto finding = ctx.report(origin.range());
      if (finding && distances && isReliedOn(changes, ctx))
        finding.severity(Severity::Warning)
            .message("the {0} is set here and not set back: the caller's coordinates become "
                     "distances",
                     ctx.dialect().groups[i].title)
            .note(ctx.blockRange(), "called here");
      else if (finding)
        finding
            .message("the {0} is set here and not set back: the caller goes on with it",
                     ctx.dialect().groups[i].title)
            .note(ctx.blockRange(), "called here");
    }
  }

  bool atCause_ = false;
  uint64_t watched_ = 0, initial_ = 0;
};

} // namespace
NCVET_RULE(FlowSubprogramLeavesState, flow_subprogram_leaves_state)
} // namespace ncvet
