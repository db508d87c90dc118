// A jump or a return names a block that does not exist.
#include "analyzer/facts/silent_program.h"
#include "analyzer/program/project.h"
#include "analyzer/program/references.h"
#include "formats/dialect/control_facts.h"
#include "formats/dialect/measure.h"

#include <map>

namespace ncvet {
namespace {

struct FlowUndefinedTargetMemory {
  /// A jump that was not taken where it was met.
  struct Untaken {
    SourceRange place;
    std::string name;
  };
  std::map<std::pair<FileId, uint32_t>, Untaken> untaken; ///< by their place
};

class FlowUndefinedTarget final : public StatefulRule<FlowUndefinedTargetMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::FlowIssue);
    to.onCode(
        [](const CodeInfo &code) { return !code.letter && llvm::any_of(code.words, isLabel); });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code)
      return labelsOfContour(event, ctx);
    if (event.flowIssue() != FlowIssue::UnknownBlock)
      return;
    const Flow &flow = ctx.outcome().flow;
    if (flow.kind == FlowKind::CallLocal &&
        !ctx.dialect().facts->program.callsBlocks) // other controls know it as a subprogram
      return;
    // Milled contours are programs as well as sections: told as a program that is not there.
    if (flow.kind == FlowKind::Contour && !isTurned(flow, ctx))
      return;
    // The block is one of the caller's, and who calls the program is not known here.
    if (flow.kind == FlowKind::Return && ctx.callDepth() == 0 && onlyReturns(ctx))
      return;
    const llvm::StringRef name = ctx.text(ctx.flowRange());
    // What decides may be another value the next time: a later pass, or another parameter at the
    // head of the program.
    const SourceRange named = ctx.flowRange();
    if (flow.condition == Truth::No) {
      memory().untaken.try_emplace({named.file, named.begin}, Memory::Untaken{named, name.str()});
      return;
    }
    auto finding = ctx.report(named, event.certain);
    if (!finding)
      return;
    if (flow.kind == FlowKind::Contour)
      finding.message("`{0}` is a contour between two labels, and this program does not have both: "
                      "the control stops here",
                      name);
    else if (const auto place = otherDirection(ctx))
      finding
          .message("the jump looks for `{0}` {1} itself only, and it is {2} it: the control stops "
                   "with an alarm",
                   name, place->begin < ctx.block().begin ? "after" : "before",
                   place->begin < ctx.block().begin ? "before" : "after")
          .note(*place, "it is here");
    else if (const auto numbered = inCaller(ctx))
      finding
          .message("`{0}` leads to a block of this program, and it has none with that number: the "
                   "control stops with an alarm",
                   name)
          .note(*numbered, "the caller has one, but this control does not return to it");
    else if (namesBlock(name, ctx))
      finding.message("`{0}` is the number of a block, and a label is due here: the control finds "
                      "no label of this name",
                      name);
    else
      finding.message("`{0}` leads to a block that is not there: the control stops with an alarm",
                      name);
  }

  /// Jumps of which no pass has taken any.
  void finish(const FileSummary &, RuleContext &ctx) const override {
    for (const auto &[place, jump] : memory().untaken)
      if (auto finding = ctx.report(jump.place))
        finding.severity(Severity::Warning)
            .message("`{0}` leads to a block that is not there: where its condition holds the "
                     "control stops with an alarm",
                     jump.name);
  }

  /// Whether the program has a block with this number where a label is looked for.
  static bool namesBlock(llvm::StringRef name, const RuleContext &ctx) {
    int64_t number = 0;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    return ctx.dialect().lexical.commaSeparates && name.consume_front_insensitive("N") &&
           !name.getAsInteger(10, number) &&
           ctx.index().block(program, number, program.body).has_value();
  }

  /// Whether the contour is one of a turning cycle.
  static bool isTurned(const Flow &flow, const RuleContext &ctx) {
    return flow.code != noCode && has(ctx.dialect().codes[flow.code], CycleTrait::TurnsContour);
  }

private:
  /// A text among the arguments of a word that names a label.
  static bool isLabel(const WordSpec &spec) {
    return spec.text && spec.role == Role::Sequence && spec.position > 0;
  }

  /// `CYCLE62("",2,"BEGIN1","END1")`: the labels of a contour in this program.
  static void labelsOfContour(const Event &event, RuleContext &ctx) {
    const CodeInfo &code = ctx.code(event);
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Item &item : ctx.block().items) {
      if (item.kind != ItemKind::Instruction || item.begin != event.word->offset)
        continue;
      for (const WordSpec &spec : code.words) {
        if (!isLabel(spec) || item.arguments < spec.position ||
            !holds(spec.when, &code, ctx.conditions()))
          continue;
        const Argument &argument = ctx.block().argumentsOf(item)[spec.position - 1u];
        const llvm::StringRef name = ctx.text(ctx.range(argument)).trim();
        if (argument.kind != ArgumentKind::Text || name.empty() ||
            ctx.index().label(program, name, ctx.block().begin))
          continue;
        if (auto finding = ctx.report(ctx.range(argument), event.certain))
          finding.message(
              "`{0}` is no label of this program, and `{1}` looks for its contour there: "
              "the control stops with an alarm",
              name, code.name);
        return;
      }
    }
  }

  /// Where the target is that a jump looks for in the other direction.
  static std::optional<SourceRange> otherDirection(const RuleContext &ctx) {
    const SourceRange named = ctx.flowRange();
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Item &item : ctx.block().items) {
      if (item.kind != ItemKind::Jump || named.begin < item.begin || named.end > item.end ||
          (item.jump != JumpKind::Forward && item.jump != JumpKind::Backward))
        continue;
      const llvm::StringRef text = ctx.text(named);
      int64_t number = 0;
      const auto place = text.ltrim("Nn:").getAsInteger(10, number)
                             ? ctx.index().label(program, text, ctx.block().begin)
                             : ctx.index().block(program, number, ctx.block().begin);
      if (place)
        return SourceRange{named.file, *place, *place + 1};
    }
    return std::nullopt;
  }

  /// The block of the caller with the number of a return that jumps in the program itself.
  static std::optional<SourceRange> inCaller(const RuleContext &ctx) {
    const Flow &flow = ctx.outcome().flow;
    const CallSite *const caller = ctx.caller();
    if (flow.item >= 0 || flow.kind != FlowKind::Jump || !flow.target.isConstant() || !caller ||
        !caller->unit || flow.code == noCode)
      return std::nullopt;
    const CodeIndex base = ctx.dialect().codes[flow.code].base;
    if (base == noCode || ctx.dialect().codes[base].action != Action::Return)
      return std::nullopt;
    const auto place = resolveBlock(caller->unit->index, *caller->program,
                                    Reference::toBlock(int64_t(flow.target.number.value())),
                                    caller->program->body);
    if (!place)
      return std::nullopt;
    return SourceRange{caller->unit->source.id(), *place, *place + 1};
  }
};

} // namespace
NCVET_RULE(FlowUndefinedTarget, flow_undefined_target)
} // namespace ncvet
