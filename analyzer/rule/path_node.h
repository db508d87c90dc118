// The path to a block, as the engine keeps it.
#pragma once

#include "formats/finding/finding.h"

#include <vector>

namespace ncvet {

/// A step of the path to a block; a list that grows at its head and is shared by all states.
struct PathNode {
  enum class Kind : uint8_t {
    Call,
    ModalCall,
    Jump,      ///< to its target
    Holds,     ///< a condition, which leads into a body or out of a loop
    NoJump,    ///< a condition that does not hold
    LoopRuns,  ///< a loop that is counted: another pass
    LoopEnded, ///< its last pass is over
    Skip,
    LoopPass
  } kind;
  SourceRange range;
  int64_t number = 0;
  unsigned length = 1;
  const PathNode *before = nullptr;
};

/// The steps in words, from the begin of the path on.
std::vector<PathStep> stepsOf(const PathNode *path);

} // namespace ncvet
