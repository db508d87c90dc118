// Jumps: by words, by statements with targets, and by the operator's answer.
#pragma once

#include "analyzer/flow/called_bodies.h"
#include "analyzer/flow/jump_targets.h"
#include "analyzer/flow/structures.h"

namespace ncvet {

/// Carries out the jump of a block.
class Jumps {
public:
  Jumps(FlowRun &run, Loops &loops, JumpTargets &targets, Structures &structures,
        CalledBodies &bodies)
      : run_(run), loops_(loops), targets_(targets), structures_(structures), bodies_(bodies) {}

  void jump(Step &step);
  /// The operator answers, or leaves by the key that the block names a target for.
  void branch(Step &step);

private:
  struct Targets {
    llvm::SmallVector<const Argument *, 3> arguments;
    bool fallsThrough = false; ///< perhaps none of them is taken
  };
  static Targets byValue(const Step &step, llvm::ArrayRef<Argument> all);
  static Targets targetsOf(const Step &step, const Item &item);
  void byWord(Step &step);
  void byItem(Step &step, const Item &item);
  void untaken(Step &step, const Item &item);
  bool leaveOut(Step &step, bool looksOn);
  void notTaken(Step step);
  void goOnIn(const Step &step, Live live, FileUnit &unit, const ProgramInfo &program,
              uint32_t target);

  FlowRun &run_;
  Loops &loops_;
  JumpTargets &targets_;
  Structures &structures_;
  CalledBodies &bodies_;
};

} // namespace ncvet
