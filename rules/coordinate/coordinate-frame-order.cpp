// Shifts, rotations, scaling and mirrors are ended in an order that the control does not allow.
#include "analyzer/facts/block_before.h"
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/blocks_since.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/project.h"

namespace ncvet {
namespace {

class CoordinateFrameOrder final : public Rule {
  static constexpr llvm::StringLiteral id = "coordinate-frame-order";

public:
  void listen(Subscriptions &to) override {
    to.onNotices(id);
    lengthEnds_ = to.flag("lengthEnds");
    to.onAction({Action::PresetPosition, Action::LocalShift, Action::MirrorOn, Action::MirrorOff,
                 Action::ScalingOff, Action::RotationOff});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const CodeInfo &code = ctx.code(event);
    ctx.reportNotices(id, event);
    if (code.alone)
      movedBetween(event, code, ctx);
    switch (code.action) {
    case Action::PresetPosition:
      return preset(event, code, ctx);
    case Action::LocalShift:
      return localShift(event, ctx);
    case Action::MirrorOn:
    case Action::MirrorOff:
      return mirror(event, code, ctx);
    case Action::RotationOff:
      if (lengthEnds_)
        lengthInside(event, code, ctx);
      return nesting(event, code, ctx);
    case Action::ScalingOff:
      return nesting(event, code, ctx);
    default:
      return;
    }
  }

private:
  /// A code that is for a frame which a block has switched on comes next to that block: no move is
  /// between the two.
  static void movedBetween(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    uint32_t wanted = 0; // switches
    for (const Notice &notice : code.notices)
      if (id == notice.rule)
        wanted |= notice.when.off;
    if (!wanted)
      return;
    const Dialect &dialect = ctx.dialect();
    BlocksBefore before(ctx);
    Block block;
    while (before.next(block)) {
      for (const CodeIndex one : codesOf(dialect, block))
        if (const uint8_t index = dialect.codes[one].effect.index;
            index != 0xFF && (wanted >> index & 1))
          return;
      if (!block.hasAny(dialect.axisWords))
        continue;
      if (auto finding = ctx.report(event, event.certain))
        finding.severity(Severity::Warning)
            .message("`{0}` comes next to the block of its frame, and a move is between the two",
                     code.name)
            .note(SourceRange{before.unit().source.id(), block.begin, block.end}, "this move");
      return;
    }
  }

  bool lengthEnds_ = false; ///< a length offset that a rotation has seen begin ends before it

  /// A length offset that was switched on under the rotation is on when that ends.
  static void lengthInside(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    if (code.effect.index == 0xFF || !before.switchMustBeOn(code.effect.index) ||
        before.isActive(ctx.dialect(), StandardGroup::LengthOffset,
                        {Action::LengthPositive, Action::LengthNegative}) != Truth::Yes ||
        ctx.find({Action::LengthOff}))
      return;
    const Origin &length = before.origin.of(StatePart::LengthOffset);
    const Origin &frame = before.origin.ofSwitch(code.effect.index);
    if (!length.known() || !frame.known() || length.file != frame.file ||
        length.begin < frame.begin || before.lengthOffset == 0 || wentHome(length, ctx))
      return;
    // The tool goes on at another height, and some versions of the control stop.
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` while a length offset is on that was switched on after the rotation: it "
                   "ends first",
                   ctx.text(*event.word))
          .note(length, "the length offset begins here");
  }

  /// A way home since `length` has suspended the offset.
  static bool wentHome(const Origin &length, const RuleContext &ctx) {
    bool home = false;
    blocksSince(length, ctx, [&](const FileUnit &, const Block &block) {
      home |= findCode(ctx.dialect(), block, {Action::ReferenceReturn}) != nullptr;
      return !home;
    });
    return home;
  }

  static bool is(const RuleContext &ctx, StandardGroup group, Action action) {
    return ctx.dialect().group(group) != noGroup &&
           ctx.before().isActive(ctx.dialect(), group, {action}) == Truth::Yes;
  }
  /// Every axis word of the block is a known zero, and there is one.
  static bool allZero(const RuleContext &ctx) {
    bool any = false;
    for (const Word &word : ctx.block().words)
      if (ctx.dialect().axisWords & maskOf(word.address)) {
        const Interval value = ctx.value(word);
        if (!value.isConstant() || value.value() != 0)
          return false;
        any = true;
      }
    return any;
  }

  /// `G92 X0 Y0` gives the former system back only where it was left.
  static void preset(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    if (code.effect.index == 0xFF || !before.switchMustBeOn(code.effect.index) ||
        !before.must(Fact::MovedSincePreset) || !allZero(ctx))
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` with zeros restores the system only where the shift was made, and the "
                   "tool has moved since",
                   ctx.text(*event.word))
          .note(before.origin.of(StatePart::Preset), "shifted here");
  }

  static void localShift(const Event &event, RuleContext &ctx) {
    if (!allZero(ctx))
      return;
    if (is(ctx, StandardGroup::Polar, Action::PolarOn) &&
        ctx.after().isActive(ctx.dialect(), StandardGroup::Polar, {Action::PolarOn}) ==
            Truth::Yes) {
      if (auto finding = ctx.report(event))
        finding.severity(Severity::Warning)
            .message("the local system is taken back while polar input is still on: end that first")
            .note(ctx.before().originOf(ctx.dialect(), StandardGroup::Polar),
                  "polar input begins here");
      return;
    }
    const CodeInfo *cycle = ctx.before().activeCode(ctx.dialect(), StandardGroup::Cycle);
    if (!cycle || !makesHole(cycle->cycle) ||
        ctx.before().cycleActive(ctx.dialect()) != Truth::Yes ||
        ctx.after().cycleActive(ctx.dialect()) != Truth::Yes)
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("the local system is taken back while `{0}` is still active: end that first",
                   cycle->name)
          .note(ctx.before().origin.of(StatePart::Cycle), cycle->name + " becomes active here");
  }

  static void mirror(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    const bool scaled = is(ctx, StandardGroup::Scaling, Action::ScalingOn);
    if (scaled || is(ctx, StandardGroup::Rotation, Action::RotationOn)) {
      if (auto finding = ctx.report(event))
        finding
            .message("`{0}` is allowed only without {1}: that was switched on inside or before it",
                     ctx.text(*event.word), scaled ? "scaling" : "rotation")
            .note(ctx.before().originOf(ctx.dialect(),
                                        scaled ? StandardGroup::Scaling : StandardGroup::Rotation),
                  scaled ? "scaling begins here" : "rotation begins here");
      return;
    }
    if (code.action != Action::MirrorOff || code.effect.index == 0xFF ||
        !ctx.before().switchMustBeOn(code.effect.index))
      return;
    const uint16_t named = axesOf(ctx.dialect(), ctx.block());
    const uint16_t mirrored = ctx.before().switches.axesOf(code.effect.index);
    const auto rest = uint16_t(mirrored & ~named);
    if (!named || !rest || (mirrored & named && endsNext(ctx, code, rest)))
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` ends the mirror image of the axes that it names only: {1} stays mirrored",
                   ctx.text(*event.word), namesOf(rest))
          .note(ctx.before().origin.ofSwitch(code.effect.index), "mirrored here");
  }

  /// The blocks that come next end the mirror image of the other axes too: one block for each.
  static bool endsNext(const RuleContext &ctx, const CodeInfo &off, uint16_t rest) {
    BlocksAhead ahead(ctx);
    Block block;
    while (rest && ahead.nextAtWork(block) &&
           findCode(ctx.dialect(), block, {Action::MirrorOff}) == &off)
      rest &= uint16_t(~axesOf(ctx.dialect(), block));
    return !rest;
  }

  /// What was switched on last is switched off first.
  static void nesting(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    if (code.effect.index == 0xFF)
      return;
    const auto mark = uint8_t(code.effect.index + 1);
    uint8_t last = 0;
    bool there = false;
    for (const uint8_t open : ctx.before().transforms)
      if (open) {
        last = open;
        there |= open == mark;
      }
    if (!there || last == mark || ctx.after().switchMayBeOn(code.effect.index) ||
        !ctx.after().switchMustBeOn(last - 1u))
      return;
    // A mirror image inside the others is the mistake that was reported where it was switched on.
    for (const CodeInfo &other : ctx.dialect().codes)
      if (other.action == Action::MirrorOn && other.effect.index == last - 1u)
        return;
    const SwitchInfo &inner = ctx.dialect().switches[last - 1u];
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` comes too early: {1} was switched on later and has to end first",
                   ctx.text(*event.word), inner.title)
          .note(ctx.before().origin.ofSwitch(last - 1u), inner.title + " begins here");
  }

  static std::string namesOf(uint16_t axes) {
    std::string names;
    for (unsigned i = 0; i < axisCount; ++i)
      if (axes >> i & 1)
        names += "XYZABCUVW"[i];
    return names;
  }
};

} // namespace
NCVET_RULE(CoordinateFrameOrder, coordinate_frame_order)
} // namespace ncvet
