// Runs called bodies, and remembers what each did for which state.
#pragma once

#include "analyzer/flow/call_recorder.h"

#include <deque>

namespace ncvet {

/// Programs and parts of programs that a block has run as a whole.
class CalledBodies {
public:
  explicit CalledBodies(FlowRun &run) : run_(run) {}

  /// Takes over what calls did in an earlier analysis, and has them recorded.
  void reuse(CallRecorder &calls) { calls_ = &calls; }
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
  /// What a body adds to what only grows.
  struct Added {
    CutArea::Box cut = CutArea::none;
    DepthMoves depth;
  };
  /// What is known of a run of a body besides its exits.
  struct Effect {
    bool stops = false; ///< the program stops in it until the operator goes on
    bool forks = false; ///< something unknown decides in it
    StateUse use;
    llvm::SmallVector<Added, 1> added;                 ///< by exit, where calls are reused
    std::optional<std::vector<KnownCall::Text>> texts; ///< that were looked at; none: not known
  };
  struct Memo {
    uint64_t hash;
    MachineState entry;
    Exits exits;
    unsigned sections; ///< repeated sections round it
    Effect effect;
  };
  /// What is remembered of one body.
  struct Remembered {
    std::deque<Memo> memos;
    unsigned known = 0;  ///< more of them in calls that were taken over
    unsigned inVain = 0; ///< runs since one of them was of use
  };
  static bool hasRoom(const Remembered &body);
  static bool isWorthLooking(Remembered &body);
  std::optional<Exits> recall(const Region &region, Remembered &body, uint64_t print,
                              unsigned sections, const Live &live);
  static Exits merge(Exits raw, const PathNode *path);
  Exits runAnew(const Region &region, Live live, Effect &effect);
  Exits runMuted(const Region &region, Live live, Effect &effect);
  Exits runOrTakeOver(const Region &region, Live live, const BodyRun &body, bool isRemembered,
                      Effect &effect);
  RunningRegion keyOfInner(const BodyRun &body) const;
  bool mayTakeOver(const KnownCall &call);
  void noteRun(const KnownCall &call);

  FlowRun &run_;
  CallRecorder *calls_ = nullptr;
  llvm::DenseSet<uint64_t> ran_;   ///< bodies that have run, by `BodyRun::print`
  llvm::DenseSet<uint64_t> known_; ///< those of calls that were taken over: not what they did
  bool muted_ = false;             ///< what runs has been told of already
  std::map<RunningRegion, Remembered> remembered_;
};

} // namespace ncvet
