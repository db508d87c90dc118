// Calls of programs: by number, by name, and by the modal call in force.
#pragma once

#include "analyzer/flow/callees.h"
#include "analyzer/flow/passes.h"

namespace ncvet {

/// Carries out the call of a block.
class Calls {
public:
  Calls(FlowRun &run, Callees &callees, CalledBodies &bodies, PassRunner &passes)
      : run_(run), callees_(callees), bodies_(bodies), passes_(passes) {}

  void call(Step &step);
  /// The block that makes a modal call runs nothing; that the program exists, and takes the
  /// arguments, is looked at here.
  void beginModalCall(Step &step);
  /// After the block the modal call in force runs its program, in the state of that block.
  void callModally(Step &step);

private:
  bool recurs(const Region &region, const Callee &callee) const;
  bool mayEnter(const Step &step, const Callee &callee);
  void tellCircle(const Step &step, const Callee &callee);
  void goOnUnknown(Step &step, const FollowedCall *known = nullptr);
  void enter(Step &step, const Callee &callee, const Passes &passes);

  FlowRun &run_;
  Callees &callees_;
  CalledBodies &bodies_;
  PassRunner &passes_;
};

} // namespace ncvet
