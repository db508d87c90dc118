// Statements of Macro B: assignments, conditions, jumps and loops of a block.
#include "interp/execution.h"

#include <cmath>

namespace ncvet {

namespace {
/// Writing here stops the program with an alarm.
constexpr int64_t alarmVariable = 3000;
} // namespace

/// False when nothing behind the statements is executed.
bool Execution::runItems(bool guardHolds) {
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
      flow.kind = FlowKind::Jump;
      flow.condition = conditional ? condition : Truth::Yes;
      flow.target = evaluate(block_, item.value, state_, &outcome_);
      flow.begin = item.begin;
      flow.end = item.end;
      return true;
    case ItemKind::Assignment: {
      const Value number = evaluate(block_, item.target, state_, &outcome_);
      const Value assigned = evaluate(block_, item.value, state_, &outcome_);
      Event &event = outcome_.emit(EventKind::Assignment);
      if (!number.isConstant()) {
        // Some variable: any of them may have changed.
        state_.locals.forget();
        state_.commons.forget();
        event.number = notKnown;
        break;
      }
      const int64_t variable = std::llround(number.number.value());
      event.number = variable;
      if (variable == alarmVariable) {
        flow.kind = FlowKind::Alarm;
        flow.begin = item.begin;
        flow.end = item.end;
        return false;
      }
      writeVariable(state_, variable, assigned);
      break;
    }
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
    case ItemKind::Output:
      break;
    }
  }
  return true;
}

} // namespace ncvet
