// An offset number that is not the tool's own.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/wanted_blocks.h"
#include "analyzer/rule/text_answers.h"
#include "formats/dialect/control_facts.h"

#include <set>

namespace ncvet {
namespace {

struct ToolOffsetMismatchMemory {
  bool read = false;
  std::set<int64_t> tools;  ///< numbers of the T words of the file
  std::set<int64_t> keep;   ///< tools of the file with an H of their own number
  std::set<int64_t> others; ///< tools of the file with an H of another number
  SourceRange waits;        ///< an edge that is programmed while its tool waits for its change
};

class ToolOffsetMismatch final : public StatefulRule<ToolOffsetMismatchMemory> {
public:
  void listen(Subscriptions &to) override {
    onlyOtherTools_ = to.flag("onlyOtherTools");
    ownStep_ = int64_t(to.number("ownStep", 0));
    radiusOfTool_ = to.flag("radiusOfTool");
    if (to.dialect().isLathe())
      to.on(EventKind::ToolWord);
    else
      to.on(EventKind::OffsetWord);
    if (!to.dialect().isLathe() && !to.dialect().facts->tools.cuttingEdges &&
        !to.dialect().zeros.systems)
      to.onAction({Action::CompensationLeft, Action::CompensationRight, Action::LengthNegative});
    edges_ = to.dialect().facts->tools.cuttingEdges && !to.dialect().toolChangeByT;
    if (edges_) {
      to.on({EventKind::ToolChange, EventKind::ToolWord});
      to.onChange({EventKind::Motion});
    }
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (edges_)
      return edge(event, ctx);
    if (event.kind == EventKind::Code && ctx.code(event).action == Action::LengthNegative)
      return subtracted(event, ctx);
    if (event.kind == EventKind::Code)
      return radiusOfOther(event, ctx);
    const MachineState &state = ctx.after();
    const Word &word = *event.word;
    if (event.kind == EventKind::ToolWord)
      return station(event, ctx);
    if (ctx.before().switches.areOn(ctx.dialect().dataSwitches)) // what is in the block are data
      return;
    if (ctx.dialect().offsetsOfTool && word.address != letterAddress('H') && isOfEdge(event, ctx))
      return;
    // An offset that is added is another one by its nature.
    if (ctx.find({Action::LengthAdd}))
      return;
    const int32_t tool = state.tool != notSet ? state.tool : state.preselected;
    if (!event.offset().isConstant() || tool <= 0 || event.offset().value() == 0 ||
        event.offset().value() == tool ||
        (onlyOtherTools_ && !isTool(int64_t(event.offset().value()), ctx) &&
         !breaksHabit(word, ctx)))
      return;
    if (auto finding = ctx.report(word)) {
      if (isLengthOfOther(word, int64_t(event.offset().value()), ctx) || isSlip(word, ctx))
        finding.severity(Severity::Warning);
      if (isOfWaiting(event, ctx)) {
        finding.severity(Severity::Warning)
            .message("`{0}` is the offset of T{1}, which still waits for its change: tool {2} is "
                     "in the spindle",
                     ctx.text(word), int(state.preselected), tool)
            .note(state.origin.of(StatePart::Preselected), "the tool is named here");
        return;
      }
      finding
          .message("`{0}` is not the offset of tool {1}: it runs with another tool's data",
                   ctx.text(word), tool)
          .note(state.origin.of(StatePart::Tool), "the tool is called here");
      if (word.isNumber())
        finding.fix(FixSafety::Unsafe, "use the tool's own number",
                    ctx.replace({ctx.source().id(), word.offset + 1, ctx.block().endOf(word)},
                                std::to_string(tool)));
    }
  }

private:
  /// `G44 H2` where all other tools have G43.
  void subtracted(const Event &event, RuleContext &ctx) const {
    const uint32_t program = ctx.index().programAt(ctx.block().begin).begin;
    const bool only = subtracts_.of({ctx.source().id(), program}, [&] {
      std::set<int64_t> plus, minus;
      for (const Block &block :
           blocksNaming(ctx.index(), ctx.index().programAt(program), ctx.dialect(),
                        {Action::LengthPositive, Action::LengthNegative})) {
        const CodeInfo *const code =
            findCode(ctx.dialect(), block, {Action::LengthPositive, Action::LengthNegative});
        const Word *const number = block.find(letterAddress('H'));
        if (code)
          (code->action == Action::LengthPositive ? plus : minus)
              .insert(number && number->isNumber() ? int64_t(number->value()) : -1);
      }
      return minus.size() == 1 && plus.size() >= 2 && !plus.count(*minus.begin());
    });
    if (!only)
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding.severity(Severity::Warning)
          .message("`{0}` subtracts the length of the tool, which the program adds for the others: "
                   "the tool goes too deep by twice its length",
                   ctx.text(*event.word));
  }

  /// By file and program: one block subtracts a length, and others add theirs.
  TextAnswers<std::pair<FileId, uint32_t>, bool> subtracts_;

  /// `T0305` on a lathe: station and offset.
  void station(const Event &event, RuleContext &ctx) const {
    const Word &word = *event.word;
    if (!event.toolNumber().isConstant() || event.toolNumber().value() < 100)
      return;
    const auto whole = int64_t(event.toolNumber().value());
    const int64_t tool = whole / 100, offset = whole % 100;
    if (tool == offset || offset == 0 || tool > 99 ||
        (ownStep_ > 0 && (offset - tool) % ownStep_ == 0))
      return;
    const bool slip =
        slips_.of({ctx.source().id(), whole}, [&] { return isOnlySlip(tool, offset, ctx); });
    if (onlyOtherTools_ && !slip)
      return;
    if (auto finding = ctx.report(word)) {
      if (slip)
        finding.severity(Severity::Warning);
      finding.message("`{0}` calls tool {1} with offset {2}: it runs with another tool's data",
                      ctx.text(word), tool, offset);
      if (word.isNumber())
        finding.fix(FixSafety::Unsafe, "use the tool's own offset",
                    ctx.replace(ctx.range(word), formatted("T{0:d2}{0:d2}", tool)));
    }
  }

  bool radiusOfTool_ = false; ///< a D names a tool of the table, as an H does

  /// A tool's own edges are numbered from 1. Where a D names a tool of the table, as an H does,
  /// that of a compensation counts when it is the number of a tool of the file.
  bool isOfEdge(const Event &event, const RuleContext &ctx) const {
    return !radiusOfTool_ || !event.offset().isConstant() ||
           !isTool(int64_t(event.offset().value()), ctx) ||
           llvm::none_of(ctx.codes(), [&](const CodeUse &use) {
             return addressesOf(ctx.code(use), Role::Offset) & maskOf(event.word->address);
           });
  }

  /// `G41 X5.` without a D: the number that is in force was given for the tool before.
  static void radiusOfOther(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before(), &after = ctx.after();
    const Origin &given = after.origin.of(StatePart::RadiusOffset);
    const Origin &tool = after.origin.of(StatePart::Tool);
    if (ctx.block().has(letterAddress('D')) || after.radiusOffset <= 0 || after.tool <= 0 ||
        after.radiusOffset == after.tool || before.may(Fact::UnknownCode) || !given.known() ||
        !tool.known() || given.file != tool.file || given.begin >= tool.begin)
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` works with D{1}, which was given for another tool: tool {2} has none of "
                   "its own",
                   ctx.text(*event.word), int(after.radiusOffset), int(after.tool))
          .note(given, "the number is given here")
          .note(tool, "the tool is changed here");
  }

  /// The length of a tool that was named and not changed in.
  static bool isOfWaiting(const Event &event, const RuleContext &ctx) {
    const MachineState &state = ctx.after();
    return event.word->address == letterAddress('H') && state.tool > 0 && state.preselected > 0 &&
           event.offset().value() == state.preselected && !state.may(Fact::UnknownCode);
  }

  bool edges_ = false; ///< a tool comes with edges, of which its change takes the first

  /// `T2`, `D2`, `M6`: the change takes the first edge again.
  void edge(const Event &event, RuleContext &ctx) const {
    if (event.kind != EventKind::OffsetWord && event.kind != EventKind::ToolChange) {
      memory().waits = {};
      return;
    }
    if (event.kind == EventKind::OffsetWord) {
      const bool further = event.offset().isConstant() && event.offset().value() > 1;
      if (event.word->address != letterAddress('D') || ctx.find({Action::ToolChange}))
        return;
      memory().waits =
          further && ctx.after().preselected != notSet ? ctx.range(*event.word) : SourceRange();
      return;
    }
    const SourceRange waits = std::exchange(memory().waits, {});
    if (waits.empty() || ctx.block().has(letterAddress('D')) || givesEdge(ctx))
      return;
    if (auto finding = ctx.report(waits))
      finding.severity(Severity::Warning)
          .message("`{0}` comes before the change of its tool, which takes edge 1 again",
                   ctx.text(waits))
          .note(ctx.blockRange(), "the tool is changed here");
  }

  /// Whether the program gives the edge anew before it moves.
  static bool givesEdge(const RuleContext &ctx) {
    constexpr unsigned furthest = 8; // blocks
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < furthest && ahead.next(next); ++i) {
      if (next.has(letterAddress('D')))
        return true;
      if (next.hasAny(ctx.dialect().axisWords))
        return false;
    }
    return true; // the text does not tell
  }

  /// Whether a T word of the file has the number.
  bool isTool(int64_t number, const RuleContext &ctx) const {
    return numbersOfFile(ctx).tools.count(number) != 0;
  }

  /// `T0305` where at least three other stations have the offsets of their own numbers, this one
  /// never has, and no other has another.
  static bool isOnlySlip(int64_t tool, int64_t offset, const RuleContext &ctx) {
    constexpr size_t habit = 3; // stations
    std::set<int64_t> own;
    for (const ProgramInfo &program : ctx.index().programs())
      for (const Block &block : blocksWith(ctx.index(), program, maskOf(letterAddress('T')))) {
        const Word *const word = block.find(letterAddress('T'));
        if (!word || !word->isNumber() || word->value() < 100 || word->value() > 9999)
          continue;
        const auto whole = int64_t(word->value());
        if (whole % 100 == 0)
          continue;
        if (whole / 100 == whole % 100)
          own.insert(whole % 100);
        else if (whole / 100 != tool || whole % 100 != offset)
          return false;
      }
    return own.size() >= habit && !own.count(tool);
  }

  /// The tool of that number has the length for itself, and all others have their own.
  bool isLengthOfOther(const Word &word, int64_t number, const RuleContext &ctx) const {
    if (word.address != letterAddress('H'))
      return false;
    const Memory &known = numbersOfFile(ctx);
    return known.keep.count(number) && known.others.size() == 1;
  }

  /// The lengths of at least three others are their own, and a second length of this tool it is
  /// not.
  bool isSlip(const Word &word, const RuleContext &ctx) const {
    constexpr size_t sure = 3; // tools
    constexpr int64_t ten = 10;
    if (word.address != letterAddress('H') || !word.isNumber())
      return false;
    const Memory &known = numbersOfFile(ctx);
    return known.others.size() == 1 && known.keep.size() >= sure &&
           !known.keep.count(*known.others.begin()) &&
           (int64_t(word.value()) - *known.others.begin()) % ten != 0;
  }

  /// The lengths of all other tools of the file, two at least, have the numbers of their tools:
  /// what is a shop's scheme elsewhere is a slip here. A second length of a tool often lies tens
  /// above its first one.
  bool breaksHabit(const Word &word, const RuleContext &ctx) const {
    constexpr size_t habit = 2, sure = 3; // tools
    constexpr int64_t ten = 10;
    if (word.address != letterAddress('H'))
      return false;
    const Memory &known = numbersOfFile(ctx);
    return known.others.size() == 1 &&
           (known.keep.size() >= sure ||
            (known.keep.size() >= habit && (int64_t(word.value()) - *known.others.begin()) % ten));
  }

  /// The numbers of T and H, by a look at the whole file, once.
  const Memory &numbersOfFile(const RuleContext &ctx) const {
    Memory &known = memory();
    if (std::exchange(known.read, true))
      return known;
    for (const ProgramInfo &program : ctx.index().programs()) {
      int64_t inUse = 0;
      constexpr AddressMask wanted = maskOf(letterAddress('T')) | maskOf(letterAddress('H'));
      for (const Block &block : blocksWith(ctx.index(), program, wanted)) {
        if (const Word *tool = block.find(letterAddress('T')); tool && tool->isNumber()) {
          inUse = int64_t(tool->value());
          known.tools.insert(inUse);
        }
        const Word *length = block.find(letterAddress('H'));
        if (inUse > 0 && length && length->isNumber() && length->value() != 0)
          (int64_t(length->value()) == inUse ? known.keep : known.others).insert(inUse);
      }
    }
    return known;
  }

  /// By file and T word: it is the only one that is not of its own tool.
  TextAnswers<std::pair<FileId, int64_t>, bool> slips_;
  bool onlyOtherTools_ = false; ///< numbers that no tool of the file has are a shop's scheme
  int64_t ownStep_ = 0;         ///< offsets of one tool lie so far apart; 0: a tool has one
};

} // namespace
NCVET_RULE(ToolOffsetMismatch, tool_offset_mismatch)
} // namespace ncvet
