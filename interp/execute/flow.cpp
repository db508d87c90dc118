// Calls, returns and ends: what a block's codes say about where control goes.
#include "formats/dialect/packed_call.h"
#include "interp/execute/execution.h"
#include "interp/execute/macro_arguments.h"

#include <cmath>

namespace ncvet {

namespace {

Value valueOf(const Interval &interval) { return Value::of(interval); }

} // namespace

void Execution::callProgram(const CodeUse &use, bool macro) {
  Flow &flow = outcome_.flow;
  flow.kind = FlowKind::Call;
  flow.code = use.code;
  flow.word = use.word;
  flow.macro = macro;
  flow.begin = use.word->offset;
  flow.end = block_.endOf(*use.word);
  flow.target = Value::vacant();
  if (const Word *p = block_.find('P')) {
    flow.word = p;
    flow.begin = p->offset;
    flow.end = block_.endOf(*p);
    const Interval number = value(*p);
    flow.target = valueOf(number);
    flow.packed = !macro && dialect_.limits.packedCallDigits && number.isConstant();
    if (!macro && number.isConstant()) {
      const PackedCall call =
          unpackCall(dialect_, int64_t(number.value()), block_.has(letterAddress('L')));
      if (call.digits) {
        flow.target = Value::of(double(call.program));
        flow.repeat = Value::of(double(call.runs));
      }
    }
  }
  if (const Word *l = block_.find('L')) {
    flow.repeat = valueOf(value(*l));
    // RS274/NGC takes the count as it is.
    if (dialect_.lexical.arithmetic == Arithmetic::Ngc && flow.repeat.isConstant() &&
        flow.repeat.number.value() == 0)
      flow.kind = FlowKind::Next;
  }
  if (!macro) {
    if (const Word *q = block_.find('Q'))
      flow.startAt = valueOf(value(*q));
    mistakenArguments(use);
    return;
  }
  forEachArgument(block_, *use.word, [&](uint32_t variable, const Word &word) {
    flow.arguments.set(variable, valueOf(value(word)));
  });
}

/// `M98 P9998 I10. D2.`: the words of a macro call. That they arrive nowhere is told here, and what
/// the called program makes without them says nothing new.
void Execution::mistakenArguments(const CodeUse &use) {
  constexpr AddressMask own = lettersMask("ABCDEHIJKRUVW");
  if (!dialect_.lexical.macro || dialect_.lexical.arithmetic == Arithmetic::Ngc ||
      !block_.hasAny(own & ~dialect_.axisWords))
    return;
  forEachArgument(block_, *use.word, [&](uint32_t variable, const Word &) {
    if (state_.locals.given(variable) == Truth::No)
      state_.locals.set(variable, Value::unknown());
  });
}

/// G66 P: the call that was in force before runs after the moves of this one's program.
void Execution::callModally(const CodeUse &use) {
  callProgram(use, true);
  Flow &flow = outcome_.flow;
  const Value number = flow.target;
  flow.kind = number.isVacant() ? FlowKind::Next : FlowKind::CallModal;
  const bool deep = state_.modalCalls && state_.modalCalls->depth() >= maxModalCalls;
  if (!number.isConstant() || !(number.number.value() >= 0 && number.number.value() < 1e9) ||
      deep || (state_.modalCalls && !state_.modalCalls->known)) {
    state_.modalCalls = unknownModalCall();
    return;
  }
  auto *call = new ModalCall;
  call->code = use.code;
  call->file = file_;
  call->at = block_.begin;
  call->program = int64_t(number.number.value());
  call->repeat = flow.repeat;
  call->arguments = flow.arguments;
  call->outer = state_.modalCalls;
  state_.modalCalls = call;
}

/// `MCALL NAME(..)`: takes the place of the one before.
void Execution::callModally(const Item &item) {
  callsModally_ = true;
  auto *call = new ModalCall;
  for (const Word &word : block_.words)
    if (word.address == keywordAddress && dialect_.codes[CodeIndex(word.mantissa)].cancelsCalls)
      call->code = CodeIndex(word.mantissa);
  call->file = file_;
  call->at = block_.begin;
  if (item.count != noExpression)
    call->repeat = evaluate(block_, item.count, state_, &outcome_);
  const llvm::ArrayRef<Argument> given = block_.argumentsOf(item);
  for (size_t i = 0; i < given.size(); ++i)
    if (given[i].kind != ArgumentKind::Empty)
      call->arguments.set(i + 1, given[i].expression == noExpression
                                     ? Value::unknown()
                                     : evaluate(block_, given[i].expression, state_, &outcome_));
  state_.modalCalls = call;
}

/// `G0`, alone or with other codes of its kind.
bool Execution::motionCodeAlone() const {
  bool motion = false;
  for (const Word &word : block_.words) {
    if (word.address != letterAddress('G') && word.address != keywordAddress)
      return false;
    motion |= llvm::any_of(outcome_.codes, [&](const CodeUse &use) {
      return use.word == &word &&
             (info(use).action == Action::Rapid || info(use).action == Action::Linear);
    });
  }
  return motion;
}

/// Whether the modal call in force runs after this block.
Truth Execution::firesModalCall() const {
  const ModalCall &call = *state_.modalCalls;
  if (callsModally_ || before_.modalCalls != state_.modalCalls) // the block that makes it
    return Truth::No;
  const CodeInfo *code = call.known && call.code != noCode ? &dialect_.codes[call.code] : nullptr;
  if (code && code->firesOnEveryBlock) // the words are arguments of a call
    return block_.words.empty() ? Truth::No : Truth::Unknown;
  Truth moves = Truth::No;
  for (const Event &event : outcome_.events)
    if (event.kind == EventKind::Motion || (event.kind == EventKind::CycleRun && call.known)) {
      const bool known = code && event.certain && event.kind == EventKind::Motion &&
                         (event.motion != MotionKind::Reference || !code->fires);
      moves = known && moves != Truth::Unknown ? Truth::Yes : Truth::Unknown;
    }
  if (moves != Truth::No || !code || outcome_.flow.kind != FlowKind::Next)
    return moves;
  if (code->firesByMotionCode && motionCodeAlone())
    return Truth::Yes;
  if (!block_.hasAny(code->fires))
    return Truth::No;
  return state_.isActive(dialect_, StandardGroup::Motion, {Action::Rapid, Action::Linear});
}

/// The block's flow is the one that a code says.
void Execution::go(FlowKind kind, const CodeUse &use) {
  Flow &flow = outcome_.flow;
  flow.kind = kind;
  flow.code = use.code;
  flow.word = use.word;
  flow.begin = use.word->offset;
  flow.end = block_.endOf(*use.word);
}

void Execution::callMacro(const CodeUse &use) { callProgram(use, true); }

void Execution::callSubprogram(const CodeUse &use) { callProgram(use, false); }

void Execution::callLocal(const CodeUse &use) {
  Flow &flow = outcome_.flow;
  go(FlowKind::CallLocal, use);
  flow.target = Value::vacant();
  // The target is a P word, or the one that the table says; an N word after the code is taken as
  // one too.
  const Word *target = block_.find('P');
  for (const WordSpec &spec : info(use).words)
    if (!target && spec.role == Role::Sequence)
      target = block_.findAny(spec.any);
  if (!target)
    target = block_.find('N');
  if (target) {
    flow.word = target;
    flow.begin = target->offset;
    flow.end = block_.endOf(*target);
    flow.target = valueOf(value(*target));
  }
  if (const Word *l = block_.find('L'))
    flow.repeat = valueOf(value(*l));
}

void Execution::returnToCaller(const CodeUse &use) {
  go(FlowKind::Return, use);
  const Word *p = block_.find('P');
  outcome_.flow.target = p ? valueOf(value(*p)) : Value::vacant();
}

void Execution::jumpPerhaps(const CodeUse &use) {
  jumpTo(use);
  outcome_.flow.condition = Truth::Unknown;
}

void Execution::jumpTo(const CodeUse &use) {
  go(FlowKind::Jump, use);
  outcome_.flow.condition = Truth::Yes;
  const Word *p = block_.find('P');
  outcome_.flow.target = p ? valueOf(value(*p)) : Value::vacant();
}

void Execution::endProgram(const CodeUse &use) { go(FlowKind::End, use); }

} // namespace ncvet
