// Statements of Macro B: assignments, conditions, jumps and loops of a block.
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
    if (!before_.seeksBranch) // the branch in front of it has run
      return;
    break;
  case Structure::Times: {
    const Value count = evaluate(block_, item.value, state_, &outcome_);
    const uint64_t counter = block_.keyOf(item.target);
    const Interval n = count.asNumber();
    const bool known = count.kind != Value::Kind::Unknown;
    state_.locals.set(counter, known ? count : Value::unknown());
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
    event.number = notKnown;
    return;
  }
  const int64_t variable = std::llround(number.number.value());
  event.number = variable;
  if (dialect_.lexical.assignsBehind) {
    if (isUnset(state_, double(variable))) // its name exists from here on
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
  state_.commons.set(sharedVariableKey("_value"), value);
  state_.commons.set(sharedVariableKey("_value_returned"), Value::of(has));
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

/// False when nothing behind the statements is executed.
bool Execution::runItems(bool guardHolds) {
  state_.seeksBranch = false;
  for (size_t i = 0; i < block_.items.size(); ++i)
    outcome_.emit(EventKind::Statement).number = int64_t(i);
  Truth condition = Truth::Yes;
  bool conditional = false;
  for (size_t i = 0; i < block_.items.size(); ++i) {
    const Item &item = block_.items[i];
    Flow &flow = outcome_.flow;
    switch (item.kind) {
    case ItemKind::If: {
      const bool jumps = i + 1 < block_.items.size() && block_.items[i + 1].kind == ItemKind::Jump;
      condition = truthOf(evaluate(block_, item.condition, state_, &outcome_));
      conditional = true;
      if (!jumps && !guardHolds)
        return false;
      break;
    }
    case ItemKind::Jump:
      // Of several conditional jumps the first whose condition may hold is followed.
      if (conditional && condition == Truth::No && i + 1 < block_.items.size()) {
        conditional = false;
        condition = Truth::Yes;
        break;
      }
      go(FlowKind::Jump, i);
      flow.condition = conditional ? condition : Truth::Yes;
      flow.target = evaluate(block_, item.value, state_, &outcome_);
      if (item.condition != noExpression)
        flow.choice = evaluate(block_, item.condition, state_, &outcome_).asNumber();
      return true;
    case ItemKind::Assignment:
      assign(item);
      if (flow.kind == FlowKind::Alarm)
        return false;
      break;
    case ItemKind::While:
    case ItemKind::Do:
      flow.kind = FlowKind::LoopBegin;
      flow.loop = item.loop;
      flow.begin = item.begin;
      flow.end = item.end;
      flow.condition = item.kind == ItemKind::Do
                           ? Truth::Yes
                           : truthOf(evaluate(block_, item.condition, state_, &outcome_));
      return true;
    case ItemKind::End:
      flow.kind = FlowKind::LoopEnd;
      flow.loop = item.loop;
      flow.begin = item.begin;
      flow.end = item.end;
      return true;
    case ItemKind::Structure:
      structure(i);
      break;
    case ItemKind::Definition:
      define(item);
      break;
    case ItemKind::Call:
      if (item.modal) {
        callModally(item);
        go(FlowKind::CallModal, i);
        break;
      }
      [[fallthrough]];
    case ItemKind::Repeat:
      go(item.kind == ItemKind::Call ? FlowKind::CallNamed : FlowKind::Repeat, i);
      if (item.count != noExpression)
        flow.repeat = evaluate(block_, item.count, state_, &outcome_);
      if (item.value != noExpression)
        flow.target = evaluate(block_, item.value, state_, &outcome_);
      outcome_.emit(EventKind::Call);
      break;
    case ItemKind::Input:
      go(FlowKind::Branch, i);
      if (const Value key = evaluate(block_, item.target, state_, nullptr); key.isConstant())
        writeVariable(state_, std::llround(key.number.value()), Value::unknown());
      break;
    case ItemKind::Abort:
      go(FlowKind::Alarm, i);
      return false;
    case ItemKind::Output:
    case ItemKind::Instruction:
    case ItemKind::Parameters:
    case ItemKind::Declaration:
    case ItemKind::Macro:
      break;
    }
  }
  return true;
}

} // namespace ncvet
