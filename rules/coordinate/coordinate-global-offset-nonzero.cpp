// A common offset of the machine shifts every program.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

struct CoordinateGlobalOffsetNonzeroMemory {
  bool reported = false; ///< the first move in work coordinates is looked at
};

class CoordinateGlobalOffsetNonzero final
    : public StatefulRule<CoordinateGlobalOffsetNonzeroMemory> {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().options.count("commonOffsetX"))
      to.onChange({EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (memory().reported || event.inMachineCoordinates() || event.motion == MotionKind::Reference)
      return;
    memory().reported = true;
    // With measuring of type B the common offset in X belongs to the tool setting arm.
    const bool typeB = ctx.machine().option("toolMeasuring").value_or("") == "B";
    const double x = typeB ? 0 : ctx.machine().number("commonOffsetX").value_or(0);
    const double z = ctx.machine().number("commonOffsetZ").value_or(0);
    if (x == 0 && z == 0)
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding.message(
          "the common offset of this machine is X{0} Z{1}: every position is shifted by it", x, z);
  }
};

} // namespace
NCVET_RULE(CoordinateGlobalOffsetNonzero, coordinate_global_offset_nonzero)
} // namespace ncvet
