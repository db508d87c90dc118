// The arguments of calls: what is given, what is wanted, and what the called program gets.
#pragma once

#include "analyzer/flow/callees.h"
#include "analyzer/flow/passes.h"

namespace ncvet {

/// An argument of a call.
struct GivenArgument {
  bool left = true; ///< nothing is given
  Value value;
  uint64_t variable = 0; ///< key of the variable that it is
};
using GivenArguments = llvm::SmallVector<GivenArgument, 8>;

/// The arguments of a call of the block, with their values in the state `caller`.
GivenArguments givenTo(const Block &block, const Item &call, const MachineState &caller);

/// Those of a modal call that the block `made` has made.
GivenArguments givenModally(const ModalCall &modal, const Block &made, const Item &call);

/// Has whether a call has the arguments that the program wants told to the rules.
void checkArguments(FlowRun &run, const Step &step, const Callee &callee, const Item &call);

/// The first numbered variables of the called program get the values of the call; the other local
/// ones keep those of the caller (LinuxCNC 2.9, section 11.7.4).
void bindPositions(const Block &block, const Item &call, const MachineState &caller,
                   MachineState &state);

/// The called program's parameters get the values of the call. What it gives back, and whether the
/// caller's modes come back, goes into `passes`.
void bindArguments(const Callee &callee, llvm::ArrayRef<GivenArgument> given,
                   const MachineState &caller, MachineState &state, Passes &passes);

} // namespace ncvet
