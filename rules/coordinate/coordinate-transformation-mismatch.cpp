// A transformation that does not fit the machine.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/stored_names.h"
#include "interp/geometry/circle.h"

#include <cmath>

namespace ncvet {
namespace {

struct CoordinateTransformationMismatchMemory {
  double greatest = 0; ///< of the words of rotary axes on the current surface
  SourceRange at;      ///< the last word with it
};

class CoordinateTransformationMismatch final
    : public StatefulRule<CoordinateTransformationMismatchMemory> {
public:
  /// The tables say when: in the block of a code, and where a modal cycle of theirs runs.
  void listen(Subscriptions &to) override {
    to.onNotices(id);
    const bool cycles = llvm::any_of(to.dialect().codes, [](const CodeInfo &code) {
      return code.action == Action::Cycle &&
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
    if (cycles)
      to.on(EventKind::CycleRun);
    if (llvm::any_of(to.dialect().codes, wraps)) {
      to.on(EventKind::Motion);
      to.onCode(wraps);
    }
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    if (event.kind == EventKind::Motion)
      return onSurface(ctx);
    if (event.kind == EventKind::Code && wraps(ctx.code(event)))
      surfaceEnds(ctx);
    else if (!asksNumbers(ctx.code(event), id))
      sleepInShape();
    const bool here = ctx.codeWord(event);
    if (event.kind == EventKind::Code || !here)
      ctx.reportNotices(id, event);
  }

private:
  /// Key of the diameter round which a code of the tables wraps a rotary axis.
  static uint64_t cylinder() { return storedKey(StoredName::Cylinder); }

  /// A code that lays such a surface in place of the plane, or takes it off.
  static bool wraps(const CodeInfo &code) {
    return llvm::any_of(code.stores, [](const Store &s) { return s.variable == cylinder(); });
  }

  static std::optional<double> circumference(const MachineState &state) {
    const Value diameter = state.commons.get(cylinder());
    if (state.commons.given(cylinder()) != Truth::Yes || !diameter.isConstant() ||
        diameter.number.value() <= 0)
      return std::nullopt;
    return circumferenceOf(diameter.number.value());
  }

  /// On the surface of a cylinder the words of its rotary axis are lengths along it.
  void onSurface(RuleContext &ctx) const {
    const auto turn = circumference(ctx.before());
    const Dialect &dialect = ctx.dialect();
    if (!turn ||
        ctx.after().isActive(dialect, StandardGroup::Distance, {Action::Absolute}) != Truth::Yes)
      return;
    constexpr double rounding = 0.05; // of the last point of a whole turn
    for (const Word &word : ctx.block().words) {
      const AddressInfo &address = dialect.addresses[word.address];
      if (address.kind != AddressKind::Axis || address.unit != AddressUnit::Angle)
        continue;
      const Interval value = ctx.value(word);
      if (!value.isConstant())
        continue;
      const double length = std::fabs(value.value());
      if (length > *turn + rounding)
        if (auto finding = ctx.report(word))
          finding.severity(Severity::Warning)
              .message("`{0}` is more than a turn: on this cylinder it counts in millimetres, and "
                       "a turn has {1:f3}",
                       ctx.text(word), *turn);
      if (length >= memory().greatest) {
        memory().greatest = length;
        memory().at = ctx.range(word);
      }
    }
  }

  /// A contour that goes to 360 and no further was meant in degrees.
  void surfaceEnds(RuleContext &ctx) const {
    const auto turn = circumference(ctx.before());
    constexpr double degrees = 360;
    if (turn && memory().at.end && memory().greatest == degrees && std::fabs(*turn - degrees) > 1)
      if (auto finding = ctx.report(memory().at))
        finding.severity(Severity::Warning)
            .message(
                "the contour goes to {0:f0} and no further: on this cylinder that is millimetres "
                "and no turn, which has {1:f3}",
                memory().greatest, *turn);
    memory().greatest = 0;
    memory().at = {};
  }

  static constexpr llvm::StringLiteral id{"coordinate-transformation-mismatch"};
};

} // namespace
NCVET_RULE(CoordinateTransformationMismatch, coordinate_transformation_mismatch)
} // namespace ncvet
