// Runs one region block by block.
#pragma once

#include "analyzer/flow/block_flow.h"
#include "analyzer/flow/known_blocks.h"
#include "analyzer/reuse/run_recorder.h"
#include "analyzer/reuse/run_replay.h"
#include "analyzer/rule/hole_row.h"
#include "interp/execute/make_plain_move.h"

#include <atomic>

namespace ncvet {

/// Who knows runs of blocks that need not be executed again: one of them, or none.
struct KnownRuns {
  RunRecorder *recorder = nullptr; ///< when rules listen
  RunReplay *replay = nullptr;     ///< when only the states are asked for
};

/// One run of a region. Straight-line blocks are read, executed and forgotten; states wait only
/// where flow meets: at targets of jumps, after conditions and skipped blocks.
///
/// Blocks are taken in the order of their place in the text, so that all paths to a block have
/// arrived before it is executed, save those over a backward jump.
class RegionRun {
public:
  RegionRun(FlowRun &run, BlockFlow &flow, const Region &region, Lives entry, KnownRuns known,
            const std::atomic<bool> *cancel);
  ~RegionRun();

  /// The states that leave the region.
  Exits execute();

private:
  bool arrive();
  bool isAtEnd();
  void runOut();
  bool takeOver() { return (recorder_ || replay_) && takeOverRun(); }
  bool takeOverRun();
  bool goOnInStretch();
  bool mayGoOn() const;
  void goOnOnce(Live &live);
  void tellOnce(Live &live);
  bool readOver();
  bool readOne(uint32_t offset) {
    return line_.readAlike(*quick_, offset, unit_.dialect->axisWords, *pattern_);
  }
  bool nobodyIsTold() const;
  void goOnUntold(Live &live);
  bool makeUntold(MachineState &state);
  void tellStill(Live &live);
  void goOnAtOnce(Live &live, uint32_t limit, bool wantStill);
  void goOnRecorded(Live &live);
  /// Whether the block at `at_` is the only one that follows, for one state.
  bool goesStraight() const {
    return lives_.size() == 1 && synced_ == &*lives_[0].state && activation_.pending.next() > at_ &&
           at_ != region_.stopAt && at_ != region_.lastBlock && at_ < region_.program.end &&
           !isSubprogram();
  }
  /// Whether the main program has come to the first block of a part of it that it has called.
  bool isSubprogram() const {
    return !run_.used.localSubprograms.empty() && region_.kind == RegionKind::Main &&
           &unit_ == &run_.unit && run_.used.localSubprograms.count(at_);
  }
  bool isStraight() const;
  bool readsBySpelling();
  uint64_t modesHere() const { return modes_ ^ caller_; }
  bool goOnAsKnown();
  void goOnAsKnownOnce(KnownBlocks::Known &known);
  void goOnInRow(KnownBlocks::Known &first);
  bool isOfRow(const KnownBlocks::Known &known, const MachineState &state) const;
  void makeInRow(KnownBlocks::Known &known);
  void countRow(uint32_t begin, uint64_t made);
  /// Holes that do the same but for their places, and their blocks.
  struct RowKind {
    KnownBlocks::Spelling *spelling;
    uint64_t serial; ///< of the spelling
    KnownBlocks::Known *known;
    std::array<uint8_t, HoleRow::mostAxes> places; ///< by step: index in `HoleRow::axes`
  };
  void beginRow();
  void noteKind(KnownBlocks::Known &known);
  bool addKind(RowKind &kind);
  size_t makeTogether(uint32_t limit, uint64_t most);
  void readRow(uint32_t limit, size_t most);
  void placeRow(size_t made, MachineState &state);
  KnownBlocks::Known *knownHere();
  /// How control leaves a block that was executed before.
  enum class Again : uint8_t { NotKnown, GoesOn, Leaves };
  bool goOnAgain();
  bool mayGoOnAgain() const;
  Again calculateAgain(KeptBlock &kept);
  Again moveAgain(KeptBlock &kept);
  Again flowAgain(KeptBlock &kept);
  bool begin(KeptBlock &kept);
  uint64_t situation(const MachineState &state);
  void calculate(const KnownCalculation &known, const Calculated &gives);
  bool loopBegins() const { return outcome_->flow.kind == FlowKind::LoopBegin; }
  Again stay();
  Again leave();
  void goWhereItSays(Step &step);
  void learnAgain(Live &live);
  void learnCalculation(const MachineState &after, uint64_t situation);
  void learnMove(Live &live, uint64_t situation);
  void learnFlow(const MachineState &after, uint64_t situation);
  uint64_t situationIn(uint64_t modes);
  void endStretch();
  bool mayTakeOver(const RunPlace &known) const;
  void follow(const RunPlace &known);
  bool isCancelled() const { return cancel_ && cancel_->load(std::memory_order_relaxed); }
  bool read();
  void readStraight();
  bool doAsKnown(Live &live);
  void make(KnownBlocks::Known &known, Live &live);
  /// What executing the block looks at, where that is recorded: of a called body it always is.
  void noteUse(const StateUse &use) {
    if (recorder_ || !run_.callStack.empty())
      stateUse |= blockUse_ = use;
  }
  void leaveModes(KnownBlocks::Known &known, const MachineState &state);
  void learn(Live &live);
  /// What is to be noted of every block that was read; false: the analysis was cancelled.
  bool noteRead() {
    const bool goesOn = countSteps(1);
    if (goesOn)
      noteText(block_->next);
    return goesOn;
  }
  /// So many blocks were read; false: the analysis was cancelled.
  bool countSteps(uint64_t blocks) {
    const uint64_t before = std::exchange(run_.steps, run_.steps + blocks);
    return before / cancelInterval == run_.steps / cancelInterval || mayRunOn(before);
  }
  bool mayRunOn(uint64_t before);
  bool fitsIntoMemory();
  /// The text from here to `end` is passed over, or executed.
  void noteText(uint32_t end) {
    refused_ = ~0u;
    if (at_ != activation_.runEnd)
      beginText();
    activation_.runEnd = end;
    firstTime_ = at_ >= activation_.high;
    if (firstTime_)
      activation_.high = end;
  }
  void beginText();
  bool passOver();
  bool passEmptyLines();
  bool spend();
  bool spend(uint64_t work);
  /// Whether blocks that are executed for the first time are those of the main program.
  bool countsOnce() const { return region_.depth() == 0 && region_.kind == RegionKind::Main; }
  uint32_t straightLimit() const;
  void decideSkip();
  void announce();
  void decide();
  void forkAtGuards();
  void executeBlock();
  void executeFor(Live &live);
  void execute(Live &live);
  void keepBefore(const MachineState &state);
  void keepMotion(const MachineState &state);
  void keepOrigins(const MachineState &state);
  void keepVariables(const MachineState &state);
  bool onlyCalculates() const;
  void tell(Live &live);
  void interruptRecord() {
    if (recorder_)
      recorder_->interrupt();
    if (replay_)
      replay_->interrupt();
  }
  void runIntoSubprogram();
  void runsInto(Live &live);
  bool goesOnWithNext(Live &live);
  Step stepOf(Live &live) {
    return {activation_,
            live,
            at_,
            before_,
            *block_,
            *outcome_,
            run_.stretch,
            firstTime_ && run_.callStack.empty() ? known_.get() : nullptr,
            kept_ ? uint64_t(unit_.source.id()) << 32 | at_ : 0};
  }
  /// What a block that is executed for the first time may cost besides without being counted, in
  /// plain moves: a text of blocks that all take as long is still checked in some seconds for each
  /// megabyte.
  static constexpr uint64_t usualWork = 1024;
  /// The cancel flag is looked at once in so many blocks (a power of two).
  static constexpr uint64_t cancelInterval = 256;

  SourceRange blockRange() const { return {unit_.source.id(), block_->begin, block_->end}; }

  FlowRun &run_;
  BlockFlow &flow_;
  const Region &region_;
  FileUnit &unit_;
  const std::atomic<bool> *cancel_;
  const QuickReader *const quick_; ///< the file's reader, where it knows short ways
  Activation activation_;
  RunRecorder *const recorder_;
  RunReplay *const replay_;
  Lives lives_;                ///< that come to the block at `at_`
  uint32_t at_;                ///< the block that is executed next
  uint32_t next_ = 0;          ///< and the one after it in the text
  uint32_t refused_ = ~0u;     ///< the block from which on no run is known to be taken over
  bool firstTime_ = false;     ///< the block was not executed before
  bool goesOn_ = false;        ///< the block only goes on as the one before
  const Block *block_ = &own_; ///< that is executed
  KeptBlock *kept_ = nullptr;  ///< the same, where it was read for an earlier execution
  Block *pattern_ = nullptr;   ///< the same, where another may be read over it
  SpelledLine line_;           ///< of the blocks of a stretch
  Block own_;                  ///< where it is read when the run does not keep it
  Outcome *outcome_ = &ownOutcome_;
  Outcome ownOutcome_;                   ///< of a block of which it is not known
  Truth decision_ = Truth::Unknown;      ///< of the operator, for what the block leaves open
  MachineState before_;                  ///< before the block
  const MachineState *synced_ = nullptr; ///< of which `before_` is a copy, set-up part too
  bool copied_ = false;                  ///< just now, so that it is in step already
  uint64_t waits_ = 0;         ///< serial number of a state that was so before it went to wait
  bool calculated_ = false;    ///< the block before changed nothing but variables
  bool wrote_ = false;         ///< and of these one at most: `written_`
  uint64_t written_ = 0;       ///< key of that variable; 0: none
  Value value_;                ///< and what it was given
  KnownMove::Numbers numbers_; ///< of a move whose words are computed; kept for its storage
  uint64_t caller_ = 0;    ///< a number for how deep the region is called, and whether as a macro
  uint32_t askedAt_ = ~0u; ///< for which block it was found out whether it is `seldom_`
  bool seldom_ = false;    ///< see `ReadBlocks::isSeldom`
  uint64_t callers_ = 0;   ///< a number for the calls that lead here; 0: it is not made out
  PlainRun plainRun_;
  unsigned repeats_ = 0; ///< blocks of the stretch that were told to all although they went on
  StateUse blockUse_;    ///< what executing the block has looked at
  std::optional<ModeMasks> masks_; ///< made when they are first asked for
  std::optional<PlainMove> move_;  ///< of the stretch; nothing: its blocks are executed in full
  uint64_t moveStretch_ = ~uint64_t(0);       ///< for which stretch `move_` was made out
  std::unique_ptr<KnownBlocks> known_;        ///< made when a block is read for the first time
  KnownBlocks::Spelling *spelling_ = nullptr; ///< of the block; null: it is not known
  uint32_t spelled_ = ~0u; ///< the block for which `spelling_` is made out though it is not read
  llvm::SmallVector<RowKind, 4> rowKinds_;
  HoleRow row_;                              ///< of those kinds
  llvm::SmallVector<uint8_t, 4> rowLetters_; ///< of its axes
  size_t rowLength_ = 8;                     ///< how many of them are read before their turn
  unsigned rowsRefused_ = 0;                 ///< one after the other that nobody took together
  uint32_t rowEnd_ = ~0u;                    ///< the same, of one that ends a row of holes
  const KnownBlocks::Known *done_ = nullptr; ///< what the last block did; null: it was executed
  uint64_t modes_ = 0; ///< of the state, see `modesNumber`; 0: they are not made out
};

} // namespace ncvet
