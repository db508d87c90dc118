// Brackets of structured flow: branches, loops and subprograms in a program's text.
#include "analyzer/flow/structures.h"

#include "analyzer/flow/flow_condition.h"
#include "interp/evaluate/expression.h"

namespace ncvet {

namespace {

constexpr WaysTold whenHolds{PathNode::Kind::Holds, PathNode::Kind::NoJump},
    whileFails{PathNode::Kind::NoJump, PathNode::Kind::Holds},
    whileCounts{PathNode::Kind::LoopRuns, PathNode::Kind::LoopEnded},
    whenCounted{PathNode::Kind::LoopEnded, PathNode::Kind::LoopRuns};

uint32_t partner(const llvm::DenseMap<uint32_t, uint32_t> &partners, uint32_t at) {
  const auto found = partners.find(at);
  return found == partners.end() ? ~0u : found->second;
}

Truth opposite(Truth truth) {
  return truth == Truth::Yes ? Truth::No : truth == Truth::No ? Truth::Yes : Truth::Unknown;
}

/// Counts one run of the loop whose head is `head`; whether it runs again.
Truth countDown(const Block &head, MachineState &state) {
  const Item &item = head.items.front();
  const uint64_t counter = head.keyOf(item.target);
  const Value now = state.locals.get(counter);
  if (now.kind != Value::Kind::Number)
    return Truth::Unknown;
  const Interval left = now.number - Interval::exactly(1);
  state.locals.set(counter, Value::of(left));
  if (left.hi < 1)
    state.locals.erase(counter);
  return left.lo >= 1 ? Truth::Yes : left.hi < 1 ? Truth::No : Truth::Unknown;
}

/// Counts the variable of the FOR in `head` up; whether its loop runs again.
Truth countUp(const Block &head, MachineState &state) {
  for (const Item &item : head.items) {
    if (item.kind != ItemKind::Structure || item.structure != Structure::For)
      continue;
    const uint64_t key = head.keyOf(item.target);
    const Value last = evaluate(head, item.limit, state, nullptr);
    if (!key || last.kind != Value::Kind::Number)
      return Truth::Unknown;
    const Value now = readVariable(state, int64_t(key));
    if (now.kind != Value::Kind::Number)
      return Truth::Unknown;
    const Interval value = now.number + Interval::exactly(1);
    writeVariable(state, int64_t(key), Value::of(value));
    return value.hi <= last.number.lo  ? Truth::Yes
           : value.lo > last.number.hi ? Truth::No
                                       : Truth::Unknown;
  }
  return Truth::Unknown;
}

} // namespace

bool Structures::isEntered(const Region &region, uint32_t from, uint32_t target) {
  return run_.shape(region.unit, region.program).partEntered(from, target).has_value();
}

/// A bracket without its partner.
void Structures::mismatch(Step &step, const Item &item) {
  // Where the text is read as it runs, the partner is looked for only where the body is left out.
  const bool head = item.structure == Structure::If || item.structure == Structure::While ||
                    item.structure == Structure::Times;
  const bool runs =
      !step.unit().dialect->loadsWhole &&
      (item.structure == Structure::Repeat || (head && step.outcome.flow.condition == Truth::Yes));
  run_.issue(runs ? FlowIssue::StructureOpen : FlowIssue::StructureMismatch, step,
             step.flowRange());
  step.goOn();
}

/// `condition` leads to the next block, else to `other`; an unknown one to both, which are told as
/// `told` says.
void Structures::decide(Step &step, Truth condition, uint32_t other, bool loops, WaysTold told) {
  if (condition == Truth::Yes)
    return step.goOn();
  const SourceRange where = step.flowRange();
  Live &live = step.live;
  if (condition == Truth::Unknown) {
    run_.fork(step.activation, where);
    Live body = live;
    body.path = run_.lengthen(live.path, told.next, where);
    const ConditionKey key = loops ? ConditionKey() : conditionOf(step);
    body.decided = run_.decide(live.decided, key, true);
    step.activation.add(step.block.next, std::move(body));
    live.path = run_.lengthen(live.path, told.other, where);
    live.decided = run_.decide(live.decided, key, false);
    if (loops)
      step.activation.heads[other].abstract = true;
  }
  const FlowShape &shape = run_.shape(step.unit(), step.region().program);
  if (condition == Truth::No)
    passed(step, shape, other);
  live.state->seeksBranch = !loops && shape.back.lookup(other) == step.at;
  loops_.goTo(step, other, std::move(live), condition == Truth::No);
}

/// Where the text is read as it runs, exits with the label of a body are looked at also on the way
/// past it.
void Structures::passed(const Step &step, const FlowShape &shape, uint32_t to) {
  const FileUnit &unit = step.unit();
  if (unit.dialect->loadsWhole)
    return;
  const std::vector<uint32_t> &exits = shape.strayExits;
  for (auto next = llvm::upper_bound(exits, step.at); next != exits.end() && *next < to; ++next) {
    const uint32_t exit = *next;
    Block block;
    unit.reader->read(exit, block);
    if (!block.items.empty() &&
        block.items.front().label == step.block.items[size_t(step.outcome.flow.item)].label)
      run_.issue(FlowIssue::StructureMismatch, step,
                 {unit.source.id(), block.items.front().begin, block.items.front().end});
  }
}

/// The head of a loop with a condition, or the end of one with the test after its body.
void Structures::whileHead(Step &step, const Item &item, const Partners &to) {
  const Truth condition = step.outcome.flow.condition;
  const bool isFor = item.structure == Structure::For;
  if (!isFor && to.past == ~0u)
    return decide(step, opposite(condition), to.back, true, whileFails);
  if (condition == Truth::Unknown)
    step.activation.heads[isFor ? step.block.next : step.at].abstract = true;
  decide(step, condition, to.past, false, isFor ? whileCounts : whenHolds);
}

/// The end of a loop that its head counts.
void Structures::countedEnd(Step &step, uint32_t headAt,
                            Truth (*count)(const Block &, MachineState &)) {
  Block own;
  const Block &head = run_.readBlocks.at(step.unit(), headAt, own);
  const Truth again = count(head, step.live.state);
  if (again == Truth::Unknown)
    step.activation.heads[head.next].abstract = true;
  // (the condition of `decide` leads on)
  decide(step, opposite(again), head.next, true, whenCounted);
}

void Structures::subprogramEnd(Step &step) {
  if (step.region().kind != RegionKind::Main)
    return step.activation.exit(std::move(step.live));
  run_.issue(FlowIssue::StructureMismatch, step, step.flowRange());
  step.goOn();
}

void Structures::bracket(Step &step) {
  const Item item = step.block.items[size_t(step.outcome.flow.item)];
  const FlowShape &shape = run_.shape(step.unit(), step.region().program);
  if (shape.isMismatched(step.at))
    return mismatch(step, item);
  if (const auto first = shape.duplicates.find(step.at); first != shape.duplicates.end())
    run_.issue(FlowIssue::DuplicateLabel, step, step.flowRange(),
               {step.unit().source.id(), first->second, first->second + 1});
  const Partners to{partner(shape.past, step.at), partner(shape.back, step.at),
                    partner(shape.out, step.at)};
  const Truth condition = step.outcome.flow.condition;
  switch (item.structure) {
  case Structure::If:
    return decide(step, condition, to.past, false, whenHolds);
  case Structure::ElseIf: // reached from the branch before it: the chain is done
    if (!step.before.seeksBranch)
      return loops_.goTo(step, to.out, std::move(step.live), true);
    return decide(step, condition, to.past, false, whenHolds);
  case Structure::Sub:
  case Structure::Else:
    return loops_.goTo(step, to.past, std::move(step.live), true);
  case Structure::EndSub:
  case Structure::Return:
    return subprogramEnd(step);
  case Structure::Break:
  case Structure::Continue:
    return loops_.goTo(step, to.out, std::move(step.live), true);
  case Structure::Times:
    if (condition == Truth::Unknown)
      step.activation.heads[step.block.next].abstract = true;
    return decide(step, condition, to.past, false, whileCounts);
  case Structure::EndTimes:
    return countedEnd(step, to.back, countDown);
  case Structure::EndFor:
    return countedEnd(step, to.back, countUp);
  case Structure::While:
  case Structure::For:
    return whileHead(step, item, to);
  case Structure::EndWhile:
  case Structure::EndLoop:
    return loops_.backTo(step, to.back, std::move(step.live),
                         !step.activation.heads[to.back].abstract);
  case Structure::Until:
    return decide(step, condition, to.back, true, whenHolds);
  case Structure::EndIf:
  case Structure::Loop:
  case Structure::Repeat:
    return step.goOn();
  }
}

} // namespace ncvet
