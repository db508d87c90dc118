// Where control goes after a block.
#pragma once

#include "analyzer/flow/calls.h"
#include "analyzer/flow/contours.h"
#include "analyzer/flow/jumps.h"
#include "analyzer/flow/sections.h"

namespace ncvet {

/// Carries out the flow of executed blocks: jumps, brackets, calls, repeats, contours, ends.
class BlockFlow {
public:
  explicit BlockFlow(FlowRun &run)
      : run_(run), loops_(run), bodies_(run), callees_(run), targets_(run, loops_),
        structures_(run, loops_), passes_(run, loops_, bodies_),
        jumps_(run, loops_, targets_, structures_, bodies_),
        calls_(run, callees_, bodies_, passes_), sections_(run, loops_, targets_, bodies_, passes_),
        contours_(run, callees_, bodies_) {}

  /// Takes over what calls did in an earlier analysis, and has them recorded.
  void reuse(CallRecorder &calls) { bodies_.reuse(calls); }
  /// The state leaves the block as its flow says.
  void leave(Step &step);
  /// After the block the modal call in force runs its program.
  void callModally(Step &step) { calls_.callModally(step); }

private:
  bool mayBePassed(const Step &step);
  void endProgram(Step &step);
  void returnFrom(Step &step);

  FlowRun &run_;
  Loops loops_;
  CalledBodies bodies_;
  Callees callees_;
  JumpTargets targets_;
  Structures structures_;
  PassRunner passes_;
  Jumps jumps_;
  Calls calls_;
  Sections sections_;
  Contours contours_;
  std::map<std::pair<FileId, uint32_t>, bool> foreignJumps_; ///< by file and begin of the program
};

} // namespace ncvet
