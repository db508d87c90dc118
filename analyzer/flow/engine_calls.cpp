// Runs what a block calls: subprograms, macros, sections that are repeated, turning profiles.
#include "analyzer/flow/end_of_passes.h"
#include "analyzer/flow/engine.h"
#include "formats/dialect/measure.h"
#include "interp/evaluate/expression.h"
#include "interp/state/kept_modes.h"

#include <algorithm>

namespace ncvet {

namespace {

/// Results of one called program that are remembered.
constexpr size_t memosPerProgram = 64;
/// Passes of one call's repeat count that are run for real.
constexpr double maxRepeats = 10000;
/// What a called body costs besides its blocks, in plain moves: states are copied and compared.
constexpr uint64_t workOfCall = 16;
/// Cycles whose passes along a turned contour are made, to see where they end.
constexpr unsigned mostPassesFollowed = 20;

} // namespace

/// Runs a called body, or remembers what it did for the same state before.
Engine::Exits Engine::callBody(const Region &region, Live live) {
  auto &memos = memos_[keyOf(region)];
  const uint64_t print = hash(live.state);
  // Deeper inside repeated sections than before, one more level may be one too many.
  const unsigned sections = region.kind == Kind::Section ? runningSections() : 0;
  for (const Memo &memo : memos)
    if (!watcher_ && memo.hash == print && sections <= memo.sections &&
        equal(memo.entry, live.state)) {
      Exits exits = memo.exits;
      stops_ += memo.stops;
      for (Returned &exit : exits)
        exit.live.path = live.path;
      return exits;
    }
  repeated_ += workOfCall;
  // The storage of the block at hand is needed again behind the call.
  Block savedBlock = block_;
  Outcome savedOutcome = outcome_;
  callStack_.push_back(keyOf(region));
  const MachineState entry = live.state;
  const PathNode *path = live.path;
  const unsigned stops = stops_;
  Lives lives;
  lives.push_back(std::move(live));
  Exits raw = execute(region, std::move(lives));
  callStack_.pop_back();
  block_ = std::move(savedBlock);
  outcome_ = std::move(savedOutcome);
  // Ways that return to the same place in the same modes are one.
  Exits exits;
  std::map<int64_t, Lives> byTarget;
  for (Returned &exit : raw) {
    exit.live.path = path;
    mergeInto(region.unit, byTarget[exit.target], std::move(exit.live));
  }
  for (auto &[target, group] : byTarget)
    for (Live &exit : group)
      exits.push_back({std::move(exit), target});
  if (!stopped_ && !watcher_ && memos.size() < memosPerProgram)
    memos.push_back({print, entry, exits, sections, stops_ != stops});
  return exits;
}

/// The program or block that the flow calls; none, with an issue, when there is none.
std::optional<Engine::Callee> Engine::callee(Activation &activation, const Live &live, uint32_t at,
                                             const MachineState &before) {
  const Region &region = activation.region;
  FileUnit &unit = region.unit;
  const Flow &flow = outcome_.flow;
  const SourceRange where = flowRange(unit);
  const auto missing = [&](FlowIssue kind, SourceRange range) {
    issue(kind, activation, live, before, range);
    return std::nullopt;
  };
  Callee callee{&unit, &region.program, 0, Kind::Subprogram, notSet};
  if (flow.kind == FlowKind::CallNamed || (flow.kind == FlowKind::CallModal && flow.item >= 0)) {
    const Item &item = block_.items[size_t(flow.item)];
    std::string name = unit.source.text(item.nameBegin, item.nameEnd).str();
    SourceRange range{unit.source.id(), item.nameBegin, item.nameEnd};
    if (name.empty()) {
      range = where;
      if (!flow.target.isConstant()) // the value of a variable is the name
        return missing(FlowIssue::ComputedTarget, where);
      name = std::to_string(std::llround(flow.target.number.value()));
    }
    calledNames_.insert(llvm::StringRef(name).upper());
    if (item.positional) {
      if (!findBracketed(callee, name)) {
        // Whoever calls this subprogram may lie elsewhere, and have what it calls beside it.
        if (callerUnknown_)
          return std::nullopt;
        return missing(FlowIssue::UnknownProgram, range);
      }
      return callee;
    }
    std::tie(callee.unit, callee.program) = project_.findProgram(unit, llvm::StringRef(name));
    if (!callee.program) {
      const Defined *known = unit.index.definition(region.program, name);
      const CodeIndex own = unit.dialect->keyword(name);
      if (item.external || (known && known->kind == ItemKind::Macro) ||
          (own != noCode && unit.dialect->codes[own].isProgram))
        return std::nullopt; // it need not lie here
      return missing(FlowIssue::UnknownProgram, range);
    }
    callee.start = callee.program->body;
    return callee;
  }
  if (flow.target.isVacant())
    return missing(FlowIssue::NoTarget, where);
  if (!flow.target.isConstant())
    return missing(FlowIssue::ComputedTarget, where);
  callee.number = int64_t(flow.target.number.value());
  if (flow.kind == FlowKind::CallLocal) {
    usedNumbers_.insert(callee.number);
    const auto offset = unit.index.block(*callee.program, callee.number, at);
    if (!offset)
      return missing(FlowIssue::UnknownBlock, where);
    callee.start = *offset;
    callee.kind = Kind::LocalSubprogram;
    if (&unit == &unit_)
      localTargets_.insert(callee.start);
    return callee;
  }
  calledPrograms_.insert(callee.number);
  std::tie(callee.unit, callee.program) = project_.findProgram(unit, callee.number);
  if (!callee.program)
    return missing(FlowIssue::UnknownProgram, where);
  callee.start = callee.program->body;
  if (flow.startAt.isConstant()) {
    const auto first = int64_t(flow.startAt.number.value());
    if (callee.unit == &unit_)
      usedNumbers_.insert(first);
    if (const auto offset = callee.unit->index.block(*callee.program, first, callee.program->begin))
      callee.start = *offset;
  }
  return callee;
}

/// The subprogram `name` between brackets, in the callee's file or in one of its own; false: there
/// is none.
bool Engine::findBracketed(Callee &callee, llvm::StringRef name) {
  auto body = subprogramBody(*callee.unit, name, callee.program);
  if (!body) {
    std::tie(callee.unit, callee.program) = project_.findProgram(*callee.unit, name);
    if (callee.program)
      body = subprogramBody(*callee.unit, name, callee.program);
  }
  if (!body)
    return false;
  if (callee.unit == &unit_)
    calledBodies_.insert(*body);
  callee.start = *body;
  callee.kind = Kind::LocalSubprogram;
  return true;
}

/// First block behind the bracket that opens the subprogram `label`, and the program that holds it.
std::optional<uint32_t> Engine::subprogramBody(const FileUnit &unit, llvm::StringRef label,
                                               const ProgramInfo *&program) {
  for (const ProgramInfo &one : unit.index.programs())
    if (const auto at = unit.index.label(one, label, one.begin)) {
      Block block;
      unit.reader->read(*at, block);
      program = &one;
      return block.next;
    }
  return std::nullopt;
}

/// Repeated sections that are being executed, one in the other.
unsigned Engine::runningSections() const {
  return unsigned(llvm::count_if(
      callStack_, [](const Running &running) { return std::get<2>(running) == Kind::Section; }));
}

bool Engine::isRunning(const FileUnit &unit, uint32_t start, Kind kind, uint32_t end) const {
  return llvm::is_contained(callStack_, Running{unit.source.id(), start, kind, end});
}

/// Whether the call comes back to a program that is being executed.
bool Engine::recurs(const Region &region, const Callee &callee) const {
  if (isRunning(*callee.unit, callee.start, callee.kind))
    return true;
  if (callee.kind != Kind::Subprogram)
    return false;
  return (callee.unit == &region.unit && callee.program == &region.program) ||
         (callee.unit == &unit_ && callee.program == &unit_.index.programs().front());
}

/// Behind a call of which nothing is known.
void Engine::goOnUnknown(Activation &activation, Live &live) {
  const FileUnit &unit = activation.region.unit;
  lose(flowRange(unit), "what is called here is not known");
  const Variables locals = live.state.locals;
  forget(live, *unit.dialect);
  if (unit.dialect->variableRanges.namedLocal) // no call changes those of its caller
    live.state.locals = locals;
  add(activation, block_.next, std::move(live));
}

/// Whether a call is followed into its program.
bool Engine::mayEnter(Activation &activation, const Live &live, const MachineState &before,
                      const Callee &callee) {
  const Region &region = activation.region;
  const SourceRange where = flowRange(region.unit);
  if (recurs(region, callee)) {
    // Without a condition nothing ends it; with one it is followed until the control's levels end.
    const ProgramInfo &program = *callee.program;
    const llvm::StringRef body = callee.unit->source.text(program.begin, program.end);
    const bool conditional = body.contains_insensitive("IF") ||
                             body.contains_insensitive("WHILE") ||
                             body.contains_insensitive("GOTO");
    if (!conditional || region.depth + 1 >= limits_.callDepth) {
      issue(FlowIssue::Recursion, activation, live, before, where,
            {callee.unit->source.id(), callee.start, callee.start + 1});
      return false;
    }
  }
  const unsigned allowed = region.unit.dialect->limits.callDepth;
  if (allowed && region.depth + 1 > allowed)
    issue(FlowIssue::TooDeep, activation, live, before, where);
  return region.depth + 1 < limits_.callDepth;
}

void Engine::call(Activation &activation, Live &live, uint32_t at, const MachineState &before) {
  const Region &region = activation.region;
  FileUnit &unit = region.unit;
  const Flow flow = outcome_.flow;
  const SourceRange where = flowRange(unit);
  const std::optional<Callee> callee = this->callee(activation, live, at, before);
  if (!callee || !mayEnter(activation, live, before, *callee))
    return goOnUnknown(activation, live);
  const PathNode *path = live.path;
  live.path = step(path, PathNode::Kind::Call, where, callee->number);
  live.state.restoresModes = false;
  live.state.saved = {};
  Passes passes;
  passes.at = at;
  passes.next = block_.next;
  passes.path = path;
  passes.setCount(flow.repeat);
  if (flow.macro) {
    passes.locals = live.state.locals;
    live.state.locals = flow.arguments;
  }
  if (flow.kind == FlowKind::CallNamed) {
    const MachineState caller = live.state;
    passes.locals = caller.locals;
    live.state.locals = Variables();
    const Item &item = block_.items[size_t(flow.item)];
    if (item.positional) {
      bindPositions(item, caller, live.state);
    } else {
      checkArguments(activation, live, before, *callee, item);
      bindArguments(*callee, givenTo(item, caller), caller, live.state, passes);
    }
  }
  runPasses(activation,
            {*callee->unit, *callee->program, callee->start, callee->kind, region.depth + 1},
            std::move(live), before, passes);
}

/// The block of a program that says what it takes; none when it takes nothing.
std::optional<Block> Engine::parametersOf(const Callee &callee) const {
  Block head;
  uint32_t at = callee.program->body;
  for (; at < callee.program->end; at = head.next) {
    callee.unit->reader->read(at, head);
    if (!head.isEmpty())
      break;
  }
  if (llvm::any_of(head.items, [](const Item &i) { return i.kind == ItemKind::Parameters; }))
    return head;
  return std::nullopt;
}

/// Whether a call has the arguments that the program wants.
void Engine::checkArguments(Activation &activation, const Live &live, const MachineState &before,
                            const Callee &callee, const Item &call) {
  if (!(dispatcher_.kinds() & bitOf(EventKind::FlowIssue)))
    return;
  FileUnit &unit = activation.region.unit;
  const llvm::ArrayRef<Argument> given = block_.argumentsOf(call);
  const SourceRange where{unit.source.id(), call.begin, call.end};
  const std::optional<Block> head = parametersOf(callee);
  llvm::ArrayRef<Argument> taken;
  SourceRange related;
  if (head)
    for (const Item &item : head->items)
      if (item.kind == ItemKind::Parameters) {
        taken = head->argumentsOf(item);
        related = {callee.unit->source.id(), item.begin, item.end};
      }
  if (given.size() > taken.size())
    return issue(FlowIssue::TooManyArguments, activation, live, before, where, related);
  for (size_t i = 0; i < taken.size(); ++i) {
    const bool left = i >= given.size() || given[i].kind == ArgumentKind::Empty;
    if (taken[i].byReference &&
        (left || (given[i].expression != noExpression && !isVariable(given[i].expression))))
      return issue(FlowIssue::ArgumentNotVariable, activation, live, before, where, related);
    if (left && taken[i].expression == noExpression && !taken[i].byReference && given.size() > 0)
      return issue(FlowIssue::ArgumentLeftOut, activation, live, before, where, related);
  }
  const Defined *declared = unit.index.definition(activation.region.program,
                                                  unit.source.text(call.nameBegin, call.nameEnd));
  if (!declared || declared->kind != ItemKind::Declaration)
    return;
  Block declaration;
  unit.reader->read(unit.source.lines().lineBegin(declared->begin), declaration);
  for (const Item &item : declaration.items) {
    if (item.kind != ItemKind::Declaration)
      continue;
    const llvm::ArrayRef<Argument> said = declaration.argumentsOf(item);
    bool same = said.size() == taken.size();
    for (size_t i = 0; same && i < said.size(); ++i)
      same = said[i].type == taken[i].type && said[i].byReference == taken[i].byReference;
    if (!same)
      issue(FlowIssue::DeclarationMismatch, activation, live, before, where, related);
  }
}

/// Whether an argument is a variable, so that a value can come back in it.
bool Engine::isVariable(uint16_t expression) const {
  const Expression &e = block_.expressions[expression];
  if (e.bad || e.count == 0)
    return e.bad;
  const Op last = block_.operations[e.first + e.count - 1].op;
  return last == Op::Variable || last == Op::ElementAt || (last == Op::Opaque && e.count == 1);
}

/// The first numbered variables of the called program get the values of the call; the other local
/// ones keep those of the caller (LinuxCNC 2.9, section 11.7.4).
void Engine::bindPositions(const Item &call, const MachineState &caller, MachineState &state) {
  const llvm::ArrayRef<Argument> given = block_.argumentsOf(call);
  for (uint64_t i = 1; i <= uint64_t(state.ranges.lastLocal); ++i) {
    if (i <= given.size())
      state.locals.set(i, evaluate(block_, given[i - 1].expression, caller, nullptr));
    else if (caller.locals.given(i) != Truth::No)
      state.locals.set(i, caller.locals.get(i));
  }
  state.commons.set(sharedVariableKey("_value"), Value::of(0));
  state.commons.set(sharedVariableKey("_value_returned"), Value::of(0));
}

/// The arguments of a call of the block at hand.
Engine::GivenArguments Engine::givenTo(const Item &call, const MachineState &caller) const {
  GivenArguments given;
  for (const Argument &argument : block_.argumentsOf(call)) {
    Given &one = given.emplace_back();
    one.left = argument.kind == ArgumentKind::Empty;
    if (argument.expression == noExpression)
      continue;
    one.left = false;
    one.value = evaluate(block_, argument.expression, caller, nullptr);
    one.variable = block_.variableOf(argument.expression);
  }
  return given;
}

/// The called program's parameters get the values of the call. What it gives back, and whether the
/// caller's modes come back, goes into `passes`.
void Engine::bindArguments(const Callee &callee, llvm::ArrayRef<Given> given,
                           const MachineState &caller, MachineState &state, Passes &passes) {
  Block head;
  callee.unit->reader->read(callee.program->body, head);
  for (uint32_t at = callee.program->body;
       head.isEmpty() && head.next < callee.program->end && head.next > at; at = head.next)
    callee.unit->reader->read(head.next, head);
  for (const Item &item : head.items) {
    if (item.kind != ItemKind::Parameters)
      continue;
    if (item.restores)
      passes.modes = caller;
    const llvm::ArrayRef<Argument> taken = head.argumentsOf(item);
    for (size_t i = 0; i < taken.size(); ++i) {
      Value value = Value::unknown();
      if (i < given.size() && !given[i].left)
        value = given[i].value;
      else
        value = taken[i].expression == noExpression
                    ? Value::of(0)
                    : evaluate(head, taken[i].expression, caller, nullptr);
      const llvm::StringRef name = callee.unit->source.text(taken[i].begin, taken[i].end);
      state.locals.set(variableKey(name), value);
      if (taken[i].byReference && i < given.size() && given[i].variable)
        passes.written.push_back(given[i].variable);
    }
  }
}

void Engine::Passes::setCount(const Value &repeat) {
  if (repeat.isConstant())
    count = repeat.number.value();
  if (!(count >= 1)) // a bad count is the rules' business; the body is looked at once
    count = 1;
  known = repeat.isConstant() && count <= maxRepeats;
  if (!known)
    count = std::min(count, 2.0);
}

/// The modal codes and frames of the caller come back.
void Engine::restoreModes(MachineState &state, const MachineState &caller) {
  state.groups = caller.groups;
  state.statedMay = caller.statedMay;
  state.statedMust = caller.statedMust;
  for (size_t i = 0; i < maxGroups; ++i)
    state.origin.all()[i] = caller.origin.all()[i];
  state.switches = caller.switches;
  if (state.frames == caller.frames)
    return;
  // The tool stays, and its coordinates are others.
  state.frames = caller.frames;
  for (Interval &position : state.position)
    position = Interval::unknown();
}

/// Runs a body as often as it is called for, and goes on behind the call.
void Engine::runPasses(Activation &activation, const Region &body, Live live,
                       const MachineState &before, const Passes &passes) {
  const Region &region = activation.region;
  if (!passes.known)
    lose(flowRange(region.unit), "how often it runs is not known");
  Lives current;
  current.push_back(std::move(live));
  for (double pass = 0; pass < passes.count && !current.empty() && !stopped_; ++pass) {
    Lives behind;
    bool changed = false;
    for (Live &one : current) {
      const MachineState entry = one.state;
      for (Returned &exit : callBody(body, std::move(one))) {
        if (exit.target != notSet) {
          // M99 P: the caller goes on at that block.
          exit.live.path = passes.path;
          restoreModalCall(exit.live.state, passes);
          if (passes.locals)
            exit.live.state.locals = *passes.locals;
          if (const auto offset = region.unit.index.block(region.program, exit.target, passes.at)) {
            usedNumbers_.insert(exit.target);
            goTo(activation, passes.at, *offset, std::move(exit.live), true);
          } else {
            issue(FlowIssue::UnknownBlock, activation, exit.live, before, flowRange(region.unit));
          }
          continue;
        }
        changed |= !equal(entry, exit.live.state);
        mergeInto(region.unit, behind, std::move(exit.live));
      }
    }
    current = std::move(behind);
    // The budget is spent: what the passes that are left may do is not known.
    if (abstract_ && pass + 1 < passes.count && pass > 0 && changed) {
      for (Live &one : current)
        forget(one, *region.unit.dialect);
      break;
    }
    if (!changed && !watcher_) { // every further pass is the same
      // A section behind which its repeat stands has run once already.
      const bool ran = pass > 0 || (body.kind == Kind::Section && body.start < passes.at);
      if (ran && passes.known && body.kind != Kind::Profile && !current.empty())
        issue(FlowIssue::RepeatSame, activation, current.front(), before, flowRange(region.unit));
      break;
    }
  }
  activation.forks += current.size() > 1;
  for (Live &one : current) {
    one.path = passes.path;
    restoreModalCall(one.state, passes);
    if (passes.locals)
      one.state.locals = *passes.locals;
    for (const uint64_t key : passes.written)
      writeVariable(one.state, int64_t(key), Value::unknown());
    const bool ofCaller = body.kind == Kind::Section || body.kind == Kind::Profile;
    if (passes.modes)
      restoreModes(one.state, *passes.modes);
    else if (!ofCaller && one.state.restoresModes)
      bringBack(*region.unit.dialect, one.state, one.state.saved);
    if (!ofCaller) {
      one.state.restoresModes = before.restoresModes;
      one.state.saved = before.saved;
    }
    if (!passes.known)
      for (Interval &position : one.state.position)
        position = Interval::unknown();
    if (dispatcher_.kinds() & bitOf(EventKind::CallReturned))
      dispatcher_.callReturned(region.unit, block_, outcome_, before, one.state, region.depth);
    add(activation, passes.next, std::move(one));
  }
}

/// Runs a section of the program again, and goes on behind the block, or behind the section when
/// the block is its head.
void Engine::repeat(Activation &activation, Live &live, uint32_t at, const MachineState &before) {
  const Region &region = activation.region;
  FileUnit &unit = region.unit;
  const Flow flow = outcome_.flow;
  const Item item = block_.items[size_t(flow.item)];
  const SourceRange where = flowRange(unit);
  const uint32_t next = block_.next;
  const llvm::SmallVector<Argument, 2> places(block_.argumentsOf(item).begin(),
                                              block_.argumentsOf(item).end());
  std::optional<uint32_t> first, last;
  if (!places.empty())
    first = resolve(activation, live, before, unit, region.program, places[0], at, item.jump);
  if (first && places.size() > 1)
    last = resolve(activation, live, before, unit, region.program, places[1],
                   *first ? *first - 1 : 0, JumpKind::Anywhere);
  if (!first || (places.size() > 1 && !last))
    return add(activation, next, std::move(live));
  if (item.single)
    last = first;
  const bool heads = *first == at; // the body is behind the block
  if (!last)
    last = endOfSection(unit, *first, at);
  if (item.count == noExpression && *last == at && !heads) { // without a count, and to itself
    if (!holdsWayOut(unit, *first, at))
      issue(FlowIssue::EndlessLoop, activation, live, before, where);
    return backTo(activation, *first, std::move(live), false);
  }
  if (*last < *first || (places.size() > 1 && *first < at && at <= *last && !heads)) {
    issue(FlowIssue::RepeatBounds, activation, live, before, where);
    return add(activation, next, std::move(live));
  }
  Block end;
  unit.reader->read(*last, end);
  for (const auto &[head, past] : shape(unit, region.program).past)
    if ((head < *first && *first < past && past < end.next) ||
        (*first < head && head < end.next && end.next < past))
      issue(FlowIssue::RepeatOverlap, activation, live, before, where,
            {unit.source.id(), head, head + 1});
  const uint32_t start = heads ? next : *first;
  const unsigned nested = runningSections();
  if (unit.dialect->limits.repeatDepth && nested >= unit.dialect->limits.repeatDepth)
    issue(FlowIssue::TooDeep, activation, live, before, where);
  if (holdsEnd(unit, start, end.next))
    issue(FlowIssue::RepeatBounds, activation, live, before, where);
  // Nested repeats may begin at one block; a section that holds its own repeat has no end.
  if ((!heads && start <= at && at < end.next) || isRunning(unit, start, Kind::Section, end.next) ||
      callStack_.size() >= limits_.callDepth || start >= end.next) {
    if (start < end.next)
      issue(FlowIssue::Recursion, activation, live, before, where,
            {unit.source.id(), start, start + 1});
    return add(activation, next, std::move(live));
  }
  Passes passes;
  passes.at = at;
  passes.next = heads ? end.next : next;
  passes.path = live.path;
  passes.setCount(item.count == noExpression ? Value::of(1) : flow.repeat);
  live.path = step(live.path, PathNode::Kind::LoopPass, where);
  Region body{unit, region.program, start, Kind::Section, region.depth};
  body.stopAt = end.next;
  runPasses(activation, body, std::move(live), before, passes);
}

/// Whether a block between two places ends the program, or returns.
bool Engine::holdsEnd(FileUnit &unit, uint32_t first, uint32_t end) const {
  Block block;
  for (uint32_t at = first; at < end; at = block.next) {
    unit.reader->read(at, block);
    bool ends = false, returns = false;
    ending(block, ends, returns);
    if ((ends || returns) && block.skip < 0)
      return true;
  }
  return false;
}

/// Whether a block between two places can leave them: a jump, a return, a stop, an answer.
bool Engine::holdsWayOut(FileUnit &unit, uint32_t first, uint32_t end) const {
  Block block;
  for (uint32_t at = first; at < end; at = block.next) {
    unit.reader->read(at, block);
    bool ends = false, returns = false;
    ending(block, ends, returns);
    const auto leaves = [&](const Item &i) {
      constexpr uint64_t alarm = 3000; // #3000 stops the program; a computed variable may be it
      return i.kind == ItemKind::Jump || i.kind == ItemKind::Input || i.kind == ItemKind::Call ||
             (i.kind == ItemKind::Assignment &&
              (block.keyOf(i.target) == alarm || !block.keyOf(i.target)));
    };
    const auto calls = [&](const Word &word) {
      const CodeIndex code = codeOf(*unit.dialect, word);
      return code != noCode && (unit.dialect->codes[code].action == Action::MacroCall ||
                                unit.dialect->codes[code].action == Action::MacroModal);
    };
    if (ends || returns || block.has(letterAddress('M')) || llvm::any_of(block.items, leaves) ||
        llvm::any_of(block.words, calls))
      return true;
  }
  return false;
}

/// Last block of a section that only its begin names: the one with the end label, or the one in
/// front of the repeating block.
uint32_t Engine::endOfSection(FileUnit &unit, uint32_t first, uint32_t at) const {
  Block block;
  uint32_t last = first;
  for (uint32_t offset = first; offset < at; offset = block.next) {
    unit.reader->read(offset, block);
    last = offset;
    if (block.hasLabel() &&
        unit.dialect->lexical.endLabel ==
            unit.reader->labelKey(unit.source.text(block.labelBegin, block.labelEnd)))
      break;
  }
  return last;
}

/// A cycle reads the section between two labels of the program, `BEGIN1:END1`, as a contour.
void Engine::contourSection(Activation &activation, const Live &live, const MachineState &before,
                            llvm::StringRef labels) {
  const Region &region = activation.region;
  FileUnit &unit = region.unit;
  const SourceRange where = flowRange(unit);
  const llvm::StringRef head = labels.split(':').first.trim();
  const llvm::StringRef tail = labels.split(':').second.trim();
  usedLabels_.insert(unit.reader->labelKey(head));
  usedLabels_.insert(unit.reader->labelKey(tail));
  const auto first = unit.index.label(region.program, head, block_.begin);
  const auto last = unit.index.label(region.program, tail, first ? *first : block_.begin);
  if (!first || !last)
    return issue(FlowIssue::UnknownProgram, activation, live, before, where);
  Block end;
  unit.reader->read(*last, end);
  const bool holdsCycle = *first <= block_.begin && block_.begin < end.next;
  if (*last < *first || holdsCycle || isRunning(unit, *first, Kind::Section, end.next) ||
      callStack_.size() >= limits_.callDepth)
    return;
  Live read = live;
  read.state.profile = 1;
  read.state.clear(Fact::Cut);
  read.state.set(Fact::InContour);
  read.state.clear(Fact::ContourBegun);
  read.path = step(live.path, PathNode::Kind::Call, where);
  Region body{unit, region.program, *first, Kind::Section, region.depth};
  body.stopAt = end.next;
  callBody(body, std::move(read));
}

/// A cycle reads a program as the contour that it works along.
void Engine::contour(Activation &activation, Live &live, const MachineState &before) {
  FileUnit &unit = activation.region.unit;
  const Flow flow = outcome_.flow;
  const CodeInfo &cycle = unit.dialect->codes[flow.code];
  const SourceRange where = flowRange(unit);
  const uint32_t next = block_.next;
  Live read = live;
  Callee callee{&unit, &activation.region.program, 0, Kind::Subprogram, notSet};
  bool found = false;
  std::optional<PassesEnd> passes;
  if (has(cycle, CycleTrait::Turned)) { // a subprogram between brackets, by its number
    const ExecutedBlock executed{*unit.dialect, unit.machine, block_, outcome_, before, live.state};
    if (auto works = contourCycle(executed); works && passesFollowed_++ < mostPassesFollowed)
      passes.emplace(executed, std::move(*works), watcher_);
    for (const Axis axis : {Axis::X, Axis::Z})
      live.state.at(axis) = Interval::unknown();
    if (!flow.target.isConstant())
      return add(activation, next, std::move(live));
    const std::string name = std::to_string(std::llround(flow.target.number.value()));
    calledNames_.insert(name);
    found = findBracketed(callee, name);
    if (!found && callerUnknown_)
      return add(activation, next, std::move(live));
  } else {
    const llvm::StringRef name = unit.source.text(where.begin, where.end);
    if (name.contains(':')) {
      contourSection(activation, live, before, name);
      return add(activation, next, std::move(live));
    }
    calledNames_.insert(name.upper());
    std::tie(callee.unit, callee.program) = project_.findProgram(unit, name);
    found = callee.program;
    if (found)
      callee.start = callee.program->body;
  }
  if (!found) {
    issue(FlowIssue::UnknownProgram, activation, live, before, where);
    return add(activation, next, std::move(live));
  }
  read.state.profile = 1;
  read.state.clear(Fact::Cut);
  if (!has(cycle, CycleTrait::Turned) && !has(cycle, CycleTrait::TurnsContour)) {
    read.state.set(Fact::InContour); // rules of contours that are milled
    read.state.clear(Fact::ContourBegun);
  }
  read.path = step(live.path, PathNode::Kind::Call, where);
  const Region region{*callee.unit, *callee.program, callee.start, callee.kind,
                      activation.region.depth + 1};
  if (!isRunning(region.unit, region.start, region.kind) && region.depth < limits_.callDepth) {
    BlockWatcher *const watcher = std::exchange(watcher_, passes ? &*passes : watcher_);
    const bool stopped = stopped_;
    callBody(region, std::move(read));
    watcher_ = watcher;
    if (!watcher_)
      stopped_ = stopped;
    if (const auto last = passes ? passes->last() : std::nullopt)
      for (const Axis axis : {Axis::X, Axis::Z})
        live.state.at(axis) = last->to[size_t(axis)];
  }
  if (watcher_)
    watcher_->profileEnds();
  add(activation, next, std::move(live));
}

/// A cycle reads the blocks between two numbers: as data when it roughs, for real when it finishes.
void Engine::profile(Activation &activation, Live &live, uint32_t at, const MachineState &before) {
  const Region &region = activation.region;
  FileUnit &unit = region.unit;
  const Dialect &dialect = *unit.dialect;
  const Flow flow = outcome_.flow;
  const SourceRange where = flowRange(unit);
  const uint32_t next = block_.next;
  if (flow.first < 0 || flow.last < 0) { // missing or not known: the word rules speak of it
    add(activation, next, std::move(live));
    return;
  }
  usedNumbers_.insert(flow.first);
  usedNumbers_.insert(flow.last);
  const auto first = unit.index.block(region.program, flow.first, at);
  const auto last = unit.index.block(region.program, flow.last, first ? *first - 1 : at);
  if (!first || !last) {
    issue(FlowIssue::ProfileMissing, activation, live, before, where);
    add(activation, next, std::move(live));
    return;
  }
  if (*last <= *first) {
    issue(FlowIssue::ProfileReversed, activation, live, before, where);
    add(activation, next, std::move(live));
    return;
  }
  const bool finishing = dialect.codes[flow.code].cycle == CycleKind::Finish;
  // Blocks that plain flow has run already, and that this cycle runs again.
  bool reached = *first >= activation.runBegin && *first < activation.runEnd;
  if (&unit == &unit_ && !reached)
    for (const auto &[begin, end] : covered_)
      reached |= *first >= begin && *first < end && *first < at;
  if (finishing && reached && *first < at && !profileStarts_.count(*first))
    issue(FlowIssue::ProfileReached, activation, live, before, where,
          {unit.source.id(), *first, *first + 1});
  const bool adjacent = *first >= next && [&] {
    Block between;
    for (uint32_t offset = next; offset < *first; offset = between.next) {
      unit.reader->read(offset, between);
      if (!between.isEmpty())
        return false;
    }
    return true;
  }();
  // Behind its own block the control goes on: it must not come to the profile.
  if (finishing && !dialect.profileRunsThrough && &unit == &unit_ && *first > at)
    finishedAhead_.try_emplace(*first, flow, where);
  const bool runsThrough = !finishing && dialect.profileRunsThrough;
  if (!runsThrough && &unit == &unit_)
    profileStarts_.insert(*first);

  Live contour = live;
  contour.state.profile = finishing ? 2 : 1;
  contour.path = step(live.path, PathNode::Kind::Call, where, flow.first);
  const Region body{unit, region.program, *first, Kind::Profile, region.depth, *last};
  Exits exits = callBody(body, std::move(contour));
  if (watcher_)
    watcher_->profileEnds();
  if (finishing) {
    // Modes that the contour set stay; the tool returns to where the cycle began.
    Lives behind;
    for (Returned &exit : exits) {
      exit.live.state.profile = before.profile;
      exit.live.state.position = live.state.position;
      exit.live.state.machineAxes = live.state.machineAxes;
      exit.live.path = live.path;
      mergeInto(unit, behind, std::move(exit.live));
    }
    for (Live &one : behind)
      add(activation, next, std::move(one));
    return;
  }
  // Behind roughing the control goes on behind the profile, or runs it.
  uint32_t onward = next;
  if (adjacent && !runsThrough) {
    Block lastBlock;
    unit.reader->read(*last, lastBlock);
    onward = lastBlock.next;
  }
  add(activation, onward, std::move(live));
}

} // namespace ncvet
