// Programs that run behind every move: what a modal call names, and its runs.
#include "analyzer/flow/engine.h"

namespace ncvet {

/// The block that makes a modal call runs nothing; that the program exists, and takes the
/// arguments, is looked at here.
void Engine::beginModalCall(Activation &activation, Live &live, uint32_t at,
                            const MachineState &before) {
  const std::optional<Callee> callee = this->callee(activation, live, at, before);
  if (callee && outcome_.flow.item >= 0)
    checkArguments(activation, live, before, *callee, block_.items[size_t(outcome_.flow.item)]);
  add(activation, block_.next, std::move(live));
}

/// The program of a modal call, and the call's item where it has one.
std::optional<Engine::Callee> Engine::modalCallee(Activation &activation, const ModalCall &call,
                                                  const Block &made, const Item *&item) {
  FileUnit &unit = activation.region.unit;
  Project::Found found{nullptr, nullptr};
  if (call.program >= 0) {
    found = project_.findProgram(unit, call.program);
  } else {
    for (const Item &one : made.items)
      if (one.kind == ItemKind::Call && one.modal)
        item = &one;
    if (!item)
      return std::nullopt;
    const SourceFile &maker = project_.sources().get(call.file);
    found = project_.findProgram(unit, maker.text(item->nameBegin, item->nameEnd));
  }
  if (!found.second)
    return std::nullopt;
  return Callee{found.first, found.second, found.second->body, Kind::Subprogram,
                call.program >= 0 ? call.program : notSet};
}

/// Behind the block at hand the modal call in force runs its program, in the state of that block.
void Engine::callModally(Activation &activation, Live &live, uint32_t at,
                         const MachineState &before) {
  const Region &region = activation.region;
  const ModalCalls call = live.state.modalCalls;
  outcome_.flow = Flow();
  outcome_.flow.kind = FlowKind::CallModal;
  outcome_.flow.begin = block_.begin;
  outcome_.flow.end = block_.end;
  Block made;
  const Item *item = nullptr;
  std::optional<Callee> callee;
  if (outcome_.callsModally == Truth::Yes && call && call->known) {
    project_.unit(project_.sources().get(call->file)).reader->read(call->at, made);
    callee = modalCallee(activation, *call, made, item);
  }
  if (!callee || !mayEnter(activation, live, before, *callee)) {
    forget(live, *region.unit.dialect);
    live.state.modalCalls = call;
    lose(blockRange(region.unit), "what runs after this block is not known");
    return add(activation, block_.next, std::move(live));
  }
  Passes passes;
  passes.at = at;
  passes.next = block_.next;
  passes.path = live.path;
  passes.setCount(call->repeat);
  passes.modal = call;
  passes.locals = live.state.locals;
  live.path = step(live.path, PathNode::Kind::ModalCall, blockRange(region.unit), callee->number);
  live.state.restoresModes = false;
  live.state.saved = {};
  live.state.modalCalls = call->outer; // runs behind the moves of this one's program
  if (item) {
    GivenArguments given;
    const llvm::ArrayRef<Argument> arguments = made.argumentsOf(*item);
    for (size_t i = 0; i < arguments.size(); ++i) {
      Given &one = given.emplace_back();
      one.left = call->arguments.given(i + 1) != Truth::Yes;
      one.value = call->arguments.get(i + 1);
      if (arguments[i].expression != noExpression)
        one.variable = made.variableOf(arguments[i].expression);
    }
    const MachineState caller = live.state;
    live.state.locals = Variables();
    bindArguments(*callee, given, caller, live.state, passes);
  } else {
    live.state.locals = call->arguments;
  }
  runPasses(activation,
            {*callee->unit, *callee->program, callee->start, callee->kind, region.depth + 1},
            std::move(live), before, passes);
}

/// Behind the run of a modal call it is in force again. The variables of a macro stay from one run
/// to the next; they are set once, by the call.
void Engine::restoreModalCall(MachineState &state, const Passes &passes) {
  if (!passes.modal)
    return;
  const ModalCall &made = *passes.modal;
  auto *call = new ModalCall(made);
  call->users = 0;
  call->outer = state.modalCalls;
  if (made.program >= 0)
    call->arguments = state.locals;
  else if (!ncvet::equal(state.modalCalls, made.outer)) // the program has made one of its own
    call->known = false;
  state.modalCalls = call;
}

} // namespace ncvet
