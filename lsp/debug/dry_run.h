// A dry run: the engine follows a program on a thread of its own, and stops where the user wants.
#pragma once

#include "analyzer/flow/activation.h"
#include "analyzer/flow/flow_listener.h"
#include "lsp/debug/breakpoints.h"
#include "lsp/debug/loaded_program.h"

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace ncvet::dap {

/// What a run does where the state leaves a condition open.
enum class OpenCondition : uint8_t { Ask, Holds, Fails };

struct RunSettings {
  bool stopOnEntry = false;
  bool stopsNowhere = false;                                  ///< no breakpoint counts
  SkipSwitches skip{};                                        ///< by level; Unknown counts as Off
  std::vector<std::pair<std::string, std::string>> variables; ///< their values at the start
  OpenCondition open = OpenCondition::Ask;
};

/// Why a run has stopped, in the protocol's words.
struct Stop {
  const char *reason = "step";
  std::string description, text; ///< may be empty
  std::vector<int> breakpoints;  ///< ids of those that were hit
};

/// A running program or part of one, and the block that it is at: of the innermost one the block
/// that is executed next, of the others the one that calls.
struct Frame {
  FileUnit *unit = nullptr;
  const ProgramInfo *program = nullptr;
  RunningRegion region{};
  const Region *identity = nullptr;
  uint32_t begin = 0, end = 0; ///< of the block
  uint32_t next = 0;           ///< after it; of one that has just begun: its first block
  std::string name;
  MachineState state; ///< before the block; of the innermost frame `DryRun::state` counts
};

/// Told what a run does, on its thread.
class RunObserver {
public:
  virtual ~RunObserver() = default;
  /// It waits now. What it shows may be asked for until it is sent on.
  virtual void stopped(const Stop &stop) = 0;
  /// `category` as the protocol has it: `console`, `important`, `stdout`, `stderr`.
  virtual void said(const char *category, const std::string &text, const FileUnit &unit,
                    uint32_t offset) = 0;
  /// The program has ended, or nothing leads on. Not told after `DryRun::end`.
  virtual void ended(bool complete) = 0;
};

enum class Go : uint8_t { On, Into, Over, Out };

/// One dry run of a program. Its functions belong to one thread, which is not the run's own.
class DryRun final : private FlowListener {
public:
  DryRun(LoadedProgram &program, Breakpoints &breakpoints, RunSettings settings,
         RunObserver &observer);
  ~DryRun() override;
  DryRun(const DryRun &) = delete;
  DryRun &operator=(const DryRun &) = delete;

  void start();
  /// Ends the run; blocks until its thread has ended.
  void end();
  /// True when it waits: `frames` and `state` may be looked at, and it may be sent on.
  bool isStopped() const;
  /// All these do nothing while the run does not wait.
  void go(Go how);
  void stepBack();
  /// Back to the breakpoint that was hit last, else to the start.
  void goBack();
  /// Goes on to that block, past all breakpoints. Where the run ends without coming there it is
  /// made again up to where it waits now, and that is said.
  void goTo(Breakpoints::Place block);
  /// Stops a run that does not wait before its next block.
  void pause() { pause_ = true; }
  /// Runs `task` while the run does not: at once, or before its next block.
  void perform(const std::function<void()> &task);

  /// Outermost first; one at least while it waits.
  llvm::ArrayRef<Frame> frames() const { return frames_; }
  /// Before the block that is executed next.
  const MachineState &state() const { return *state_; }
  /// Gives a variable another value, as the control reads both.
  llvm::Error assignVariable(llvm::StringRef name, llvm::StringRef value);
  /// Whether the block that is executed next has a condition that the state leaves open.
  bool isOpen() const { return isOpen_; }
  /// What the operator says of that condition.
  void answer(bool holds) { answer_ = holds ? Truth::Yes : Truth::No; }

private:
  FlowInterest interest() const override { return {0, false, true, true, true}; }
  Truth arrives(const Arrival &arrival) override;
  void executed(const Step &, bool) override {}
  void pathLost(SourceRange where, llvm::StringRef why) override;

  void launch();
  void runThread();
  void runOnce();
  void replay(uint64_t goal, uint64_t scanTo);
  bool enter(const Arrival &arrival);
  Truth comeAgain(const Arrival &arrival, bool entered);
  void applyJournal(MachineState &state);
  void serve();
  bool look(const Arrival &arrival);
  void tellReached(const Arrival &arrival, bool aloud);
  void tellMessages(const Arrival &arrival, Truth answer) const;
  void tellPassed(const Arrival &arrival) const;
  void tellNotReached();
  std::optional<Stop> whyStop(const Arrival &arrival, bool entered);
  std::optional<Stop> atBreakpoint(const Arrival &arrival, bool entered, bool aloud);
  std::optional<Stop> atEvent(const Arrival &arrival) const;
  std::optional<Stop> atFinding() const;
  bool stepEnds() const;
  void wait(const Stop &stop, MachineState &state);
  Truth decide(const Arrival &arrival, std::optional<Stop> stop);

  /// What the user did before a block, for a run that comes there again.
  struct Change {
    std::string name, value;
  };
  struct Journal {
    std::vector<Change> changes;
    Truth answer = Truth::Unknown;
  };

  LoadedProgram &program_;
  Breakpoints &breakpoints_;
  const RunSettings settings_;
  RunObserver &observer_;
  std::thread thread_;

  mutable std::mutex mutex_; ///< of what follows
  std::condition_variable wake_, served_;
  bool waits_ = false, running_ = false;
  std::optional<Go> sentOn_;
  std::function<void()> task_;

  std::atomic<bool> pause_ = false, ending_ = false, hasTask_ = false;
  std::map<uint64_t, Journal> journal_; ///< by the number of the block

  // Of the run's thread, and of the other one while the run waits.
  std::atomic<bool> stopsEngine_ = false;
  uint64_t count_ = 0;   ///< blocks that were come to
  uint64_t goal_ = 0;    ///< the block at which a run that is made again stops; 0: it is the first
  uint64_t scanTo_ = 0;  ///< it is made again up to here to find the breakpoint that was hit last
  uint64_t lastHit_ = 0; ///< its block; 0: none
  std::optional<Breakpoints::Place> goTo_; ///< the block that the run goes on to
  uint64_t goFrom_ = 0;                    ///< number of the block at which it was sent there
  std::vector<Frame> frames_;
  uint32_t passedFrom_ = 0; ///< end of the block before the current one, in its frame
  MachineState last_;       ///< before the block that was come to last
  MachineState *state_ = &last_;
  Go how_ = Go::On;
  size_t depth_ = 0; ///< frames when the run was sent on
  bool isOpen_ = false;
  Truth guard_ = Truth::Yes; ///< of the block that is executed next
  Truth answer_ = Truth::Unknown;
  Outcome peek_; ///< of the block that is executed next
  bool lost_ = false;
  std::set<size_t> told_;       ///< findings, by index
  std::vector<size_t> reached_; ///< those of the block that were not told before
};

} // namespace ncvet::dap
