// The levels of a drilling cycle lie in the wrong order: start, R, depth.
#include "analyzer/facts/lookahead.h"
#include "formats/dialect/control_facts.h"

#include <cmath>

namespace ncvet {
namespace {

struct CycleDepthOrderMemory {
  /// Planes that were found wrong, and where.
  struct Kept {
    double start = 0, depth = 0, height = 0; ///< NaN: not known
    TextPlace block;

    bool isSame(const Kept &other) const {
      return start == other.start && depth == other.depth &&
             (height == other.height || (std::isnan(height) && std::isnan(other.height)));
    }
  };
  std::optional<Kept> said;
};

class CycleDepthOrder final : public StatefulRule<CycleDepthOrderMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::CycleStart, EventKind::CycleRun});
    to.onCode([](const CodeInfo &code) { return storesPlanes(code); });
    to.onNotices(id);
    absolute_ = to.dialect().facts->cycles.planesAbsolute;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const CodeInfo &code = ctx.code(event);
    if (event.kind == EventKind::Code)
      ctx.reportNotices(id, event);
    if (event.kind == EventKind::Code ? !storesPlanes(code) : !makesHole(code.cycle))
      return;
    if (hasPlanes(code))
      return planes(event, code, ctx);
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
    if (zWord && unit && z && countsFromApproach(*zWord, ctx) && code.cycle != CycleKind::BackBore)
      countsUpwards(event, code, *zWord, *z * *unit, ctx);
    const bool increments =
        dialect.group(StandardGroup::Distance) != noGroup &&
        state.active(dialect, StandardGroup::Distance) != groupUnset &&
        state.isActive(dialect, StandardGroup::Distance, {Action::Incremental}) != Truth::No;
    if (unit && r && zWord && !increments && upwards(*zWord, *r * *unit, ctx)) {
      if (auto finding = ctx.report(*zWord, event.certain))
        finding.message("`{0}` leads away from the bottom of the hole: `{1}` begins at {2} and "
                        "there is nothing to drill",
                        ctx.text(*zWord), code.name, text(state.initialLevel.value() / *unit));
      return;
    }
    if (!unit || !r || !z || mixed(state.cycle, code, dialect) ||
        (rWord && rWord->has(wordIncremental)) || (zWord && zWord->has(wordIncremental)))
      return;
    if (increments)
      return;
    const Word &word = rWord ? *rWord : *zWord;
    const double level = *r * *unit, depth = *z * *unit;
    if (code.cycle == CycleKind::BackBore) {
      if (level < depth - tolerance)
        return;
      if (auto finding = ctx.report(word, event.certain))
        finding.message("back boring `{0}` cuts upwards: its R ({1}) must lie deeper than Z ({2})",
                        code.name, text(*r), text(*z));
      return;
    }
    const Interval &from = state.initialLevel;
    if (std::fabs(level - depth) <= tolerance) {
      if (event.kind != EventKind::CycleStart)
        return; // a later block that goes to R
      if (auto finding = ctx.report(word, event.certain))
        finding.message("{0} and depth of `{1}` are both {2}: there is nothing to drill between "
                        "them",
                        retractOf(code), code.name, text(*z));
      return;
    }
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
    if (level > depth + tolerance && from.isConstant() && from.value() < level - tolerance &&
        event.kind == EventKind::CycleStart) {
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
  static constexpr double tolerance = 1e-6;

  /// The depth is an increment, which a mill counts from the level of approach.
  static bool countsFromApproach(const Word &word, const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const MachineState &state = ctx.after();
    if (dialect.isLathe() || !(dialect.axisWords & maskOf(word.address)))
      return false;
    return word.has(wordIncremental) ||
           (dialect.group(StandardGroup::Distance) != noGroup &&
            state.active(dialect, StandardGroup::Distance) != groupUnset &&
            state.isActive(dialect, StandardGroup::Distance, {Action::Incremental}) == Truth::Yes);
  }

  static void countsUpwards(const Event &event, const CodeInfo &code, const Word &word, double way,
                            RuleContext &ctx) {
    if (way <= 0)
      return;
    if (auto finding = ctx.report(word, event.certain))
      finding.message("`{0}` of `{1}` counts upwards from {2}: there is nothing to drill there",
                      ctx.text(word), code.name, retractOf(code));
  }

  /// An increment of depth away from the work. Whether it counts from R or from the start, a hole
  /// drilled from a start that lies before R goes the other way.
  static bool upwards(const Word &depth, double level, const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const Interval &from = ctx.after().initialLevel, way = ctx.value(depth);
    return dialect.isLathe() && dialect.addresses[depth.address].kind == AddressKind::Increment &&
           dialect.addresses[depth.address].axis == Axis::Z &&
           toolAxis(dialect, ctx.after()) == Axis::Z && from.isConstant() && way.isConstant() &&
           way.value() > 0 && from.value() > level + 1e-6;
  }

  /// The planes of the cycle are variables, which keep their values from block to block.
  static bool hasPlanes(const CodeInfo &code) {
    return llvm::any_of(code.words, [](const WordSpec &word) {
      return word.variable && (word.role == Role::Retract || word.role == Role::Depth);
    });
  }
  /// A call that only stores them for later.
  static bool storesPlanes(const CodeInfo &code) {
    return code.action == Action::Switch && makesHole(code.cycle) && hasPlanes(code);
  }

  /// Planes that are variables: start, depth and return, and the surface when it is known to be
  /// zero. Of a later hole only what its block gives anew.
  void planes(const Event &event, const CodeInfo &code, RuleContext &ctx) const {
    const Block &block = ctx.block();
    const Word *const call = codeWord(code, ctx);
    const Word *const from = wordOf(block, code, Role::Retract);
    const Word *const to = wordOf(block, code, Role::Depth);
    const Word *const back = wordOf(block, code, Role::Height);
    if (!call && !from && !to && !back)
      return;
    const MachineState &state = ctx.after();
    const auto start = kept(state, code, Role::Retract), depth = kept(state, code, Role::Depth);
    const auto height = kept(state, code, Role::Height);
    if (!start || !depth || !isAbsolute(ctx))
      return;
    const Memory::Kept now{*start, *depth, height.value_or(NAN), {ctx.source().id(), block.begin}};
    // Called again with the planes of which it was said.
    if (!from && !to && !back && memory().said && memory().said->isSame(now) &&
        memory().said->block != now.block)
      return;
    const auto at = [&](const Word *word, const Word *other) {
      const Word *found = word ? word : other ? other : call;
      memory().said = now;
      return found ? ctx.report(*found, event.certain) : ctx.report(event, event.certain);
    };
    // Where the tool comes from below, all planes are the other way round.
    const double up = comesFromBelow(state) ? -1 : 1;
    const auto isBelow = [&](double plane, double other) {
      return up * plane < up * other - tolerance;
    };
    const bool here = call || from || to;
    if (code.cycle == CycleKind::BackBore) {
      if (here && !isBelow(*start, *depth))
        if (auto finding = at(to, from))
          finding.message("back boring `{0}` cuts upwards: its {3} ({1}) must lie deeper than the "
                          "depth {2}",
                          code.name, text(*start), text(*depth), retractOf(code));
      return;
    }
    if (here && isBelow(*start, *depth)) {
      if (auto finding = at(to, from))
        finding.message("{0} ({1}) of `{2}` lies {4} the depth {3}: there is nothing to drill "
                        "between them",
                        retractOf(code), text(*start), code.name, text(*depth),
                        up < 0 ? "above" : "below");
    } else if (here && absolute_ && !isBelow(*depth, *start)) {
      if (auto finding = at(to, from))
        finding.message("{0} of `{1}` is its depth {2} too: there is nothing to drill between them",
                        retractOf(code), code.name, text(*depth));
    }
    if ((call || from || back) && height && isBelow(*height, *start))
      if (auto finding = at(back, from))
        finding.message("the return plane {0} of `{1}` lies {3} its start plane {2}", text(*height),
                        code.name, text(*start), up < 0 ? "above" : "below");
    if (ctx.machine().option("zeroOnSurface").value_or("") != "true")
      return;
    if ((call || from) && *start <= 0)
      if (auto finding = at(from, nullptr))
        finding.severity(Severity::Warning)
            .message("the start plane {0} of `{1}` is not above the surface, which is Z0",
                     text(*start), code.name);
    if ((call || to) && *depth >= 0)
      if (auto finding = at(to, nullptr))
        finding.severity(Severity::Warning)
            .message("the depth {0} of `{1}` is not below the surface, which is Z0", text(*depth),
                     code.name);
  }

  /// The word that calls the cycle in this block, or null.
  static const Word *codeWord(const CodeInfo &code, RuleContext &ctx) {
    for (const CodeUse &use : ctx.codes())
      if (ctx.code(use).base == code.base)
        return use.word;
    return nullptr;
  }

  /// Planes are coordinates, not distances.
  bool isAbsolute(RuleContext &ctx) const {
    const Dialect &dialect = ctx.dialect();
    return absolute_ || dialect.group(StandardGroup::Distance) == noGroup ||
           ctx.after().active(dialect, StandardGroup::Distance) == groupUnset ||
           ctx.after().isActive(dialect, StandardGroup::Distance, {Action::Incremental}) ==
               Truth::No;
  }

  bool absolute_ = false; ///< planes are absolute in every mode, and the depth lies below the start

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
