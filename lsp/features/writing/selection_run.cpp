// What a program moves, and what its selected blocks do.
#include "lsp/features/writing/selection_run.h"

#include "analyzer/flow/activation.h"
#include "analyzer/trace/trace.h"
#include "formats/dialect/control_facts.h"

#include "llvm/ADT/Hashing.h"

namespace ncvet::lsp {

namespace {

/// A program with more moves is not rewritten: both lists would take a gigabyte.
constexpr size_t mostMoves = 2'000'000;
/// Steps of the selection that are kept: more than anybody would want to read one after the other.
constexpr size_t mostSteps = 100'000;

double number(const Interval &value) {
  return value.isConstant() ? value.value() : std::numeric_limits<double>::quiet_NaN();
}

std::array<double, axisCount> numbers(const Place &place) {
  std::array<double, axisCount> all;
  for (size_t i = 0; i < axisCount; ++i)
    all[i] = number(place[i]);
  return all;
}

/// `factor * x + shift` for the moves of one block, by axis.
struct BlockChange {
  AxisChanges ends, centres;
  bool mirrors = false; ///< arcs turn the other way round
};

bool isFlow(const CodeInfo &code) {
  return namesTarget(code.action) || code.action == Action::Jump;
}

/// Whether a block says which one comes next, and nothing else.
bool onlyDecides(const Step &step) {
  switch (step.outcome.flow.kind) {
  case FlowKind::Jump:
  case FlowKind::LoopBegin:
  case FlowKind::LoopEnd:
  case FlowKind::Structure:
  case FlowKind::Repeat:
    return true;
  default:
    return false;
  }
}

class Recorder final : public TraceSink {
public:
  Recorder(SelectionRun &run, const FileUnit &unit, uint32_t begin, uint32_t end,
           const AxisChanges &changes)
      : run_(run), unit_(unit), program_(unit.index.programAt(begin)), begin_(begin), end_(end),
        changes_(changes),
        isChanged_(llvm::any_of(changes, [](const AxisChange &one) { return !one.isNone(); })) {}

  uint32_t markOf(const Step &step) override {
    const Dialect &dialect = *step.unit().dialect;
    for (const CodeUse &use : step.outcome.codes) {
      const CodeInfo &code = dialect.codes[use.code];
      if (code.letter == 'M' && !isFlow(code))
        run_.functions.push_back(llvm::hash_value(code.number));
    }
    const bool isSelected = &step.unit() == &unit_ && begin_ <= step.at && step.at < end_;
    if (isSelected)
      note(step);
    keepStep(step, isSelected);
    if (step.outcome.flow.kind == FlowKind::End || step.outcome.flow.kind == FlowKind::Return) {
      run_.ending = std::make_shared<const MachineState>(step.live.state);
      run_.returns = step.outcome.flow.kind == FlowKind::Return;
    }
    return isChanged_ ? change(step, isSelected) : 0;
  }

  void moved(const TracedMove &traced) override {
    if (run_.moves.size() == mostMoves) {
      run_.isTooLong = true;
      return;
    }
    const Move &move = traced.move;
    const BlockChange none;
    const BlockChange &change = move.mark ? blocks_[move.mark - 1] : none;
    SelectionRun::KeptMove kept;
    kept.begin = traced.begin;
    kept.kind = move.kind;
    kept.inFile = traced.unit == &unit_;
    for (size_t i = 0; i < axisCount; ++i) {
      const bool onMachine = move.machineAxes >> i & 1;
      const AxisChange axis = onMachine ? AxisChange() : change.ends[i];
      kept.to[i] = axis.factor * number(move.to[i]) + axis.shift;
    }
    const int side = change.mirrors ? -move.side : move.side;
    llvm::hash_code rest =
        llvm::hash_combine(move.kind, move.machineAxes, side, move.spindle, rounded(move.value));
    if (move.kind != MoveKind::Rapid) // which has no feed
      rest = llvm::hash_combine(rest, move.feedMode, rounded(move.feed));
    if (move.kind == MoveKind::Arc) {
      for (size_t i = 0; i < 2; ++i) {
        const AxisChange &axis = change.centres[size_t(move.plane[i])];
        kept.centre[i] = axis.factor * number(move.centre[i]) + axis.shift;
      }
      kept.turns = number(move.turns);
      rest =
          llvm::hash_combine(rest, move.plane[0], move.plane[1], move.clockwise != change.mirrors);
    }
    kept.rest = rest;
    run_.moves.push_back(kept);
  }

  void lost(const FileUnit &, SourceRange, llvm::StringRef) override { run_.isLost = true; }

private:
  static int64_t rounded(const Interval &value) {
    constexpr double steps = 1e4; // feeds and times: what is after it is rounding
    return value.isConstant() ? std::llround(value.value() * steps) : INT64_MIN;
  }

  void note(const Step &step) {
    const Dialect &dialect = *step.unit().dialect;
    const MachineState &after = step.live.state;
    Execution &known = run_.blocks[step.at];
    Execution now;
    now.before = numbers(step.before.position);
    now.after = numbers(after.position);
    now.machineAxes = after.machineAxes;
    now.distance = after.activeAction(dialect, StandardGroup::Distance);
    now.motion = after.activeAction(dialect, StandardGroup::Motion);
    now.arcDistance = after.activeAction(dialect, StandardGroup::ArcDistance);
    now.unit = after.activeAction(dialect, StandardGroup::Units) == Action::Inch ? 25.4 : 1;
    now.runsCycle = step.outcome.kinds & bitOf(EventKind::CycleRun);
    now.leaves = step.outcome.flow.kind != FlowKind::Next;
    now.times = known.times + 1;
    now.isAlike = known.times == 0 ||
                  (known.isAlike && known.distance == now.distance && known.motion == now.motion &&
                   known.arcDistance == now.arcDistance && known.unit == now.unit);
    known = now;
  }

  /// Blocks of the selection's own program that are not selected end a visit; called programs and
  /// other files do not.
  void keepStep(const Step &step, bool isSelected) {
    if (!isSelected) {
      if (&step.unit() == &unit_ && program_.begin <= step.at && step.at < program_.end)
        isInside_ = false;
      return;
    }
    if (!std::exchange(isInside_, true))
      run_.visits.emplace_back();
    if (++steps_ > mostSteps)
      run_.visitsAreWhole = false;
    else
      run_.visits.back().push_back({step.at, onlyDecides(step)});
  }

  /// How the block's own words and those before it change where its moves end.
  uint32_t change(const Step &step, bool isSelected) {
    const Dialect &dialect = *step.unit().dialect;
    const MachineState &after = step.live.state;
    const bool incremental =
        after.activeAction(dialect, StandardGroup::Distance) == Action::Incremental;
    std::array<bool, axisCount> absolute{}, relative{};
    for (const Word &word : step.block.words) {
      const AddressInfo &info = dialect.addresses[word.address];
      if (info.axis == Axis::Count)
        continue;
      if (info.kind == AddressKind::Axis)
        (incremental || word.has(wordIncremental) ? relative : absolute)[size_t(info.axis)] = true;
      else if (info.kind == AddressKind::Increment)
        relative[size_t(info.axis)] = true;
    }
    BlockChange change;
    double turn = 1;
    for (size_t i = 0; i < axisCount; ++i) {
      const double from = number(step.before.position[i]);
      double shifted = due_[i] - from; // of what is not named
      if (std::isnan(shifted))
        shifted = 0;
      const AxisChange &wanted = changes_[i];
      AxisChange &end = change.ends[i], &centre = change.centres[i];
      end.shift = shifted;
      if (isSelected)
        turn *= wanted.factor < 0 ? -1 : 1;
      if (absolute[i])
        end = isSelected ? wanted : AxisChange();
      else if (relative[i] && isSelected)
        end = aroundPlace(wanted.factor, from, from + shifted);
      centre = end;
      if (isSelected && !absolute[i])
        centre = aroundPlace(wanted.factor, from, from + shifted);
      const bool onMachine = after.machineAxes >> i & 1;
      const double to = number(after.position[i]);
      due_[i] = onMachine ? to : end.factor * to + end.shift;
    }
    change.mirrors = turn < 0;
    blocks_.push_back(change);
    return uint32_t(blocks_.size());
  }

  /// What is at `from` comes to `to`, and distances from there change by `factor`.
  static AxisChange aroundPlace(double factor, double from, double to) {
    if (std::isnan(from) || std::isnan(to))
      return {factor, 0};
    return {factor, to - factor * from};
  }

  SelectionRun &run_;
  const FileUnit &unit_;
  const ProgramInfo &program_; ///< that holds the selection
  const uint32_t begin_, end_;
  const AxisChanges changes_;
  const bool isChanged_;
  bool isInside_ = false;
  size_t steps_ = 0;
  std::vector<BlockChange> blocks_; ///< by the mark of the moves, from 1
  /// Where each axis is with the changes; NaN: not known.
  std::array<double, axisCount> due_ = [] {
    std::array<double, axisCount> all;
    all.fill(std::numeric_limits<double>::quiet_NaN());
    return all;
  }();
};

bool isSame(double a, double b, double tolerance) {
  return std::isnan(a) || std::isnan(b) ? std::isnan(a) && std::isnan(b)
                                        : std::fabs(a - b) <= tolerance;
}

bool isSame(const SelectionRun::KeptMove &a, const SelectionRun::KeptMove &b, double tolerance) {
  if (a.rest != b.rest || !isSame(a.turns, b.turns, 1e-4))
    return false;
  for (size_t i = 0; i < axisCount; ++i)
    if (!isSame(a.to[i], b.to[i], tolerance))
      return false;
  return isSame(a.centre[0], b.centre[0], tolerance) && isSame(a.centre[1], b.centre[1], tolerance);
}

} // namespace

SelectionRun runSelection(Project &project, FileUnit &unit, uint32_t begin, uint32_t end,
                          const AxisChanges &changes, const AnalysisLimits &limits,
                          const std::atomic<bool> *cancel) {
  SelectionRun run;
  Recorder recorder(run, unit, begin, end, changes);
  trace(project, unit, limits, recorder, TracedPath::Programmed, cancel);
  return run;
}

std::optional<uint32_t> firstDifference(const SelectionRun &before, const SelectionRun &after,
                                        double tolerance) {
  const size_t common = std::min(before.moves.size(), after.moves.size());
  for (size_t i = 0; i < common; ++i)
    if (!isSame(before.moves[i], after.moves[i], tolerance))
      return before.moves[i].begin;
  if (before.moves.size() != after.moves.size())
    return before.moves.size() > common ? before.moves[common].begin : after.moves[common].begin;
  if (before.functions != after.functions)
    return before.moves.empty() ? 0 : before.moves.front().begin;
  return std::nullopt;
}

/// Without what the last subprogram gave back: nothing reads it after the end.
static Variables keptVariables(const MachineState &state) {
  Variables variables = state.commons;
  for (const char *const name : {"_value", "_value_returned"})
    variables.erase(sharedVariableKey(name));
  return variables;
}

bool endAlike(const Dialect &dialect, const SelectionRun &a, const SelectionRun &b) {
  if (!a.ending || !b.ending)
    return !a.ending && !b.ending;
  const MachineState &one = *a.ending, &other = *b.ending;
  const bool modesCount = a.returns || dialect.facts->program.modesOutliveEnd;
  for (size_t i = 0; i < dialect.groups.size() && modesCount; ++i)
    if (!dialect.groups[i].oneShot && one.group(i) != other.group(i))
      return false;
  for (size_t i = 0; i < axisCount; ++i)
    if (!isSame(number(one.position[i]), number(other.position[i]), 1e-6))
      return false;
  return one.tool == other.tool && one.toolOffset == other.toolOffset &&
         one.lengthOffset == other.lengthOffset && one.radiusOffset == other.radiusOffset &&
         one.spindle == other.spindle && a.returns == b.returns &&
         (!a.returns || one.locals == other.locals) && keptVariables(one) == keptVariables(other);
}

} // namespace ncvet::lsp
