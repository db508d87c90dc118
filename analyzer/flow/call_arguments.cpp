// The arguments of calls: what is given, what is wanted, and what the called program gets.
#include "analyzer/flow/call_arguments.h"

#include "interp/evaluate/expression.h"

namespace ncvet {

namespace {

/// Whether an argument is a variable, so that a value can come back in it. An element of an array
/// with several indices is one whose value is not followed.
bool isVariable(const Block &block, uint16_t expression) {
  const Expression &e = block.expressions[expression];
  if (e.bad || e.count == 0)
    return e.bad;
  const Op last = block.operations[e.first + e.count - 1].op;
  return last == Op::Variable || last == Op::ElementAt || last == Op::Opaque;
}

/// What is wrong with the arguments of a call, when something is.
std::optional<FlowIssue> wrongWith(const Block &block, llvm::ArrayRef<Argument> given,
                                   llvm::ArrayRef<Argument> taken) {
  if (given.size() > taken.size())
    return FlowIssue::TooManyArguments;
  for (size_t i = 0; i < taken.size(); ++i) {
    const bool left = i >= given.size() || given[i].kind == ArgumentKind::Empty;
    if (taken[i].byReference &&
        (left || (given[i].expression != noExpression && !isVariable(block, given[i].expression))))
      return FlowIssue::ArgumentNotVariable;
    const VariableType type = taken[i].type;
    if (!left && given[i].kind == ArgumentKind::Text &&
        (type == VariableType::Integer || type == VariableType::Real ||
         type == VariableType::Boolean))
      return FlowIssue::ArgumentType;
    if (left && taken[i].expression == noExpression && !taken[i].byReference && !given.empty())
      return FlowIssue::ArgumentLeftOut;
  }
  return std::nullopt;
}

/// How often the caller declares the called program with other parameters than it has.
unsigned mismatches(const Step &step, const Item &call, llvm::ArrayRef<Argument> taken) {
  const FileUnit &unit = step.unit();
  const Defined *declared =
      unit.index.definition(step.region().program, unit.source.text(call.nameBegin, call.nameEnd));
  if (!declared || declared->kind != ItemKind::Declaration)
    return 0;
  Block declaration;
  unit.reader->read(unit.source.lines().lineBegin(declared->begin), declaration);
  return unsigned(llvm::count_if(declaration.items, [&](const Item &item) {
    if (item.kind != ItemKind::Declaration)
      return false;
    const llvm::ArrayRef<Argument> said = declaration.argumentsOf(item);
    bool same = said.size() == taken.size();
    for (size_t i = 0; same && i < said.size(); ++i)
      same = said[i].type == taken[i].type && said[i].byReference == taken[i].byReference;
    return !same;
  }));
}

} // namespace

GivenArguments givenTo(const Block &block, const Item &call, const MachineState &caller) {
  GivenArguments given;
  for (const Argument &argument : block.argumentsOf(call)) {
    GivenArgument &one = given.emplace_back();
    one.left = argument.kind == ArgumentKind::Empty;
    if (argument.expression == noExpression)
      continue;
    one.left = false;
    one.value = evaluate(block, argument.expression, caller, nullptr);
    one.variable = block.variableOf(argument.expression);
  }
  return given;
}

GivenArguments givenModally(const ModalCall &modal, const Block &made, const Item &call) {
  GivenArguments given;
  const llvm::ArrayRef<Argument> arguments = made.argumentsOf(call);
  for (size_t i = 0; i < arguments.size(); ++i) {
    GivenArgument &one = given.emplace_back();
    one.left = modal.arguments.given(i + 1) != Truth::Yes;
    one.value = modal.arguments.get(i + 1);
    if (arguments[i].expression != noExpression)
      one.variable = made.variableOf(arguments[i].expression);
  }
  return given;
}

void checkArguments(FlowRun &run, const Step &step, const Callee &callee, const Item &call) {
  if (!run.listeners.want(EventKind::FlowIssue))
    return;
  const SourceRange where{step.unit().source.id(), call.begin, call.end};
  const Block head = headOf(callee.unit->index, *callee.program);
  llvm::ArrayRef<Argument> taken;
  SourceRange related;
  for (const Item &item : head.items)
    if (item.kind == ItemKind::Parameters) {
      taken = head.argumentsOf(item);
      related = {callee.unit->source.id(), item.begin, item.end};
    }
  if (const auto wrong = wrongWith(step.block, step.block.argumentsOf(call), taken))
    return run.issue(*wrong, step, where, related);
  for (unsigned i = mismatches(step, call, taken); i > 0; --i)
    run.issue(FlowIssue::DeclarationMismatch, step, where, related);
  const Defined *declared = step.unit().index.definition(
      step.region().program, step.unit().source.text(call.nameBegin, call.nameEnd));
  if (call.arguments && callee.unit != &step.unit() &&
      (!declared || declared->kind != ItemKind::Declaration))
    run.issue(FlowIssue::NotDeclared, step, where, related);
}

void bindPositions(const Block &block, const Item &call, const MachineState &caller,
                   MachineState &state) {
  const llvm::ArrayRef<Argument> given = block.argumentsOf(call);
  llvm::SmallVector<Value, 32> values(size_t(state.ranges.lastLocal), Value::of(0));
  for (size_t i = 0; i < std::min(given.size(), values.size()); ++i)
    values[i] = evaluate(block, given[i].expression, caller, nullptr);
  state.locals = Variables::numbered(values);
  state.commons.set(givenBackKey(), Value::of(0));
  state.commons.set(isGivenBackKey(), Value::of(0));
}

void bindArguments(const Callee &callee, llvm::ArrayRef<GivenArgument> given,
                   const MachineState &caller, MachineState &state, Passes &passes) {
  const Block head = headOf(callee.unit->index, *callee.program);
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

} // namespace ncvet
