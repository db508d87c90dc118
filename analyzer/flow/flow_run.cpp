// What all parts of the flow engine share while one file is run.
#include "analyzer/flow/flow_run.h"

#include "analyzer/flow/decided_conditions.h"
#include "formats/readers/quick_reader.h"

#include <algorithm>
#include <new>

namespace ncvet {

namespace {

/// Issues after which the control stops, or goes where the text does not say.
bool endsThePath(FlowIssue kind) {
  switch (kind) {
  case FlowIssue::NoTarget:
  case FlowIssue::UnknownProgram:
  case FlowIssue::UnknownBlock:
  case FlowIssue::Recursion:
  case FlowIssue::ProfileMissing:
  case FlowIssue::ProfileReversed:
  case FlowIssue::ComputedTarget:
  case FlowIssue::StructureMismatch:
  case FlowIssue::EndlessLoop:
    return true;
  default:
    return false;
  }
}

} // namespace

bool Coverage::holds(uint32_t offset) const {
  return llvm::any_of(runs_,
                      [&](const auto &run) { return offset >= run.first && offset < run.second; });
}

std::vector<SourceRange> Coverage::ranges(FileId file) const {
  std::vector<SourceRange> ranges;
  for (const auto &[begin, end] : runs_)
    ranges.push_back({file, begin, end});
  llvm::sort(ranges, [](const SourceRange &a, const SourceRange &b) { return a.begin < b.begin; });
  std::vector<SourceRange> joined;
  for (const SourceRange &range : ranges) {
    if (!joined.empty() && range.begin <= joined.back().end)
      joined.back().end = std::max(joined.back().end, range.end);
    else
      joined.push_back(range);
  }
  return joined;
}

void FlowRun::cut(SourceRange where, std::string why) {
  complete = false;
  lose(where, why);
  if (!llvm::is_contained(cuts, why))
    cuts.push_back(std::move(why));
}

void FlowRun::lose(SourceRange where, llvm::StringRef why) {
  if (stopped || !listeners.followOnePath())
    return;
  stopped = true;
  listeners.tell([&](FlowListener &listener) { listener.pathLost(where, why); });
}

void FlowRun::fork(Activation &activation, SourceRange where) {
  ++activation.forks;
  ++forks;
  lose(where, "what decides here is not known");
}

const PathNode *FlowRun::lengthen(const PathNode *before, PathNode::Kind kind, SourceRange range,
                                  int64_t number) {
  // A path that is longer than anybody reads is not continued.
  constexpr unsigned longestPath = 24;
  if (before && before->length >= longestPath)
    return before;
  auto *node = new (paths_.Allocate<PathNode>()) PathNode{kind, range, number};
  node->before = before;
  node->length = before ? before->length + 1 : 1;
  return node;
}

const DecidedCondition *FlowRun::decide(const DecidedCondition *before,
                                        const ConditionKey &condition, bool holds) {
  constexpr unsigned mostDecided = 16; // a macro that first looks at all its arguments tests more
  if (!condition.sum || (before && before->length >= mostDecided))
    return before;
  return new (paths_.Allocate<DecidedCondition>()) DecidedCondition{
      condition.sum, holds != condition.negated, before ? before->length + 1 : 1, before};
}

void FlowRun::cover(const FileUnit &of, uint32_t begin, uint32_t end) {
  if (&of == &unit && begin < end)
    covered.add(begin, end);
}

void FlowRun::issue(FlowIssue kind, const Step &step, const MachineState &before,
                    const MachineState &after, SourceRange where, SourceRange related) {
  if (endsThePath(kind))
    lose(where, "control cannot go where the block says");
  if (listeners.want(EventKind::FlowIssue))
    listeners.tell([&](FlowListener &listener) {
      listener.problem(step, {kind, before, after, where, related});
    });
}

void FlowRun::noteFollowed(const Step &step, const FileUnit &callee, const MachineState *after) {
  if (!outer || abstract || &step.unit() == &callee || &step.unit() == &unit)
    return;
  uint64_t &groups = followed[step.unit().source.id()][step.block.begin];
  for (GroupIndex i = 0; i < GroupIndex(unit.dialect->groups.size()); ++i)
    if (!after || after->group(i) != step.before.group(i) ||
        !(after->origin.ofGroup(i) == step.before.origin.ofGroup(i)))
      groups |= uint64_t(1) << i;
}

const FollowedCall *FlowRun::leftToCallers(const Step &step, const FileUnit &callee) {
  static constexpr FollowedCall any{0, ~uint64_t(0)};
  const CallSite *const caller = step.region().caller;
  if (!outer || !entryUnknown || &callee == &unit || (caller && caller->unit))
    return nullptr;
  asksOuter = true;
  postponed = stopped |= outer->postpones;
  return postponed ? &any : outer->find(step.block.begin);
}

const QuickReader *FlowRun::quickReader(const FileUnit &of) {
  if (quick_.first != &of)
    quick_ = {&of, dynamic_cast<const QuickReader *>(of.reader.get())};
  return quick_.second;
}

const FlowShape &FlowRun::shape(const FileUnit &of, const ProgramInfo &program) {
  const auto [found, fresh] = shapes_.try_emplace({of.source.id(), program.begin});
  if (fresh)
    found->second = readShape(*of.reader, program.begin, program.end);
  return found->second;
}

/// What has been done before the next block, as far as a program that nobody knows may have done
/// it: who calls it expects the control ready to go on.
constexpr Fact preparedByAny[] = {
    Fact::ToolCalled,       Fact::Moved,         Fact::FeedSet,          Fact::SpeedSet,
    Fact::SpeedSinceMode,   Fact::SpeedLimitSet, Fact::WorkOffsetStated, Fact::LengthSinceTool,
    Fact::AwayFromPart,     Fact::PoleSet,       Fact::PolarRadiusSet,   Fact::OrientedSinceTool,
    Fact::ReferenceReturned};
/// What it hardly leaves so.
constexpr Fact leftByNone[] = {Fact::UnknownCode, Fact::SpindleStoppedByTap, Fact::FeedIsLead,
                               Fact::FeedCarried, Fact::PlungedUncompensated};

void forget(MachineState &state, const Dialect &dialect) {
  const MachineState before = state;
  state = unknownState(dialect);
  state.origin = before.origin;
  state.profile = before.profile;
  // After a code that nobody knows there may be modes of which the state has no part. Else each
  // part is unknown until the program says it anew; then it is known again.
  if (before.may(Fact::UnknownCode))
    return;
  for (const Fact fact : preparedByAny)
    state.set(fact);
  for (const Fact fact : leftByNone)
    state.clear(fact);
  if (!before.modalCalls)
    state.modalCalls = nullptr;
}

} // namespace ncvet
