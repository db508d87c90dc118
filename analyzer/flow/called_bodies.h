// Runs called bodies, and remembers what each did for which state.
#pragma once

#include "analyzer/flow/flow_run.h"

namespace ncvet {

/// Programs and parts of programs that a block has run as a whole.
class CalledBodies {
public:
  explicit CalledBodies(FlowRun &run) : run_(run) {}

  /// The states that leave the body; paths that return to the same place in the same modes are one.
  Exits run(const Region &region, Live live);
  bool isRunning(const FileUnit &unit, uint32_t start, RegionKind kind, uint32_t end = ~0u) const {
    return llvm::is_contained(run_.callStack, RunningRegion{unit.source.id(), start, kind, end});
  }
  /// Repeated sections that are being executed, one in the other.
  unsigned runningSections() const;
  /// Whether bodies are nested as deep as they may be.
  bool isDeep() const { return run_.callStack.size() >= run_.limits.callDepth; }

private:
  struct Memo {
    uint64_t hash;
    MachineState entry;
    Exits exits;
    unsigned sections; ///< repeated sections round it
    bool stops;        ///< the program stops in it until the operator goes on
    bool forks;        ///< something unknown decides in it
  };
  /// What is remembered of one body.
  struct Remembered {
    std::vector<Memo> memos;
    unsigned inVain = 0; ///< runs since one of them was of use
  };
  static bool isWorthLooking(Remembered &body);
  std::optional<Exits> recall(Remembered &body, uint64_t print, unsigned sections,
                              const Live &live);
  static Exits merge(Exits raw, const PathNode *path);

  FlowRun &run_;
  std::map<RunningRegion, Remembered> remembered_;
};

} // namespace ncvet
