// Jumps: by words, by statements with targets, and by the operator's answer.
#include "analyzer/flow/jumps.h"

#include "analyzer/flow/flow_condition.h"
#include "interp/evaluate/condition.h"
#include "interp/evaluate/expression.h"

namespace ncvet {

void Jumps::jump(Step &step) {
  const Flow &flow = step.outcome.flow;
  if (flow.item >= 0 && step.block.items[size_t(flow.item)].arguments) {
    const Item item = step.block.items[size_t(flow.item)];
    if (step.at >= step.activation.lastNoted) {
      targets_.note(step);
      step.activation.lastNoted = step.at + 1;
    }
    byItem(step, item);
  } else {
    byWord(step);
  }
}

/// Where the condition may fail the state goes on after the jump, too. True: it fails for certain,
/// and the jump is not taken at all. `looksOn`: the block may hold another jump.
bool Jumps::leaveOut(Step &step, bool looksOn) {
  const Flow &flow = step.outcome.flow;
  if (flow.condition == Truth::Yes)
    return false;
  const bool never = flow.condition == Truth::No;
  Live straight = never ? std::move(step.live) : step.live;
  if (flow.condition == Truth::Unknown) {
    run_.fork(step.activation, step.flowRange());
    straight.path = run_.lengthen(straight.path, PathNode::Kind::NoJump, step.flowRange());
    const ConditionKey key = conditionOf(step);
    straight.decided = run_.decide(straight.decided, key, false);
    step.live.decided = run_.decide(step.live.decided, key, true);
  }
  Step other{step.activation, straight,     step.at,     step.before,
             step.block,      step.outcome, step.stretch};
  if (looksOn)
    notTaken(other);
  else
    other.goOn();
  return never;
}

/// A jump whose words, or a statement without targets, say where it leads.
void Jumps::byWord(Step &step) {
  const Flow &flow = step.outcome.flow;
  const SourceRange where = step.flowRange();
  if (flow.condition == Truth::No) {
    const bool named =
        flow.item < 0 || step.block.items[size_t(flow.item)].jump != JumpKind::ToStart;
    if (named && flow.target.isConstant()) {
      const auto number = int64_t(flow.target.number.value());
      run_.used.numbers.insert(number); // with other values the jump is taken
      if (!resolveBlock(step.unit().index, step.region().program, Reference::toBlock(number),
                        step.at))
        run_.issue(FlowIssue::UnknownBlock, step, where);
    }
  }
  if (leaveOut(step, false))
    return;
  const bool certain = flow.condition == Truth::Yes;
  step.live.path = run_.lengthen(step.live.path, PathNode::Kind::Jump, where);
  if (flow.item >= 0 && step.block.items[size_t(flow.item)].jump == JumpKind::ToStart)
    return loops_.goTo(step, step.region().program.body, std::move(step.live), certain);
  if (flow.target.isVacant())
    return run_.issue(FlowIssue::NoTarget, step, where);
  if (!flow.target.isConstant()) {
    run_.fork(step.activation, where);
    run_.issue(FlowIssue::ComputedTarget, step, where);
    return targets_.anywhere(step);
  }
  const auto number = int64_t(flow.target.number.value());
  run_.used.numbers.insert(number);
  const auto target =
      resolveBlock(step.unit().index, step.region().program, Reference::toBlock(number), step.at);
  if (!target)
    run_.issue(FlowIssue::UnknownBlock, step, where);
  else if (certain && loops_.isNeverLeft(step, step.unit(), *target))
    run_.issue(FlowIssue::EndlessLoop, step, where);
  else {
    if (flow.item >= 0 && structures_.isEntered(step.region(), step.at, *target))
      run_.issue(FlowIssue::IntoStructure, step, where,
                 {step.unit().source.id(), *target, *target + 1});
    loops_.goTo(step, *target, std::move(step.live), certain);
  }
}

/// Targets of a choice by value: pairs of a value and a target, perhaps with one for all others.
Jumps::Targets Jumps::byValue(const Step &step, llvm::ArrayRef<Argument> all) {
  const Interval &choice = step.outcome.flow.choice;
  const bool hasDefault = all.size() % 2;
  Targets targets;
  for (size_t i = 0; i + 1 < all.size(); i += 2) {
    const Value value = evaluate(step.block, all[i].expression, MachineState(), nullptr);
    const bool known = value.isConstant() && choice.isConstant();
    if (known && value.number.value() == choice.value()) {
      targets.arguments.push_back(&all[i + 1]);
      return targets;
    }
    if (!known && (!value.isConstant() || choice.contains(value.number.value())))
      targets.arguments.push_back(&all[i + 1]);
  }
  targets.fallsThrough = !hasDefault;
  if (hasDefault)
    targets.arguments.push_back(&all.back());
  return targets;
}

/// Targets of a jump that may be meant, and whether it is certain which.
Jumps::Targets Jumps::targetsOf(const Step &step, const Item &item) {
  const llvm::ArrayRef<Argument> all = step.block.argumentsOf(item);
  const Interval &choice = step.outcome.flow.choice;
  if (item.jump == JumpKind::ByValue)
    return byValue(step, all);
  Targets targets;
  if (item.jump == JumpKind::BySign) {
    const bool open[] = {choice.lo<0, choice.contains(0), choice.hi> 0};
    for (size_t i = 0; i < all.size() && i < 3; ++i)
      if (open[i])
        targets.arguments.push_back(&all[i]);
  } else {
    targets.arguments.push_back(&all[0]);
  }
  return targets;
}

/// After a conditional jump that is not taken: the next one of the block, or the next block.
void Jumps::notTaken(Step step) {
  const Block &block = step.block;
  for (size_t i = size_t(step.outcome.flow.item) + 1; i + 1 < block.items.size(); ++i) {
    if (block.items[i].kind != ItemKind::If || block.items[i + 1].kind != ItemKind::Jump)
      continue;
    const Flow flow = step.outcome.flow;
    Flow &next = step.outcome.flow;
    next.item = int16_t(i + 1);
    next.begin = block.items[i + 1].begin;
    next.end = block.items[i + 1].end;
    next.condition = truthOf(evaluate(block, block.items[i].condition, step.live.state, nullptr));
    next.target = evaluate(block, block.items[i + 1].value, step.live.state, nullptr);
    jump(step);
    step.outcome.flow = flow;
    return;
  }
  step.goOn();
}

/// A jump whose item names its targets.
void Jumps::byItem(Step &step, const Item &item) {
  const Region &region = step.region();
  const SourceRange where = step.flowRange();
  if (step.outcome.flow.condition == Truth::No)
    untaken(step, item);
  if (leaveOut(step, true))
    return;
  FileUnit *unit = &region.unit;
  const ProgramInfo *program = &region.program;
  if (item.nameEnd > item.nameBegin) {
    std::tie(unit, program) = run_.project.findProgram(
        region.unit, region.unit.source.text(item.nameBegin, item.nameEnd));
    if (!program)
      return run_.issue(FlowIssue::UnknownProgram, step,
                        {region.unit.source.id(), item.nameBegin, item.nameEnd});
  }
  const bool here = unit == &region.unit && program == &region.program;
  const Targets targets = targetsOf(step, item);
  const bool certain = step.outcome.flow.condition == Truth::Yes && targets.arguments.size() == 1 &&
                       !targets.fallsThrough;
  if (targets.fallsThrough)
    step.activation.add(step.block.next, step.live);
  if (!certain)
    run_.fork(step.activation, where);
  std::vector<uint32_t> offsets;
  for (const Argument *argument : targets.arguments) {
    const JumpKind kind = searchKind(item, *argument);
    if (const auto target = targets_.resolve(step, *unit, *program, *argument,
                                             here ? step.at : program->begin, kind))
      offsets.push_back(*target);
    else if (kind == JumpKind::IfFound)
      offsets.push_back(step.block.next);
  }
  for (size_t i = 0; i < offsets.size(); ++i) {
    const uint32_t target = offsets[i];
    if (here && structures_.isEntered(region, step.at, target))
      run_.issue(FlowIssue::IntoStructure, step, where, {unit->source.id(), target, target + 1});
    if (here && certain && item.arguments == 1 && loops_.isNeverLeft(step, *unit, target)) {
      run_.issue(FlowIssue::EndlessLoop, step, where);
      continue;
    }
    Live one = i + 1 == offsets.size() ? std::move(step.live) : step.live;
    one.path = run_.lengthen(one.path, PathNode::Kind::Jump, where);
    if (here)
      loops_.goTo(step, target, std::move(one), certain);
    else
      goOnIn(step, std::move(one), *unit, *program, target);
  }
}

/// The condition does not hold with the values of this program: with others the jump is taken, and
/// the blocks that it names have to be there.
void Jumps::untaken(Step &step, const Item &item) {
  if (item.nameEnd > item.nameBegin)
    return;
  for (const Argument *argument : targetsOf(step, item).arguments)
    targets_.resolve(step, step.unit(), step.region().program, *argument, step.at,
                     searchKind(item, *argument));
}

/// Goes on in the middle of another program; nothing comes back to after the jump.
void Jumps::goOnIn(const Step &step, Live live, FileUnit &unit, const ProgramInfo &program,
                   uint32_t target) {
  const Region &region = step.region();
  const RegionKind kind = region.kind == RegionKind::Section ? RegionKind::Main : region.kind;
  if (bodies_.isRunning(unit, target, kind) || bodies_.isDeep())
    return run_.cut(step.blockRange(), "programs jump into each other");
  for (Returned &exit : bodies_.run({unit, program, target, kind, region.caller}, std::move(live)))
    step.activation.exits.push_back(std::move(exit));
}

void Jumps::branch(Step &step) {
  const Item item = step.block.items[size_t(step.outcome.flow.item)];
  const SourceRange where = step.flowRange();
  run_.fork(step.activation, where);
  if (item.arguments)
    if (const auto target =
            targets_.resolve(step, step.unit(), step.region().program,
                             step.block.argumentsOf(item)[0], step.at, JumpKind::Anywhere)) {
      Live left = step.live;
      left.path = run_.lengthen(left.path, PathNode::Kind::Jump, where);
      loops_.goTo(step, *target, std::move(left), false);
    }
  step.goOn();
}

} // namespace ncvet
