// The blocks that a turning cycle names as its profile do not exist or are in the wrong order.
#include "analyzer/facts/cause_place.h"
#include "analyzer/program/references.h"
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class TurningProfileRangeUndefined final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::FlowIssue);
    for (size_t i = 0; i < to.dialect().switches.size(); ++i)
      if (to.dialect().switches[i].id == "contour")
        called_ = unsigned(i);
    if (called_)
      to.onCode([](const CodeInfo &code) { return contourName(code) != nullptr; });
    if (to.dialect().facts->turning.profileAfterCycle)
      to.on(EventKind::CycleRun);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code)
      return ofCalledContour(event, ctx);
    if (event.kind == EventKind::CycleRun)
      return beforeProfile(event, ctx);
    const auto issue = event.flowIssue();
    if (issue != FlowIssue::ProfileMissing && issue != FlowIssue::ProfileReversed)
      return;
    const Flow &flow = ctx.outcome().flow;
    const std::string name =
        flow.code == noCode ? std::string("the cycle") : ctx.dialect().codes[flow.code].name;
    if (issue == FlowIssue::ProfileReversed) {
      if (auto finding = ctx.report(ctx.flowRange()))
        finding.message(flow.first == flow.last
                            ? "`{0}` names N{1} as the first and the last block of its profile"
                            : "`{0}` names a profile from N{1} to N{2}, but N{2} is before N{1}",
                        name, flow.first, flow.last);
      return;
    }
    // A finishing cycle along the profile of the roughing cycle before says it once more.
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    if (flow.code != noCode && ctx.dialect().codes[flow.code].cycle == CycleKind::Finish &&
        roughingLacksIt(program, ctx))
      return;
    const bool noFirst =
        !resolveBlock(ctx.index(), program, Reference::toBlock(flow.first), ctx.block().begin);
    if (auto finding = ctx.report(ctx.flowRange()))
      finding.message(
          "`{0}` names N{1} as the {2} block of its profile, and this program has no such "
          "block",
          name, noFirst ? flow.first : flow.last, noFirst ? "first" : "last");
  }

private:
  /// Whether the roughing cycle before names the same blocks and did not find them either.
  static bool roughingLacksIt(const ProgramInfo &program, const RuleContext &ctx) {
    const Flow &flow = ctx.outcome().flow;
    const Origin &roughing = ctx.before().origin.of(StatePart::Roughing);
    return ctx.before().roughFirst == flow.first && ctx.before().roughLast == flow.last &&
           isIn(ctx, roughing, program) &&
           !resolveProfile(ctx.index(), program, Reference::toBlock(flow.first),
                           Reference::toBlock(flow.last), roughing.begin)
                .areInOrder();
  }

  /// The word of a cycle that names its contour, or null.
  static const WordSpec *contourName(const CodeInfo &code) {
    for (const WordSpec &spec : code.words)
      if (spec.text && spec.role == Role::Program && spec.position == 1)
        return &spec;
    return nullptr;
  }

  /// `CYCLE72("",...)` works along the contour that another block has called.
  void ofCalledContour(const Event &event, RuleContext &ctx) const {
    const WordSpec *const name = contourName(ctx.code(event));
    const MachineState &before = ctx.before();
    if (before.switchMayBeOn(*called_) || before.may(Fact::UnknownCode) || ctx.callDepth() > 0)
      return;
    for (const Item &item : ctx.block().items) {
      if (item.kind != ItemKind::Instruction || item.begin != event.word->offset ||
          item.arguments < name->position)
        continue;
      const Argument &argument = ctx.block().argumentsOf(item)[name->position - 1u];
      if (argument.kind != ArgumentKind::Text || argument.end > argument.begin)
        continue;
      if (auto finding = ctx.report(event, event.certain))
        finding.message("`{0}` has no name for its contour, and none was called before",
                        ctx.code(event).name);
    }
  }

  std::optional<unsigned> called_; ///< the switch of a contour that a block calls for the cycles

  /// Roughing goes on after its contour; finishing may look back.
  static void beforeProfile(const Event &event, RuleContext &ctx) {
    const Flow &flow = ctx.outcome().flow;
    if (flow.kind != FlowKind::Profile || event.code == noCode ||
        ctx.code(event).cycle == CycleKind::Finish || flow.first < 0 || flow.last < 0)
      return;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    const auto begin =
        resolveBlock(ctx.index(), program, Reference::toBlock(flow.first), ctx.block().begin);
    const auto end =
        resolveBlock(ctx.index(), program, Reference::toBlock(flow.last), ctx.block().begin);
    if (!begin || !end || *begin >= ctx.block().begin || *end < *begin || *end >= ctx.block().begin)
      return;
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding
          .message("the contour N{1} to N{2} is before `{0}`, which looks for it after itself",
                   ctx.code(event).name, flow.first, flow.last)
          .severity(Severity::Warning);
  }
};

} // namespace
NCVET_RULE(TurningProfileRangeUndefined, turning_profile_range_undefined)
} // namespace ncvet
