// How often a body runs, and where control goes on after it.
#pragma once

#include "analyzer/flow/called_bodies.h"
#include "analyzer/flow/loops.h"

namespace ncvet {

/// Repeat count of a call, its return point, and what the caller gets back.
struct Passes {
  uint32_t next = 0; ///< offset of the block to go on with
  double count = 1;
  bool known = true; ///< false: it runs an unknown number of times
  const PathNode *path = nullptr;
  std::optional<Variables> locals;        ///< of the caller, when the body has its own
  std::optional<MachineState> modes;      ///< of the caller, when the body gives them back
  llvm::SmallVector<uint64_t, 2> written; ///< variables of the caller that the body may write
  ModalCalls modal;                       ///< the modal call that runs the body

  /// Those of a block that calls once and goes on with the next one.
  explicit Passes(const Step &step) : next(step.block.next), path(step.live.path) {}
  void setCount(const Value &repeat);
};

/// Runs bodies pass by pass.
class PassRunner {
public:
  PassRunner(FlowRun &run, Loops &loops, CalledBodies &bodies)
      : run_(run), loops_(loops), bodies_(bodies) {}

  /// Runs a body as often as it is called for, and goes on after the call. The step's own state
  /// enters it.
  void run(Step &step, const Region &body, const Passes &passes);

private:
  Lives runOnce(const Step &step, const Region &body, const Passes &passes, Lives &entries,
                bool &changed);
  void jumpBack(const Step &step, const Passes &passes, Returned exit);
  void comeBack(const Step &step, const Region &body, const Passes &passes, Live &live);

  FlowRun &run_;
  Loops &loops_;
  CalledBodies &bodies_;
};

} // namespace ncvet
