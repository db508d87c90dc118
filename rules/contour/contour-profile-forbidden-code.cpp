// Codes that a contour program may not hold.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct ContourProfileForbiddenCodeMemory {
  unsigned moves = 0; ///< of the outline so far
};

class ContourProfileForbiddenCode final : public StatefulRule<ContourProfileForbiddenCodeMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::Code, EventKind::Motion, EventKind::ToolWord, EventKind::SpeedWord});
    to.onCode([](const CodeInfo &) { return true; });
    for (const CodeInfo &code : to.dialect().codes)
      records_ |= code.action == Action::ProfileBegin;
    to.onChange({EventKind::Block});
    most_ = to.dialect().facts->cycles.outlineMoves;
    rapidOnly_ = to.dialect().facts->cycles.contourBeginsAtRapid;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (records_ && ctx.before().profile == ProfileMode::Recorded)
      return recorded(event, ctx);
    if (!ctx.before().must(Fact::InContour))
      return sleepInShape();
    switch (event.kind) {
    case EventKind::Code:
      return atCode(event, ctx);
    case EventKind::Motion:
      return atMove(event, ctx);
    case EventKind::Block:
      for (const Word &word : ctx.block().words)
        if (maskOf(word.address) & lettersMask("TSD"))
          foreign(word, ctx);
      return;
    default:
      return;
    }
  }

private:
  /// A profile that the control records and runs later: elements of one plane, and nothing else.
  static void recorded(const Event &event, RuleContext &ctx) {
    // In the main program only codes tell: the moves of what is recorded lie elsewhere, as a rule.
    if (ctx.callDepth() == 0 &&
        (event.kind != EventKind::Code || ctx.find({Action::ProfileBegin, Action::ProfileRun})))
      return;
    if (event.kind == EventKind::Block)
      return technology(ctx);
    if (event.kind == EventKind::Motion) {
      const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
      const bool contour =
          ctx.before().compensation == phaseOn && ctx.after().compensation == phaseOn;
      if (!(event.axes & ~plane & 7u) && !(contour && event.motion == MotionKind::Rapid))
        return;
      if (auto finding = ctx.report(event))
        finding.severity(Severity::Warning)
            .message(event.axes & ~plane & 7u
                         ? "this block of a recorded profile moves the infeed axis"
                         : "this piece of a recorded profile is a rapid move");
      return;
    }
    if (event.kind == EventKind::Code) {
      const CodeInfo &code = ctx.code(event);
      const bool own = code.letter == 'M' && code.action != Action::Return;
      const bool sets = code.action == Action::WorkOffset || code.action == Action::Cycle ||
                        code.action == Action::FrameAdd || code.action == Action::FrameSet ||
                        code.action == Action::Reset || code.action == Action::PlaneXY ||
                        code.action == Action::PlaneZX || code.action == Action::PlaneYZ;
      if (!own && !sets)
        return;
    }
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` has no place in a recorded profile: the control reads the path alone",
                   ctx.text(*event.word));
  }

  /// Feeds, speeds and tools, which mean nothing to a path that is recorded.
  static void technology(RuleContext &ctx) {
    for (const Word &word : ctx.block().words) {
      const AddressUnit unit = ctx.dialect().addresses[word.address].unit;
      if (unit != AddressUnit::Feed && unit != AddressUnit::Speed &&
          word.address != letterAddress('T'))
        continue;
      if (auto finding = ctx.report(word))
        finding.severity(Severity::Warning)
            .message("`{0}` has no place in a recorded profile: the control reads the path alone",
                     ctx.text(word));
    }
  }

  bool records_ = false;   ///< the control records profiles
  unsigned most_ = 0;      ///< moves of a contour that is an outline; 0: it is none
  bool rapidOnly_ = false; ///< the first block of a contour is one of G0

  void atCode(const Event &event, RuleContext &ctx) const {
    switch (ctx.code(event).action) {
    case Action::CompensationLeft:
    case Action::CompensationRight:
    case Action::CompensationOff:
      if (auto finding = ctx.report(event))
        finding.message("`{0}` in a contour program: the cycle switches compensation itself",
                        ctx.code(event).name);
      return;
    case Action::FrameSet:
    case Action::FrameAdd:
    case Action::FrameClear:
      if (!ctx.before().may(Fact::ContourBegun))
        if (auto finding = ctx.report(event))
          finding.message("`{0}` before the first position of a contour: the cycle does not "
                          "know where the contour begins",
                          ctx.code(event).name);
      return;
    case Action::PlaneXY:
    case Action::PlaneZX:
    case Action::PlaneYZ: {
      const GroupIndex group = ctx.code(event).group;
      if (group != noGroup && ctx.before().group(group) != (uint64_t(1) << ctx.code(event).bit))
        if (auto finding = ctx.report(event))
          finding.message("`{0}` changes the plane inside a contour: a contour lies in one plane",
                          ctx.code(event).name);
      return;
    }
    case Action::ToolChange:
    case Action::SpindleCw:
    case Action::SpindleCcw:
    case Action::SpindleStop:
    case Action::Cycle:
    case Action::CycleCancel:
      return foreign(*event.word, ctx);
    default: {
      // A contour is made of lines and arcs.
      const CodeInfo &code = ctx.code(event);
      const bool own = most_ && code.letter == 'M' && code.action != Action::Return;
      if (own || code.stopsPreparation || code.action == Action::CurveFeed)
        foreign(*event.word, ctx);
      return;
    }
    }
  }

  static void foreign(const Word &word, RuleContext &ctx) {
    if (auto finding = ctx.report(word))
      finding.severity(Severity::Warning)
          .message("`{0}` has no place in a contour: the cycle reads the path alone",
                   ctx.text(word));
  }

  /// An outline may begin with any move, and has so many.
  void outline(const Event &event, RuleContext &ctx) const {
    unsigned &moves = memory().moves;
    moves = ctx.before().may(Fact::ContourBegun) ? moves + 1 : 1;
    if (moves != most_ + 1)
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("this outline has more than {0} moves: the cycle does not take so many", most_);
  }

  /// The first block relies on the dimensions of the caller.
  static void unstated(const Event &event, RuleContext &ctx) {
    if (!ctx.asked() || ctx.find({Action::Absolute}))
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Style)
          .message("the first block of a contour has no G90: its start is where the caller's "
                   "dimensions say");
  }

  void atMove(const Event &event, RuleContext &ctx) const {
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    if (event.axes & ~plane & 7u) {
      if (auto finding = ctx.report(event))
        finding.message(
            "this block of a contour moves the infeed axis: a contour lies in one plane");
      return;
    }
    if (most_)
      return outline(event, ctx);
    if (ctx.before().may(Fact::ContourBegun))
      return;
    const bool absolute = ctx.after().isActive(ctx.dialect(), StandardGroup::Distance,
                                               {Action::Absolute}) != Truth::No;
    // The contour of a turned part begins with any move.
    constexpr uint16_t turned = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Z);
    if (plane == turned)
      return;
    if (event.motion == MotionKind::Rapid && absolute)
      return unstated(event, ctx);
    if (auto finding = ctx.report(event))
      // Other versions of the control take it with G1.
      finding
          .severity(!rapidOnly_ && event.motion == MotionKind::Feed && absolute
                        ? std::optional(Severity::Style)
                        : std::nullopt)
          .message("a contour begins with a straight block of G90 and G0, which says where its "
                   "start is");
  }
};

} // namespace
NCVET_RULE(ContourProfileForbiddenCode, contour_profile_forbidden_code)
} // namespace ncvet
