// With incremental repeats the place where the cycle is called gets no hole.
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <cmath>

namespace ncvet {
namespace {

struct CycleHoleAtDefinitionMemory {
  uint16_t axes = 0; ///< in which the tool has gone to some place
  bool said = false; ///< the first hole was looked at
};

class CycleHoleAtDefinition final : public StatefulRule<CycleHoleAtDefinitionMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleStart);
    if (to.flag("placeFirst"))
      to.on({EventKind::CycleRun, EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind != EventKind::CycleStart)
      return firstPlace(event, ctx);
    const CodeInfo &code = ctx.code(event);
    const auto count = valueOf(ctx, code, Role::Repeat);
    if (!makesHole(code.cycle) || !count || *count < 2)
      return;
    const Dialect &dialect = ctx.dialect();
    const Axis tool = toolAxis(dialect, ctx.after());
    const GroupIndex group = dialect.group(StandardGroup::Distance);
    const bool allIncremental =
        group != noGroup && ctx.after().group(group) != groupUnset &&
        ctx.after().isActive(dialect, StandardGroup::Distance, {Action::Incremental}) == Truth::Yes;
    const auto unit = millimetresPer(dialect, ctx.after());
    if (!unit)
      return;
    bool stepping = false;
    for (const Word &word : ctx.block().words) {
      const AddressInfo &address = dialect.addresses[word.address];
      if (!(dialect.axisWords & maskOf(word.address)) || address.axis == tool)
        continue;
      if (!allIncremental && address.kind != AddressKind::Increment && !word.has(wordIncremental))
        return;
      const Interval step = ctx.value(word);
      const Interval &from = ctx.before().at(address.axis);
      if (!step.isConstant() || !from.isConstant() || step.value() == 0)
        return;
      // A tool a whole number of steps from the origin is on a hole of the pattern.
      const double steps = from.value() / (step.value() * *unit);
      if (steps < 0.5 || std::fabs(steps - std::round(steps)) > 1e-6)
        return;
      stepping = true;
    }
    if (!stepping || ctx.before().cycleActive(dialect) != Truth::No)
      return;
    if (auto finding = ctx.report(event, false))
      finding.message("`{0}` makes its first of {1} holes one step away: there is none at "
                      "the tool's place",
                      code.name, *count);
  }

private:
  /// Axes of which the program has said where they are, by a move or not.
  static uint16_t knownAxes(const MachineState &state) {
    uint16_t axes = 0;
    for (unsigned i = 0; i < axisCount; ++i)
      axes = uint16_t(axes | unsigned(state.position[i].isConstant()) << i);
    return axes;
  }

  static bool hasNumber(const RuleContext &ctx) {
    return ctx.index().programAt(ctx.block().begin).hasHeader();
  }

  /// Whether the program begins with its head: a number, or a code of its own.
  static bool isWhole(const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    if (program.kind == ProgramKind::Subprogram)
      return false;
    if (program.hasHeader())
      return true;
    Block first;
    const auto &reader = ctx.index().reader();
    for (uint32_t at = program.begin; at < program.end; at = first.next) {
      reader.read(at, first);
      if (!first.isEmpty())
        break;
    }
    return findCode(ctx.dialect(), first, {Action::ProgramHead}) != nullptr;
  }

  /// The first hole of a whole program: some block has gone to its place.
  void firstPlace(const Event &event, RuleContext &ctx) const {
    memory().axes |= event.axes;
    if (event.kind == EventKind::Motion) // further ones of a stretch name the same axes
      sleepInStretch();
    if (memory().said || ctx.callDepth() > 0 || ctx.before().may(Fact::UnknownCode)) {
      memory().said = true;
      return;
    }
    if (event.kind != EventKind::CycleRun || event.code == noCode ||
        !makesHole(ctx.code(event).cycle))
      return;
    memory().said = true;
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    const auto open = uint16_t(plane & ~memory().axes & ~knownAxes(ctx.before()));
    // In a program with a number one axis alone may be left where it is.
    if (!open || !isWhole(ctx) || (open != plane && hasNumber(ctx)))
      return; // what comes before a fragment places it
    const char *const along = open == plane                     ? "its place"
                              : open == 1u << unsigned(Axis::X) ? "its X"
                              : open == 1u << unsigned(Axis::Y) ? "its Y"
                                                                : "its Z";
    if (auto finding = ctx.report(event, event.certain))
      finding.severity(Severity::Warning)
          .message("`{0}` makes its first hole where the tool happens to be: no block has gone "
                   "to {1} before",
                   ctx.code(event).name, along);
  }
};

} // namespace
NCVET_RULE(CycleHoleAtDefinition, cycle_hole_at_definition)
} // namespace ncvet
