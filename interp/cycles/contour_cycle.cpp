// Cycles that work along a contour: what their own block says of them.
#include "interp/cycles/contour_cycle.h"

#include "interp/cycles/depth_levels.h"
#include "interp/cycles/move_feed.h"
#include "interp/state/modes.h"

namespace ncvet {

namespace {

constexpr size_t ofX = 0, ofZ = 1; ///< in the pairs of `ContourCycle`

std::optional<double> known(const std::optional<Interval> &value, double absent) {
  if (!value)
    return absent;
  return value->isConstant() ? std::optional(value->value()) : std::nullopt;
}

bool worksAlongContour(CycleKind kind) { return turnsProfile(kind) || kind == CycleKind::Contour; }

void readLevels(const ExecutedBlock &executed, const CycleParameters &words, ContourCycle &cycle) {
  cycle.tool = toolAxis(executed.dialect, executed.after);
  if (!executed.after.frames.empty())
    return;
  cycle.levels = depthLevels(words);
  cycle.approach = approachLevel(words).value_or(Interval::unknown());
  cycle.back = backLevel(words).value_or(Interval::unknown());
  cycle.feedDown = words.length(Measure::FeedDown);
  if (const auto feed = words.length(Measure::FeedAlong)) {
    cycle.feed.feed = *feed;
    if (cycle.feed.feedMode == Action::None)
      cycle.feed.feedMode = Action::FeedPerMinute;
  }
  const auto rest = words.length(Measure::SideRest);
  cycle.onContour = !rest || *rest == Interval::exactly(0);
}

std::optional<ProfilePasses> readPasses(const CycleParameters &words) {
  ProfilePasses passes;
  bool known = true;
  const auto read = [&](double &into, const std::optional<Interval> &value) {
    known &= value && value->isConstant();
    if (known)
      into = value->value();
  };
  const auto number = [&](Measure what, double absent) {
    return words.number(what).value_or(Interval::exactly(absent));
  };
  passes.finishing = !words.has(Measure::Step);
  read(passes.firstDistance, number(Measure::FirstDistance, passes.firstDistance));
  read(passes.lastDistance, number(Measure::LastDistance, passes.lastDistance));
  read(passes.count, number(Measure::Count, passes.count));
  read(passes.step, number(Measure::Step, passes.step));
  read(passes.retract, number(Measure::Retract, passes.retract));
  read(passes.unit, words.lengthFactor());
  double pockets = 0, across = 0;
  read(pockets, number(Measure::Pockets, 0));
  read(across, number(Measure::Across, 0));
  passes.pockets = ProfilePasses::Pockets(uint8_t(pockets));
  passes.across = across != 0;
  return known ? std::optional(passes) : std::nullopt;
}

ContourCycle read(const ExecutedBlock &executed, const CodeInfo &code) {
  ContourCycle cycle;
  cycle.kind = code.cycle;
  cycle.traits = code.traits;
  cycle.start.kind = MoveKind::Rapid;
  if (executed.after.frames.empty()) {
    cycle.start.to = executed.before.position;
    cycle.start.machineAxes = executed.before.machineAxes;
  }
  setFeed(executed.dialect, executed.after, cycle.feed);
  const CycleParameters words(executed, code);
  if (cycle.has(CycleTrait::Turned)) {
    cycle.profile = readPasses(words);
    cycle.start.to = executed.after.position; // as its axis words say
    cycle.start.machineAxes = executed.after.machineAxes;
    if (!executed.after.frames.empty())
      cycle.profile.reset();
    return cycle;
  }
  if (cycle.has(CycleTrait::TurnsContour)) {
    cycle.roughs = words.number(Measure::MostStep) != Interval::exactly(0);
    cycle.finishes = words.number(Measure::FinishPasses) == Interval::exactly(1);
    cycle.feed.feed = words.length(Measure::FeedDown).value_or(Interval::unknown());
    cycle.finishFeed = words.length(Measure::FeedAlong).value_or(Interval::unknown());
    return cycle;
  }
  if (code.cycle == CycleKind::Contour) {
    readLevels(executed, words, cycle);
    return cycle;
  }
  cycle.lengths = {executed.dialect.lengthsPerUnit(Axis::X),
                   executed.dialect.lengthsPerUnit(Axis::Z)};
  cycle.rest[ofX] = known(words.length(Measure::AllowanceX, Role::AllowanceX), 0);
  cycle.rest[ofZ] = known(words.length(Measure::AllowanceZ, Role::AllowanceZ), 0);
  if (cycle.rest[ofX])
    *cycle.rest[ofX] /= cycle.lengths[ofX];
  cycle.last[ofX] = known(words.length(Measure::LastCutX), 0);
  cycle.last[ofZ] = known(words.length(Measure::LastCutZ), 0);
  cycle.depth = known(words.length(Role::CutDepth));
  cycle.passes = known(words.length(Role::PassCount));
  cycle.retract = words.length(Measure::Retract, Role::Retract).value_or(Interval::unknown());
  // The stock is divided by the number of passes, or the path between first and last is given.
  const auto passes = cycle.passes;
  const auto wayOf = [&](Measure spread, Role stock) -> std::optional<double> {
    if (const auto way = words.length(spread))
      return known(way);
    const auto all = known(words.length(stock));
    return all && passes && *passes >= 1 ? std::optional(*all * (*passes - 1) / *passes)
                                         : std::nullopt;
  };
  cycle.way = {wayOf(Measure::SpreadX, Role::StockX), wayOf(Measure::SpreadZ, Role::StockZ)};
  return cycle;
}

} // namespace

std::optional<ContourCycle> contourCycle(const ExecutedBlock &executed) {
  const Flow &flow = executed.outcome.flow;
  if ((flow.kind != FlowKind::Profile && flow.kind != FlowKind::Contour) || flow.code == noCode)
    return std::nullopt;
  const CodeInfo &code = executed.dialect.codes[flow.code];
  if (!worksAlongContour(code.cycle))
    return std::nullopt;
  return read(executed, code);
}

} // namespace ncvet
