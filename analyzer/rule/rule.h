// The interface of rules: what they may listen to, what they may look at, how they report.
#pragma once

#include "analyzer/program/call_site.h"
#include "analyzer/program/program_index.h"
#include "analyzer/rule/known_arcs.h"
#include "analyzer/rule/rule_memory.h"
#include "analyzer/rule/rule_table.h"
#include "formats/finding/finding.h"
#include "formats/text/formatted.h"
#include "interp/evaluate/condition.h"
#include "interp/execute/execute.h"
#include "interp/path/arc_block.h"
#include "interp/state/event.h"
#include "interp/state/modes.h"

#include "llvm/ADT/STLExtras.h"
#include "llvm/ADT/StringMap.h"

#include <functional>
#include <memory>

namespace ncvet {

class Collector;
class RuleContext;
struct HoleRow;
class TextAhead;
struct FileUnit;

/// Fills in a finding; false when nobody will see it, so that nothing is formatted in vain:
///
///     if (auto finding = ctx.report(word))
///       finding.message("`{0}` …", ctx.text(word)).note(range, "…");
class FindingBuilder {
public:
  FindingBuilder() = default;
  explicit FindingBuilder(Finding *finding) : finding_(finding) {}
  explicit operator bool() const { return finding_; }

  /// Message in the form of `formatted`: what is, then what the control does with it; lower case,
  /// no final period, code in backticks.
  template <typename... Values>
  FindingBuilder &message(const char *form, const Values &...values) {
    if (finding_)
      finding_->message = formatted(form, values...);
    return *this;
  }
  FindingBuilder &text(std::string message) {
    if (finding_)
      finding_->message = std::move(message);
    return *this;
  }
  /// Severity of this finding where the table or this case has another than the rule.
  FindingBuilder &severity(std::optional<Severity> severity) {
    if (finding_ && severity)
      finding_->severity = *severity;
    return *this;
  }
  FindingBuilder &note(const Origin &origin, std::string message) {
    if (finding_ && origin.known())
      finding_->notes.push_back({origin.range(), std::move(message)});
    return *this;
  }
  FindingBuilder &note(SourceRange range, std::string message) {
    if (finding_)
      finding_->notes.push_back({range, std::move(message)});
    return *this;
  }
  FindingBuilder &fix(FixSafety safety, std::string description, TextEdit edit) {
    if (finding_) {
      finding_->fix.emplace();
      finding_->fix->safety = safety;
      finding_->fix->description = std::move(description);
      finding_->fix->edits.push_back(std::move(edit));
    }
    return *this;
  }
  /// A further edit of the fix given before.
  FindingBuilder &edit(TextEdit edit) {
    if (finding_ && finding_->fix)
      finding_->fix->edits.push_back(std::move(edit));
    return *this;
  }

private:
  Finding *finding_ = nullptr;
};

/// The codes of a control, found once for all rules that ask for them.
struct SortedCodes {
  explicit SortedCodes(const Dialect &dialect);

  std::vector<std::vector<CodeIndex>> byAction;
  llvm::StringMap<llvm::SmallVector<CodeIndex, 4>> byNotice; ///< by rule: those with notices for it
};

/// What a rule subscribes to. Compiled into one table per run: a block in which nothing happens
/// that anybody listens for costs one bit test.
class Subscriptions {
public:
  Subscriptions(const Dialect &dialect, const MachineProfile &machine, const RuleOverride *options,
                const SortedCodes &sorted)
      : dialect_(dialect), machine_(machine), options_(options), sorted_(sorted) {}

  const Dialect &dialect() const { return dialect_; }
  const MachineProfile &machine() const { return machine_; }
  void on(EventKind kind) {
    kinds_ |= bitOf(kind);
    everyBlock_ |= bitOf(kind);
  }
  void on(std::initializer_list<EventKind> kinds) {
    for (const EventKind kind : kinds)
      on(kind);
  }
  /// As `on`, but not in blocks that only go on as the block before: plain words for the same axes,
  /// in the same modes, with the same facts known. For rules that no coordinate interests.
  void onChange(std::initializer_list<EventKind> kinds) {
    for (const EventKind kind : kinds)
      kinds_ |= bitOf(kind);
  }
  /// `Motion` events of these kinds of moves only.
  void onMoves(std::initializer_list<MotionKind> moves) {
    on(EventKind::Motion);
    moves_ = 0;
    for (const MotionKind move : moves)
      moves_ |= bitOf(move);
  }
  /// `Code` events of the codes for which `wanted` is true (variants are codes of their own).
  void onCode(llvm::function_ref<bool(const CodeInfo &)> wanted) {
    for (size_t i = 0; i < dialect_.codes.size(); ++i)
      if (wanted(dialect_.codes[i]))
        codes_.push_back(CodeIndex(i));
  }
  void onAction(std::initializer_list<Action> actions);
  /// `Code` events of the codes that have notices for rule `id`.
  void onNotices(llvm::StringRef id);
  /// The rule reports its notices itself; without this they are reported for it.
  void handleNotices() { noticesHandled_ = true; }
  bool noticesHandled() const { return noticesHandled_; }
  // Options of the rule: what the user says, else the dialect, else `fallback`.
  double number(llvm::StringRef name, double fallback) const;
  bool flag(llvm::StringRef name, bool fallback = false) const;
  /// Index of the name that is chosen; in old files the index itself.
  unsigned choice(llvm::StringRef name, llvm::ArrayRef<llvm::StringLiteral> names,
                  unsigned fallback) const;

  /// See `Rule::gathered`.
  void gathers() { gathers_ = true; }
  bool isGathering() const { return gathers_; }

  uint32_t kinds() const { return kinds_; }
  /// Those of `kinds` that are wanted of every block.
  uint32_t everyBlock() const { return everyBlock_; }
  /// Bit per kind of move of which `Motion` events are wanted.
  uint8_t moves() const { return moves_; }
  llvm::ArrayRef<CodeIndex> codes() const { return codes_; }

private:
  const OptionValue *option(llvm::StringRef name) const;

  const Dialect &dialect_;
  const MachineProfile &machine_;
  const RuleOverride *options_;
  const SortedCodes &sorted_;
  uint32_t kinds_ = 0;
  uint32_t everyBlock_ = 0;
  uint8_t moves_ = 0xFF;
  bool noticesHandled_ = false;
  bool gathers_ = false;
  std::vector<CodeIndex> codes_;
};

/// What a rule may look at and how it reports. Valid during one call.
class RuleContext {
public:
  RuleContext(Collector &collector) : collector_(collector) {}

  const Dialect &dialect() const { return *dialect_; }
  const MachineProfile &machine() const { return *machine_; }
  const SourceFile &source() const { return *source_; }
  const FileIndex &index() const { return *index_; }
  /// The file of the current block, and any other of which something is known here: the state may
  /// come from a caller or from a called program.
  FileUnit &unit() const { return *unit_; }
  FileUnit &unitOf(FileId file) const;
  const FileIndex &indexOf(FileId file) const;
  const Block &block() const { return *block_; }
  llvm::ArrayRef<CodeUse> codes() const { return outcome_->codes; }
  /// Word of this block that names the event's code; null: the code runs on from an earlier block.
  const Word *codeWord(const Event &event) const {
    const auto *use =
        llvm::find_if(codes(), [&](const CodeUse &u) { return u.code == event.code; });
    return use == codes().end() ? nullptr : use->word;
  }
  const Outcome &outcome() const { return *outcome_; }
  /// State on entry of the block, and after it.
  const MachineState &before() const { return *before_; }
  const MachineState &after() const { return *after_; }
  /// The words of the arc that the block makes, and the geometry that they give; made out once for
  /// all rules.
  const ArcWords &arcWords() const;
  const ArcGeometry &arc() const;
  /// Number of calls between the main program and this block.
  unsigned callDepth() const { return caller_ ? caller_->depth : 0; }
  /// Where the program of this block was called; null: by nothing that is known.
  const CallSite *caller() const { return caller_; }
  /// Where the flow that a `FlowIssue` event speaks of is written; a further place that explains
  /// it.
  SourceRange flowRange() const { return flowRange_; }
  SourceRange flowRelated() const { return flowRelated_; }
  /// For conditions of the table.
  ConditionContext conditions() const {
    return {*dialect_, *machine_, *block_, outcome_->codes, *before_};
  }

  const CodeInfo &code(const Event &event) const { return dialect_->codes[event.code]; }
  const CodeInfo &code(const CodeUse &use) const { return dialect_->codes[use.code]; }
  /// The next block of the text where the run knows it already: plain words alone, spelled as a
  /// block before it. Null: whoever wants to know it reads it. Valid while the rule is told. Who
  /// lets it decide says so by `index().noteRead`.
  const Block *nextAlike() const;
  /// What was looked at when something was found out that is only taken now. Without anybody who
  /// records runs it is of interest while it is found out who sleeps alone.
  void noteUse(const StateUse &use) const {
    if (notes_)
      stateUse |= use;
  }

  /// Value of a word as written (before units), on the state before the block.
  Interval value(const Word &word) const { return wordValue(word, *block_, *before_); }
  /// First code of the block with one of these actions, or null.
  const CodeUse *find(std::initializer_list<Action> actions) const;
  /// Codes of the block as written: the spelling of a word, a range, a code's word.
  llvm::StringRef text(const Word &word) const {
    return source_->text(word.offset, block_->endOf(word));
  }
  /// Of any file.
  llvm::StringRef text(SourceRange range) const;

  SourceRange range(const Word &word) const {
    return {source_->id(), word.offset, block_->endOf(word)};
  }
  /// Of an item, an argument, an expression: all that says where it is written.
  template <typename T>
  requires requires(const T &written) { written.begin + written.end; }
  SourceRange range(const T &written) const { return {source_->id(), written.begin, written.end}; }
  /// The block's words, without leading blanks, number and trailing comment or blanks.
  SourceRange blockRange() const;

  /// `certain` false: the rule is broken on some of the paths that the state represents.
  FindingBuilder report(SourceRange range, bool certain = true);
  FindingBuilder report(const Word &word, bool certain = true) {
    return report(range(word), certain);
  }
  FindingBuilder report(const Event &event, bool certain = true) {
    return event.word ? report(*event.word, certain) : report(blockRange(), certain);
  }
  /// Whether the user selected the rule at work: its advice is wanted too.
  bool asked() const;
  /// Reports every notice of `code` for rule `id` whose condition holds.
  void reportNotices(llvm::StringRef id, const Event &event);

  // Edits for fixes.
  TextEdit replace(SourceRange range, llvm::StringRef text) const { return {range, text.str()}; }
  /// Removes the word and the blanks before it.
  TextEdit remove(const Word &word) const;
  /// A new line before the block, with the block's own line end.
  TextEdit insertBlockBefore(llvm::StringRef text) const;
  TextEdit insertBlockAfter(llvm::StringRef text) const;
  TextEdit insertBefore(uint32_t offset, llvm::StringRef text) const {
    return {{source_->id(), offset, offset}, text.str()};
  }

private:
  friend class Dispatcher;
  friend class Engine;
  /// In a block with the code, the control's manual has what the rule finds as another one's.
  struct ToldAt {
    RuleId rule;
    std::string code; ///< empty: in blocks with none of the codes
    RuleId as;
    bool wanted; ///< the user has not left it out
  };
  /// Another rule is told: what it looks at is noted anew.
  void startNotes() { arcWordsNoted_ = false; }
  /// Whether the block has the code, or without any moves by it; always when `name` is empty.
  bool isAt(llvm::StringRef name) const;
  /// The rule under whose name what is found in this block is told; none: it is not wanted.
  std::optional<RuleId> toldRule() const;

  Collector &collector_;
  RuleId rule_ = 0;
  std::vector<ToldAt> toldAt_;
  const Dialect *dialect_ = nullptr;
  const MachineProfile *machine_ = nullptr;
  FileUnit *unit_ = nullptr;
  const SourceFile *source_ = nullptr;
  const FileIndex *index_ = nullptr;
  const Block *block_ = nullptr;
  const Outcome *outcome_ = nullptr;
  const MachineState *before_ = nullptr;
  const MachineState *after_ = nullptr;
  const CallSite *caller_ = nullptr;
  TextAhead *ahead_ = nullptr;
  bool notes_ = false; ///< see `noteUse`
  mutable std::optional<ArcWords> arcWords_;
  mutable std::optional<ArcGeometry> arc_;
  mutable bool arcWordsNoted_ = false;          ///< what they depend on, since `startNotes`
  mutable const FileUnit *centresOf_ = nullptr; ///< for whose control and machine these are:
  mutable ArcCentres centres_ = ArcCentres::Incremental;
  mutable std::unique_ptr<KnownArcs> knownArcs_; ///< made when an arc is asked for
  SourceRange flowRange_, flowRelated_;
};

/// What is known of a file when all of its programs have been followed.
struct FileSummary {
  const FileIndex &index;
  const SourceFile &source;
  const Reader &reader;
  /// Byte ranges of blocks that were executed on some path, ascending, joined where they touch.
  llvm::ArrayRef<SourceRange> reached;
  /// Block numbers that a jump, call, return or profile of this file named, ascending.
  llvm::ArrayRef<int64_t> usedNumbers;
  /// Program numbers called from the analysed files, ascending.
  llvm::ArrayRef<int64_t> calledPrograms;
  /// Keys of the labels that a jump or repeat of this file named, ascending.
  llvm::ArrayRef<std::string> usedLabels;
  bool complete =
      true; ///< false: the analysis was cut short, what was not reached may be reachable
  bool anyNumberUsed = false; ///< a local call computes the number to which it leads

  bool isReached(uint32_t offset) const;
  /// Where the number of the block is that begins at `offset`.
  SourceRange numberAt(uint32_t offset) const;
  /// Whether any of [begin, end) is.
  bool isAnyReached(uint32_t begin, uint32_t end) const;
};

/// What a rule has gathered in a stretch of blocks.
class Gathered {
public:
  virtual ~Gathered() = default;
  /// The text before it has changed.
  virtual void move(const TextChange &change) = 0;
};

/// By which of the rules that gather.
using Gatherings = std::vector<std::pair<size_t, std::shared_ptr<Gathered>>>;

/// A rule. One object per analysed file; what it is made of in `listen` stays. A rule that
/// remembers something of the blocks that it has seen is a `StatefulRule`; the flow of the program
/// is the machine state's job.
class Rule {
public:
  virtual ~Rule() = default;
  virtual void listen(Subscriptions &to) = 0;
  virtual void on(const Event &, RuleContext &) const {}
  /// As `on` for each of at most so many of the first holes of the row, after which `ctx` has the
  /// state that comes before them; how many it was: of the others it is told one by one.
  virtual size_t onRow(const HoleRow &, size_t /*most*/, RuleContext &) const { return 0; }
  /// Called once, when all flow is known; only findings that the whole file decides.
  virtual void finish(const FileSummary &, RuleContext &) const {}

  // Of a `StatefulRule`, which makes these of its memory.
  virtual void remember(RuleMemory &memory) const { memory.leaveOut(); }
  /// Of a `GatheringRule` that has said so in `listen`: forgets what was gathered since the last
  /// call, gives it, and takes it for its own as if the blocks had been executed; false when the
  /// rule would have had something to say.
  virtual void startGathering() {}
  virtual std::shared_ptr<Gathered> gathered() const { return nullptr; }
  virtual bool gather(const Gathered &) { return true; }
};

/// A rule that remembers something of the blocks that it has seen. All that `on` may change is
/// `memory()`, a struct of which every member counts: how it is compared and how it moves with the
/// text follows from their types. A member of the rule itself cannot be changed, and a type that
/// cannot be compared does not compile.
template <typename State, typename Base = Rule>
class StatefulRule : public Base {
public:
  using Base::Base;
  void remember(RuleMemory &memory) const final { memory(memory_); }

protected:
  using Memory = State;
  Memory &memory() const { return memory_; }

private:
  mutable Memory memory_;
};

/// Ends a rule's file: defines the factory that the generated table names. (Without `make_unique`:
/// a pointer type for each rule is compiled for a second of each batch.)
// NOLINTBEGIN(bugprone-macro-parentheses): the name of a type
#define NCVET_RULE(Class, function)                                                                \
  std::unique_ptr<Rule> make_##function() { return std::unique_ptr<Rule>(new Class); }
// NOLINTEND(bugprone-macro-parentheses)

} // namespace ncvet
