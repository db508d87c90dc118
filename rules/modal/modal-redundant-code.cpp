// Codes and words that change nothing: a code that switches off what is off already, a feed in a
// rapid block, an increment under incremental dimensions, a block that holds nothing.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"

#include <map>
#include <set>

namespace ncvet {
namespace {

struct ModalRedundantCodeMemory {
  bool acts = false; ///< the program gives numbers to things that another word ends
};

class ModalRedundantCode final : public StatefulRule<ModalRedundantCodeMemory> {
public:
  void listen(Subscriptions &to) override {
    for (const CodeInfo &code : to.dialect().codes)
      if (isNumbered(code))
        ends_.push_back(code.opposite);
    to.onCode([&](const CodeInfo &code) { return isNumbered(code) || endsNumbered(code.base); });
    wanted_ = to.flag("wanted");
    neverCalled_ = to.flag("cycleOff");
    firstToo_ = to.flag("firstToo");
    if (to.flag("macroOff"))
      to.onAction({Action::MacroCancel});
    if (wanted_)
      to.onAction({Action::CompensationOff});
    if (wanted_ || neverCalled_)
      to.onAction({Action::CycleCancel});
    if (to.flag("emptyBlocks"))
      to.on(EventKind::Block);
    // Controls with words that are distances by themselves.
    if (wanted_ && to.dialect().incrementWords)
      to.onMoves({MotionKind::Rapid, MotionKind::Feed, MotionKind::ArcCw, MotionKind::ArcCcw});
    rapidFeed_ = to.flag("rapidFeed");
    if (rapidFeed_)
      to.onMoves({MotionKind::Rapid});
    to.onNotices(id);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Block)
      return emptyBlock(ctx);
    if (event.kind == EventKind::Motion) {
      if (rapidFeed_ && event.motion == MotionKind::Rapid)
        feedOfRapid(event, ctx);
      return increment(ctx);
    }
    ctx.reportNotices(id, event);
    if (isNumbered(ctx.code(event)) || endsNumbered(event.code)) {
      memory().acts = true;
      return;
    }
    const Action action = ctx.code(event).action;
    if (action == Action::MacroCancel)
      return macroOff(event, ctx);
    if (action == Action::CycleCancel) {
      if (wanted_)
        cycleOffAgain(event, ctx);
      if (neverCalled_)
        cycleOff(event, ctx);
    } else if (action == Action::CompensationOff && wanted_) {
      compensationOff(event, ctx);
    }
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (memory().acts)
      for (const ProgramInfo &program : file.index.programs())
        numbers(program, file, ctx);
  }

private:
  static constexpr llvm::StringLiteral id{"modal-redundant-code"};

  /// `ID=1 ...`: it stays on under its number until another word ends that.
  static bool isNumbered(const CodeInfo &code) {
    return !code.letter && code.opposite != noCode && code.words.size() == 1 &&
           code.words.front().position == 1 && code.words.front().range.integer;
  }
  bool endsNumbered(CodeIndex code) const { return llvm::is_contained(ends_, code); }

  /// Numbers that are given twice in a row of blocks which nothing enters or leaves, and such as
  /// are ended and were never given.
  void numbers(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) const {
    std::map<int64_t, SourceRange> on;
    std::set<int64_t> given;
    std::vector<std::pair<int64_t, SourceRange>> ended;
    bool calls = program.kind == ProgramKind::Subprogram;
    for (const Block &block : blocks(file.reader, program.body, program.end)) {
      if (block.hasLabel() || block.skip >= 0 || leads(block))
        on.clear(); // another path may lead here, or past here
      for (const Item &item : block.items) {
        calls |= item.kind == ItemKind::Call;
        if (item.kind != ItemKind::Instruction)
          continue;
        const SourceRange range{file.source.id(), item.begin, item.end};
        const CodeIndex code =
            ctx.dialect().keyword(file.source.text(item.nameBegin, item.nameEnd));
        if (code == noCode)
          continue;
        const CodeInfo &info = ctx.dialect().codes[code];
        if (isNumbered(info)) {
          const auto number = numberOf(block, item, 0);
          if (!number) {
            calls = true; // it may be any
            continue;
          }
          given.insert(*number);
          const auto [known, fresh] = on.try_emplace(*number, range);
          if (fresh)
            continue;
          if (auto finding = ctx.report(range))
            finding.severity(Severity::Warning)
                .message("`{0}` takes the place of the action with the same number",
                         ctx.text(range))
                .note(known->second, "the first one");
          known->second = range;
        } else if (endsNumbered(code)) {
          if (!item.arguments)
            on.clear();
          for (size_t i = 0; i < item.arguments; ++i) {
            const auto number = numberOf(block, item, i);
            if (!number)
              on.clear();
            else if (on.erase(*number) == 0)
              ended.emplace_back(*number, range);
          }
        }
      }
    }
    if (calls)
      return;
    for (const auto &[number, range] : ended)
      if (!given.count(number))
        if (auto finding = ctx.report(range))
          finding.message("`{0}`: nothing has the number {1} in this program", ctx.text(range),
                          number);
  }

  static bool leads(const Block &block) {
    return llvm::any_of(block.items, [](const Item &item) {
      return item.kind == ItemKind::Jump || item.kind == ItemKind::Structure ||
             item.kind == ItemKind::Call || item.kind == ItemKind::Repeat ||
             item.kind == ItemKind::If;
    });
  }

  static std::optional<int64_t> numberOf(const Block &block, const Item &item, size_t place) {
    const Argument &argument = block.argumentsOf(item)[place];
    const auto number = block.numberIn(argument.expression);
    if (argument.kind != ArgumentKind::Expression || !number)
      return std::nullopt;
    return int64_t(*number);
  }

  /// A line of several modes, which states them all whatever they are.
  static bool isSafeLine(const RuleContext &ctx) { return ctx.codes().size() > 2; }

  void compensationOff(const Event &event, RuleContext &ctx) const {
    const MachineState &before = ctx.before();
    const CodeInfo &code = ctx.code(event);
    // The first one, and one at the head of a tool's section, makes the state certain.
    if (before.compensation != phaseOff || before.may(Fact::UnknownCode) || code.group == noGroup ||
        before.group(code.group) != (uint64_t(1) << code.bit) || isSafeLine(ctx))
      return;
    const bool usual =
        before.must(Fact::Cut) && before.must(Fact::CutSinceTool) && before.isStated(code.group);
    // Whoever asks for it hears of each one after a move of the same tool.
    if (!usual &&
        !(firstToo_ && ctx.asked() && ctx.callDepth() == 0 && before.must(Fact::MovedSinceTool)))
      return;
    if (otherWayLeadsHere(before.origin.ofGroup(code.group), ctx))
      return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}`: compensation is off already", code.name)
          .note(before.origin.ofGroup(code.group), "since here");
  }

  /// Whether the code that has switched it off may be left out: by the block skip, or by a jump to
  /// a block after it. What is redundant after it is then needed on the other path.
  static bool otherWayLeadsHere(const Origin &off, RuleContext &ctx) {
    constexpr unsigned lookBack = 200; // blocks
    // A called program states what it needs, whoever calls it.
    if (ctx.callDepth() > 0 && off.known() &&
        !isIn(ctx, off, ctx.index().programAt(ctx.block().begin)))
      return true;
    if (!isHere(ctx, off) || off.begin >= ctx.block().begin)
      return false;
    if (ctx.block().hasLabel())
      return true;
    Block block;
    bool more = readPrevious(ctx, block);
    for (unsigned i = 0; more && i < lookBack; ++i, more = readBack(ctx, block)) {
      const bool there = block.begin <= off.begin;
      if (there)
        return block.skip >= 0;
      if (block.hasLabel() || llvm::any_of(block.items, [](const Item &item) {
            return item.kind == ItemKind::Structure || item.kind == ItemKind::End;
          }))
        return true;
    }
    return false;
  }

  /// As for compensation: only after a cycle that has ended.
  static void cycleOffAgain(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    const CodeInfo &code = ctx.code(event);
    if (code.group == noGroup || before.group(code.group) != (uint64_t(1) << code.bit) ||
        !(before.isStated(code.group)) || !before.must(Fact::MovedSinceTool) ||
        before.may(Fact::UnknownCode) || isSafeLine(ctx) || before.modalCalls ||
        ctx.after().modalCalls)
      return;
    if (otherWayLeadsHere(before.origin.ofGroup(code.group), ctx))
      return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}`: no cycle is active", code.name)
          .note(before.origin.ofGroup(code.group), "since here");
  }

  /// Advice: a block that holds a number and nothing else.
  static void emptyBlock(RuleContext &ctx) {
    const Block &block = ctx.block();
    if (!ctx.asked() || !block.isEmpty() || block.numberEnd <= block.begin ||
        !block.issues.empty() || ctx.before().cycleActive(ctx.dialect()) == Truth::Yes)
      return;
    const SourceRange range{ctx.source().id(), block.numberBegin, block.numberEnd};
    if (auto finding = ctx.report(range)) {
      finding.severity(Severity::Style);
      if (block.number < 0)
        finding.message("this block holds nothing");
      else
        finding.message("block `{0}` holds nothing", block.number);
    }
  }

  /// A feed beside a rapid move, whichever block has switched to rapid.
  static void feedOfRapid(const Event &event, RuleContext &ctx) {
    const Word *feed = ctx.block().find('F');
    if (!feed || !event.axes || !event.certain || ctx.find({Action::Cycle, Action::CycleCancel}))
      return;
    if (auto finding = ctx.report(*feed))
      finding.severity(Severity::Style)
          .message("F does nothing in a rapid move: it counts from the next feed move on");
  }

  /// A modal call of a macro is ended and none was begun.
  static void macroOff(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    if (ctx.callDepth() > 0 || before.callsModally() != Truth::No || !before.must(Fact::Moved) ||
        before.may(Fact::UnknownCode) || isSafeLine(ctx))
      return;
    const CodeInfo &code = ctx.code(event);
    if (code.group != noGroup && before.mayBeStated(code.group))
      return; // one was on before
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Style)
          .message("`{0}`: no modal call is active", ctx.text(*event.word));
  }

  /// Advice: a cycle is cancelled and none was called.
  static void cycleOff(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    const GroupIndex group = ctx.dialect().group(StandardGroup::Cycle);
    if (!ctx.asked() || ctx.callDepth() > 0 || group == noGroup || before.may(Fact::UnknownCode) ||
        before.mayBeStated(group) || !before.must(Fact::Moved) || isSafeLine(ctx))
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Style)
          .message("`{0}`: no cycle was called before", ctx.code(event).name);
  }

  static void increment(RuleContext &ctx) {
    if (ctx.after().activeAction(ctx.dialect(), StandardGroup::Distance) != Action::Incremental ||
        ctx.find({Action::Absolute}))
      return;
    for (const Word &word : ctx.block().words)
      if (ctx.dialect().incrementWords & maskOf(word.address))
        if (auto finding = ctx.report(word))
          finding
              .message("`{0}` is a distance by itself: under `{1}` the plain word says the same",
                       ctx.text(word),
                       ctx.after().activeCode(ctx.dialect(), StandardGroup::Distance)->name)
              .note(ctx.after().originOf(ctx.dialect(), StandardGroup::Distance), "since here");
  }

  std::vector<CodeIndex> ends_; ///< words that end what has a number
  bool wanted_ = false;
  bool rapidFeed_ = false;   ///< a feed in a rapid block is advised against
  bool neverCalled_ = false; ///< a cancel before every cycle is advised against
  bool firstToo_ = false;    ///< compensation that was never on is told to who asks for the rule
};

} // namespace
NCVET_RULE(ModalRedundantCode, modal_redundant_code)
} // namespace ncvet
