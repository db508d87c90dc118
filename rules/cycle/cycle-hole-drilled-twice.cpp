// A cycle makes the same hole more than once.
#include "analyzer/facts/hole_list.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/gathering_rule.h"
#include "interp/value/sum.h"

#include <bit>
#include <cmath>
#include <cstring>

namespace ncvet {
namespace {

struct CycleHoleDrilledTwiceMemory {
  SourceRange call{}; ///< block of the last cycle of one hole; no end: none
  std::array<double, axisCount> calledAt{};
  std::optional<double> calledDepth; ///< of its hole
  Origin recalled;                   ///< the last call of a cycle that was in force
  TextPlace recalledList;            ///< where the list begins with which it goes on
};

class CycleHoleDrilledTwice final
    : public GatheringRule<CycleHoleDrilledTwiceMemory, HolePlace, HoleList> {
public:
  void listen(Subscriptions &to) override {
    to.gathers();
    to.on({EventKind::CycleStart, EventKind::CycleRun, EventKind::ToolChange});
    calls_ = llvm::any_of(to.dialect().codes, [](const CodeInfo &code) {
      return code.group == noGroup && makesHole(code.cycle);
    });
    for (const CodeInfo &code : to.dialect().codes) {
      waits_ |= code.waits;
      for (const WordSpec &spec : code.words)
        if (spec.role == Role::Repeat)
          repeats_ |= spec.position || spec.variable ? ~AddressMask(0) : spec.any;
    }
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::CycleRun && isNextOfRow(event, ctx))
      return;
    if (event.kind == EventKind::ToolChange) { // what comes is the work of another tool
      memory().call = {};
      return;
    }
    if (event.code == noCode || !makesHole(ctx.code(event).cycle))
      return;
    if (event.kind == EventKind::CycleRun) {
      if (calls_)
        afterCall(event, ctx);
      if (othersTell(event, ctx))
        return;
      using Position = std::array<Interval, axisCount>;
      const llvm::ArrayRef<Position> holes = ctx.outcome().holes;
      for (const Position &position :
           holes.size() > 1 ? holes : llvm::ArrayRef<Position>(ctx.after().position))
        if (samePlace(event, position, ctx))
          break;
      if (ctx.block().hasAny(repeats_))
        repeatedHere(event, ctx);
    }
  }

  /// Holes of the row up to one whose place was there before.
  size_t onRow(const HoleRow &holes, size_t most, RuleContext &ctx) const override {
    LastRow &row = list().row;
    const MachineState &state = ctx.after();
    if (isGathering() || row.call != state.origin.of(StatePart::Cycle) ||
        !state.position[0].isConstant() || !isAt(row, state.position))
      return 0;
    for (const Outcome *kind : holes.kinds)
      if (const KindOfHole *const known = row.find(kind->known);
          !known || !list().continues(known->place))
        return 0;
    size_t taken = 0;
    for (; taken < most; ++taken)
      if (!addHole(holes, holes.holes[taken], row))
        break;
    return taken;
  }

private:
  /// Whether the last hole of the row was there.
  static bool isAt(const LastRow &row, const std::array<Interval, axisCount> &position) {
    for (unsigned i = 0; i < axisCount; ++i)
      if (i != unsigned(row.tool) && row.position[i] != position[i])
        return false;
    return true;
  }

  /// Adds a further hole of the row; false: there was one at its place.
  bool addHole(const HoleRow &holes, const HoleRow::Hole &hole, LastRow &row) const {
    std::array<uint64_t, HoleRow::mostAxes> parts;
    uint64_t key = row.key;
    for (size_t i = 0; i < holes.axes.size(); ++i) {
      const auto axis = unsigned(holes.axes[i]);
      const bool stays = row.position[axis].lo == hole.at[i];
      parts[i] =
          stays ? row.parts[axis] : partOfKey(axis, hole.at[i] == 0 ? 0 : rounded(hole.at[i]));
      key += parts[i] - row.parts[axis];
    }
    if (list().addNext(key, hole))
      return false;
    row.key = key;
    for (size_t i = 0; i < holes.axes.size(); ++i) {
      const auto axis = unsigned(holes.axes[i]);
      row.parts[axis] = parts[i];
      row.position[axis] = Interval::exactly(hole.at[i]);
    }
    return true;
  }

  using Numbers = std::array<double, axisCount>; ///< 0 where it is not known, and along the tool

  bool takeOver(llvm::ArrayRef<HolePlace> holes) const override {
    for (const HolePlace &place : holes) { // of the list that is being run
      if (!list().continues(place))
        break;
      if (const auto *known = list().find(place); known && known->begin != place.block.offset)
        return false;
    }
    // Of its lists the last one alone goes on.
    const HolePlace &last = holes.back();
    size_t first = holes.size() - 1;
    while (first > 0 && holes[first - 1].isOfListOf(last))
      --first;
    for (const HolePlace &place : holes.drop_front(first))
      list().add(place);
    return true;
  }

  /// A repeat count with absolute positions, or with none.
  static void repeatedHere(const Event &event, RuleContext &ctx) {
    const CodeInfo &code = ctx.code(event);
    const Word *count = wordOf(ctx.block(), code, Role::Repeat);
    if (!count)
      return;
    const auto n = valueOf(ctx, code, Role::Repeat);
    if (!n || *n < 2 || ctx.find({Action::Incremental})) // `G91 Y45. G90 R2.`
      return;
    const Dialect &dialect = ctx.dialect();
    const Axis tool = toolAxis(dialect, ctx.after());
    const GroupIndex group = dialect.group(StandardGroup::Distance);
    if (group != noGroup && ctx.after().group(group) != groupUnset &&
        ctx.after().isActive(dialect, StandardGroup::Distance, {Action::Incremental}) != Truth::No)
      return;
    for (const Word &word : ctx.block().words) {
      const AddressInfo &address = dialect.addresses[word.address];
      if (!(dialect.axisWords & maskOf(word.address)) || address.axis == tool)
        continue;
      if (address.kind == AddressKind::Increment || word.has(wordIncremental) || !word.isNumber())
        return;
    }
    if (auto finding = ctx.report(*count, event.certain))
      finding.message("`{0}` runs `{1}` {2} times at the same place: the positions are absolute",
                      ctx.text(*count), code.name, int64_t(*n));
  }

  /// A modal cycle called where a cycle of one hole has just made it.
  void afterCall(const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const Axis tool = toolAxis(ctx.dialect(), state);
    std::array<double, axisCount> at{};
    bool known = state.position[0].isConstant() && state.position[1].isConstant();
    for (unsigned i = 0; i < axisCount; ++i)
      if (i != unsigned(tool) && state.position[i].isConstant())
        at[i] = state.position[i].value();
    if (ctx.code(event).group == noGroup) {
      memory().call = known ? ctx.blockRange() : SourceRange{};
      memory().calledAt = at;
      memory().calledDepth = kept(state, ctx.code(event), Role::Depth);
      return;
    }
    const bool here = memory().call.end != 0 && memory().call.file == ctx.source().id() && known &&
                      at == memory().calledAt && ctx.block().begin >= memory().call.end &&
                      ctx.codeWord(event);
    const auto depth = kept(state, ctx.code(event), Role::Depth);
    const bool deeper = depth && memory().calledDepth && *depth != *memory().calledDepth;
    if (here && !deeper && !ctx.before().may(Fact::UnknownCode))
      if (auto finding = ctx.report(event, event.certain))
        finding
            .message("`{0}` {1} a hole again that was made already", ctx.code(event).name,
                     verbOf(ctx.code(event).cycle))
            .note(memory().call, "the hole is made here");
    memory().call = {};
  }
  /// Of a block that neither moves nor calls the cycle, other rules say that it runs it: of a modal
  /// call also where only the tool's axis moves.
  bool othersTell(const Event &event, const RuleContext &ctx) const {
    if (ctx.codeWord(event))
      return false;
    return waits_ ? !(event.axes & ~(1u << unsigned(toolAxis(ctx.dialect(), ctx.after()))))
                  : ctx.dialect().emptyBlocksRun && !event.axes;
  }

  bool calls_ = false;      ///< the control has cycles of one hole
  bool waits_ = false;      ///< modal calls, which only an own word ends
  AddressMask repeats_ = 0; ///< of words that may say how often a cycle runs

  /// A position that the same list of holes has had before; true: it was reported.
  bool samePlace(const Event &event, const std::array<Interval, axisCount> &position,
                 RuleContext &ctx) const {
    const StateUse used = std::exchange(stateUse, StateUse());
    HolePlace place;
    const bool isKnown = findPlace(event, position, place, ctx);
    if (isKnown && ctx.outcome().known && !calls_ && ctx.outcome().holes.size() == 1 &&
        ctx.after().frames.empty())
      keepKind(position, place, ctx);
    stateUse |= used;
    return isKnown && wasHereBefore(event, place, ctx);
  }

  void keepKind(const std::array<Interval, axisCount> &position, const HolePlace &place,
                const RuleContext &ctx) const {
    LastRow &row = list().row;
    const Axis tool = toolAxis(ctx.dialect(), ctx.after());
    const Origin &call = ctx.after().origin.of(StatePart::Cycle);
    if (row.call != call || row.tool != tool || row.offset != place.offset)
      row.begin(call, tool, place.offset);
    row.position = position;
    row.key = place.key;
    for (unsigned i = 0; i < axisCount; ++i)
      row.parts[i] = partOfKey(i, numberAt(position[i], i == unsigned(tool)));
    const uint64_t known = ctx.outcome().known;
    row.kinds[known % row.kinds.size()] = {known, stateUse, place};
  }

  /// A further hole of the row, as one before it but for its numbers; false: it is another.
  bool isNextOfRow(const Event &event, RuleContext &ctx) const {
    LastRow &row = list().row;
    const KindOfHole *const kind = row.find(ctx.outcome().known);
    if (!kind || row.call != ctx.after().origin.of(StatePart::Cycle))
      return false;
    ctx.noteUse(kind->use);
    const std::array<Interval, axisCount> &position = ctx.after().position;
    constexpr unsigned usual = 3; // X, Y, Z
    const bool othersStay = std::memcmp(&position[usual], &row.position[usual],
                                        (axisCount - usual) * sizeof(Interval)) == 0;
    for (unsigned i = 0; i < (othersStay ? usual : axisCount); ++i)
      if (position[i] != row.position[i]) {
        const uint64_t part = partOfKey(i, numberAt(position[i], i == unsigned(row.tool)));
        row.key += part - row.parts[i];
        row.parts[i] = part;
        row.position[i] = position[i];
      }
    if (!isPlaceKnown(event, position, row.tool))
      return true;
    // A hole that is the first one at its place is put into the list as it is made.
    if (!isGathering() && list().continues(kind->place) &&
        !list().addNext(ctx.block().begin, ctx.block().end))
      return true;
    HolePlace place = kind->place;
    place.block.offset = ctx.block().begin;
    place.end.offset = ctx.block().end;
    place.key = row.key;
    wasHereBefore(event, place, ctx);
    return true;
  }

  /// Where the hole is; false: that is not known, or no matter.
  bool findPlace(const Event &event, const std::array<Interval, axisCount> &position,
                 HolePlace &place, const RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const Axis tool = toolAxis(ctx.dialect(), state);
    const bool hasFrame = !state.frames.empty();
    if (state.profile != ProfileMode::Off || (state.transforms[0] && !hasFrame))
      return false;
    place.block = {ctx.source().id(), ctx.block().begin};
    place.end = {ctx.source().id(), ctx.block().end};
    place.list = {ctx.source().id(), listOf(event, ctx)};
    place.depth = ctx.callDepth();
    place.offset = state.active(ctx.dialect(), StandardGroup::WorkOffset);
    if (!isPlaceKnown(event, position, tool))
      return false;
    Numbers at;
    for (unsigned i = 0; i < axisCount; ++i)
      at[i] = numberAt(position[i], i == unsigned(tool));
    if (hasFrame && !putIntoFrame(at, position, tool, state))
      return false;
    place.key = keyOf(place.offset, at);
    return true;
  }

  /// Whether it is known where the hole is along X, and along the axes that its block names.
  static bool isPlaceKnown(const Event &event, const std::array<Interval, axisCount> &position,
                           Axis tool) {
    if (!position[0].isConstant())
      return false;
    for (uint32_t left = event.axes & ~(1u << unsigned(tool)); left; left &= left - 1)
      if (!position[size_t(std::countr_zero(left))].isConstant())
        return false;
    return true;
  }

  static double numberAt(const Interval &position, bool isTool) {
    const bool counts = !isTool && position.isConstant() && position.value() != 0;
    return counts ? rounded(position.value()) : 0;
  }

  /// Adds the hole to its list; true: it was reported.
  bool wasHereBefore(const Event &event, const HolePlace &place, RuleContext &ctx) const {
    note(place);
    const HoleList::Made *const known = list().add(place);
    if (!known)
      return false;
    // Another depth at the same place is a second step, and a longer path cannot be one list.
    const CodeInfo &code = ctx.code(event);
    const bool deeper =
        wordOf(ctx.block(), code, Role::Depth) || wordOf(ctx.block(), code, Role::Retract);
    if (known->begin == place.block.offset || (deeper && place.list.offset < ctx.block().begin))
      return false;
    if (auto finding = ctx.report(ctx.blockRange(), false))
      finding.message("`{0}` {1} at the same place again", code.name, verbOf(code.cycle))
          .note(SourceRange{place.block.file, known->begin, known->end},
                "this block was here already");
    return true;
  }

  /// A shifted, turned or mirrored system makes other places of the same numbers; false: it is not
  /// known which.
  static bool putIntoFrame(Numbers &at, const std::array<Interval, axisCount> &position, Axis tool,
                           const MachineState &state) {
    const std::optional<Frame> frame = state.frames.total();
    if (!frame)
      return false;
    const Point3 turned = *frame * Point3{position[0], position[1], position[2]};
    for (unsigned i = 0; i < turned.size(); ++i) {
      if (i == unsigned(tool))
        continue;
      if (!turned[i].isConstant())
        return false;
      at[i] = rounded(turned[i].value());
    }
    return true;
  }

  /// Where the list of holes begins: at the call of the cycle. One that is called again while it is
  /// in force goes on with its list.
  uint32_t listOf(const Event &event, const RuleContext &ctx) const {
    const Origin &call = ctx.after().origin.of(StatePart::Cycle);
    if (memory().recalled.known() && call == memory().recalled)
      return memory().recalledList.offset;
    if (!ctx.dialect().emptyBlocksRun || !ctx.codeWord(event) ||
        ctx.before().activeCode(ctx.dialect(), StandardGroup::Cycle) != &ctx.code(event))
      return call.begin;
    const Origin &first = ctx.before().origin.of(StatePart::Cycle);
    if (!memory().recalled.known() || first != memory().recalled)
      memory().recalledList = {first.file, first.begin};
    memory().recalled = call;
    return memory().recalledList.offset;
  }

  /// In ten-thousandths of a millimetre, rounded: polar input and frames calculate.
  static double rounded(double value) {
    constexpr double parts = 1e4, mostExact = 1e15;
    const double number = value * parts;
    if (std::fabs(number) < mostExact) // as `round`, without a call
      return double(int64_t(number + std::copysign(0.5, number)));
    return number;
  }

  static uint64_t keyOf(uint64_t offset, const Numbers &at) {
    uint64_t key = Sum(offset).get();
    for (unsigned i = 0; i < axisCount; ++i)
      key += partOfKey(i, at[i]);
    return key;
  }
  /// What a number of one axis adds to the key.
  static uint64_t partOfKey(unsigned axis, double at) {
    if (at == 0)
      return 0;
    Sum sum(axis + 1);
    sum.add(llvm::bit_cast<uint64_t>(at));
    sum.add(axis);
    return sum.get();
  }
};

} // namespace
NCVET_RULE(CycleHoleDrilledTwice, cycle_hole_drilled_twice)
} // namespace ncvet
