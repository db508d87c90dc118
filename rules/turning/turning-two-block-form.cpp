// A turning cycle is written in another control's form, or one of its two blocks is missing.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"

#include <set>

namespace ncvet {
namespace {

struct TurningTwoBlockFormMemory {
  SourceRange oneBlock{};    ///< the first cycle in one block
  SourceRange data{};        ///< the first data block
  std::set<CodeIndex> given; ///< cycles whose data were given
};

class TurningTwoBlockForm final : public StatefulRule<TurningTwoBlockFormMemory> {
  static constexpr llvm::StringLiteral id = "turning-two-block-form";

public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleStart);
    mixed_ = to.flag("mixed");
    if (mixed_ || llvm::any_of(to.dialect().codes, [](const CodeInfo &c) { return c.twoBlock; }))
      to.on(EventKind::CycleRun);
    to.onNotices(id);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code) {
      ctx.reportNotices(id, event);
      return;
    }
    if (event.code == noCode)
      return;
    const CodeInfo &code = ctx.code(event);
    if (mixed_)
      forms(event, code, ctx);
    if (event.kind == EventKind::CycleRun)
      return isGroove(code) ? relief(event, code, ctx) : withoutData(event, code, ctx);
    if (code.twoBlock && ctx.after().pendingCycle == event.code)
      memory().given.insert(baseOf(event.code, ctx));
    if (!code.twoBlock || ctx.after().pendingCycle != event.code)
      return;
    BlocksAhead ahead(ctx);
    Block next;
    const bool more = ahead.next(next);
    if (more)
      for (const Word &word : next.words) {
        if (word.address != letterAddress('G') || !word.isNumber())
          continue;
        const CodeIndex index = ctx.dialect().find('G', word.codeNumber());
        if (index == noCode)
          continue;
        const CodeInfo &other = ctx.dialect().codes[index];
        if (other.letter == code.letter && other.number == code.number)
          return;
        if (!other.twoBlock)
          continue;
        const SourceRange at{ahead.unit().source.id(), word.offset, next.endOf(word)};
        if (auto finding = ctx.report(at, event.certain))
          finding
              .message(
                  "`{0}` runs with the data of `{1}`: both blocks of a cycle carry the same code",
                  other.name, code.name)
              .note(ctx.range(*event.word), "the data block of " + code.name);
        return;
      }
    if (more ? runsLater(code, ahead, next, ctx) : !ahead.isOver())
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding.message("`{0}` gives only the data of the cycle, and no block that runs it follows",
                      code.name);
  }

private:
  static CodeIndex baseOf(CodeIndex code, const RuleContext &ctx) {
    const CodeIndex base = ctx.dialect().codes[code].base;
    return base == noCode ? code : base;
  }

  /// The depth and the retract of roughing are those that the control has kept.
  void withoutData(const Event &event, const CodeInfo &code, RuleContext &ctx) const {
    const CodeIndex base = baseOf(event.code, ctx);
    if ((code.cycle != CycleKind::RoughTurn && code.cycle != CycleKind::RoughFace) ||
        !(code.twoBlock || ctx.dialect().codes[base].twoBlock) ||
        ctx.before().pendingCycle != noCode || ctx.block().has(letterAddress('D')) ||
        ctx.callDepth() > 0 || ctx.before().may(Fact::UnknownCode) ||
        !memory().given.insert(base).second)
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding.severity(Severity::Style)
          .message("`{0}` runs, and no block of the program has given its depth and retract: those "
                   "of an earlier program count",
                   code.name);
  }

  /// A grooving cycle of two blocks.
  static bool isGroove(const CodeInfo &code) {
    return code.twoBlock &&
           (code.cycle == CycleKind::GrooveRadial || code.cycle == CycleKind::GrooveFace);
  }

  /// R in the block that runs the cycle, and no block before it that gives the retract: it is the
  /// relief at the bottom, and the tool moves sideways in the groove.
  static void relief(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    const Word *const word = wordOf(ctx.block(), code, Role::Relief);
    const auto value = valueOf(ctx, code, Role::Relief);
    if (!word || !value || *value == 0 || ctx.before().pendingCycle != noCode)
      return;
    // To the axis and past it: each pass is a cut of the face, and the tool lifts off it.
    if (const Word *const end = ctx.block().find('X');
        code.cycle == CycleKind::GrooveRadial && end && end->isNumber() && end->value() <= 0)
      return;
    constexpr unsigned furthest = 200; // blocks
    Block block;
    bool more = readPrevious(ctx, block);
    for (unsigned i = 0; more && i < furthest; ++i, more = readBack(ctx, block))
      for (const CodeIndex index : codesOf(ctx.dialect(), block))
        if (const CodeInfo &other = ctx.dialect().codes[index];
            other.letter == code.letter && other.number == code.number &&
            !block.hasAny(ctx.dialect().axisWords | ctx.dialect().incrementWords))
          return; // the data last until others are given
    if (auto finding = ctx.report(*word, event.certain))
      finding.severity(Severity::Warning)
          .message("`{0}` in the block that runs `{1}` is the relief at the bottom, where the tool "
                   "moves sideways in the groove: the retract is in a block before it",
                   ctx.text(*word), code.name);
  }

  bool mixed_ = false; ///< a machine takes one of the two forms

  /// A parameter of the machine decides between the forms: one program has one of them.
  void forms(const Event &event, const CodeInfo &code, RuleContext &ctx) const {
    const Word *word = ctx.codeWord(event);
    const bool data = event.kind == EventKind::CycleStart && code.twoBlock &&
                      ctx.after().pendingCycle == event.code;
    const bool ofForm = code.twoBlock || ctx.dialect().codes[code.base].twoBlock ||
                        code.cycle == CycleKind::ThreadMulti;
    const bool whole = event.kind == EventKind::CycleRun && ofForm &&
                       ctx.before().pendingCycle == noCode && ctx.block().has(letterAddress('D'));
    if (!word || (!data && !whole))
      return;
    SourceRange &own = data ? memory().data : memory().oneBlock;
    const SourceRange other = data ? memory().oneBlock : memory().data;
    if (own.empty())
      own = ctx.range(*word);
    if (other.empty())
      return;
    if (auto finding = ctx.report(*word, event.certain))
      finding.severity(Severity::Warning)
          .message(data ? "`{0}` gives the data of a cycle in two blocks, and the program has one "
                          "in one block too: a machine takes one of the two forms"
                        : "`{0}` is a cycle in one block, and the program has one in two blocks "
                          "too: a machine takes one of the two forms",
                   ctx.text(*word))
          .note(other, "the other form");
  }

  /// The data last until others are given: a later block of the cycle may take them.
  static bool runsLater(const CodeInfo &code, BlocksAhead &ahead, Block &block,
                        const RuleContext &ctx) {
    constexpr unsigned lookAhead = 60;
    bool more = true;
    for (unsigned i = 0; more && i < lookAhead; ++i, more = ahead.next(block))
      for (const CodeIndex index : codesOf(ctx.dialect(), block)) {
        const CodeInfo &other = ctx.dialect().codes[index];
        if (other.letter != code.letter || other.number != code.number)
          continue;
        AddressMask running = 0;
        for (const WordSpec &spec : other.words)
          if (spec.role == Role::ProfileFirst || spec.role == Role::Target ||
              spec.role == Role::Depth)
            running |= spec.any;
        return block.hasAny(running);
      }
    return !more && !ahead.isOver();
  }
};

} // namespace
NCVET_RULE(TurningTwoBlockForm, turning_two_block_form)
} // namespace ncvet
