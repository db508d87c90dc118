// Who watches a program run along one way.
#pragma once

#include "analyzer/program/project.h"
#include "interp/state/event.h"

namespace ncvet {

/// Told of every block that is executed, in the order in which the control would execute them:
/// repeated blocks as often as they are repeated.
class BlockWatcher {
public:
  virtual ~BlockWatcher() = default;
  /// `before.profile` says whether the block is data of a contour (1), or run by a cycle (2).
  virtual void executed(const FileUnit &unit, const Block &block, const Outcome &outcome,
                        const MachineState &before, const MachineState &after) = 0;
  /// A cycle has read its contour, or run it.
  virtual void profileEnds() {}
  /// From `where` on only the run itself decides where control goes; nothing follows.
  virtual void lost(SourceRange where, llvm::StringRef why) = 0;
};

} // namespace ncvet
