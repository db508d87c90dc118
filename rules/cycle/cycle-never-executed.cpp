// A cycle is set up without a hole and cancelled before it made one, or its data are in a place
// where they are lost.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

#include <set>
#include <unordered_map>

namespace ncvet {
namespace {

struct CycleNeverExecutedMemory {
  uint32_t stored = 0; ///< switches that say that parameters are stored
  SourceRange storedIn{};
  bool assigns = false;
};

class CycleNeverExecuted final : public StatefulRule<CycleNeverExecutedMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onChange(
        {EventKind::CycleCancel, EventKind::CycleStart, EventKind::ProgramEnd, EventKind::Block});
    const Dialect &dialect = to.dialect();
    for (unsigned i = 0; i < dialect.switches.size(); ++i)
      if (dialect.switches[i].leftOn == id)
        memory().stored |= 1u << i;
    if (memory().stored)
      to.onCode([&](const CodeInfo &code) {
        return code.action == Action::Switch && code.effect.on && code.effect.index < 64 &&
               (memory().stored >> code.effect.index & 1);
      });
    if (dialect.lexical.blocksSpanLines)
      callParameters(dialect);
    to.onNotices(id);
    if (to.dialect().facts->cycles.valuesInVariables)
      for (const CodeInfo &code : dialect.codes)
        for (const WordSpec &spec : code.words)
          if (spec.variable && code.action == Action::Cycle)
            parameters_.insert({spec.variable, spec.orVariable});
    if (!parameters_.empty())
      to.on(EventKind::Statement);
    to.onCode([](const CodeInfo &code) { return countsFrames(code) || code.cancelsCalls; });
    if (!dialect.isLathe())
      to.onAction({Action::CycleCancel});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &before = ctx.before();
    if (event.kind == EventKind::Block) {
      if (ctx.block().items.empty() && !ctx.block().hasAny(dataWords))
        return sleepInShape();
      if (!ctx.block().items.empty() && callParameters_.empty())
        return sleepAtBlock();
      checkLooseWords(ctx);
      checkLooseParameters(ctx);
      return;
    }
    if (event.kind == EventKind::Statement) {
      memory().assigns |= ctx.block().items[event.item()].kind == ItemKind::Assignment;
      return;
    }
    if (event.kind == EventKind::Code) {
      ctx.reportNotices(id, event);
      if (ctx.code(event).action == Action::CycleCancel && !ctx.code(event).cancelsCalls)
        positionsLost(ctx);
      if (countsFrames(ctx.code(event)))
        return counts(event, ctx);
      if (ctx.code(event).cancelsCalls)
        return endsCall(ctx);
      memory().storedIn =
          ctx.block().numberEnd > ctx.block().begin
              ? SourceRange{ctx.source().id(), ctx.block().begin, ctx.block().numberEnd}
              : ctx.range(*event.word);
      return;
    }
    if (event.kind == EventKind::ProgramEnd && memory().stored)
      storedForNothing(ctx);
    const CodeInfo *cycle = before.activeCode(ctx.dialect(), StandardGroup::Cycle);
    if (!cycle || cycle->action != Action::Cycle ||
        !(makesHole(cycle->cycle) || cycle->firesInPlane) || before.may(Fact::CycleRan) ||
        before.may(Fact::UnknownCode))
      return;
    if (event.kind == EventKind::CycleStart && &ctx.code(event) == cycle)
      return;
    const Origin &origin = before.origin.of(StatePart::Cycle);
    if (!origin.known())
      return;
    const CausePlace place = causePlace(ctx, origin);
    if (auto finding = ctx.report(place.at))
      finding
          .message("`{0}` is set up {1} and ends without having made a hole", cycle->name,
                   place.where)
          .note(place.other, place.note("the cycle ends here", "it is set up here"));
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (memory().assigns && file.complete)
      for (const ProgramInfo &program : file.index.programs())
        orphans(file, program, ctx);
  }

private:
  /// A motion code in a list of holes ends the cycle: the positions from there to its G80 are not
  /// drilled.
  static void positionsLost(RuleContext &ctx) {
    constexpr unsigned furthest = 60; // blocks
    const Dialect &dialect = ctx.dialect();
    constexpr AddressMask plane = maskOf(letterAddress('X')) | maskOf(letterAddress('Y'));
    if (ctx.block().hasAny(plane) || ctx.before().cycleActive(dialect) != Truth::No ||
        ctx.before().may(Fact::UnknownCode))
      return;
    Block block;
    SourceRange ends{};
    std::string by;
    bool more = readPrevious(ctx, block);
    for (unsigned i = 0; more && i < furthest; ++i, more = readBack(ctx, block)) {
      if (!block.items.empty() || block.skip >= 0 || !block.hasAny(plane))
        return;
      const CodeInfo *const cycle = findCode(dialect, block, {Action::Cycle});
      if (cycle && !ends.empty() && makesHole(cycle->cycle)) {
        if (auto finding = ctx.report(ends))
          finding
              .message("`{0}` ends `{1}`: the positions from here to the code that ends the cycle "
                       "are not drilled",
                       by, cycle->name)
              .note(ctx.blockRange(), "the end that was meant");
        return;
      }
      if (cycle || (block.addresses & dialect.axisWords & ~plane))
        return;
      const CodeInfo *const move = findCode(dialect, block, {Action::Rapid, Action::Linear});
      if (!block.has(letterAddress('G')))
        continue;
      if (!move || i == 0 || !ends.empty())
        return;
      ends = wordsRange(ctx, block);
      by = move->name;
    }
  }

  /// `MCALL SLOT(5)` and `MCALL` in the next block: the program never runs.
  static void endsCall(RuleContext &ctx) {
    Block previous;
    if (ctx.block().words.size() != 1 || !ctx.block().items.empty() || !readPrevious(ctx, previous))
      return;
    for (const Item &item : previous.items) {
      if (item.kind != ItemKind::Call || !item.modal)
        continue;
      const SourceRange call{ctx.source().id(), item.begin, item.end};
      if (auto finding = ctx.report(call))
        finding
            .message("`{0}` is to run after each move, and the next block ends it: it never runs",
                     ctx.text(call))
            .note(ctx.blockRange(), "the modal call ends here");
    }
  }

  /// A frame that is set once per pass.
  static bool countsFrames(const CodeInfo &code) {
    return code.action == Action::FrameAdd &&
           llvm::any_of(code.words, [](const WordSpec &w) { return w.role == Role::Repeat; });
  }

  /// Whether a repetition may be the one that is meant: its count is no other number.
  static bool mayCount(const Item &repeat, const Block &block, const Interval &wanted) {
    if (repeat.count == noExpression)
      return true;
    const auto count = block.numberIn(repeat.count);
    return !count || !wanted.isConstant() || *count == wanted.value();
  }

  /// A frame that is to be set several times, and nothing repeats it.
  static void counts(const Event &event, RuleContext &ctx) {
    for (const WordSpec &spec : ctx.code(event).words) {
      const Word *word = spec.role == Role::Repeat ? wordFor(ctx.block(), spec) : nullptr;
      if (!word || !(ctx.value(*word).lo > 1) || ctx.callDepth() > 0)
        continue;
      const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
      for (const Block &block : blocks(ctx.index(), program.body, program.end)) {
        // A jump before the frame only leads past something: a loop round the frame closes after
        // it.
        const bool later = block.begin >= ctx.block().begin;
        if (llvm::any_of(block.items, [&](const Item &i) {
              return (i.kind == ItemKind::Repeat && mayCount(i, block, ctx.value(*word))) ||
                     i.kind == ItemKind::Call || (i.kind == ItemKind::Jump && later);
            }))
          return;
      }
      if (auto finding = ctx.report(event))
        finding.severity(Severity::Warning)
            .message("`{0}` counts {1} passes, and nothing in the program repeats them",
                     ctx.code(event).name, spec.name);
    }
  }

  /// Parameters of cycles in a program that has none that reads them.
  void orphans(const FileSummary &file, const ProgramInfo &program, RuleContext &ctx) const {
    constexpr size_t readable = 4u << 20; // a program that long was made by a machine
    if (program.end - program.begin > readable)
      return;
    std::vector<std::pair<uint64_t, SourceRange>> given; // and not read since
    std::vector<std::pair<uint64_t, SourceRange>> all;
    std::set<uint64_t> read;
    bool loops = false, active = false;
    for (const Block &block : blocks(file.reader, program.body, program.end)) {
      std::set<uint64_t> here;
      if (!readsOf(block, here, active, ctx))
        return;
      for (const Item &item : block.items) {
        if (item.kind == ItemKind::Call ||
            (item.kind == ItemKind::Jump && item.nameEnd > item.nameBegin))
          return; // a called program may read them
        loops |= item.kind == ItemKind::Jump || item.kind == ItemKind::Repeat;
        if (item.kind != ItemKind::Assignment || !parameters_.count(block.keyOf(item.target)))
          continue;
        all.emplace_back(block.keyOf(item.target),
                         SourceRange{file.source.id(), item.begin, item.end});
        if (!active) // else for the next place
          given.push_back(all.back());
      }
      llvm::erase_if(given, [&](const auto &each) { return here.count(each.first); });
      read.insert(here.begin(), here.end());
    }
    for (const auto &[key, range] : loops ? all : given)
      if (!loops || !read.count(key))
        if (auto finding = ctx.report(range))
          finding.severity(Severity::Style)
              .message("`{0}` is a parameter of cycles, and no cycle {1} reads it", ctx.text(range),
                       read.count(key) ? "after it" : "of the program");
  }

  /// Variables that the block's cycles and expressions read; `active`: a cycle runs at the places
  /// that follow. False where the block returns to a caller, who may run what reads them.
  static bool readsOf(const Block &block, std::set<uint64_t> &read, bool &active,
                      const RuleContext &ctx) {
    for (const Word &word : block.words) {
      const CodeIndex index = codeOf(ctx.dialect(), word);
      if (index == noCode)
        continue;
      const CodeInfo &code = ctx.dialect().codes[index];
      for (const WordSpec &spec : code.words)
        read.insert({spec.variable, spec.orVariable});
      if (code.action == Action::Return)
        return false;
      if (code.action == Action::Cycle || code.action == Action::CycleCancel)
        active = code.action == Action::Cycle;
    }
    for (const ExpressionOp &op : block.operations)
      if (op.op == Op::Variable)
        read.insert(uint64_t(op.value));
    return true;
  }

  std::set<uint64_t> parameters_; ///< keys of variables that cycles read

  static constexpr llvm::StringLiteral id{"cycle-never-executed"};

  /// Parameters that were stored for a cycle that the program does not call.
  void storedForNothing(RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    if (!state.switches.areOn(memory().stored) || ctx.callDepth() > 0 ||
        state.may(Fact::UnknownCode) || memory().storedIn.end == 0)
      return;
    if (auto finding = ctx.report(memory().storedIn))
      finding.severity(Severity::Warning)
          .text("parameters of a cycle are stored here, and no later block calls the cycle")
          .note(ctx.blockRange(), "the program ends here");
  }

  /// Variables that only calls read which have them in their own block.
  void callParameters(const Dialect &dialect) {
    for (const CodeInfo &code : dialect.codes)
      for (const WordSpec &spec : code.words)
        if (spec.variable && code.action == Action::Cycle && code.group == noGroup)
          callParameters_.insert({spec.variable, CodeIndex(&code - dialect.codes.data())});
    for (const CodeInfo &code : dialect.codes)
      for (const WordSpec &spec : code.words)
        if (code.group != noGroup)
          callParameters_.erase(spec.variable);
  }

  /// The parameters of a call are in a block that does not make it.
  void checkLooseParameters(RuleContext &ctx) const {
    const Block &block = ctx.block();
    if (callParameters_.empty() || block.items.empty() || !block.has(variableAddress))
      return;
    // What such a block names last says best what it is for.
    for (const Item &item : llvm::reverse(block.items)) {
      if (item.kind != ItemKind::Assignment)
        continue;
      const auto call = callParameters_.find(block.keyOf(item.target));
      if (call == callParameters_.end())
        continue;
      const CodeInfo &code = ctx.dialect().codes[call->second];
      if (llvm::any_of(ctx.codes(), [&](const CodeUse &use) {
            return ctx.dialect().codes[use.code].base == code.base;
          }))
        return;
      const SourceRange range = block.numberEnd > block.begin
                                    ? SourceRange{ctx.source().id(), block.begin, block.numberEnd}
                                    : ctx.range(item);
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Warning)
            .message("the block sets `{0}` and holds no `{1}`: no cycle takes it",
                     ctx.text(SourceRange{ctx.source().id(), item.nameBegin, item.nameEnd}),
                     code.name);
      return;
    }
  }

  std::unordered_map<uint64_t, CodeIndex> callParameters_;

  /// Depths of pecks and the like in a block that makes no hole.
  /// What a cycle may keep of a block.
  static constexpr AddressMask dataWords = lettersMask("IJKQEP");

  void checkLooseWords(RuleContext &ctx) const {
    const Block &block = ctx.block();
    if (!block.hasAny(dataWords) || block.has(letterAddress('G')) || !block.items.empty() ||
        (ctx.outcome().kinds & bitOf(EventKind::UnknownCode)))
      return;
    const CodeInfo *cycle = ctx.before().activeCode(ctx.dialect(), StandardGroup::Cycle);
    if (!cycle || cycle->action != Action::Cycle || !makesHole(cycle->cycle))
      return;
    for (const Event &other : ctx.outcome().events)
      if (other.kind == EventKind::CycleRun || other.kind == EventKind::Motion)
        return;
    AddressMask lost = 0;
    for (const WordSpec &spec : cycle->words)
      switch (spec.role) {
      case Role::Peck:
      case Role::PeckFirst:
      case Role::PeckStep:
      case Role::PeckLeast:
      case Role::PeckClearance:
      case Role::Dwell:
      case Role::Shift:
        lost |= spec.any & dataWords;
        break;
      default:
        break;
      }
    for (const CodeUse &use : ctx.codes()) { // an M code may read such a word
      lost &= ~ctx.code(use).takes;
      for (const WordSpec &spec : ctx.code(use).words)
        lost &= ~spec.any;
    }
    const Word *word = block.findAny(lost);
    if (!word)
      return;
    if (auto finding = ctx.report(*word))
      finding
          .message("`{0}` of `{1}` is in a block that makes no hole: the control does not keep it",
                   ctx.text(*word), cycle->name)
          .note(ctx.before().origin.of(StatePart::Cycle), cycle->name + " becomes active here");
  }
};

} // namespace
NCVET_RULE(CycleNeverExecuted, cycle_never_executed)
} // namespace ncvet
