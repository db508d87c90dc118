// Jumps to a known block: which lead back, how often they are followed, and which never end.
#pragma once

#include "analyzer/flow/flow_run.h"

namespace ncvet {

/// Lets states go on at blocks of their region, and sees to it that every analysis ends.
class Loops {
public:
  explicit Loops(FlowRun &run) : run_(run) {}

  /// Goes on at `target`; jumps that lead back are counted. `certain`: no other way was open.
  void goTo(const Step &step, uint32_t target, Live live, bool certain);
  void backTo(const Step &step, uint32_t target, Live live, bool certain);
  /// Begin or end of a loop with a number, `WHILE DO` and `END`.
  void loop(Step &step);
  /// Whether the jump of the block leads back over blocks that hold no way out, whatever the values
  /// are. Asked once for every jump.
  bool isNeverLeft(const Step &step, FileUnit &unit, uint32_t target);

private:
  bool runsForReal(const Activation &activation, LoopHead &head) const;
  bool runsOnceMore(const Step &step, uint32_t target, LoopHead &head, const Live &live);
  void runPass(const Step &step, uint32_t target, LoopHead &head, Live live);

  FlowRun &run_;
  std::map<std::pair<FileId, uint32_t>, bool> closed_; ///< by the jump that closes the loop
};

} // namespace ncvet
