// A polar point lacks its radius, or gives it as an increment.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct CoordinatePolarInvalidMemory {
  bool noPole = false; ///< said once
};

class CoordinatePolarInvalid final : public StatefulRule<CoordinatePolarInvalidMemory> {
public:
  void listen(Subscriptions &to) override {
    words_ = to.dialect().polarWords & ~to.dialect().elementWords;
    aboutZero_ = to.dialect().facts->coordinates.polarAboutZero;
    for (const CodeInfo &code : to.dialect().codes)
      modal_ |= isPolar(code, to.dialect());
    if (modal_)
      to.onChange({EventKind::Motion});
    if (to.dialect().group(StandardGroup::Polar) != noGroup || words_)
      to.onChange({EventKind::Motion, EventKind::CycleRun});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &before = ctx.before(), &after = ctx.after();
    const Dialect &dialect = ctx.dialect();
    if (modal_ && event.kind == EventKind::Motion) {
      goesOn(event, ctx);
      asDistance(event, ctx);
    }
    if (ctx.block().hasAny(words_))
      return byWords(event, ctx);
    if (after.isActive(dialect, StandardGroup::Polar, {Action::PolarOn}) != Truth::Yes)
      return modal_ ? void() : sleepInShape();
    if (event.inMachineCoordinates() || event.motion == MotionKind::Reference)
      return;
    // The first axis of the plane carries the radius, the second the angle.
    Axis radius = Axis::X, angle = Axis::Y;
    switch (after.activeAction(dialect, StandardGroup::Plane)) {
    case Action::PlaneZX:
      radius = Axis::Z;
      angle = Axis::X;
      break;
    case Action::PlaneYZ:
      radius = Axis::Y;
      angle = Axis::Z;
      break;
    case Action::PlaneXY:
      break;
    default:
      if (dialect.isLathe())
        return;
    }
    const bool hasRadius = event.axes >> unsigned(radius) & 1;
    const bool hasAngle = event.axes >> unsigned(angle) & 1;
    if (hasAngle && !hasRadius) {
      if (before.may(Fact::PolarRadiusSet))
        return;
      if (auto finding = ctx.report(event))
        finding.message("under polar input this block gives an angle, but no radius was programmed")
            .note(after.originOf(dialect, StandardGroup::Polar), "polar input begins here");
      return;
    }
    if (!hasRadius)
      return;
    for (const Word &word : ctx.block().words) {
      const AddressInfo &address = dialect.addresses[word.address];
      if (address.axis != radius ||
          (address.kind != AddressKind::Axis && address.kind != AddressKind::Increment))
        continue;
      if (!word.has(wordIncremental) && address.kind != AddressKind::Increment &&
          (dialect.group(StandardGroup::Distance) == noGroup ||
           after.active(dialect, StandardGroup::Distance) == groupUnset ||
           after.isActive(dialect, StandardGroup::Distance, {Action::Incremental}) != Truth::Yes))
        return;
      if (auto finding = ctx.report(word))
        finding.severity(Severity::Style)
            .message("`{0}` does not lengthen the radius: the tool goes that far from where it is, "
                     "in the direction of the angle",
                     ctx.text(word));
      return;
    }
  }

private:
  /// A motion code that takes a pole: letters of axes are its angle and radius.
  static bool isPolar(const CodeInfo &code, const Dialect &dialect) {
    return isMotion(code.action) && llvm::any_of(code.words, [&](const WordSpec &w) {
             return (w.any & dialect.axisWords) && w.role == Role::Angle;
           });
  }

  /// A polar motion code goes on in the next blocks: their coordinates would be poles.
  static void goesOn(const Event &event, RuleContext &ctx) {
    const CodeInfo *motion = ctx.after().activeCode(ctx.dialect(), StandardGroup::Motion);
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    if (!motion || !isPolar(*motion, ctx.dialect()) || (event.axes & plane) != plane ||
        event.inMachineCoordinates() ||
        ctx.before().activeCode(ctx.dialect(), StandardGroup::Motion) != motion)
      return;
    for (const CodeUse &use : ctx.codes())
      if (isMotion(ctx.code(use).action) || ctx.code(use).action == Action::MachineMove)
        return;
    for (const WordSpec &spec : motion->words)
      if (spec.role == Role::Angle && ctx.block().hasAny(spec.any))
        return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding.severity(Severity::Warning)
          .message("`{0}` is still in force: these coordinates are a pole, not an end point",
                   motion->name)
          .note(ctx.before().originOf(ctx.dialect(), StandardGroup::Motion),
                "it is programmed here");
  }

  /// Whether the word is a polar one with a value of the unit.
  bool address(const Word &word, AddressUnit unit, const RuleContext &ctx) const {
    return (words_ & maskOf(word.address)) && ctx.dialect().addresses[word.address].unit == unit;
  }

  /// A later block of a polar motion code under distances; of the block with the code the table
  /// speaks.
  static void asDistance(const Event &event, RuleContext &ctx) {
    const CodeInfo *motion = ctx.after().activeCode(ctx.dialect(), StandardGroup::Motion);
    if (!motion || !isPolar(*motion, ctx.dialect()) || event.inMachineCoordinates() ||
        ctx.find({motion->action}))
      return;
    const Word *distance = ctx.block().findAny(ctx.dialect().incrementWords);
    if (!distance && ctx.after().isActive(ctx.dialect(), StandardGroup::Distance,
                                          {Action::Incremental}) != Truth::Yes)
      return;
    if (auto finding = ctx.report(distance ? ctx.range(*distance) : ctx.blockRange()))
      finding
          .message("`{0}` is still in force and takes absolute values only: this block gives "
                   "distances",
                   motion->name)
          .note(ctx.before().originOf(ctx.dialect(), StandardGroup::Motion),
                "it is programmed here");
  }

  bool modal_ = false; ///< polar points have motion codes of their own
  /// An end point by words for angle and radius.
  void byWords(const Event &event, RuleContext &ctx) const {
    const Dialect &dialect = ctx.dialect();
    const Word *const polar = ctx.block().findAny(words_);
    for (const Word &word : ctx.block().words) {
      if (!(words_ & maskOf(word.address)))
        continue;
      const Interval value = ctx.value(word);
      if (dialect.addresses[word.address].unit == AddressUnit::Length && value.hi < 0 &&
          !aboutZero_)
        if (auto finding = ctx.report(word))
          finding.message("`{0}`: a radius is not negative", ctx.text(word));
      if (address(word, AddressUnit::Length, ctx) && value.isConstant() && value.value() == 0 &&
          !aboutZero_ && llvm::any_of(ctx.block().words, [&](const Word &other) {
            return address(other, AddressUnit::Angle, ctx);
          }))
        if (auto finding = ctx.report(word))
          finding.message("`{0}`: with a radius of 0 the angle says nothing, and its direction is "
                          "lost",
                          ctx.text(word));
    }
    const uint16_t plane = planeAxes(dialect, ctx.after());
    for (const Word &word : ctx.block().words) {
      const AddressInfo &address = dialect.addresses[word.address];
      if (address.kind != AddressKind::Axis || !(plane >> unsigned(address.axis) & 1))
        continue;
      if (auto finding = ctx.report(word))
        finding.message("`{0}` beside `{1}`: an end point is given by angle and radius or by "
                        "coordinates, not by both",
                        ctx.text(word), ctx.text(*polar));
      break; // the other axis has the same cause
    }
    if (aboutZero_)
      return fromZero(event, *polar, ctx);
    if (ctx.before().may(Fact::PoleSet) || ctx.before().may(Fact::UnknownCode) || memory().noPole)
      return;
    memory().noPole = true;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("no pole was programmed for `{0}`: it counts from the workpiece zero",
                   ctx.text(*polar));
  }

  /// A control that knows no pole but the zero point, and the XY plane only.
  static void fromZero(const Event &event, const Word &polar, RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const MachineState &before = ctx.before(), &after = ctx.after();
    const Action plane = after.activeAction(dialect, StandardGroup::Plane);
    if (plane == Action::PlaneZX || plane == Action::PlaneYZ) {
      if (auto finding = ctx.report(polar, event.certain))
        finding.message("`{0}` works in the XY plane only: the interpreter stops", ctx.text(polar))
            .note(after.originOf(dialect, StandardGroup::Plane), "the plane is selected here");
      return;
    }
    const Interval zero = Interval::exactly(0);
    const bool atZero = before.at(Axis::X) == zero && before.at(Axis::Y) == zero &&
                        !before.inMachineCoordinates(Axis::X) &&
                        !before.inMachineCoordinates(Axis::Y);
    if (!atZero ||
        after.isActive(dialect, StandardGroup::Distance, {Action::Incremental}) != Truth::Yes)
      return;
    if (auto finding = ctx.report(polar, event.certain))
      finding.message("`{0}` is an increment (G91) and the tool is at the zero point, where no "
                      "direction is known: the interpreter stops",
                      ctx.text(polar));
  }

  bool aboutZero_ = false;
  AddressMask words_ = 0; ///< angle and radius
};

} // namespace
NCVET_RULE(CoordinatePolarInvalid, coordinate_polar_invalid)
} // namespace ncvet
