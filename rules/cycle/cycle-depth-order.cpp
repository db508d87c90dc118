// The levels of a drilling cycle lie in the wrong order: start, R, depth.
#include "analyzer/lookahead.h"

#include <cmath>

namespace ncvet {
namespace {

class CycleDepthOrder final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::CycleStart, EventKind::CycleRun});
    to.onNotices(id);
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.code == noCode)
      return;
    if (event.kind == EventKind::Code)
      return ctx.reportNotices(id, event);
    const CodeInfo &code = ctx.code(event);
    if (!makesHole(code.cycle))
      return;
    const Block &block = ctx.block();
    const Word *rWord = wordOf(block, code, Role::Retract);
    const Word *zWord = wordOf(block, code, Role::Depth);
    if (!rWord && !zWord)
      return;
    const Dialect &dialect = ctx.dialect();
    const MachineState &state = ctx.after();
    const auto unit = millimetresPer(dialect, state);
    const Axis tool = toolAxis(dialect, state);
    if (zWord && dialect.addresses[zWord->address].kind == AddressKind::Axis &&
        dialect.addresses[zWord->address].axis != tool)
      return; // in this plane it is a coordinate of the hole
    const auto r = kept(state, code, Role::Retract);
    const auto z = kept(state, code, Role::Depth);
    if (!unit || !r || !z || mixed(state.cycle, code, dialect) ||
        (rWord && rWord->has(wordIncremental)) || (zWord && zWord->has(wordIncremental)))
      return;
    if (dialect.group(StandardGroup::Distance) != noGroup &&
        state.active(dialect, StandardGroup::Distance) != groupUnset &&
        state.isActive(dialect, StandardGroup::Distance, {Action::Incremental}) != Truth::No)
      return;
    const bool parameters = (rWord ? rWord : zWord)->address == variableAddress;
    const Word &word = parameters ? (zWord ? *zWord : *rWord) : (rWord ? *rWord : *zWord);
    if (parameters)
      planes(event, code, *r, *z, ctx);
    const double level = *r * *unit, depth = *z * *unit;
    constexpr double tolerance = 1e-6;
    if (code.cycle == CycleKind::BackBore) {
      if (level < depth - tolerance)
        return;
      if (auto finding = ctx.report(word, event.certain))
        finding.message("back boring `{0}` cuts upwards: its R ({1}) must lie deeper than Z ({2})",
                        code.name, text(*r), text(*z));
      return;
    }
    const Interval &from = state.initialLevel;
    if (level < depth - tolerance) {
      // Drilling towards plus is a matter of lathes with a second spindle; the start tells.
      const bool startKnown = from.isConstant();
      if (startKnown && from.value() <= level + tolerance && dialect.isLathe())
        return;
      if (auto finding = ctx.report(word, event.certain && (startKnown || !dialect.isLathe())))
        finding.message("{0} ({1}) of `{2}` lies below the depth {3}: there is nothing to drill "
                        "between them",
                        retractOf(code), text(*r), code.name, text(*z));
      return;
    }
    // Where the planes are parameters the way to the hole is made before the tool rises to them:
    // another rule speaks of it.
    if (!parameters && level > depth + tolerance && from.isConstant() &&
        from.value() < level - tolerance && event.kind == EventKind::CycleStart) {
      const bool inside = from.value() < depth - tolerance;
      if (auto finding = ctx.report(word, event.certain && inside))
        finding
            .message(
                "`{0}` begins at {1}, below its {3} ({2}): the tool rises to {3} at rapid first",
                code.name, text(from.value() / *unit), text(*r), retractOf(code))
            .severity(inside ? Severity::Warning : Severity::Style);
    }
  }

private:
  static constexpr llvm::StringLiteral id{"cycle-depth-order"};

  /// Planes that are parameters: the return plane, and the surface when it is known to be zero.
  static void planes(const Event &event, const CodeInfo &code, double start, double depth,
                     RuleContext &ctx) {
    const Word *back = wordOf(ctx.block(), code, Role::Height);
    const auto height = kept(ctx.after(), code, Role::Height);
    if (back && height && *height < start)
      if (auto finding = ctx.report(*back, event.certain))
        finding.message("the return plane {0} of `{1}` lies below its start plane {2}",
                        text(*height), code.name, text(start));
    if (ctx.machine().option("zeroOnSurface").value_or("") != "true")
      return;
    const Word *from = wordOf(ctx.block(), code, Role::Retract);
    if (from && start <= 0)
      if (auto finding = ctx.report(*from, event.certain))
        finding.severity(Severity::Warning)
            .message("the start plane {0} of `{1}` is not above the surface, which is Z0",
                     text(start), code.name);
    const Word *to = wordOf(ctx.block(), code, Role::Depth);
    if (to && depth >= 0)
      if (auto finding = ctx.report(*to, event.certain))
        finding.severity(Severity::Warning)
            .message("the depth {0} of `{1}` is not below the surface, which is Z0", text(depth),
                     code.name);
  }

  /// What the control calls the level from which it drills.
  static std::string retractOf(const CodeInfo &code) {
    for (const WordSpec &word : code.words)
      if (word.role == Role::Retract && !word.name.empty())
        return word.name;
    return "R";
  }

  static std::string text(double value) {
    return llvm::formatv("{0}", llvm::format("%g", value)).str();
  }
  /// The depth was given as an increment (W), alone or beside an absolute one.
  static bool mixed(const CycleWords &words, const CodeInfo &code, const Dialect &dialect) {
    const AddressMask mask = addressesOf(code, Role::Depth);
    for (char letter = 'A'; letter <= 'Z'; ++letter)
      if ((mask & maskOf(letter) & dialect.incrementWords) && words.has(letter))
        return true;
    return false;
  }
};

} // namespace
NCVET_RULE(CycleDepthOrder, cycle_depth_order)
} // namespace ncvet
