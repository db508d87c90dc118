// The finishing cycle runs along other blocks, or starts elsewhere, than the roughing before it.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/turning_profile.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "formats/text/number_text.h"

#include <cmath>

namespace ncvet {
namespace {

class TurningFinishMismatch final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    sameStart_ = to.dialect().facts->turning.finishStartsAtRoughing;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || ctx.outcome().flow.kind != FlowKind::Profile ||
        ctx.code(event).cycle != CycleKind::Finish)
      return sleepInShape();
    const CodeInfo &cycle = ctx.code(event);
    const Flow &flow = ctx.outcome().flow;
    const MachineState &before = ctx.before();
    if (before.roughFirst < 0 || before.roughLast < 0 || flow.first < 0 || flow.last < 0)
      return;
    if (flow.first == before.roughFirst && flow.last == before.roughLast) {
      if (startsInside(event, cycle, ctx))
        return;
      if (sameStart_)
        checkStart(event, cycle, ctx);
      return;
    }
    // Another profile altogether is finished for itself, unless nobody has roughed it.
    const bool related = flow.first == before.roughFirst || flow.last == before.roughLast;
    if (!related && isRoughed(ctx, flow.first))
      return;
    if (auto finding = ctx.report(event, event.certain && related))
      finding
          .message(
              "`{0}` finishes N{1} to N{2}, but the roughing of line {3} worked along N{4} to N{5}",
              cycle.name, flow.first, flow.last, lineOf(ctx, before.origin.of(StatePart::Roughing)),
              before.roughFirst, before.roughLast)
          .note(before.origin.of(StatePart::Roughing), "the roughing cycle");
  }

private:
  /// Whether some roughing cycle of the program names `first` as its first block.
  static bool isRoughed(const RuleContext &ctx, int64_t first) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &block : blocks(ctx.index(), program.body, program.end)) {
      if (block.begin == ctx.block().begin || !block.has(letterAddress('P')))
        continue;
      const Word *p = block.find('P');
      if (!p->isNumber() || p->value() != double(first))
        continue;
      for (const Word &word : block.words) {
        if (word.address != letterAddress('G') || !word.isNumber())
          continue;
        const CodeIndex index = ctx.dialect().find('G', word.codeNumber());
        if (index == noCode)
          continue;
        for (const CodeInfo &code : ctx.dialect().codes)
          if (code.letter == 'G' && code.number == ctx.dialect().codes[index].number &&
              roughsProfile(code.cycle))
            return true;
      }
    }
    return false;
  }

  /// The finishing begins beside the contour, past the face before which the roughing began: the
  /// tool has come there through what roughing has left.
  static bool startsInside(const Event &event, const CodeInfo &cycle, RuleContext &ctx) {
    constexpr double least = 0.5; // mm
    const MachineState &before = ctx.before();
    const Interval &x = before.at(Axis::X), &z = before.at(Axis::Z);
    const Interval &was = before.roughStart[0], &front = before.roughStart[1];
    const auto unit = millimetresPer(ctx.dialect(), before);
    if (!event.certain || !x.isConstant() || !z.isConstant() || !was.isConstant() || !unit ||
        !front.isConstant() || front.value() <= 0 || z.value() >= 0 ||
        before.inMachineCoordinates(Axis::X) || before.inMachineCoordinates(Axis::Z))
      return false;
    const Profile profile = readProfile(ctx);
    if (!profile.known || !profile.minX || !profile.maxX || !profile.minZ ||
        z.value() < *profile.minZ)
      return false;
    const bool outside = was.value() >= *profile.maxX, inside = was.value() <= *profile.minX;
    if (outside == inside ||
        (outside ? x.value() > *profile.maxX - least : x.value() < *profile.minX + least))
      return false;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` starts at X{1} Z{2}, beside the contour and not before it: the tool goes "
                   "there through what roughing has left",
                   cycle.name, shortNumber(x.value() / *unit), shortNumber(z.value() / *unit))
          .note(before.origin.of(StatePart::Roughing), "the roughing cycle");
    return true;
  }

  static void checkStart(const Event &event, const CodeInfo &cycle, RuleContext &ctx) {
    constexpr double least = 0.5; // mm
    const MachineState &before = ctx.before();
    const auto unit = millimetresPer(ctx.dialect(), before);
    if (!unit)
      return;
    for (const Axis axis : {Axis::X, Axis::Z}) {
      const Interval &was = before.roughStart[axis == Axis::X ? 0 : 1];
      const Interval &is = before.at(axis);
      if (!was.isConstant() || !is.isConstant() || before.inMachineCoordinates(axis) ||
          std::fabs(was.value() - is.value()) < least)
        continue;
      if (auto finding = ctx.report(event, event.certain))
        finding
            .message("`{0}` starts at {1}{2}, the roughing of line {3} started at {1}{4}: the tool "
                     "returns to its own start",
                     cycle.name, axis == Axis::X ? "X" : "Z", shortNumber(is.value() / *unit),
                     lineOf(ctx, before.origin.of(StatePart::Roughing)),
                     shortNumber(was.value() / *unit))
            .note(before.origin.of(StatePart::Roughing), "the roughing cycle");
      return;
    }
  }

  bool sameStart_ = false;
};

} // namespace
NCVET_RULE(TurningFinishMismatch, turning_finish_mismatch)
} // namespace ncvet
