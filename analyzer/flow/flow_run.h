// What all parts of the flow engine share while one file is run.
#pragma once

#include "analyzer/flow/listeners.h"
#include "analyzer/flow/outer_calls.h"
#include "analyzer/flow/read_blocks.h"
#include "analyzer/program/flow_shape.h"
#include "analyzer/rule/analysis_limits.h"
#include "analyzer/rule/visits.h"
#include "interp/value/work_meter.h"

#include "llvm/ADT/DenseMap.h"
#include "llvm/Support/Allocator.h"

#include <set>

namespace ncvet {

struct ConditionKey; // interp/evaluate/condition_key.h

class QuickReader; // formats/readers/quick_reader.h

/// A set that can tell what was put into it, whether it was there already or not.
template <typename T>
class NotedSet : public std::set<T> {
public:
  void insert(T value) {
    if (notes_)
      noted_.push_back(value);
    std::set<T>::insert(std::move(value));
  }
  void startNoting() { notes_ = true; }
  /// What was put into it since then.
  std::vector<T> takeNoted() {
    notes_ = false;
    return std::exchange(noted_, {});
  }

private:
  bool notes_ = false;
  std::vector<T> noted_;
};

/// What the main file's programs have named as targets so far.
struct UsedTargets {
  NotedSet<int64_t> numbers;
  NotedSet<int64_t> programs;
  NotedSet<std::string> labels, names; ///< by key, in capitals
  NotedSet<uint32_t> localSubprograms; ///< by their first block
  NotedSet<uint32_t> profiles;         ///< that plain flow must not reach, by their first block
  NotedSet<uint32_t> bracketed;        ///< subprograms between brackets, by their first block
  bool anyNumber = false;              ///< a local call computes the number to which it leads
  /// Profiles that follow the cycle which finished along them: by their first block.
  std::map<uint32_t, std::pair<Flow, SourceRange>> finishedAhead;
};

/// Which text of the main file was executed.
class Coverage {
public:
  void add(uint32_t begin, uint32_t end) {
    uint32_t &known = runs_[begin];
    known = std::max(known, end);
    for (auto *noted : noted_)
      if (noted)
        noted->emplace_back(begin, end);
  }
  /// From now on what is added is noted in both as well; null: no more.
  using Noted = std::vector<std::pair<uint32_t, uint32_t>>;
  void note(Noted *first, Noted *second) { noted_ = {first, second}; }
  bool holds(uint32_t offset) const;
  /// In text order, without gaps between ranges that meet.
  std::vector<SourceRange> ranges(FileId file) const;

private:
  llvm::DenseMap<uint32_t, uint32_t> runs_; ///< begin → end
  std::array<Noted *, 2> noted_{};
};

/// One analysis of a file: what it works on, what it has spent and found out so far.
struct FlowRun {
  FlowRun(Project &programs, FileUnit &entry, const AnalysisLimits &bounds)
      : project(programs), unit(entry), limits(bounds) {
    workDone = 0;
  }
  FlowRun(const FlowRun &) = delete;
  virtual ~FlowRun() = default;

  /// Runs a region from its start, and gives the states that leave it.
  virtual Exits execute(const Region &region, Lives entry) = 0;

  /// The analysis is no longer complete. `where`: the block that it came to.
  void cut(SourceRange where, std::string why);
  /// The one path that is followed ends: only the run itself decides where control goes.
  void lose(SourceRange where, llvm::StringRef why);
  /// The path goes on in more than one direction.
  void fork(Activation &activation, SourceRange where);
  /// A step of the path to a block.
  const PathNode *lengthen(const PathNode *before, PathNode::Kind kind, SourceRange range,
                           int64_t number = 0);
  /// What a path has decided that goes on where the condition holds, or where it does not; `before`
  /// is what it had decided before.
  const DecidedCondition *decide(const DecidedCondition *before, const ConditionKey &condition,
                                 bool holds);
  void cover(const FileUnit &of, uint32_t begin, uint32_t end);
  /// Something is wrong with where control goes.
  void issue(FlowIssue kind, const Step &step, SourceRange where, SourceRange related = {}) {
    const HeldState &state = step.live.state; // which may have gone on already
    issue(kind, step, step.before, state.isHeld() ? *state : step.before, where, related);
  }
  /// The same, in other states than those of the step.
  void issue(FlowIssue kind, const Step &step, const MachineState &before,
             const MachineState &after, SourceRange where, SourceRange related = {});
  /// All states of a stop have gone through its block.
  void endStop() {
    if (visits.isReported())
      listeners.tell([](FlowListener &listener) { listener.stopEnded(); });
    visits.end();
  }
  const FlowShape &shape(const FileUnit &of, const ProgramInfo &program);
  /// What the block of another file calls in a further one was followed, and has come back with
  /// `after`; null: it was looked at as far as anybody follows it.
  void noteFollowed(const Step &step, const FileUnit &callee, const MachineState *after);
  /// What those who call the program that is run know of the call, when it is left to their checks.
  const FollowedCall *leftToCallers(const Step &step, const FileUnit &callee);
  /// The file's reader, where it knows short ways; null: it knows none.
  const QuickReader *quickReader(const FileUnit &of);

  Project &project;
  FileUnit &unit; ///< the file that is run
  const AnalysisLimits &limits;
  Listeners listeners;
  Visits visits;
  UsedTargets used;
  Coverage covered;
  ReadBlocks readBlocks;
  std::vector<RunningRegion> callStack;
  uint64_t steps = 0;       ///< blocks executed
  uint64_t stretch = 0;     ///< number of the stretch of blocks that only go on
  uint64_t knownBlocks = 0; ///< kinds of blocks of which it is known what they do
  unsigned stops = 0;       ///< programmed stops so far: at each one the operator decides
  unsigned forks = 0;       ///< times that a path went on in more than one direction
  unsigned deepest = 0;     ///< level of the deepest call in the program that is run
  uint64_t repeated = 0;    ///< blocks executed again, by what they cost
  uint64_t blocks = 0;      ///< blocks with content of the file's main programs
  bool abstract = false;    ///< the budget is spent: loops are no longer run for real
  const ProgramInfo *mainProgram = nullptr; ///< of the file, see `Engine`
  bool callerUnknown = false;        ///< subprograms that nothing in the file calls are being run
  bool entryUnknown = false;         ///< a program whose caller is not known is being run
  const OuterCalls *outer = nullptr; ///< null: all calls are followed
  std::map<FileId, std::map<uint32_t, uint64_t>> followed;          ///< see `AnalysisResult`
  bool asksOuter = false, postponed = false, restsOnOthers = false; ///< the same
  bool stopped = false;
  bool stale = false; ///< what was known of an earlier analysis must not be reused: once more
  bool opaque =
      false; ///< what was called is not known, lies in another file or is between brackets
  bool inFull = false; ///< every block is read, executed and told in full: see docs/fast-path.md
  bool complete = true;
  std::vector<std::string> cuts;

private:
  llvm::BumpPtrAllocator paths_;
  std::pair<const FileUnit *, const QuickReader *> quick_{}; ///< of the file asked for last
  std::map<std::pair<FileId, uint32_t>, FlowShape> shapes_;
};

/// Nothing is known of the machine any more, but for where things were set.
void forget(MachineState &state, const Dialect &dialect);

} // namespace ncvet
