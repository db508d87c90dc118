// Radius compensation that is still on at a tool change, a return, the end or the next contour.
#include "analyzer/facts/after_calls.h"
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/references.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

#include <map>

namespace ncvet {
namespace {

struct CompensationLeftOnMemory {
  /// Last block of a profile (file, offset) → offset of its first, number of its last.
  std::map<std::pair<FileId, uint32_t>, std::pair<uint32_t, int64_t>> profiles;
  bool retracted = false; ///< the tool was lifted at rapid while compensation was on
  Origin told;            ///< where the compensation began that was reported last
  /// File and begin of the program that it was reported in, and how deep its call was: a local
  /// subprogram is of the same one.
  std::pair<std::pair<FileId, uint32_t>, unsigned> toldIn;
};

class CompensationLeftOn final : public StatefulRule<CompensationLeftOnMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::ToolChange, EventKind::ProgramEnd, EventKind::Return,
                 EventKind::CycleRun, EventKind::Block, EventKind::FlowIssue});
    to.onAction({Action::CompensationLeft, Action::CompensationRight, Action::CompensationOff,
                 Action::Reset});
    refusesChange_ = to.flag("refusesChange", true);
    if (to.dialect().facts->compensation.offAtStops)
      to.onAction({Action::ProgramStop, Action::OptionalStop});
    if (to.flag("atReference"))
      to.onAction({Action::ReferenceReturn});
    if (!to.dialect().isLathe())
      to.onMoves({MotionKind::Rapid});
    if (to.dialect().facts->tools.cuttingEdges)
      to.on(EventKind::OffsetWord);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    // It was told where the first of several tools came.
    const bool atTool = event.kind == EventKind::ToolChange || event.kind == EventKind::OffsetWord;
    if ((atTool || event.kind == EventKind::ProgramEnd) && outlivesTool(ctx.before()))
      return;
    switch (event.kind) {
    case EventKind::CycleRun:
      rememberProfile(ctx);
      return;
    case EventKind::Block:
      atProfileEnd(event, ctx);
      return;
    case EventKind::Code:
      if (ctx.code(event).action == Action::Reset)
        return atReset(event, ctx);
      if (ctx.code(event).action == Action::ProgramStop ||
          ctx.code(event).action == Action::OptionalStop)
        leftOn(event, "the program stops", Severity::Warning, ctx);
      else if (ctx.code(event).action == Action::ReferenceReturn)
        leftOn(event, "the tool goes home", Severity::Warning, ctx);
      else
        onceMore(event, ctx);
      return;
    case EventKind::Motion:
      if (ctx.before().compensationActive(ctx.dialect()) != Truth::Yes)
        return sleepInShape();
      memory().retracted |= isRetract(ctx);
      return;
    case EventKind::ToolChange:
      if (ctx.after().profile == ProfileMode::Off && !staysOrBegins(ctx))
        leftOn(event, "the tool is changed",
               refusesChange_ ? std::optional(Severity::Error) : std::nullopt, ctx);
      return;
    case EventKind::OffsetWord:
      if (ctx.after().profile == ProfileMode::Off &&
          ctx.before().compensationActive(ctx.dialect()) == Truth::Yes &&
          !ctx.find({Action::ToolChange}) && ctx.before().radiusOffset != ctx.after().radiusOffset)
        leftOn(event, "the tool's edge changes", Severity::Style, ctx); // may be meant
      return;
    case EventKind::ProgramEnd:
      leftOn(event, "the program ends", std::nullopt, ctx);
      return;
    case EventKind::FlowIssue:
      runsOut(event, ctx);
      return;
    default:
      // A subprogram called under compensation may return under it; of a profile that is
      // recorded another rule speaks.
      if (ctx.after().profile == ProfileMode::Off &&
          switchedOnIn(ctx.index().programAt(ctx.block().begin), ctx) && !callersLeave(ctx))
        leftOn(event, "the program returns", std::nullopt, ctx);
    }
  }

private:
  /// The tool is the one that is in use, with another offset; or compensation is for the new tool.
  static bool staysOrBegins(const RuleContext &ctx) {
    const MachineState &before = ctx.before();
    return (before.tool != notSet && before.tool == ctx.after().tool &&
            !ctx.find({Action::ToolChange})) ||
           (before.compensationActive(ctx.dialect()) == Truth::No &&
            ctx.find({Action::CompensationLeft, Action::CompensationRight}));
  }

  static std::string nameOf(RuleContext &ctx) {
    const CodeInfo *code = ctx.after().activeCode(ctx.dialect(), StandardGroup::Compensation);
    return code ? "`" + code->name + "`" : "radius compensation";
  }

  /// A file that says itself to be a subprogram, and whose text ends without a return.
  static void runsOut(const Event &event, RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.flowRange().begin);
    const Truth active = ctx.after().compensationActive(ctx.dialect());
    if (event.flowIssue() != FlowIssue::MainRunsOut || program.kind != ProgramKind::Subprogram ||
        active == Truth::No || !switchedOnIn(program, ctx))
      return;
    if (auto finding = ctx.report(ctx.flowRange(), active == Truth::Yes && event.certain)) {
      finding.message("the program ends with {0} still on", nameOf(ctx));
      describe(finding, ctx);
    }
  }

  /// A reset in the middle of the program takes compensation away without leaving the contour.
  static void atReset(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    const CodeInfo *code = before.activeCode(ctx.dialect(), StandardGroup::Compensation);
    if (before.compensationActive(ctx.dialect()) != Truth::Yes || !code ||
        before.may(Fact::UnknownCode) || before.profile != ProfileMode::Off)
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` resets the control with `{1}` still on: compensation ends without a move",
                   ctx.text(*event.word), code->name)
          .note(before.origin.of(StatePart::Compensation), "it is switched on here");
  }

  /// Whether every caller cuts on along the contour that this program has approached, and switches
  /// compensation off before anything else.
  bool callersLeave(const RuleContext &ctx) const {
    const Dialect &dialect = ctx.dialect();
    // Where what a program sets outlives its return, it has to end what it has begun.
    if (dialect.facts->program.modesOutliveReturn)
      return false;
    const bool cuts =
        ctx.after().isActive(dialect, StandardGroup::Motion,
                             {Action::Linear, Action::ArcCw, Action::ArcCcw}) == Truth::Yes;
    bool feeding = cuts;
    const auto judge = [&](const Block &block) {
      if (findCode(dialect, block, {Action::CompensationOff}))
        return AfterCall::Ends;
      for (const Word &word : block.words) {
        if (dialect.addresses[word.address].kind != AddressKind::Code)
          continue;
        const CodeIndex code = codeOf(dialect, word);
        switch (code == noCode ? Action::None : dialect.codes[code].action) {
        case Action::Linear:
        case Action::ArcCw:
        case Action::ArcCcw:
          feeding = true;
          break;
        case Action::CoolantOn:
        case Action::CoolantOff:
        case Action::OptionalStop:
          break;
        default:
          return AfterCall::Relies;
        }
      }
      const bool moves = block.hasAny(dialect.axisWords);
      return (moves && !feeding) || block.has(letterAddress('T')) ? AfterCall::Relies
                                                                  : AfterCall::GoesOn;
    };
    return afterCalls_.allEnd(
        cuts, ctx, [&] { feeding = cuts; }, judge);
  }
  AfterCalls afterCalls_;
  bool refusesChange_ = true; ///< the control stops at a change of the tool

  static bool switchedOnIn(const ProgramInfo &program, RuleContext &ctx) {
    return isIn(ctx, ctx.after().origin.of(StatePart::Compensation), program);
  }

  /// Once for each compensation and program: what comes after is of the same cause.
  void leftOn(const Event &event, const char *when, std::optional<Severity> severity,
              RuleContext &ctx) const {
    const Truth active = ctx.after().compensationActive(ctx.dialect());
    const Origin &begin = ctx.after().origin.of(StatePart::Compensation);
    const std::pair here{
        std::pair{ctx.source().id(), ctx.index().programAt(ctx.block().begin).begin},
        unsigned(ctx.callDepth())};
    if (active == Truth::No || !begin.known() || outlivesTool(ctx.before()) ||
        (begin == memory().told && here == memory().toldIn))
      return;
    memory().told = begin;
    memory().toldIn = here;
    if (auto finding = ctx.report(event, active == Truth::Yes && event.certain)) {
      finding.message("{0} with {1} still on", when, nameOf(ctx)).severity(severity);
      describe(finding, ctx);
      const std::string off = compensationOffCode(ctx.dialect(), ctx.after());
      // At the end no move comes that would take the offset away.
      if (event.kind != EventKind::ToolChange && event.kind != EventKind::OffsetWord &&
          event.kind != EventKind::ProgramEnd && event.kind != EventKind::Return)
        finding.fix(FixSafety::Unsafe, "insert `" + off + "` before this block",
                    ctx.insertBlockBefore(off));
    }
  }

  /// A rapid move up under compensation.
  static bool isRetract(const RuleContext &ctx) {
    const Interval &from = ctx.before().at(Axis::Z), &to = ctx.after().at(Axis::Z);
    return from.isConstant() && to.isConstant() && to.value() > from.value() &&
           ctx.before().compensationActive(ctx.dialect()) == Truth::Yes &&
           ctx.after().profile == ProfileMode::Off;
  }

  /// Compensation is switched on for the next contour, and that of the last one was never
  /// cancelled: the tool came down beside its place.
  void onceMore(const Event &event, RuleContext &ctx) const {
    const MachineState &before = ctx.before();
    const CodeInfo *active = before.activeCode(ctx.dialect(), StandardGroup::Compensation);
    const bool same = active && active->action == ctx.code(event).action &&
                      before.compensationActive(ctx.dialect()) == Truth::Yes;
    if (!std::exchange(memory().retracted, false) || !same || !event.certain ||
        ctx.after().profile != ProfileMode::Off || before.may(Fact::UnknownCode))
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message(
              "`{0}` is switched on again, and was not cancelled after the contour before: the "
              "tool came down beside its place",
              active->name)
          .note(before.origin.of(StatePart::Compensation), "it is switched on here");
  }

  static void describe(FindingBuilder &finding, RuleContext &ctx) {
    finding.note(ctx.after().origin.of(StatePart::Compensation),
                 nameOf(ctx) + " is switched on here");
  }

  /// A cycle that reads a profile: its last block is where compensation has to be off again.
  void rememberProfile(RuleContext &ctx) const {
    const Flow &flow = ctx.outcome().flow;
    if (flow.kind != FlowKind::Profile)
      return sleepInShape();
    if (flow.first < 0 || flow.last < 0)
      return;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    const auto [first, last] = resolveProfile(ctx.index(), program, Reference::toBlock(flow.first),
                                              Reference::toBlock(flow.last), ctx.block().begin);
    if (first && last)
      memory().profiles[{ctx.source().id(), *last}] = {*first, flow.last};
  }

  void atProfileEnd(const Event &event, RuleContext &ctx) const {
    if (ctx.before().profile == ProfileMode::Off)
      return sleepInShape();
    const auto found = memory().profiles.find({ctx.source().id(), ctx.block().begin});
    if (found == memory().profiles.end())
      return;
    const Truth active = ctx.after().compensationActive(ctx.dialect());
    const Origin &origin = ctx.after().origin.of(StatePart::Compensation);
    // Only what the contour itself has switched on; the rest is the program's.
    if (active == Truth::No || !isHere(ctx, origin) || origin.begin < found->second.first ||
        origin.begin > ctx.block().end)
      return;
    if (auto finding = ctx.report(ctx.blockRange(), active == Truth::Yes && event.certain)) {
      finding.message("the contour ends in N{0} with {1} still on: the cycle returns under "
                      "compensation",
                      found->second.second, nameOf(ctx));
      if (endsNext(ctx))
        finding.severity(Severity::Style);
      describe(finding, ctx);
    }
  }

  /// The first move after the contour, which is the one away from the part, switches it off.
  static bool endsNext(const RuleContext &ctx) {
    constexpr unsigned furthest = 10; // blocks: the finishing cycle, the coolant, the spindle
    const Dialect &dialect = ctx.dialect();
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &next :
         blocks(ctx.index().reader(), ctx.block().next, program.end, furthest)) {
      if (findCode(dialect, next, {Action::CompensationOff}))
        return true;
      if (next.hasAny(dialect.axisWords))
        return false;
    }
    return false;
  }
};

} // namespace
NCVET_RULE(CompensationLeftOn, compensation_left_on)
} // namespace ncvet
