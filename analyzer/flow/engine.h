// Follows a program as its control would: calls, jumps, loops, block skip, profiles.
#pragma once

#include "analyzer/flow/flow_listener.h"
#include "analyzer/flow/states_at_block.h"
#include "analyzer/program/flow_shape.h"
#include "analyzer/reuse/run_cache.h"
#include "analyzer/rule/dispatch.h"
#include "formats/text/crash_guard.h"

#include "llvm/ADT/DenseMap.h"
#include "llvm/ADT/DenseSet.h"
#include "llvm/Support/Allocator.h"

#include <atomic>
#include <map>
#include <memory>
#include <set>
#include <tuple>

namespace ncvet {

/// Runs the programs of one file. Straight-line blocks are read, executed and forgotten; states
/// wait only where flow meets: at targets of jumps, behind conditions and skipped blocks.
///
/// Blocks are taken in the order of their place in the text, so that all ways to a block have
/// arrived before it is executed, save those over a backward jump. A backward jump under a known
/// condition is run for real; under an unknown one the states at its target are joined, later
/// widened, until nothing new comes. Findings are made in every pass: the first pass through a
/// loop is a way to each of its blocks, and later states only add ways, so what is reported early
/// stays true.
class Engine {
public:
  Engine(Project &project, FileUnit &unit, const RuleSelection &rules, const AnalysisLimits &limits,
         const std::atomic<bool> *cancel, StraightRuns *runs = nullptr);

  AnalysisResult run();
  /// Runs the file's first program along one way only: block skip off, and no further than to where
  /// something unknown decides. No findings are made.
  void follow(BlockWatcher &watcher);
  /// Runs as `run` does, and gives the states that came by the block at `offset` of `file`.
  StatesAt observe(FileId file, uint32_t offset);

private:
  /// One state on its way, and how it came there.
  struct Live {
    MachineState state;
    const PathNode *path = nullptr;
    /// Block skip switch per level, as far as this way has decided it: 0 unknown, 1 off, 2 on.
    std::array<uint8_t, 10> skip{};
  };
  using Lives = llvm::SmallVector<Live, 1>;

  enum class Kind : uint8_t { Main, Subprogram, LocalSubprogram, Profile, Section };
  struct Region {
    FileUnit &unit;
    const ProgramInfo &program;
    uint32_t start;
    Kind kind;
    unsigned depth = 0;
    uint32_t lastBlock = ~0u; ///< profile: offset of the last block
    uint32_t stopAt = ~0u;    ///< section: offset behind its last block
  };
  /// A region that is being executed: its file, start, kind and end. Sections and profiles of one
  /// start may end at different blocks, and one may hold the other.
  using Running = std::tuple<FileId, uint32_t, Kind, uint32_t>;
  static Running keyOf(const Region &region) {
    const uint32_t end = region.kind == Kind::Section   ? region.stopAt
                         : region.kind == Kind::Profile ? region.lastBlock
                                                        : ~0u;
    return {region.unit.source.id(), region.start, region.kind, end};
  }
  struct Callee {
    FileUnit *unit;
    const ProgramInfo *program;
    uint32_t start;
    Kind kind;
    int64_t number; ///< for the path; `notSet`: none
  };
  /// How often a body runs, and where control goes on behind it.
  struct Passes {
    uint32_t at = 0, next = 0;
    double count = 1;
    bool known = true; ///< false: it runs an unknown number of times
    const PathNode *path = nullptr;
    std::optional<Variables> locals;        ///< of the caller, when the body has its own
    std::optional<MachineState> modes;      ///< of the caller, when the body gives them back
    llvm::SmallVector<uint64_t, 2> written; ///< variables of the caller that the body may write
    ModalCalls modal;                       ///< the modal call that runs the body

    void setCount(const Value &repeat);
  };
  /// An argument of a call.
  struct Given {
    bool left = true; ///< nothing is given
    Value value;
    uint64_t variable = 0; ///< key of the variable that it is
  };
  using GivenArguments = llvm::SmallVector<Given, 8>;
  struct Targets {
    llvm::SmallVector<const Argument *, 3> arguments;
    bool fallsThrough = false; ///< perhaps none of them is taken
  };
  struct Returned {
    Live live;
    int64_t target = notSet; ///< block of the caller to go on with
  };
  using Exits = std::vector<Returned>;

  /// What is remembered of a target of backward jumps.
  struct Head {
    unsigned visits = 0;
    bool abstract = false;
    bool hasSeen = false;
    MachineState seen;
    uint64_t snapshot = 0; ///< hash of the state at an earlier visit
    unsigned nextSnapshot = 16;
    unsigned snapshotForks = 0; ///< forks of the activation at the time of the snapshot
    unsigned snapshotStops = 0; ///< and how often the operator had been asked to go on by then
    unsigned windowEnd = 0;     ///< visits up to this one are compared with the snapshot
    unsigned lastForks = 0;     ///< forks of the activation at the last visit
    unsigned forkedVisits = 0;  ///< visits behind a pass in which something unknown decided
    uint64_t firstStep = 0;     ///< steps of the engine at the first visit
  };
  /// What is remembered of a place at which ways arrive again and again.
  struct Meeting {
    unsigned lastRound = 0;
    unsigned rounds = 0;                ///< in so many rounds a way arrived
    std::unique_ptr<MachineState> seen; ///< all that has gone on from here, since it is kept
  };
  struct Activation {
    const Region &region;
    std::map<uint32_t, Lives> pending;
    uint32_t nextPending = ~0u;
    std::map<uint32_t, Head> heads;
    Exits exits;
    uint32_t runBegin = 0, runEnd = 0; ///< blocks executed in a row
    uint32_t high = 0;                 ///< behind the last block executed for the first time
    uint32_t lastBegin = 0, lastEnd = 0;
    bool executedAny = false;
    unsigned forks = 0;     ///< times that the way went on in more than one direction
    unsigned rounds = 0;    ///< times that joined states went back over a backward jump
    uint32_t lastNoted = 0; ///< the labels of jumps in front of this place are noted
    std::map<uint32_t, Meeting> meetings{};
  };
  struct Memo {
    uint64_t hash;
    MachineState entry;
    Exits exits;
    unsigned sections; ///< repeated sections around it
    bool stops;        ///< the program stops in it until the operator goes on
  };
  Exits execute(const Region &region, Lives lives);
  void follow(const RunPlace &run, Activation &activation);
  bool mayTakeOver(const RunPlace &run, const FileUnit &unit) const;
  void add(Activation &activation, uint32_t offset, Live live);
  void wait(Activation &activation, uint32_t offset, Live live);
  static bool bringsNothing(Activation &activation, uint32_t offset, MachineState &state);
  Lives takePending(Activation &activation, uint32_t &offset);
  void mergeInto(const FileUnit &unit, Lives &lives, Live live);
  /// Handles the flow of one executed block for one state; false when the state goes on with the
  /// next block, and stays where it is.
  bool leave(Activation &activation, Live &live, uint32_t at, const MachineState &before);
  SourceRange loopAt(const Activation &activation, uint32_t target) const;
  void backTo(Activation &activation, uint32_t target, Live live, bool certain);
  void goTo(Activation &activation, uint32_t from, uint32_t target, Live live, bool certain);
  void jump(Activation &activation, Live &live, uint32_t at, const MachineState &before);
  void loop(Activation &activation, Live &live, uint32_t at, const MachineState &before);
  void anywhere(Activation &activation, const Live &live, uint32_t at,
                const Argument *target = nullptr, JumpKind kind = JumpKind::Anywhere);
  void anyLabel(Activation &activation, const Live &live, uint32_t at, const Argument &target,
                JumpKind kind);
  void noteTargets(const FileUnit &unit);
  std::optional<uint32_t> resolve(Activation &activation, const Live &live,
                                  const MachineState &before, FileUnit &unit,
                                  const ProgramInfo &program, const Argument &target, uint32_t at,
                                  JumpKind kind);
  Targets targetsOf(const Item &item, const Interval &choice) const;
  void notTaken(Activation &activation, Live live, uint32_t at, const MachineState &before);
  void jumpTo(Activation &activation, Live &live, uint32_t at, const MachineState &before);
  void goOnIn(Activation &activation, Live live, FileUnit &unit, const ProgramInfo &program,
              uint32_t target);
  void branch(Activation &activation, Live &live, uint32_t at, const MachineState &before);
  void structure(Activation &activation, Live &live, uint32_t at, const MachineState &before);
  static Truth countUp(const Block &head, MachineState &state);
  static Truth countDown(const Block &head, MachineState &state);
  bool findBracketed(Callee &callee, llvm::StringRef name);
  static std::optional<uint32_t> subprogramBody(const FileUnit &unit, llvm::StringRef label,
                                                const ProgramInfo *&program);
  void runOtherSubprograms();
  std::optional<Callee> callee(Activation &activation, const Live &live, uint32_t at,
                               const MachineState &before);
  unsigned runningSections() const;
  bool isRunning(const FileUnit &unit, uint32_t start, Kind kind, uint32_t end = ~0u) const;
  bool recurs(const Region &region, const Callee &callee) const;
  void bindPositions(const Item &call, const MachineState &caller, MachineState &state);
  GivenArguments givenTo(const Item &call, const MachineState &caller) const;
  void bindArguments(const Callee &callee, llvm::ArrayRef<Given> given, const MachineState &caller,
                     MachineState &state, Passes &passes);
  bool mayEnter(Activation &activation, const Live &live, const MachineState &before,
                const Callee &callee);
  static void restoreModes(MachineState &state, const MachineState &caller);
  void runPasses(Activation &activation, const Region &body, Live live, const MachineState &before,
                 const Passes &passes);
  void repeat(Activation &activation, Live &live, uint32_t at, const MachineState &before);
  bool holdsEnd(FileUnit &unit, uint32_t first, uint32_t end) const;
  bool holdsWayOut(FileUnit &unit, uint32_t first, uint32_t end) const;
  bool neverLeft(FileUnit &unit, uint32_t target, uint32_t at);
  uint32_t endOfSection(FileUnit &unit, uint32_t first, uint32_t at) const;
  void call(Activation &activation, Live &live, uint32_t at, const MachineState &before);
  void goOnUnknown(Activation &activation, Live &live);
  void beginModalCall(Activation &activation, Live &live, uint32_t at, const MachineState &before);
  void callModally(Activation &activation, Live &live, uint32_t at, const MachineState &before);
  std::optional<Callee> modalCallee(Activation &activation, const ModalCall &call,
                                    const Block &made, const Item *&item);
  static void restoreModalCall(MachineState &state, const Passes &passes);
  void contour(Activation &activation, Live &live, const MachineState &before);
  void contourSection(Activation &activation, const Live &live, const MachineState &before,
                      llvm::StringRef labels);
  bool runsForReal(const Activation &activation, Head &head) const;
  bool entersStructure(const Region &region, uint32_t from, uint32_t target);
  void checkArguments(Activation &activation, const Live &live, const MachineState &before,
                      const Callee &callee, const Item &call);
  bool isVariable(uint16_t expression) const;
  std::optional<Block> parametersOf(const Callee &callee) const;
  void profile(Activation &activation, Live &live, uint32_t at, const MachineState &before);
  Exits callBody(const Region &region, Live live);
  void runsIntoProfile(Activation &activation, const Live &live, const MachineState &before,
                       uint32_t at);
  void runOut(Activation &activation, Lives &lives);
  void issue(FlowIssue kind, Activation &activation, const Live &live, const MachineState &before,
             SourceRange where, SourceRange related = {});
  void forget(Live &live, const Dialect &dialect);
  const FlowShape &shape(const FileUnit &unit, const ProgramInfo &program);
  const PathNode *step(const PathNode *before, PathNode::Kind kind, SourceRange range,
                       int64_t number = 0);
  void cut(std::string why);
  /// The way goes on in more than one direction.
  void fork(Activation &activation, SourceRange where);
  void lose(SourceRange where, llvm::StringRef why);
  SourceRange blockRange(const FileUnit &unit) const {
    return {unit.source.id(), block_.begin, block_.end};
  }
  void cover(const FileUnit &unit, uint32_t begin, uint32_t end);
  void ending(const Block &block, bool &ends, bool &returns) const;
  void endings(uint32_t begin, uint32_t end, bool &ends, bool &returns);
  void runOtherPrograms();
  void inspectUnreached();
  std::vector<SourceRange> reachedRanges() const;
  SourceRange flowRange(const FileUnit &unit) const {
    return {unit.source.id(), outcome_.flow.begin, outcome_.flow.end};
  }

  Project &project_;
  FileUnit &unit_;
  const AnalysisLimits &limits_;
  const std::atomic<bool> *cancel_;
  StraightRuns *const runs_; ///< null: every block is executed
  Collector collector_;
  Dispatcher dispatcher_;
  llvm::BumpPtrAllocator paths_;
  Block block_;
  Outcome outcome_;
  std::map<Running, std::vector<Memo>> memos_;
  std::map<std::pair<FileId, uint32_t>, FlowShape> shapes_;
  std::map<std::pair<FileId, uint32_t>, bool> closedLoops_; ///< by the jump that closes them
  llvm::DenseMap<uint32_t, uint32_t> covered_; ///< of the main file: begin → end of runs
  std::set<int64_t> usedNumbers_;
  std::set<int64_t> calledPrograms_;
  std::set<uint32_t> localTargets_, profileStarts_;
  /// Profiles that stand behind the cycle which finished along them: by their first block.
  std::map<uint32_t, std::pair<Flow, SourceRange>> finishedAhead_;
  std::set<uint32_t> calledBodies_; ///< of the main file: subprograms between brackets
  std::set<std::string> usedLabels_, calledNames_; ///< by key, in capitals
  std::vector<Running> callStack_;
  uint64_t steps_ = 0;
  unsigned stops_ = 0; ///< programmed stops so far: at each one the operator decides
  uint64_t repeated_ = 0;
  uint64_t blocks_ = 0;
  bool abstract_ = false;      ///< the budget is spent: loops are no longer run for real
  bool callerUnknown_ = false; ///< subprograms that nothing in the file calls are being run
  bool stopped_ = false;
  bool complete_ = true;
  std::vector<std::string> cuts_;
  BlockWatcher *watcher_ = nullptr; ///< of the one way that is followed
  unsigned passesFollowed_ = 0;     ///< cycles whose passes were made to see where they end
  void note(const MachineState &before, const Live &live);
  FileId observedFile_ = 0;
  uint32_t observedAt_ = ~0u; ///< block whose states are wanted; none
  StatesAt observed_;
};

} // namespace ncvet
