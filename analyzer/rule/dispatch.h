// Hands the events of a block to the rules that listen for them.
#pragma once

#include "analyzer/program/project.h"
#include "analyzer/rule/collector.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <memory>

namespace ncvet {

/// A block that was executed for one state, as rules are told of it.
struct ToldBlock {
  FileUnit &unit;
  const Block &block;
  const Outcome &outcome;
  const MachineState &before, &after;
  const CallSite *caller;
};

/// The rules of one run, made and subscribed for one dialect.
class Dispatcher {
public:
  Dispatcher(const Dialect &dialect, const MachineProfile &machine, const RuleSelection &selection,
             Collector &collector);

  /// Events of these kinds have listeners.
  uint32_t kinds() const { return kinds_; }
  /// Some rule wants to know of moves that only go on as the block before.
  bool wantsEveryMove() const { return !everyBlock_.empty(); }
  /// `place`: a number for file and offset of a block that is executed again; 0: of others.
  void dispatch(const ToldBlock &told, TextAhead *ahead = nullptr, uint64_t place = 0);
  /// Runs of blocks are recorded, with all that is looked at in them: see `RuleContext::noteUse`.
  void recordUses() { recordsUses_ = context_.notes_ = true; }
  /// Every rule is told of every event that it listens for, whatever it has said of blocks like it.
  void tellInFull() { shapes_.reset(); }
  /// As `dispatch` for at most so many of the first holes of the row, where those who are told of
  /// them take them together; how many it was. `before`: the block before the row.
  size_t dispatchRow(const ToldBlock &before, const HoleRow &row, size_t most);
  /// As `dispatch`, for a plain move that only goes on as the block before: told to those who want
  /// to know of every move, as long as they do. Blocks of one `stretch` differ in numbers only.
  void dispatchMove(const ToldBlock &told, uint64_t stretch);
  /// Whether nobody wants to know of further moves of the stretch.
  bool sleepThrough(uint64_t stretch) const { return stretch == stretch_ && awake_.empty(); }
  /// Whether somebody wants to know of those that lead to where the tool is.
  bool wantsStill() const { return !atStill_.empty(); }
  /// A `FlowIssue` event of its own, outside of what the block itself emitted.
  void flowIssue(FlowIssue issue, const ToldBlock &told, SourceRange where, SourceRange related);
  /// A `CallReturned` event at the call: the state before the call and the one that came back.
  void callReturned(const ToldBlock &told);
  void finish(const FileSummary &summary, FileUnit &unit);
  /// What the rules remember at this moment.
  void remember(RuleMemory &memory) const {
    for (const Rule *rule : rememberers_)
      rule->remember(memory);
  }
  /// The same of those that are told of moves that only go on.
  void rememberMoves(RuleMemory &memory) const {
    for (const auto &[kind, listener] : everyBlock_)
      listener.rule->remember(memory);
  }
  /// The same of those that are told of changes only.
  void rememberChanges(RuleMemory &memory) const {
    for (const Rule *rule : changeRememberers_)
      rule->remember(memory);
  }
  void startGathering() const {
    for (Rule *rule : gatherers_)
      rule->startGathering();
  }
  /// What rules have gathered since then.
  Gatherings gathered() const {
    Gatherings all;
    for (size_t i = 0; i < gatherers_.size(); ++i)
      if (auto gathered = gatherers_[i]->gathered())
        all.emplace_back(i, std::move(gathered));
    return all;
  }
  /// False when a rule would have had something to say.
  bool gather(const Gatherings &all) const {
    return llvm::all_of(
        all, [&](const auto &entry) { return gatherers_[entry.first]->gather(*entry.second); });
  }

private:
  struct Listener {
    Rule *rule;
    RuleId id;
    uint8_t moves = 0xFF; ///< bit per kind of move of which `Motion` events are wanted
    bool wants(const Event &event) const {
      return event.kind != EventKind::Motion || (moves & bitOf(event.motion));
    }
  };
  /// Who is told of a block, and of which event of it.
  struct Awake {
    uint32_t event;
    Listener listener;
  };
  /// What was found out of blocks of one shape in some modes.
  struct KnownModes {
    uint64_t modes = 0; ///< see `modesOf`, or `Outcome::known`; 0: nothing is known
    std::vector<Awake> awake;
    std::vector<Awake> inRow; ///< those of them that are told of every block of a row
    StateUse asleepUse;       ///< what the others looked at
  };
  struct KnownShape {
    uint64_t shape = 0; ///< see `shapeOf`; 0: none
    StateUse use;       ///< what decides in some of the modes who sleeps
    unsigned next = 0;  ///< which of the modes is given up next
    std::array<KnownModes, 4> modes;
  };
  /// Shapes that were met last.
  struct KnownShapes {
    /// A program has some dozens of shapes, and perhaps many more of which no block has the same.
    static constexpr size_t most = 512, places = 4096;
    std::vector<KnownShape> all;
    unsigned next = 0;                  ///< which of them is given up next
    std::array<uint64_t, places> met{}; ///< by place: the shape that was met there last
    std::array<uint16_t, places> at{};  ///< which of `all` it may be
    /// The same by `Outcome::known`, which says shape and modes.
    std::array<KnownModes, 256> again;
  };
  const KnownModes *toldAgain(const Outcome &outcome) const;
  bool tellKnown(uint64_t place, const Outcome &outcome);
  const KnownModes *toldOfRow(const HoleRow &row) const;
  void tellAwake(const KnownModes &modes, const Outcome &outcome);
  KnownShape &knownShape(uint64_t shape);
  void findOut(KnownShape &shape, const Outcome &outcome);
  void tellAll(const Outcome &outcome);
  void tellOne(const Event &event, const Listener &listener);
  RuleSleep sleepsInShape(const Event &event, const Listener &listener);
  void listenToKinds(const Listener &listener, const Subscriptions &subscriptions);
  /// The table has something to say of the `noticed` codes: what names the rule, is said when the
  /// code runs as a cycle, and with `report` when it is active.
  void listenToNotices(RuleId rule, const Dialect &dialect, llvm::ArrayRef<CodeIndex> noticed,
                       bool report);
  void listenToCodes(const Listener &listener, const Subscriptions &subscriptions);
  void reportChanged(const Event &event);
  void wake(const Outcome &outcome);
  void tell(const Outcome &outcome, uint32_t event, llvm::ArrayRef<Listener> listeners);
  void prepare(const ToldBlock &told);

  std::vector<std::unique_ptr<Rule>> rules_;
  std::vector<Listener> all_;
  std::vector<Rule *> gatherers_;
  std::vector<const Rule *> rememberers_;
  std::vector<const Rule *> changeRememberers_; ///< those that are not told of every move
  std::array<std::vector<Listener>, size_t(EventKind::Count)> byKind_;
  std::array<std::vector<Listener>, size_t(MotionKind::Reference) + 1> byMove_; ///< of `Motion`
  std::vector<std::vector<Listener>> byCode_;
  std::vector<std::vector<RuleId>> noticesOf_; ///< by code: rules for which the table has some
  std::vector<std::pair<EventKind, Listener>> everyBlock_; ///< of every move, by kind of event
  std::vector<Awake> awake_;                               ///< of the moves of the stretch
  std::vector<Awake> atStill_;                             ///< of those that lead nowhere
  StateUse asleepUse_; ///< what the others looked at to find that they may sleep
  uint64_t stretch_ = ~uint64_t(0);
  uint32_t kinds_ = 0;
  std::unique_ptr<KnownShapes> shapes_ = std::make_unique<KnownShapes>();
  KnownModes *finding_ = nullptr; ///< of whom it is found out who is told
  bool findingPlace_ = false;     ///< of one block of the text alone
  bool recordsUses_ = false;      ///< see `recordUses`
  RuleContext context_;
};

} // namespace ncvet
