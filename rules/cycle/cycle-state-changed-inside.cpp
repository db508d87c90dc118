// A code that is not known to cancel a drilling cycle, while the cycle is active.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/report_once.h"
#include "formats/dialect/control_facts.h"

#include <set>

namespace ncvet {
namespace {

struct CycleStateChangedInsideMemory {
  OncePerCause once;
};

class CycleStateChangedInside final : public StatefulRule<CycleStateChangedInsideMemory> {
public:
  void listen(Subscriptions &to) override {
    const GroupIndex cycles = to.dialect().group(StandardGroup::Cycle);
    if (cycles == noGroup)
      return;
    goesOn_ = to.dialect().cycleSurvivesMotion;
    cycles_ = cycles;
    for (const std::string &name : to.dialect().axisVariables)
      axes_.insert(variableKey(name));
    for (const CodeInfo &code : to.dialect().codes)
      for (const WordSpec &spec : code.words)
        axes_.erase(spec.variable); // it is one cycle's own
    const bool replaces = to.dialect().facts->cycles.newCallReplaces;
    to.onCode([&](const CodeInfo &code) {
      if (goesOn_)
        return changes(code.action) || shifts(code) ||
               (!replaces && code.action == Action::Cycle && code.base != noCode &&
                code.cycle != CycleKind::Pattern);
      return !code.cancelsCycle && code.group != cycles &&
             (isMotion(code.action) || code.action == Action::Cycle);
    });
    if (goesOn_)
      to.on(EventKind::CycleRun);
    if (to.dialect().facts->cycles.valuesInVariables)
      to.on(EventKind::Statement);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &before = ctx.before();
    const CodeInfo *cycle = before.activeCode(ctx.dialect(), StandardGroup::Cycle);
    if (event.kind == EventKind::CycleRun && before.cycleActive(ctx.dialect()) == Truth::No)
      return called(event, ctx);
    if (!cycle || cycle->action != Action::Cycle ||
        !(makesHole(cycle->cycle) || cycle->firesInPlane) || ctx.find({Action::CycleCancel}) ||
        (cycleOutlivesTool(before) && !ctx.find({Action::Cycle})))
      return;
    if (event.kind == EventKind::Statement)
      return assigned(ctx.block().items[event.item()], *cycle, ctx);
    if (event.kind == EventKind::CycleRun) {
      if (makesHole(cycle->cycle))
        running(*cycle, ctx);
      return;
    }
    const CodeInfo &code = ctx.code(event);
    // A pattern runs the active cycle at each of its places.
    if (&code == cycle || code.cycle == CycleKind::Pattern ||
        (isArc(code.action) && !makesHole(cycle->cycle)))
      return;
    // One of the same family ends the one before, one that is called leaves it what it is.
    const bool families = !cycle->family.empty() && code.action == Action::Cycle;
    if (families && (code.family == cycle->family || code.group != cycles_))
      return;
    // That a block that moves nowhere runs the cycle weighs more, and is a rule of its own.
    if (ctx.dialect().emptyBlocksRun && code.action != Action::Cycle && !shifts(code) &&
        !axesOf(ctx.dialect(), ctx.block()))
      return;
    // What states the plane once more changes nothing.
    if (code.group != noGroup && code.group == ctx.dialect().group(StandardGroup::Plane) &&
        before.group(code.group) == uint64_t(1) << code.bit)
      return;
    auto finding = ctx.report(event);
    if (!finding)
      return;
    const std::string cancel = cancelOf(ctx.dialect(), *cycle);
    if (!goesOn_)
      finding.message(
          "`{0}` is written while `{1}` of line {2} is active: it is not documented that it "
          "cancels the cycle",
          code.name, cycle->name, lineOf(ctx, before.origin.of(StatePart::Cycle)));
    else if (code.action == Action::Cycle)
      finding.severity(families ? Severity::Warning : Severity::Style)
          .message("`{0}` replaces `{1}` of line {2}: `{3}` in between says it clearly", code.name,
                   cycle->name, lineOf(ctx, before.origin.of(StatePart::Cycle)), cancel);
    else
      finding.severity(isArc(code.action) ? std::optional(Severity::Error) : Severity::Warning)
          .message(
              "`{0}` is written while `{1}` of line {2} is active: the cycle goes on in what it "
              "changes",
              code.name, cycle->name, lineOf(ctx, before.origin.of(StatePart::Cycle)));
    finding.note(before.origin.of(StatePart::Cycle), cycle->name + " becomes active here")
        .fix(FixSafety::Unsafe, "insert " + cancel + " before this block",
             ctx.insertBlockBefore(cancel));
  }

private:
  /// A variable that the active cycle reads gets another value.
  void assigned(const Item &item, const CodeInfo &cycle, RuleContext &ctx) const {
    if (item.kind == ItemKind::Assignment && axes_.count(ctx.block().keyOf(item.target)))
      return axis(item, cycle, ctx);
    if (makesHole(cycle.cycle))
      parameter(item, cycle, ctx);
  }

  /// The axis along which cycles work.
  static void axis(const Item &item, const CodeInfo &cycle, RuleContext &ctx) {
    const uint64_t key = ctx.block().keyOf(item.target);
    const Value was = ctx.before().commons.get(key), now = ctx.after().commons.get(key);
    if (!was.isConstant() || !now.isConstant() || was.number.value() == now.number.value())
      return;
    const SourceRange range = ctx.range(item);
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Warning)
          .message("`{0}` changes the axis under `{1}` of line {2}, which is active",
                   ctx.text(range), cycle.name,
                   lineOf(ctx, ctx.before().origin.of(StatePart::Cycle)))
          .note(ctx.before().origin.of(StatePart::Cycle), cycle.name + " becomes active here");
  }

  /// A parameter of the active cycle gets another value between its holes.
  static void parameter(const Item &item, const CodeInfo &cycle, RuleContext &ctx) {
    if (item.kind != ItemKind::Assignment || ctx.find({Action::Cycle}))
      return;
    const uint64_t key = ctx.block().keyOf(item.target);
    for (const WordSpec &spec : cycle.words) {
      if (!spec.variable || spec.variable != key)
        continue;
      const SourceRange range = ctx.range(item);
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Warning)
            .message("`{0}` changes `{1}` of line {2} between its holes", ctx.text(range),
                     cycle.name, lineOf(ctx, ctx.before().origin.of(StatePart::Cycle)))
            .note(ctx.before().origin.of(StatePart::Cycle), cycle.name + " becomes active here");
      return;
    }
  }

  /// What turns or moves the system in which a cycle's planes are given, and arcs.
  static bool changes(Action action) {
    switch (action) {
    case Action::PlaneXY:
    case Action::PlaneZX:
    case Action::PlaneYZ:
    case Action::WorkOffset:
    case Action::ArcCw:
    case Action::ArcCcw:
      return true;
    default:
      return false;
    }
  }

  /// A call that shifts the coordinates without being a code of a group.
  static bool shifts(const CodeInfo &code) {
    return code.action == Action::Switch &&
           llvm::any_of(code.words, [](const WordSpec &w) { return w.role == Role::Shift; });
  }

  /// A later block of a cycle that goes on: its path to the hole, and its words.
  void running(const CodeInfo &cycle, RuleContext &ctx) const {
    const Axis tool = toolAxis(ctx.dialect(), ctx.after());
    for (const Word &word : ctx.block().words) {
      const AddressInfo &address = ctx.dialect().addresses[word.address];
      if (address.kind != AddressKind::Axis || address.axis != tool)
        continue;
      if (auto finding = ctx.report(word))
        finding.severity(Severity::Warning)
            .message("`{0}` says nothing to `{1}`: its planes are parameters of its own",
                     ctx.text(word), cycle.name);
    }
    if (cycle.firesOnEveryBlock && !axesOf(ctx.dialect(), ctx.block()) &&
        llvm::none_of(ctx.codes(), [&](const CodeUse &use) { return &ctx.code(use) == &cycle; }))
      if (const Word *word = assignsWordOf(ctx.block(), cycle))
        if (auto finding = ctx.report(*word))
          finding.severity(Severity::Warning)
              .message("`{0}` changes `{1}` in a block that moves nowhere: the last hole is made "
                       "again with it",
                       ctx.text(*word), cycle.name);
    const CodeInfo *motion = ctx.after().activeCode(ctx.dialect(), StandardGroup::Motion);
    if (motion && isArc(motion->action) && axesOf(ctx.dialect(), ctx.block())) {
      arrivesByArc(cycle, *motion, ctx);
      return;
    }
    // What holds after power-on the machine's settings decide.
    const GroupIndex group = ctx.dialect().group(StandardGroup::Motion);
    if (!motion || motion->action != Action::Linear || !ctx.after().mayBeStated(group) ||
        !axesOf(ctx.dialect(), ctx.block()) ||
        !memory().once.speaks(ctx.before().origin.of(StatePart::Cycle), ctx))
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding.severity(Severity::Warning)
          .message("the path to this hole of `{0}` is made at feed: `{1}` is active", cycle.name,
                   motion->name);
  }

  /// The block that calls the cycle: its path to the first hole.
  void called(const Event &event, RuleContext &ctx) const {
    const CodeInfo *motion = ctx.after().activeCode(ctx.dialect(), StandardGroup::Motion);
    if (event.code != noCode && makesHole(ctx.code(event).cycle) && motion &&
        ctx.code(event).group != noGroup && isArc(motion->action) &&
        axesOf(ctx.dialect(), ctx.block()))
      arrivesByArc(ctx.code(event), *motion, ctx);
  }

  /// An arc that was in force before the cycle leads to the hole; one in the block itself was
  /// spoken of already.
  void arrivesByArc(const CodeInfo &cycle, const CodeInfo &motion, RuleContext &ctx) const {
    const Origin origin = ctx.after().originOf(ctx.dialect(), StandardGroup::Motion);
    if (ctx.find({Action::ArcCw, Action::ArcCcw}) ||
        !memory().once.speaks(ctx.after().origin.of(StatePart::Cycle), ctx))
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding.severity(Severity::Error)
          .message("the path to this hole of `{0}` is an arc: `{1}` is still in force", cycle.name,
                   motion.name)
          .note(origin, "`" + motion.name + "` becomes active here");
  }

  bool goesOn_ = false; ///< motion codes do not end a cycle
  GroupIndex cycles_ = noGroup;
  std::set<uint64_t> axes_; ///< keys of variables that hold the axis of whatever cycle
};

} // namespace
NCVET_RULE(CycleStateChangedInside, cycle_state_changed_inside)
} // namespace ncvet
