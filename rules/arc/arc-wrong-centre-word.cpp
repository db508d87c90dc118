// An arc block with a centre word of an axis that does not lie in the active plane.
#include "analyzer/facts/ending_code.h"
#include "analyzer/rule/report_once.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

#include <bit>
#include <map>

namespace ncvet {
namespace {

struct ArcWrongCentreWordMemory {
  std::map<AddressId, OncePerCause> once; ///< by the letter that does not belong
};

class ArcWrongCentreWord final : public StatefulRule<ArcWrongCentreWordMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw});
    zeroCounts_ = to.dialect().facts->arcs.wrongCentreOfZeroStops;
    zeroIsSilent_ = !to.flag("zero", true);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const Dialect &dialect = ctx.dialect();
    const ArcWords &words = ctx.arcWords();
    if (!words.foreign || !words.planeKnown)
      return sleepInShape();
    const Interval value = ctx.value(*words.foreign);
    const bool zero = value.isConstant() && value.value() == 0;
    if (zeroIsSilent_ && zero && words.hasCentre() && !movesOutOfPlane(ctx, words))
      return;
    // With both words of the plane it is a habit of the program's writer: told once a plane.
    const bool complete = words.centre[0] && words.centre[1];
    const CodeInfo *plane = ctx.after().activeCode(dialect, StandardGroup::Plane);
    const Origin planeOrigin =
        plane ? ctx.after().originOf(dialect, StandardGroup::Plane) : Origin();
    if (complete && !memory().once[words.foreign->address].speaks(planeOrigin, ctx))
      return;
    const std::string first = dialect.addressName(words.centreAddress[0]);
    const std::string second = dialect.addressName(words.centreAddress[1]);
    auto finding = ctx.report(*words.foreign, event.certain);
    if (!finding)
      return;
    if (tellsOfPlane(finding, words, complete, ctx))
      return;
    const std::string where = plane ? "in the plane of `" + plane->name + "`" : "in this plane";
    finding.message("`{0}` does not belong to an arc {1}: its centre words are {2} and {3}",
                    ctx.text(*words.foreign), where, first, second);
    if (plane)
      finding.note(planeOrigin, "`" + plane->name + "` is selected here");
    if (complete && ((!zeroCounts_ && zero) || movesAlong(ctx, words.foreign->address)))
      finding.severity(Severity::Style); // changes nothing, or is the lead of a helix
    if (complete) {
      finding.fix(FixSafety::Unsafe, "remove `" + ctx.text(*words.foreign).str() + "`",
                  ctx.remove(*words.foreign));
    } else if (words.hasCentre()) {
      const std::string &missing = words.centre[0] ? second : first;
      const SourceRange letter{ctx.source().id(), words.foreign->offset, words.foreign->offset + 1};
      finding.fix(FixSafety::Unsafe, "write `" + missing + "` for `" + ctx.text(letter).str() + "`",
                  ctx.replace(letter, missing));
    }
  }

private:
  /// `G2 Y20. Z5. J0 K5.`: ends and centre lie in another plane, which the block does not select.
  static bool tellsOfPlane(FindingBuilder &finding, const ArcWords &words, bool complete,
                           RuleContext &ctx) {
    constexpr uint16_t space = 7; // X, Y and Z
    const AddressId foreign = words.foreign->address;
    const uint16_t axes = axesOf(ctx.dialect(), ctx.block()) & space;
    if (complete || foreign < letterAddress('I') || foreign > letterAddress('K') ||
        std::popcount(unsigned(axes)) != 2 || !(axes >> (foreign - letterAddress('I')) & 1))
      return false;
    constexpr uint16_t x = 1u << unsigned(Axis::X), y = 1u << unsigned(Axis::Y);
    const Action meant = axes == (x | y)   ? Action::PlaneXY
                         : (axes & x) != 0 ? Action::PlaneZX
                                           : Action::PlaneYZ;
    const CodeInfo *const other = firstCodeWith(ctx.dialect(), meant);
    const CodeInfo *const plane = ctx.after().activeCode(ctx.dialect(), StandardGroup::Plane);
    if (!other || !plane || other == plane)
      return false;
    finding
        .message(
            "ends and centre of this arc lie in the plane of `{0}`, and `{1}` is in force: the "
            "control ignores `{2}`, or stops",
            other->name, plane->name, ctx.text(*words.foreign))
        .note(ctx.after().originOf(ctx.dialect(), StandardGroup::Plane),
              "`" + plane->name + "` is selected here")
        .fix(FixSafety::Unsafe, "select the plane",
             ctx.insertBefore(ctx.block().words.front().offset, other->name + " "));
    return true;
  }

  /// The block also moves along the axis of a centre word.
  static bool movesAlong(const RuleContext &ctx, AddressId centre) {
    return centre >= letterAddress('I') && centre <= letterAddress('K') &&
           (axesOf(ctx.dialect(), ctx.block()) >> unsigned(centre - letterAddress('I')) & 1);
  }

  /// `G18`, then `G2 X50. Y20. I10. J0`: the end is one of another plane, as the centre is.
  static bool movesOutOfPlane(const RuleContext &ctx, const ArcWords &words) {
    const AddressId foreign = words.foreign->address;
    if (foreign < letterAddress('I') || foreign > letterAddress('K') ||
        (words.centre[0] && words.centre[1]) ||
        !ctx.after().originOf(ctx.dialect(), StandardGroup::Plane).known())
      return false;
    constexpr uint16_t space = 7; // X, Y and Z
    const uint16_t axes = axesOf(ctx.dialect(), ctx.block()) & space;
    const auto along = uint16_t(1u << (foreign - letterAddress('I')));
    return (axes & along) && std::popcount(unsigned(axes)) == 2; // a helix has all three
  }

  bool zeroCounts_ = false;   ///< the control stops at a word of value 0 too
  bool zeroIsSilent_ = false; ///< a word of value 0 beside the plane's own changes nothing
};

} // namespace
NCVET_RULE(ArcWrongCentreWord, arc_wrong_centre_word)
} // namespace ncvet
