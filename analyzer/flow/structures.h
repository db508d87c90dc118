// Brackets of structured flow: branches, loops and subprograms in a program's text.
#pragma once

#include "analyzer/flow/loops.h"

namespace ncvet {

/// How the ways from a bracket to the next block and to another one are told.
struct WaysTold {
  PathNode::Kind next, other;
};

/// Carries out one bracket at a time: which block follows it.
class Structures {
public:
  Structures(FlowRun &run, Loops &loops) : run_(run), loops_(loops) {}

  void bracket(Step &step);
  /// Whether `target` lies inside a bracket of structured flow that does not hold `from`.
  bool isEntered(const Region &region, uint32_t from, uint32_t target);

private:
  /// Where control goes from a bracket.
  struct Partners {
    uint32_t past = ~0u, back = ~0u, out = ~0u; ///< `~0u`: nowhere
  };
  void mismatch(Step &step, const Item &item);
  void passed(const Step &step, const FlowShape &shape, uint32_t to);
  void decide(Step &step, Truth condition, uint32_t other, bool loops, WaysTold told);
  void whileHead(Step &step, const Item &item, const Partners &to);
  void countedEnd(Step &step, uint32_t headAt, Truth (*count)(const Block &, MachineState &));
  void subprogramEnd(Step &step);

  FlowRun &run_;
  Loops &loops_;
};

} // namespace ncvet
