// A cycle begins below its retraction plane, at the part.
#include "analyzer/facts/lookahead.h"
#include "formats/text/number_text.h"

#include <array>

namespace ncvet {
namespace {

class CycleApproachTooLow final : public Rule {
public:
  void listen(Subscriptions &to) override {
    const bool planes = to.dialect().cycleSurvivesMotion;
    if (llvm::any_of(to.dialect().codes, [&](const CodeInfo &code) {
          return code.cycle == CycleKind::Pocket || code.cycle == CycleKind::Contour ||
                 (planes && makesHole(code.cycle) && hasPlaneVariable(code));
        }))
      to.on(EventKind::CycleRun);
    if (llvm::any_of(to.dialect().codes, [](const CodeInfo &code) {
          return makesHole(code.cycle) && !code.words.empty() && code.words.front().position;
        }))
      to.on(EventKind::CycleStart);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const CodeInfo &code = ctx.code(event);
    if (makesHole(code.cycle))
      return hasPlaneVariable(code) ? wayToHole(event, code, ctx) : belowSurface(event, code, ctx);
    if (event.kind != EventKind::CycleRun || !hasPlanes(code))
      return;
    const std::array<const Word *, 3> words = planesOf(code, ctx);
    const auto unit = millimetresPer(ctx.dialect(), ctx.before());
    const Axis tool = toolAxis(ctx.dialect(), ctx.before());
    const Interval &from = ctx.before().at(tool);
    if (!words[0] || !words[1] || !unit || !from.isConstant() || mayBeDiameter(tool, ctx) ||
        ctx.before().inMachineCoordinates(tool))
      return;
    // From anywhere above the part the path up is free.
    const Interval part = ctx.value(*words[1]);
    const Interval distance = words[2] ? ctx.value(*words[2]) : Interval::exactly(0);
    const Interval level = part + distance;
    if (!level.isConstant() || from.value() >= level.value() * *unit - 1e-6)
      return belowRetract(event, *words[0], from.value() / *unit, ctx);
    // A retraction plane that is itself no higher is the mistake, and another rule's.
    if (const Interval retract = ctx.value(*words[0]); retract.hi < level.lo)
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding.message("`{0}` begins at {1}, below its retraction plane {2} and inside the safety "
                      "distance: the path to its first point is not free",
                      code.name, shortNumber(from.value() / *unit), ctx.text(*words[0]));
  }

private:
  /// A turning cycle, which has no depth below a plane, finds its own way to the contour.
  static bool hasPlanes(const CodeInfo &code) {
    return code.cycle == CycleKind::Pocket ||
           (code.cycle == CycleKind::Contour && llvm::any_of(code.words, [](const WordSpec &spec) {
              return spec.role == Role::Depth;
            }));
  }

  /// The retraction plane is the first argument after the name of the contour; the plane of the
  /// part and the safety distance above it follow.
  static std::array<const Word *, 3> planesOf(const CodeInfo &code, const RuleContext &ctx) {
    std::array<const WordSpec *, 3> specs{};
    for (const WordSpec &spec : code.words)
      if (spec.position && !spec.text) {
        const WordSpec *next = &spec;
        for (const WordSpec *&held : specs)
          if (next && (!held || next->position < held->position))
            std::swap(held, next);
      }
    std::array<const Word *, 3> words{};
    for (size_t i = 0; i < specs.size(); ++i)
      words[i] = specs[i] ? wordFor(ctx.block(), *specs[i]) : nullptr;
    return words;
  }

  /// Levels along X may be diameters, as its coordinates are.
  static bool mayBeDiameter(Axis tool, const RuleContext &ctx) {
    return tool == Axis::X && ctx.dialect().group(StandardGroup::Diameter) != noGroup;
  }

  /// The tool is below the surface in which the holes begin, where the cycle is called.
  static void belowSurface(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    const std::array<const Word *, 3> words = planesOf(code, ctx);
    const Axis tool = toolAxis(ctx.dialect(), before);
    const Interval &from = before.at(tool);
    const auto unit = millimetresPer(ctx.dialect(), before);
    if (!words[0] || !words[1] || !unit || !from.isConstant() || !event.certain ||
        mayBeDiameter(tool, ctx) || !ctx.codeWord(event) || before.inMachineCoordinates(tool) ||
        (axesOf(ctx.dialect(), ctx.block()) >> unsigned(tool) & 1) ||
        before.may(Fact::UnknownCode) || before.profile != ProfileMode::Off)
      return;
    const Interval retract = ctx.value(*words[0]), part = ctx.value(*words[1]);
    if (!part.isConstant() || !(retract.lo > part.value()) ||
        from.value() >= part.value() * *unit - 1e-6)
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` is called at {1}, below the surface {2} in which its hole begins: the "
                   "path to the hole is not free",
                   code.name, shortNumber(from.value() / *unit), ctx.text(*words[1]));
  }

  /// Above the part, but lower than the plane at which the cycle goes to its first point.
  static void belowRetract(const Event &event, const Word &retract, double from, RuleContext &ctx) {
    const Interval level = ctx.value(retract);
    if (!level.isConstant() || from >= level.value() - 1e-6 || !ctx.asked())
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding.severity(Severity::Style)
          .message("`{0}` begins at {1}, below its retraction plane {2}: the path to its first "
                   "point is meant to be free at that height",
                   ctx.code(event).name, shortNumber(from), ctx.text(retract));
  }

  static bool hasPlaneVariable(const CodeInfo &code) {
    return llvm::any_of(code.words, [](const WordSpec &spec) {
      return spec.role == Role::Retract && spec.variable;
    });
  }

  /// A drilling cycle whose planes are parameters goes to its hole at the level where it is,
  /// and only then to its start plane.
  static void wayToHole(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    if (event.kind != EventKind::CycleRun)
      return;
    const Axis tool = toolAxis(ctx.dialect(), ctx.before());
    const Interval &from = ctx.before().at(tool);
    if (!ctx.dialect().cycleSurvivesMotion || !from.isConstant() || !hasPlaneVariable(code) ||
        comesFromBelow(ctx.before()))
      return;
    const auto unit = millimetresPer(ctx.dialect(), ctx.before());
    const auto start = kept(ctx.after(), code, Role::Retract);
    if (!unit || !start || ctx.before().inMachineCoordinates(tool) ||
        (axesOf(ctx.dialect(), ctx.block()) >> unsigned(tool) & 1) ||
        !(event.axes & ~(1u << unsigned(tool))) || from.value() >= *start * *unit - 1e-6)
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding.severity(Severity::Warning)
          .message("the path to this hole of `{0}` is made at {1}, below the start plane {2}",
                   code.name, shortNumber(from.value() / *unit), shortNumber(*start));
  }
};

} // namespace
NCVET_RULE(CycleApproachTooLow, cycle_approach_too_low)
} // namespace ncvet
