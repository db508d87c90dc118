// Where control goes behind a block: jumps, loops, brackets of structured flow.
#include "analyzer/flow/engine.h"
#include "interp/evaluate/expression.h"

namespace ncvet {

namespace {

/// Visits of a loop head with joined states before bounds that still move are given up.
constexpr unsigned visitsBeforeWidening = 8;
/// Passes of a loop in which something unknown decides where to go: as likely as not it decides on
/// the way out, and the loop has no number of passes at all. So many are run, fewer when they are
/// long.
constexpr unsigned maxForkedVisits = 128, minForkedVisits = 4;
constexpr uint64_t maxForkedSteps = 1000; ///< blocks, those of called programs included
/// A jump to a number that is not known may go to any block with a number, when these are few.
constexpr size_t maxComputedTargets = 64;

Search searchOf(JumpKind kind) {
  return kind == JumpKind::Forward    ? Search::Forward
         : kind == JumpKind::Backward ? Search::Backward
                                      : Search::Anywhere;
}

/// The targets of a choice by value have their directions each for itself.
JumpKind searchKind(const Item &item, const Argument &target) {
  return item.jump != JumpKind::ByValue ? item.jump
         : target.separator == 'F'      ? JumpKind::Forward
         : target.separator == 'B'      ? JumpKind::Backward
         : target.separator == 'C'      ? JumpKind::IfFound
                                        : JumpKind::Anywhere;
}

} // namespace

bool Engine::leave(Activation &activation, Live &live, uint32_t at, const MachineState &before) {
  const Region &region = activation.region;
  const Flow flow = outcome_.flow;
  const SourceRange where = flowRange(region.unit);
  // Jumps in the text of another control are not seen: this block may be passed.
  if (outcome_.foreign && region.unit.source.text(region.program.begin, region.program.end)
                              .contains_insensitive("GOTO"))
    add(activation, block_.next, live);
  switch (flow.kind) {
  case FlowKind::Next:
    add(activation, block_.next, std::move(live));
    return true;
  case FlowKind::Jump:
    if (flow.item >= 0 && block_.items[size_t(flow.item)].arguments)
      jumpTo(activation, live, at, before);
    else
      jump(activation, live, at, before);
    return true;
  case FlowKind::Branch:
    branch(activation, live, at, before);
    return true;
  case FlowKind::Structure:
    structure(activation, live, at, before);
    return true;
  case FlowKind::Repeat:
    repeat(activation, live, at, before);
    return true;
  case FlowKind::LoopBegin:
  case FlowKind::LoopEnd:
    loop(activation, live, at, before);
    return true;
  case FlowKind::CallModal:
    beginModalCall(activation, live, at, before);
    return true;
  case FlowKind::Call:
  case FlowKind::CallLocal:
  case FlowKind::CallNamed:
    call(activation, live, at, before);
    return true;
  case FlowKind::Contour:
    contour(activation, live, before);
    return true;
  case FlowKind::Profile:
    profile(activation, live, at, before);
    return true;
  case FlowKind::End:
    if (region.kind != Kind::Main && region.kind != Kind::Profile && region.depth > 0) {
      issue(FlowIssue::EndInSubprogram, activation, live, before, where);
      if (region.unit.dialect->endReturns)
        activation.exits.push_back({std::move(live), notSet});
    }
    return true;
  case FlowKind::Alarm:
    return true;
  case FlowKind::Return:
    break;
  }
  int64_t target = notSet;
  if (flow.target.isConstant())
    target = int64_t(flow.target.number.value());
  if (region.kind == Kind::Main) {
    if (target != notSet) {
      // M99 P in a main program is a jump.
      usedNumbers_.insert(target);
      if (const auto offset = region.unit.index.block(region.program, target, at))
        goTo(activation, at, *offset, std::move(live), true);
      else
        issue(FlowIssue::UnknownBlock, activation, live, before, where);
      return true;
    }
    issue(FlowIssue::ReturnInMain, activation, live, before, where);
    return true;
  }
  activation.exits.push_back({std::move(live), target});
  return true;
}

/// Continues at `target`; jumps that lead back are counted, so that every analysis ends.
void Engine::goTo(Activation &activation, uint32_t from, uint32_t target, Live live, bool certain) {
  if (target > from)
    add(activation, target, std::move(live));
  else
    backTo(activation, target, std::move(live), certain);
}

/// Where a loop that begins at `target` is seen: at the head of a structure, else at the jump.
SourceRange Engine::loopAt(const Activation &activation, uint32_t target) const {
  const FileUnit &unit = activation.region.unit;
  Block head;
  unit.reader->read(target, head);
  for (const Item &item : head.items)
    if (item.kind == ItemKind::Structure)
      return {unit.source.id(), item.begin, item.end};
  return {unit.source.id(), activation.lastBegin, activation.lastEnd};
}

/// Whether a loop whose last jump back is certain is followed pass by pass.
bool Engine::runsForReal(const Activation &activation, Head &head) const {
  if (head.visits == 1)
    head.firstStep = steps_;
  head.forkedVisits += head.lastForks != activation.forks;
  head.lastForks = activation.forks;
  head.abstract |=
      head.forkedVisits > maxForkedVisits ||
      (head.forkedVisits > minForkedVisits && steps_ - head.firstStep > maxForkedSteps);
  return !head.abstract && !abstract_;
}

void Engine::backTo(Activation &activation, uint32_t target, Live live, bool certain) {
  Head &head = activation.heads[target];
  ++head.visits;
  if (certain && runsForReal(activation, head)) {
    // Run for real, unless the same state comes round again: then it comes round for ever. Hashing
    // every pass would cost more than running it, so this is looked for at growing distances.
    constexpr unsigned window = 4;
    if (head.visits == head.nextSnapshot) {
      head.snapshot = hash(live.state);
      head.snapshotForks = activation.forks;
      head.snapshotStops = stops_;
      head.windowEnd = head.visits + window;
      head.nextSnapshot *= 4;
    } else if (head.visits <= head.windowEnd && hash(live.state) == head.snapshot) {
      // A way out that depends on something unknown was taken beside this one, or the operator is
      // asked in every pass: who loads the next part leaves the loop by reset.
      if (head.snapshotForks == activation.forks && head.snapshotStops == stops_)
        issue(FlowIssue::EndlessLoop, activation, live, live.state, loopAt(activation, target));
      return;
    }
    wait(activation, target, std::move(live));
    return;
  }
  if (head.hasSeen) {
    if (covers(head.seen, live.state))
      return;
    head.seen = head.visits < visitsBeforeWidening ? join(head.seen, live.state)
                                                   : widen(head.seen, live.state);
  } else {
    head.seen = live.state;
    head.hasSeen = true;
  }
  live.state = head.seen;
  live.path = step(live.path, PathNode::Kind::LoopPass,
                   {activation.region.unit.source.id(), activation.lastBegin, activation.lastEnd});
  ++activation.rounds;
  wait(activation, target, std::move(live));
}

/// Whether the jump of the block at hand leads back over blocks that hold no way out, whatever the
/// values are. Asked once for every jump.
bool Engine::neverLeft(FileUnit &unit, uint32_t target, uint32_t at) {
  if (target > at || block_.skip >= 0 ||
      llvm::any_of(block_.items, [](const Item &i) { return i.kind == ItemKind::If; }))
    return false;
  const auto [known, fresh] = closedLoops_.try_emplace({unit.source.id(), at}, false);
  if (fresh)
    known->second = !holdsWayOut(unit, target, at);
  return known->second;
}

void Engine::jump(Activation &activation, Live &live, uint32_t at, const MachineState &before) {
  const Region &region = activation.region;
  const Flow flow = outcome_.flow;
  const SourceRange where = flowRange(region.unit);
  if (flow.condition != Truth::Yes) {
    Live straight = live;
    if (flow.condition == Truth::Unknown) {
      fork(activation, where);
      straight.path = step(live.path, PathNode::Kind::NoJump, where);
    }
    add(activation, block_.next, std::move(straight));
    if (flow.condition == Truth::No)
      return;
  }
  const bool certain = flow.condition == Truth::Yes;
  live.path = step(live.path, PathNode::Kind::Jump, where);
  if (flow.item >= 0 && block_.items[size_t(flow.item)].jump == JumpKind::ToStart)
    return goTo(activation, at, region.program.body, std::move(live), certain);
  if (flow.target.isVacant()) {
    issue(FlowIssue::NoTarget, activation, live, before, where);
    return;
  }
  if (!flow.target.isConstant()) {
    fork(activation, where);
    issue(FlowIssue::ComputedTarget, activation, live, before, where);
    anywhere(activation, live, at);
    return;
  }
  const auto number = int64_t(flow.target.number.value());
  usedNumbers_.insert(number);
  if (const auto target = region.unit.index.block(region.program, number, at);
      target && neverLeft(region.unit, *target, at))
    issue(FlowIssue::EndlessLoop, activation, live, before, where);
  else if (target)
    goTo(activation, at, *target, std::move(live), certain);
  else
    issue(FlowIssue::UnknownBlock, activation, live, before, where);
}

const FlowShape &Engine::shape(const FileUnit &unit, const ProgramInfo &program) {
  const auto [found, fresh] = shapes_.try_emplace({unit.source.id(), program.begin});
  if (fresh)
    found->second = readShape(*unit.reader, program.begin, program.end);
  return found->second;
}

void Engine::loop(Activation &activation, Live &live, uint32_t at, const MachineState &before) {
  const Region &region = activation.region;
  const Flow flow = outcome_.flow;
  const uint32_t next = block_.next;
  const FlowShape &shape = this->shape(region.unit, region.program);
  if (llvm::is_contained(shape.mismatched, at))
    issue(FlowIssue::StructureMismatch, activation, live, before, flowRange(region.unit));
  if (flow.kind == FlowKind::LoopEnd) {
    const auto head = shape.back.find(at);
    if (head == shape.back.end())
      add(activation, next, std::move(live));
    else
      backTo(activation, head->second, std::move(live), !activation.heads[head->second].abstract);
    return;
  }
  const auto behind = shape.past.find(at);
  if (flow.condition == Truth::Yes || behind == shape.past.end()) {
    if (flow.condition != Truth::No)
      add(activation, next, std::move(live));
    return;
  }
  if (flow.condition == Truth::Unknown) {
    // From now on this head is a place where states are joined.
    fork(activation, flowRange(region.unit));
    activation.heads[at].abstract = true;
    Live body = live;
    body.path = step(live.path, PathNode::Kind::Jump, flowRange(region.unit));
    add(activation, next, std::move(body));
  }
  add(activation, behind->second, std::move(live));
}

/// A jump of which only the run decides where it leads: to any numbered block, or where its target
/// is put together from texts to any label that begins as they do.
void Engine::anywhere(Activation &activation, const Live &live, uint32_t at, const Argument *text,
                      JumpKind kind) {
  const Region &region = activation.region;
  if (text && text->expression < block_.expressions.size() &&
      block_.expressions[text->expression].bad)
    return anyLabel(activation, live, at, *text, kind);
  const llvm::ArrayRef<NumberedBlock> all = region.unit.index.numbers(region.program);
  if (all.size() > maxComputedTargets) {
    cut("a computed jump may lead to too many blocks");
    return;
  }
  const std::vector<NumberedBlock> targets(all.begin(), all.end());
  for (const NumberedBlock &target : targets) {
    usedNumbers_.insert(target.number);
    goTo(activation, at, target.offset, live, false);
  }
}

void Engine::anyLabel(Activation &activation, const Live &live, uint32_t at, const Argument &target,
                      JumpKind kind) {
  const Region &region = activation.region;
  fork(activation, {region.unit.source.id(), target.begin, target.end});
  llvm::StringRef text = region.unit.source.text(target.begin, target.end);
  const bool literal = text.consume_front("\"");
  const std::string begin =
      literal ? region.unit.reader->labelKey(text.take_until([](char c) { return c == '"'; })) : "";
  std::vector<uint32_t> places;
  for (const auto &label : region.unit.index.labels(region.program)) {
    if (!label.getKey().startswith(begin))
      continue;
    usedLabels_.insert(label.getKey().str());
    for (const uint32_t place : label.getValue())
      if (kind == JumpKind::Forward ? place > at : kind != JumpKind::Backward || place <= at)
        places.push_back(place);
  }
  llvm::sort(places);
  if (places.size() > maxComputedTargets)
    return cut("a computed jump may lead to too many blocks");
  for (const uint32_t place : places)
    goTo(activation, at, place, live, false);
}

/// Every label and number of the block's jumps is in use, wherever this time's values lead.
void Engine::noteTargets(const FileUnit &unit) {
  for (const Item &item : block_.items) {
    if (item.kind != ItemKind::Jump || item.nameEnd > item.nameBegin)
      continue;
    for (const Argument &target : block_.argumentsOf(item)) {
      if (target.kind == ArgumentKind::Label) {
        usedLabels_.insert(unit.reader->labelKey(unit.source.text(target.begin, target.end)));
      } else if (target.kind == ArgumentKind::BlockNumber) {
        const Value number = evaluate(block_, target.expression, MachineState(), nullptr);
        if (number.isConstant())
          usedNumbers_.insert(std::llround(number.number.value()));
      }
    }
  }
}

/// Offset of the block that `target` names in `program`; none, with an issue, when there is none.
std::optional<uint32_t> Engine::resolve(Activation &activation, const Live &live,
                                        const MachineState &before, FileUnit &unit,
                                        const ProgramInfo &program, const Argument &target,
                                        uint32_t at, JumpKind kind) {
  const SourceRange where{activation.region.unit.source.id(), target.begin, target.end};
  std::optional<uint32_t> offset;
  if (target.kind == ArgumentKind::Label) {
    const llvm::StringRef text = activation.region.unit.source.text(target.begin, target.end);
    usedLabels_.insert(unit.reader->labelKey(text));
    offset = unit.index.label(program, text, at, searchOf(kind));
  } else {
    if (target.kind ==
        ArgumentKind::Name) // no place at all: how it is written is a rule's business
      return std::nullopt;
    const Value number = target.kind == ArgumentKind::Empty
                             ? Value::vacant()
                             : evaluate(block_, target.expression, live.state, nullptr);
    if (target.kind == ArgumentKind::BlockNumber && number.isConstant()) {
      const auto wanted = std::llround(number.number.value());
      usedNumbers_.insert(wanted);
      offset = unit.index.block(program, wanted, at, searchOf(kind));
    } else {
      issue(number.isVacant() ? FlowIssue::NoTarget : FlowIssue::ComputedTarget, activation, live,
            before, where);
      if (!number.isVacant() && &unit == &activation.region.unit)
        anywhere(activation, live, at, &target, kind);
      return std::nullopt;
    }
  }
  if (!offset && kind != JumpKind::IfFound)
    issue(FlowIssue::UnknownBlock, activation, live, before, where);
  return offset;
}

/// Targets of a jump that may be meant, and whether it is certain which.
Engine::Targets Engine::targetsOf(const Item &item, const Interval &choice) const {
  const llvm::ArrayRef<Argument> all = block_.argumentsOf(item);
  Targets targets;
  if (item.jump == JumpKind::BySign) {
    const bool way[] = {choice.lo<0, choice.contains(0), choice.hi> 0};
    for (size_t i = 0; i < all.size() && i < 3; ++i)
      if (way[i])
        targets.arguments.push_back(&all[i]);
    targets.fallsThrough = false;
  } else if (item.jump == JumpKind::ByValue) {
    const bool hasDefault = all.size() % 2;
    for (size_t i = 0; i + 1 < all.size(); i += 2) {
      const Value value = evaluate(block_, all[i].expression, MachineState(), nullptr);
      const bool known = value.isConstant() && choice.isConstant();
      if (known && value.number.value() == choice.value()) {
        targets.arguments.push_back(&all[i + 1]);
        targets.fallsThrough = false;
        return targets;
      }
      if (!known && (!value.isConstant() || choice.contains(value.number.value())))
        targets.arguments.push_back(&all[i + 1]);
    }
    targets.fallsThrough = !hasDefault;
    if (hasDefault)
      targets.arguments.push_back(&all.back());
  } else {
    targets.arguments.push_back(&all[0]);
    targets.fallsThrough = false;
  }
  return targets;
}

/// Behind a conditional jump that is not taken: the next one of the block, or the next block.
void Engine::notTaken(Activation &activation, Live live, uint32_t at, const MachineState &before) {
  for (size_t i = size_t(outcome_.flow.item) + 1; i + 1 < block_.items.size(); ++i) {
    if (block_.items[i].kind != ItemKind::If || block_.items[i + 1].kind != ItemKind::Jump)
      continue;
    const Flow flow = outcome_.flow;
    Flow &next = outcome_.flow;
    next.item = int16_t(i + 1);
    next.begin = block_.items[i + 1].begin;
    next.end = block_.items[i + 1].end;
    next.condition = truthOf(evaluate(block_, block_.items[i].condition, live.state, nullptr));
    next.target = evaluate(block_, block_.items[i + 1].value, live.state, nullptr);
    leave(activation, live, at, before);
    outcome_.flow = flow;
    return;
  }
  add(activation, block_.next, std::move(live));
}

/// A jump whose item names its targets.
void Engine::jumpTo(Activation &activation, Live &live, uint32_t at, const MachineState &before) {
  const Region &region = activation.region;
  const Flow flow = outcome_.flow;
  const Item item = block_.items[size_t(flow.item)];
  const SourceRange where = flowRange(region.unit);
  if (at >= activation.lastNoted) {
    noteTargets(region.unit);
    activation.lastNoted = at + 1;
  }
  if (flow.condition != Truth::Yes) {
    Live straight = live;
    if (flow.condition == Truth::Unknown) {
      fork(activation, where);
      straight.path = step(live.path, PathNode::Kind::NoJump, where);
    }
    notTaken(activation, std::move(straight), at, before);
    if (flow.condition == Truth::No)
      return;
  }
  FileUnit *unit = &region.unit;
  const ProgramInfo *program = &region.program;
  if (item.nameEnd > item.nameBegin) {
    std::tie(unit, program) =
        project_.findProgram(region.unit, region.unit.source.text(item.nameBegin, item.nameEnd));
    if (!program) {
      issue(FlowIssue::UnknownProgram, activation, live, before,
            {region.unit.source.id(), item.nameBegin, item.nameEnd});
      return;
    }
  }
  const bool here = unit == &region.unit && program == &region.program;
  const Targets targets = targetsOf(item, flow.choice);
  const bool certain =
      flow.condition == Truth::Yes && targets.arguments.size() == 1 && !targets.fallsThrough;
  if (targets.fallsThrough)
    add(activation, block_.next, live);
  if (!certain)
    fork(activation, where);
  // What a nested run does to the block at hand must not touch the targets that are left.
  const llvm::SmallVector<const Argument *, 3> arguments = targets.arguments;
  std::vector<uint32_t> offsets;
  for (const Argument *argument : arguments) {
    const auto target = resolve(activation, live, before, *unit, *program, *argument,
                                here ? at : program->begin, searchKind(item, *argument));
    if (target)
      offsets.push_back(*target);
    else if (searchKind(item, *argument) == JumpKind::IfFound)
      offsets.push_back(block_.next);
  }
  for (const uint32_t target : offsets) {
    if (here && entersStructure(region, at, target))
      issue(FlowIssue::IntoStructure, activation, live, before, where,
            {unit->source.id(), target, target + 1});
    Live one = live;
    one.path = step(live.path, PathNode::Kind::Jump, where);
    if (here && certain && item.arguments == 1 && neverLeft(*unit, target, at))
      issue(FlowIssue::EndlessLoop, activation, one, before, where);
    else if (here)
      goTo(activation, at, target, std::move(one), certain);
    else
      goOnIn(activation, std::move(one), *unit, *program, target);
  }
}

/// Goes on in the middle of another program; nothing comes back behind the jump.
void Engine::goOnIn(Activation &activation, Live live, FileUnit &unit, const ProgramInfo &program,
                    uint32_t target) {
  const Region &region = activation.region;
  const Kind kind = region.kind == Kind::Section ? Kind::Main : region.kind;
  if (isRunning(unit, target, kind) || callStack_.size() >= limits_.callDepth) {
    cut("programs jump into each other");
    return;
  }
  for (Returned &exit : callBody({unit, program, target, kind, region.depth}, std::move(live)))
    activation.exits.push_back(std::move(exit));
}

/// The operator answers, or leaves by the key that the block names a target for.
void Engine::branch(Activation &activation, Live &live, uint32_t at, const MachineState &before) {
  const Item item = block_.items[size_t(outcome_.flow.item)];
  fork(activation, flowRange(activation.region.unit));
  if (item.arguments)
    if (const auto target =
            resolve(activation, live, before, activation.region.unit, activation.region.program,
                    block_.argumentsOf(item)[0], at, JumpKind::Anywhere)) {
      Live left = live;
      left.path = step(live.path, PathNode::Kind::Jump, flowRange(activation.region.unit));
      goTo(activation, at, *target, std::move(left), false);
    }
  add(activation, block_.next, std::move(live));
}

/// Whether `target` lies inside a bracket of structured flow that does not hold `from`.
bool Engine::entersStructure(const Region &region, uint32_t from, uint32_t target) {
  for (const auto &[head, past] : this->shape(region.unit, region.program).past)
    if (target > head && target < past && (from < head || from >= past))
      return true;
  return false;
}

/// One bracket of structured flow.
void Engine::structure(Activation &activation, Live &live, uint32_t at,
                       const MachineState &before) {
  const Region &region = activation.region;
  const Flow flow = outcome_.flow;
  const SourceRange where = flowRange(region.unit);
  const Item item = block_.items[size_t(flow.item)];
  const uint32_t next = block_.next;
  const FlowShape &shape = this->shape(region.unit, region.program);
  if (llvm::is_contained(shape.mismatched, at)) {
    // Where the text is read as it runs, the partner is looked for only where the body is left out.
    const bool head = item.structure == Structure::If || item.structure == Structure::While ||
                      item.structure == Structure::Times;
    const bool runs = !region.unit.dialect->loadsWhole && (item.structure == Structure::Repeat ||
                                                           (head && flow.condition == Truth::Yes));
    issue(runs ? FlowIssue::StructureOpen : FlowIssue::StructureMismatch, activation, live, before,
          where);
    add(activation, next, std::move(live));
    return;
  }
  if (const auto first = shape.duplicates.find(at); first != shape.duplicates.end())
    issue(FlowIssue::DuplicateLabel, activation, live, before, where,
          {region.unit.source.id(), first->second, first->second + 1});
  const auto past = shape.past.find(at), back = shape.back.find(at), out = shape.out.find(at);
  // `condition` leads to the next block, else to `other`; an unknown one to both.
  const auto decide = [&](Truth condition, uint32_t other, bool loops) {
    if (condition == Truth::Unknown) {
      fork(activation, where);
      Live body = live;
      body.path = step(live.path, PathNode::Kind::NoJump, where);
      add(activation, next, std::move(body));
      live.path = step(live.path, PathNode::Kind::Jump, where);
      if (loops)
        activation.heads[other].abstract = true;
      live.state.seeksBranch = !loops && shape.back.lookup(other) == at;
    } else if (condition == Truth::Yes) {
      add(activation, next, std::move(live));
      return;
    } else {
      live.state.seeksBranch = !loops && shape.back.lookup(other) == at;
    }
    goTo(activation, at, other, std::move(live), condition == Truth::No);
  };
  const auto opposite = [](Truth truth) {
    return truth == Truth::Yes ? Truth::No : truth == Truth::No ? Truth::Yes : Truth::Unknown;
  };
  switch (item.structure) {
  case Structure::If:
    return decide(flow.condition, past->second, false);
  case Structure::ElseIf: // reached from the branch in front of it: the chain is done
    if (!before.seeksBranch)
      return goTo(activation, at, out->second, std::move(live), true);
    return decide(flow.condition, past->second, false);
  case Structure::Sub:
    return goTo(activation, at, past->second, std::move(live), true);
  case Structure::EndSub:
  case Structure::Return:
    if (region.kind == Kind::Main) {
      issue(FlowIssue::StructureMismatch, activation, live, before, where);
      return add(activation, next, std::move(live));
    }
    activation.exits.push_back({std::move(live), notSet});
    return;
  case Structure::Break:
  case Structure::Continue:
    return goTo(activation, at, out->second, std::move(live), true);
  case Structure::Times:
    if (flow.condition == Truth::Unknown)
      activation.heads[next].abstract = true;
    return decide(flow.condition, past->second, false);
  case Structure::EndTimes: {
    Block head;
    region.unit.reader->read(back->second, head);
    const Truth again = countDown(head, live.state);
    if (again == Truth::Unknown)
      activation.heads[head.next].abstract = true;
    return decide(opposite(again), head.next, true);
  }
  case Structure::While:
    if (past == shape.past.end()) // the end of a loop with the test behind
      return decide(opposite(flow.condition), back->second, true);
    [[fallthrough]];
  case Structure::For:
    if (flow.condition == Truth::Unknown)
      activation.heads[item.structure == Structure::For ? next : at].abstract = true;
    return decide(flow.condition, past->second, false);
  case Structure::Else:
    return goTo(activation, at, past->second, std::move(live), true);
  case Structure::EndWhile:
  case Structure::EndLoop:
    return backTo(activation, back->second, std::move(live),
                  !activation.heads[back->second].abstract);
  case Structure::Until:
    return decide(flow.condition, back->second, true);
  case Structure::EndFor: {
    Block head;
    region.unit.reader->read(back->second, head);
    const Truth again = countUp(head, live.state);
    if (again == Truth::Unknown)
      activation.heads[head.next].abstract = true;
    // (the condition of `decide` is the way on)
    return decide(opposite(again), head.next, true);
  }
  case Structure::EndIf:
  case Structure::Loop:
  case Structure::Repeat:
    return add(activation, next, std::move(live));
  }
}

/// Counts one run of the loop whose head is `head`; whether it runs again.
Truth Engine::countDown(const Block &head, MachineState &state) {
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
Truth Engine::countUp(const Block &head, MachineState &state) {
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

} // namespace ncvet
