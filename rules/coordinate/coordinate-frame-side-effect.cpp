// An active scaling or mirror image changes more than it seems to.
#include "analyzer/facts/defined_elements.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <set>

namespace ncvet {
namespace {

struct CoordinateFrameSideEffectMemory {
  std::set<uint32_t> reported; ///< one finding for each scaling code
  DefinedElements elements;
};

class CoordinateFrameSideEffect final : public StatefulRule<CoordinateFrameSideEffectMemory> {
public:
  void listen(Subscriptions &to) override {
    const Dialect &dialect = to.dialect();
    if (dialect.group(StandardGroup::Scaling) != noGroup)
      to.onChange({EventKind::Motion, EventKind::CycleRun});
    if (dialect.elementWords) {
      to.onAction({Action::DefineElement, Action::FrameSet});
      to.onChange({EventKind::Motion});
    }
    for (const CodeInfo &code : dialect.codes)
      if (code.frame == FrameKind::MirrorAxes && code.effect.index != 0xFF && code.effect.on)
        switch_ = code.effect.index;
    if (dialect.group(StandardGroup::Mirror) != noGroup || switch_ != 0xFF)
      to.onAction({Action::CompensationLeft, Action::CompensationRight});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (ctx.block().hasAny(ctx.dialect().elementWords))
      element(ctx);
    if (event.kind == EventKind::Code && ctx.code(event).action == Action::FrameSet)
      return insideContour(event, ctx);
    if (event.kind == EventKind::Code)
      return mirror(event, ctx);
    const MachineState &state = ctx.after();
    if (state.isActive(ctx.dialect(), StandardGroup::Scaling, {Action::ScalingOn}) != Truth::Yes) {
      if (!ctx.block().hasAny(ctx.dialect().elementWords))
        sleepInShape();
      return;
    }
    const Axis tool = toolAxis(ctx.dialect(), state);
    const bool cuts = event.kind == EventKind::CycleRun || event.motion == MotionKind::Feed ||
                      (event.motion == MotionKind::Rapid && !event.inMachineCoordinates());
    if (ctx.dialect().isLathe() || !cuts || !(event.axes >> unsigned(tool) & 1))
      return;
    const Origin origin = state.originOf(ctx.dialect(), StandardGroup::Scaling);
    if (!memory().reported.insert(origin.begin).second)
      return;
    if (auto finding = ctx.report(event))
      finding.message("scaling is on: it changes the depth of this move too")
          .note(origin, "scaling begins here");
  }

private:
  /// The element before has no end of its own: it is solved with the next one, which lies in
  /// another frame.
  static void insideContour(const Event &event, RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    Block last;
    if (!readPrevious(ctx, last) || !last.hasAny(dialect.lineAngleWords) ||
        (axesOf(dialect, last) & planeAxes(dialect, ctx.before())) ||
        findCode(dialect, last, {Action::DefineElement, Action::FrameSet}))
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` inside a contour: the element before it is solved with the next one, "
                   "which alone is shifted and turned",
                   ctx.code(event).name);
  }

  /// An element keeps the shift and rotation that were on when it was defined.
  void element(RuleContext &ctx) const {
    if (const Word *word = DefinedElements::definedBy(ctx)) {
      memory().elements.define(*word, ctx);
      return;
    }
    uint32_t frames = 0;
    for (size_t i = 0; i < ctx.dialect().switches.size(); ++i)
      if (ctx.dialect().switches[i].leftOn == "coordinate-frame-left-on")
        frames |= 1u << i;
    for (const Word &word : ctx.block().words) {
      if (!(ctx.dialect().elementWords & maskOf(word.address)))
        continue;
      const DefinedElements::Element *element = memory().elements.find(word);
      if (!element)
        continue;
      const uint32_t then = frames & element->switches;
      if (!ctx.before().switches.areOn(frames & ~element->switches) &&
          (!then || ctx.before().switches.mayBeOn(then)))
        continue;
      if (auto finding = ctx.report(word))
        finding.severity(Severity::Warning)
            .message("`{0}` was defined in another frame than is on now: it stays where it was",
                     ctx.text(word))
            .note(element->where, "it is defined here");
    }
  }

  /// The switch of the mirror that is on; 0xFF: none, or which is not known.
  uint8_t mirrorOn(const RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    if (switch_ != 0xFF)
      return state.switchMustBeOn(switch_) ? switch_ : uint8_t(0xFF);
    if (state.isActive(ctx.dialect(), StandardGroup::Mirror, {Action::MirrorOn}) != Truth::Yes)
      return 0xFF;
    const CodeInfo *code = state.activeCode(ctx.dialect(), StandardGroup::Mirror);
    return code ? code->effect.index : uint8_t(0xFF);
  }

  void mirror(const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const uint8_t on = mirrorOn(ctx);
    if (on == 0xFF)
      return;
    const auto axes = uint16_t(state.switches.axesOf(on) & planeAxes(ctx.dialect(), state));
    if (!axes || (axes & (axes - 1))) // mirrored in both axes, the path keeps its sense
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Style)
          .message("one axis of the plane is mirrored: `{0}` runs on the other side, climb becomes "
                   "conventional milling",
                   ctx.text(*event.word))
          .note(state.origin.ofSwitch(on), "mirrored here");
  }

  uint8_t switch_ = 0xFF; ///< of a mirror that is no modal code; 0xFF: there is none
};

} // namespace
NCVET_RULE(CoordinateFrameSideEffect, coordinate_frame_side_effect)
} // namespace ncvet
