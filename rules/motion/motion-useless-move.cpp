// A rapid move to where the tool has cut, and then the tool is changed.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <algorithm>
#include <map>

namespace ncvet {
namespace {

struct MotionUselessMoveMemory {
  /// Blocks with a number to which a jump may lead; whether one does, the whole file says.
  struct Still {
    SourceRange range;
    int64_t number = -1;
  };
  std::map<std::pair<FileId, uint32_t>, Still> still;
};

class MotionUselessMove final : public StatefulRule<MotionUselessMoveMemory> {
public:
  void listen(Subscriptions &to) override {
    zero_ = to.flag("zero");
    if (zero_)
      to.onMoves({MotionKind::Rapid, MotionKind::Feed});
    else if (!to.dialect().isLathe())
      to.onMoves({MotionKind::Rapid});
    margin_ = to.number("margin", 10);
    to.onAction({Action::ReferenceReturn});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code)
      return staysFromHome(event, ctx);
    if (zero_)
      nowhere(event, ctx);
    if (event.motion != MotionKind::Rapid)
      return sleepWhileMoving();
    constexpr uint16_t plane = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y);
    if (event.inMachineCoordinates() || !event.axes || (event.axes & ~plane))
      return;
    if (!changesToolNext(ctx))
      return;
    const MachineState &state = ctx.after();
    const auto cut = state.cutArea.get();
    const Interval &x = cut[0], &y = cut[1];
    if (!x.isBounded() || !y.isBounded() || (x.hi <= x.lo && y.hi <= y.lo))
      return;
    for (unsigned i = 0; i < 2; ++i) {
      const Interval &area = cut[i], &to = state.position[i];
      if (!to.isConstant() || to.value() < area.lo - margin_ || to.value() > area.hi + margin_)
        return;
    }
    if (auto finding = ctx.report(event))
      finding.message("the tool is sent to where it has been cutting and then changed: was an "
                      "operation forgotten?");
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    for (const auto &[place, block] : memory().still)
      if (place.first == file.source.id() &&
          !std::binary_search(file.usedNumbers.begin(), file.usedNumbers.end(), block.number))
        staysPut(block.range, ctx);
  }

private:
  /// `G28 U0`, and `W0` in the next block: the code counts in its own block alone.
  static void staysFromHome(const Event &event, RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const uint16_t home = axesOf(dialect, ctx.block());
    BlocksAhead ahead(ctx);
    Block next;
    if (!home || !ahead.next(next) || !next.items.empty() || next.words.empty() ||
        (next.addresses & ~dialect.axisWords) || (axesOf(dialect, next) & home))
      return;
    const bool incremental =
        ctx.after().isActive(dialect, StandardGroup::Distance, {Action::Incremental}) == Truth::Yes;
    const bool still = llvm::all_of(next.words, [&](const Word &word) {
      return word.isNumber() && word.mantissa == 0 &&
             (incremental || (dialect.incrementWords & maskOf(word.address)));
    });
    if (!still)
      return;
    const SourceRange range = wordsRange(ahead.unit().source.id(), next);
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Warning)
          .message("this block moves nothing: `{0}` counts in its own block only, so this axis "
                   "does not go home",
                   ctx.text(*event.word))
          .note(ctx.blockRange(), "the return is here");
  }

  /// A feed move of coordinates alone that ends where it begins.
  void nowhere(const Event &event, RuleContext &ctx) const {
    if (event.motion != MotionKind::Feed || event.inMachineCoordinates() || event.code == noCode ||
        !event.axes || saysMore(ctx) || ctx.before().profile != ProfileMode::Off ||
        ctx.after().compensation != phaseOff)
      return;
    for (unsigned i = 0; i < axisCount; ++i)
      if ((event.axes >> i & 1) && (!ctx.before().position[i].isConstant() ||
                                    !(ctx.before().position[i] == ctx.after().position[i]) ||
                                    (ctx.before().machineAxes >> i & 1)))
        return;
    if (!comesFromFront(event.axes, ctx))
      return;
    if (ctx.block().number >= 0 && ctx.callDepth() == 0) {
      memory().still[{ctx.source().id(), ctx.block().begin}] = {ctx.blockRange(),
                                                                ctx.block().number};
      return;
    }
    staysPut(ctx.blockRange(), ctx);
  }

  /// The block holds something beside its coordinates and the code of the line.
  static bool saysMore(const RuleContext &ctx) {
    const AddressMask rest = ctx.block().addresses & ~ctx.dialect().axisWords;
    return rest && (rest != maskOf(letterAddress('G')) || ctx.codes().size() != 1 ||
                    ctx.code(ctx.codes().front()).action != Action::Linear);
  }

  static void staysPut(SourceRange range, RuleContext &ctx) {
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Style)
          .message("this block moves nothing: the tool is there already");
  }

  /// Whether the blocks that brought these axes to their places come before this one, with
  /// nothing in between that another path may lead to: in a loop the first pass moves.
  static bool comesFromFront(uint16_t axes, RuleContext &ctx) {
    constexpr unsigned lookBack = 50; // blocks
    if (ctx.block().hasLabel())
      return false;
    Block block;
    bool more = readPrevious(ctx, block);
    for (unsigned i = 0; more && axes && i < lookBack; ++i, more = readBack(ctx, block)) {
      if (block.skip >= 0 || llvm::any_of(block.items, [](const Item &item) {
            return item.kind != ItemKind::Assignment && item.kind != ItemKind::Definition;
          }))
        return false;
      axes &= uint16_t(~axesOf(ctx.dialect(), block));
      if (axes && block.hasLabel())
        return false;
    }
    return axes == 0;
  }

  bool zero_ = false;

  /// Whether the next block that does more than switch something changes the tool.
  static bool changesToolNext(RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    // Most often a move that is known already follows.
    if (const Block *next = ctx.nextAlike(); next && next->hasAny(dialect.axisWords)) {
      ctx.index().noteRead(next->begin, next->next);
      return false;
    }
    constexpr unsigned lookAhead = 6;
    const auto size = uint32_t(ctx.source().text().size());
    for (const Block &block : blocks(ctx.index(), ctx.block().next, size, lookAhead)) {
      if (!block.items.empty() || block.hasAny(dialect.axisWords))
        return false;
      if (dialect.toolChangeByT && block.has(letterAddress('T')))
        return true;
      for (const Word &word : block.words) {
        if (dialect.addresses[word.address].kind != AddressKind::Code || !word.isNumber())
          continue;
        const CodeIndex index = dialect.find(char('A' + word.address), word.codeNumber());
        if (index == noCode)
          return false;
        const Action action = dialect.codes[index].action;
        if (action == Action::ToolChange)
          return true;
        if (action == Action::CallProgram || action == Action::CallLocal ||
            action == Action::MacroCall || action == Action::ProgramStop ||
            action == Action::OptionalStop || action == Action::SkipMove)
          return false;
      }
    }
    return false;
  }

  double margin_ = 10;
};

} // namespace
NCVET_RULE(MotionUselessMove, motion_useless_move)
} // namespace ncvet
