// Runs called bodies, and remembers what each did for which state.
#pragma once

#include "analyzer/flow/body_memos.h"
#include "analyzer/flow/call_recorder.h"

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
  using Memo = BodyMemos::Memo;
  using Effect = BodyMemos::Effect;
  using Remembered = BodyMemos::Remembered;
  BodyMemos &memos();
  static bool isWorthLooking(Remembered &body);
  const Memo *find(const Region &region, const Remembered &body, uint64_t sum, unsigned sections,
                   const Live &live) const;
  std::optional<Exits> recall(const Region &region, Remembered &body, uint64_t sum,
                              unsigned sections, const Live &live);
  static Exits merge(Exits raw, const PathNode *path, const DecidedCondition *decided);
  Exits runAnew(const Region &region, Live live, Effect &effect);
  Exits runMuted(const Region &region, Live live, Effect &effect);
  Exits runOrTakeOver(const Region &region, Live live, const BodyRun &body, bool isRemembered,
                      Effect &effect);
  RunningRegion keyOfInner(const BodyRun &body) const;
  bool mayTakeOver(const KnownCall &call);
  void noteRun(const KnownCall &call);
  void noteFiles(const llvm::BitVector &more);
  bool isShared() const { return memos_ != &own_; }

  FlowRun &run_;
  CallRecorder *calls_ = nullptr;
  llvm::DenseSet<uint64_t> ran_;   ///< bodies that have run, by `BodyRun::print`
  llvm::DenseSet<uint64_t> known_; ///< those of calls that were taken over: not what they did
  bool muted_ = false;             ///< what runs has been told of already
  BodyMemos own_;
  BodyMemos *memos_ = nullptr; ///< null: nothing has been called yet
  llvm::BitVector files_;      ///< that run in the body, where runs share memos
  unsigned mainFile_ = 0;      ///< number of the file that is run, among them
};

} // namespace ncvet
