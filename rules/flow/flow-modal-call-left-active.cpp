// A modal call is still on when the tool changes or the program ends.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/report_once.h"
#include "interp/state/any_state.h"

namespace ncvet {
namespace {

struct FlowModalCallLeftActiveMemory {
  OncePerCause once; ///< left on at a change of the tool, it is so at the end too
};

class FlowModalCallLeftActive final : public StatefulRule<FlowModalCallLeftActiveMemory> {
public:
  void listen(Subscriptions &to) override {
    for (const CodeInfo &code : to.dialect().codes)
      if (code.cancelsCalls) {
        cancel_ = code.name;
        ofCycles_ = code.action == Action::CycleCancel;
        to.on({EventKind::ProgramEnd, EventKind::ToolChange, EventKind::Return});
        if (!to.dialect().toolChangeByT)
          to.on(EventKind::ToolWord);
        return;
      }
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &state = ctx.before();
    if (event.kind == EventKind::ToolWord && !changesByT(ctx))
      return;
    if (event.kind == EventKind::Return ? !begunHere(ctx) : ctx.callDepth() > 0)
      return;
    const Truth cycle = ofCycles_ ? state.cycleActive(ctx.dialect()) : Truth::No;
    const Truth call = state.callsModally();
    if (cycle == Truth::No && call == Truth::No)
      return;
    // After codes that nobody knows only what the program has begun itself is certain.
    if ((state.may(Fact::UnknownCode) || anyCycleMayBeOn(state, ctx.dialect())) &&
        cycle != Truth::Yes && call != Truth::Yes)
      return;
    if (!memory().once.speaks(begins(state, cycle), ctx))
      return;
    if (auto finding = ctx.report(event, cycle == Truth::Yes || call == Truth::Yes))
      finding
          .message(
              "a modal call is still on {0}: every move from here on runs it again; `{1}` ends "
              "it",
              event.kind == EventKind::ToolChange || event.kind == EventKind::ToolWord
                  ? "at this tool change"
                  : "at the program's end",
              cancel_)
          .note(begins(state, cycle), "the modal call begins here")
          .fix(FixSafety::Unsafe, "insert " + cancel_ + " before this block",
               ctx.insertBlockBefore(cancel_));
  }

private:
  /// A turret changes by T alone.
  static bool changesByT(const RuleContext &ctx) {
    return !ctx.find({Action::ToolChange}) &&
           ctx.before().isActive(ctx.dialect(), StandardGroup::Plane, {Action::PlaneZX}) ==
               Truth::Yes;
  }

  /// Whether the program that returns has begun the call, and no caller is known that may end it.
  static bool begunHere(const RuleContext &ctx) {
    const ModalCall *call = ctx.before().modalCalls.get();
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    if (!call || (ctx.caller() && ctx.caller()->unit))
      return false;
    if (call->known)
      return call->file == ctx.source().id() && call->at >= program.begin && call->at < program.end;
    for (const Block &block : blocks(ctx.index(), program.body, ctx.block().begin))
      if (findCode(ctx.dialect(), block, {Action::MacroModal}))
        return true;
    return false;
  }

  static Origin begins(const MachineState &state, Truth cycle) {
    const ModalCall *call = state.modalCalls.get();
    if (cycle != Truth::No || !call || !call->known)
      return state.origin.of(StatePart::Cycle);
    return {call->file, call->at, call->at + 1};
  }

  std::string cancel_;
  bool ofCycles_ = false; ///< cycles are called modally too
};

} // namespace
NCVET_RULE(FlowModalCallLeftActive, flow_modal_call_left_active)
} // namespace ncvet
