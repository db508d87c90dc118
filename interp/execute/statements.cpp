// Statements of Macro B: assignments, conditions, jumps and loops of a block.
#include "interp/evaluate/program_operators.h"
#include "interp/execute/execution.h"

#include <cmath>

namespace ncvet {

namespace {
/// Writing here stops the program with an alarm.
constexpr int64_t alarmVariable = 3000;
} // namespace

/// The block's flow is the one that item `index` says.
void Execution::go(FlowKind kind, size_t index) {
  Flow &flow = outcome_.flow;
  flow.kind = kind;
  flow.item = int16_t(index);
  flow.begin = block_.items[index].begin;
  flow.end = block_.items[index].end;
}

void Execution::structure(size_t index) {
  const Item &item = block_.items[index];
  go(FlowKind::Structure, index);
  Flow &flow = outcome_.flow;
  switch (item.structure) {
  case Structure::EndSub:
  case Structure::Return:
    return giveBack(item);
  case Structure::ElseIf:
    if (!before_.seeksBranch) // the branch before it has run
      return;
    break;
  case Structure::Times: {
    const Value count = evaluate(block_, item.value, state_, &outcome_);
    const uint64_t counter = block_.keyOf(item.target);
    const Interval given = count.asNumber();
    const Interval n{std::floor(given.lo + 0.5), std::floor(given.hi + 0.5)}; // to the nearest
    const bool known = count.kind != Value::Kind::Unknown;
    state_.locals.set(counter, known ? Value::of(n) : Value::unknown());
    flow.condition = known && n.lo >= 1  ? Truth::Yes
                     : known && n.hi < 1 ? Truth::No
                                         : Truth::Unknown;
    return;
  }
  default:
    break;
  }
  if (item.condition != noExpression)
    flow.condition = truthOf(evaluate(block_, item.condition, state_, &outcome_));
  else if (item.structure == Structure::While || item.structure == Structure::If ||
           item.structure == Structure::ElseIf || item.structure == Structure::Until)
    flow.condition = Truth::Unknown; // it cannot be read
  if (item.structure != Structure::For)
    return;
  const Value first = evaluate(block_, item.value, state_, &outcome_);
  const Value last = evaluate(block_, item.limit, state_, &outcome_);
  if (const uint64_t key = block_.keyOf(item.target))
    writeVariable(state_, int64_t(key), first);
  const Interval a = first.asNumber(), b = last.asNumber();
  const bool known = first.kind != Value::Kind::Unknown && last.kind != Value::Kind::Unknown;
  flow.condition = known && a.hi <= b.lo  ? Truth::Yes
                   : known && a.lo > b.hi ? Truth::No
                                          : Truth::Unknown;
}

void Execution::assign(const Item &item) {
  const Value number = evaluate(block_, item.target, state_, &outcome_);
  const Value assigned = evaluate(block_, item.value, state_, &outcome_);
  Event &event = outcome_.emit(EventKind::Assignment);
  if (!number.isConstant()) {
    // Some variable: any of them may have changed, but those with names of their own.
    if (state_.ranges.namedLocal)
      for (int32_t i = 1; i <= state_.ranges.lastLocal; ++i)
        state_.locals.set(uint64_t(i), Value::unknown());
    else
      state_.locals.forget();
    state_.commons.forget();
    event.setVariable(notKnown);
    return;
  }
  const int64_t variable = std::llround(number.number.value());
  constexpr double mostOff = 1e-4; // of a number that counts as whole
  if (dialect_.lexical.arithmetic == Arithmetic::Ngc &&
      std::fabs(number.number.value() - double(variable)) > mostOff)
    outcome_.emit(EventKind::DomainError).setPlace(item.begin);
  event.setVariable(variable);
  if (dialect_.lexical.assignsAfterWords) {
    if (isUnset(state_, double(variable)) == Truth::Yes) // its name exists from here on
      writeVariable(state_, variable, Value::of(0));
    pending_.emplace_back(variable, assigned);
    return;
  }
  if (variable == alarmVariable) {
    Flow &flow = outcome_.flow;
    flow.kind = FlowKind::Alarm;
    flow.begin = item.begin;
    flow.end = item.end;
    return;
  }
  writeVariable(state_, variable, assigned);
}

/// A subprogram returns, perhaps with a value (LinuxCNC 2.9, section 11.7.10).
void Execution::giveBack(const Item &item) {
  const bool has = item.value != noExpression;
  const Value value = has ? evaluate(block_, item.value, state_, &outcome_) : Value::of(0);
  state_.commons.set(givenBackKey(), value);
  state_.commons.set(isGivenBackKey(), Value::of(has));
}

/// A variable of the running program; it begins with its value, or with zero.
void Execution::define(const Item &item) {
  const uint64_t key = block_.keyOf(item.target);
  if (!key)
    return;
  const bool number = item.type == VariableType::Integer || item.type == VariableType::Real ||
                      item.type == VariableType::Boolean;
  Value value = number ? Value::of(0) : Value::unknown();
  if (item.value != noExpression)
    value = number ? evaluate(block_, item.value, state_, &outcome_) : Value::unknown();
  state_.locals.set(key, item.arguments ? Value::unknown() : value);
}

/// False when nothing after the statements is executed.
bool Execution::runItems(bool guardHolds) {
  state_.seeksBranch = false;
  for (size_t i = 0; i < block_.items.size(); ++i)
    outcome_.emit(EventKind::Statement).setItem(i);
  Guard guard;
  guard.holds = guardHolds;
  for (size_t i = 0; i < block_.items.size(); ++i)
    if (const Items next = runItem(i, guard); next != Items::GoOn)
      return next == Items::Done;
  return true;
}

Execution::Items Execution::runItem(size_t index, Guard &guard) {
  const Item &item = block_.items[index];
  switch (item.kind) {
  case ItemKind::If: {
    const bool jumps =
        index + 1 < block_.items.size() && block_.items[index + 1].kind == ItemKind::Jump;
    guard.condition = truthOf(evaluate(block_, item.condition, state_, &outcome_));
    guard.conditional = true;
    return !jumps && !guard.holds ? Items::Stop : Items::GoOn;
  }
  case ItemKind::Jump:
    return jump(index, guard);
  case ItemKind::Assignment:
    assign(item);
    return outcome_.flow.kind == FlowKind::Alarm ? Items::Stop : Items::GoOn;
  case ItemKind::While:
  case ItemKind::Do:
    return loop(FlowKind::LoopBegin, item);
  case ItemKind::End:
    return loop(FlowKind::LoopEnd, item);
  case ItemKind::Structure:
    structure(index);
    return Items::GoOn;
  case ItemKind::Definition:
    define(item);
    return Items::GoOn;
  case ItemKind::Call:
  case ItemKind::Repeat:
    callOrRepeat(index);
    return Items::GoOn;
  case ItemKind::Input:
    go(FlowKind::Branch, index);
    if (const Value key = evaluate(block_, item.target, state_, nullptr); key.isConstant())
      writeVariable(state_, std::llround(key.number.value()), Value::unknown());
    return Items::GoOn;
  case ItemKind::Abort:
    go(FlowKind::Alarm, index);
    return Items::Stop;
  case ItemKind::Output:
  case ItemKind::Instruction:
  case ItemKind::Parameters:
  case ItemKind::Declaration:
  case ItemKind::Macro:
    break;
  }
  return Items::GoOn;
}

/// Of several conditional jumps the first whose condition may hold is followed.
Execution::Items Execution::jump(size_t index, Guard &guard) {
  const Item &item = block_.items[index];
  if (guard.conditional && guard.condition == Truth::No && index + 1 < block_.items.size()) {
    guard.conditional = false;
    guard.condition = Truth::Yes;
    return Items::GoOn;
  }
  go(FlowKind::Jump, index);
  Flow &flow = outcome_.flow;
  flow.condition = guard.conditional ? guard.condition : Truth::Yes;
  flow.target = evaluate(block_, item.value, state_, &outcome_);
  if (item.condition != noExpression)
    flow.choice = evaluate(block_, item.condition, state_, &outcome_).asNumber();
  return Items::Done;
}

Execution::Items Execution::loop(FlowKind kind, const Item &item) {
  Flow &flow = outcome_.flow;
  flow.kind = kind;
  flow.loop = item.loop;
  flow.begin = item.begin;
  flow.end = item.end;
  if (kind == FlowKind::LoopBegin)
    flow.condition = item.kind == ItemKind::Do
                         ? Truth::Yes
                         : truthOf(evaluate(block_, item.condition, state_, &outcome_));
  return Items::Done;
}

void Execution::callOrRepeat(size_t index) {
  const Item &item = block_.items[index];
  if (item.kind == ItemKind::Call && item.modal) {
    callModally(item);
    return go(FlowKind::CallModal, index);
  }
  go(item.kind == ItemKind::Call ? FlowKind::CallNamed : FlowKind::Repeat, index);
  Flow &flow = outcome_.flow;
  if (item.count != noExpression)
    flow.repeat = evaluate(block_, item.count, state_, &outcome_);
  if (item.value != noExpression)
    flow.target = evaluate(block_, item.value, state_, &outcome_);
  outcome_.emit(EventKind::Call);
}

/// What the expressions in words cannot compute; those of assignments are looked at where they are
/// made.
void Execution::wordDomains() {
  if (llvm::none_of(block_.operations, [](const ExpressionOp &op) { return mayFail(op.op); }))
    return;
  Outcome computed;
  for (const Word &word : block_.words)
    if (word.has(wordExpression) && word.address != variableAddress)
      evaluate(block_, uint16_t(word.mantissa), state_, &computed);
  for (const Event &event : computed.events)
    if (event.kind == EventKind::DomainError)
      outcome_.emit(EventKind::DomainError).setPlace(event.place());
}

} // namespace ncvet
