// Who is told how programs run.
#pragma once

#include "interp/state/event.h"

namespace ncvet {

struct FileSummary;
struct FileUnit;
struct Region;
struct Step;
struct HoleRow;

/// What is known of the state with which a program begins.
enum class EntryState : uint8_t {
  Known,         ///< the machine's own
  CallerUnknown, ///< that of a caller which is not known
  Uncalled       ///< the same, of a body that nothing calls and the control only reads over
};

/// Something is wrong with where control goes.
struct FlowProblem {
  FlowIssue kind;
  const MachineState &before, &after;
  SourceRange where;
  SourceRange related; ///< a further place that explains it
};

/// What a listener wants to be told of.
struct FlowInterest {
  uint32_t kinds = 0;      ///< bit per `EventKind`: blocks that emit one of these
  bool everyMove = false;  ///< blocks that only go on as the one before, too
  bool everyBlock = false; ///< all blocks, whatever they emit
  /// One path alone: the run ends where something unknown decides, and nothing is told after that.
  bool onePath = false;
  /// Blocks before they are executed: see `FlowListener::arrives`.
  bool beforeBlocks = false;
};

/// A block that is executed next for one state.
struct Arrival {
  const Region &region;
  const Block &block;
  MachineState &state; ///< may be changed
  size_t depth;        ///< programs and parts of programs that run around the region
};

/// Told of every block that is executed, in the order in which the control would execute them:
/// repeated blocks as often as they are repeated, called ones as far as no earlier call from the
/// same state says what they do.
class FlowListener {
public:
  virtual ~FlowListener() = default;
  virtual FlowInterest interest() const = 0;
  /// A block with content is executed next. The answer is that of the operator: it decides a
  /// condition of the block that the state leaves open.
  virtual Truth arrives(const Arrival & /*arrival*/) { return Truth::Unknown; }
  /// The block was executed for one state. `continues`: it only goes on as the one before.
  virtual void executed(const Step &step, bool continues) = 0;
  /// Whether it is told in vain of further blocks of the stretch that only go on.
  virtual bool sleepsThrough(uint64_t /*stretch*/) const { return false; }
  /// Whether, though it is, it wants to be told of such blocks that lead to where the tool is.
  virtual bool wantsStill() const { return false; }
  /// As `executed`, for a block that does what the one before did, numbers aside, but that names
  /// codes: whether nobody but those who are told of every move need be told of a further one.
  virtual bool executedAgain(const Step &step) {
    executed(step, false);
    return true;
  }
  /// As `executed` for at most so many of the first holes of a row that comes after `step`; how
  /// many it was.
  virtual size_t executedRow(const Step & /*step*/, const HoleRow & /*row*/, size_t /*most*/) {
    return 0;
  }
  virtual void problem(const Step & /*step*/, const FlowProblem & /*problem*/) {}
  /// The state comes back from what the block calls.
  virtual void callReturned(const Step & /*step*/, const MachineState & /*after*/) {}
  /// A cycle has read its contour, or run it.
  virtual void contourEnded() {}
  /// From `where` on only the run itself decides where control goes; nothing follows.
  virtual void pathLost(SourceRange /*where*/, llvm::StringRef /*why*/) {}
  /// What follows begins with such a state.
  virtual void entered(EntryState /*entry*/) {}
  /// All states have been told of at a stop at which something was reported.
  virtual void stopEnded() {}
  /// A block that no path reaches, with what its text alone decides.
  virtual void unreached(FileUnit & /*unit*/, const Block & /*block*/, const Outcome & /*outcome*/,
                         const MachineState & /*before*/, const MachineState & /*after*/) {}
  /// All programs of the file have been followed.
  virtual void finished(const FileSummary & /*summary*/) {}
  /// Whether the blocks of this text must be executed, though it is known what they do.
  virtual bool mustSee(FileId /*file*/, uint32_t /*begin*/, uint32_t /*end*/) const {
    return false;
  }
};

} // namespace ncvet
