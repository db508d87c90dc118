// The blocks of a turning profile: as they are, and along which paths a cycle may find them.
#include "analyzer/facts/turning_profile.h"

#include "analyzer/program/block_reading.h"
#include "analyzer/program/references.h"
#include "formats/dialect/measure.h"

#include <cmath>

namespace ncvet {

namespace {

/// Longer profiles than this are no contour that anybody wrote.
constexpr size_t maxProfileBlocks = 2000;

/// Offsets of a profile's first block and of its last one.
using ProfileEnds = std::optional<std::pair<uint32_t, uint32_t>>;

/// Of the blocks between two numbers.
ProfileEnds numberedProfile(const RuleContext &ctx, const Flow &flow) {
  if (flow.first < 0 || flow.last < 0)
    return std::nullopt;
  const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
  const ReferredBlocks blocks = resolveProfile(ctx.index(), program, Reference::toBlock(flow.first),
                                               Reference::toBlock(flow.last), ctx.block().begin);
  return blocks.areInOrder() ? ProfileEnds({*blocks.first, *blocks.last}) : std::nullopt;
}

/// Of the subprogram between brackets that a turning cycle names.
ProfileEnds bracketedProfile(const RuleContext &ctx, const Flow &flow) {
  if (flow.code == noCode || !has(ctx.dialect().codes[flow.code], CycleTrait::Turned) ||
      !flow.target.isConstant())
    return std::nullopt;
  const std::string name = std::to_string(std::llround(flow.target.number.value()));
  for (const ProgramInfo &program : ctx.index().programs()) {
    const auto head = ctx.index().label(program, name, program.begin);
    if (!head)
      continue;
    Block opening;
    ctx.index().read(*head, opening);
    const uint32_t first = opening.next;
    uint32_t last = first;
    for (const Block &block : blocks(ctx.index(), first, program.end)) {
      if (!block.items.empty()) {
        const Item &item = block.items.front();
        const bool ends = item.kind == ItemKind::Structure && item.structure == Structure::EndSub;
        return ends && last > first ? ProfileEnds({first, last}) : std::nullopt;
      }
      last = block.begin;
    }
  }
  return std::nullopt;
}

/// What is made of blocks that a switch may leave out.
enum class Skippable : uint8_t { Undecided, Run, LeftOut };

/// The blocks of a profile that a switch leaves out.
struct SkippedBlocks {
  SourceRange first;
  int level = -1;
  bool severalLevels = false;
};

/// Reads the blocks of a profile one by one, and asks of them what the contour is.
class ProfileReading {
public:
  ProfileReading(const RuleContext &ctx, Skippable way, SkippedBlocks &skipped)
      : ctx_(ctx), way_(way), skipped_(skipped) {}

  Profile run() {
    if (!readBlocks())
      return std::move(profile_);
    profile_.known = true;
    findLastCut();
    measure();
    if (profile_.reachesX.lo <= profile_.reachesX.hi)
      profile_.side = side();
    return std::move(profile_);
  }

private:
  ProfileEnds ends() const {
    const Flow &flow = ctx_.outcome().flow;
    return flow.kind == FlowKind::Profile   ? numberedProfile(ctx_, flow)
           : flow.kind == FlowKind::Contour ? bracketedProfile(ctx_, flow)
                                            : std::nullopt;
  }

  /// False when they are not there, or not a plain list.
  bool readBlocks() {
    const ProfileEnds found = ends();
    if (!found)
      return false;
    const auto [first, last] = *found;
    MachineState state = ctx_.after();
    state.profile = ProfileMode::Recorded;
    for (const Axis axis : {Axis::X, Axis::Z})
      if (state.inMachineCoordinates(axis))
        state.at(axis) = Interval::unknown();
    if (state.at(Axis::X).isConstant())
      startX_ = state.at(Axis::X).value();
    auto &blocks = profile_.blocks;
    for (uint32_t offset = first; offset <= last && blocks.size() < maxProfileBlocks;) {
      ProfileBlock &entry = blocks.emplace_back();
      ctx_.index().read(offset, entry.block);
      offset = entry.block.next;
      if (entry.block.isEmpty()) {
        blocks.pop_back();
        continue;
      }
      const bool skips = entry.block.skip >= 0;
      if (skips)
        note(entry.block);
      if (!entry.block.items.empty() || (skips && way_ == Skippable::Undecided))
        return false; // what it does decides itself at run time
      if (skips && way_ == Skippable::LeftOut)
        blocks.pop_back();
      else
        execute(entry, state);
    }
    return blocks.size() < maxProfileBlocks && !blocks.empty();
  }

  /// Notes a block that a switch leaves out.
  void note(const Block &block) {
    if (skipped_.first.empty())
      skipped_.first = wordsRange(ctx_, block);
    skipped_.severalLevels |= skipped_.level >= 0 && skipped_.level != block.skip;
    skipped_.level = block.skip;
  }

  void execute(ProfileBlock &entry, MachineState &state) {
    constexpr uint16_t both = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Z);
    const MachineState before = state;
    executor_.execute(entry.block, before, state, outcome_);
    entry.range = wordsRange(ctx_, entry.block);
    entry.codes.assign(outcome_.codes.begin(), outcome_.codes.end());
    entry.fromX = before.at(Axis::X);
    entry.fromZ = before.at(Axis::Z);
    entry.toX = state.at(Axis::X);
    entry.toZ = state.at(Axis::Z);
    for (const Event &event : outcome_.events)
      if (event.kind == EventKind::Motion) {
        entry.moves = (event.axes & both) != 0;
        entry.axes = event.axes;
        entry.motion = event.motion;
        entry.motionKnown = event.certain;
      }
  }

  /// The last block only leaves the contour when it is a rapid or cancels compensation.
  void findLastCut() {
    profile_.lastCut = profile_.blocks.size();
    const ProfileBlock &end = profile_.blocks.back();
    bool leaves = !end.moves || end.motion == MotionKind::Rapid;
    for (const CodeUse &use : end.codes)
      leaves |= ctx_.code(use).action == Action::CompensationOff;
    if (leaves && profile_.blocks.size() > 1)
      --profile_.lastCut;
  }

  /// How far the contour reaches.
  void measure() {
    for (size_t i = 0; i < profile_.lastCut; ++i) {
      const ProfileBlock &entry = profile_.blocks[i];
      if (!entry.moves)
        continue;
      if (entry.toX.isConstant()) {
        profile_.reachesX.lo = std::min(profile_.reachesX.lo, entry.toX.value());
        profile_.reachesX.hi = std::max(profile_.reachesX.hi, entry.toX.value());
      }
      allKnown_ &= entry.toX.isConstant() && (i == 0 || entry.toZ.isConstant());
      if (!allKnown_)
        continue;
      take(entry.toX, profile_.minX, profile_.maxX);
      if (entry.toZ.isConstant())
        take(entry.toZ, profile_.minZ, profile_.maxZ);
    }
    if (!allKnown_ || !profile_.minX)
      profile_.minX = profile_.maxX = profile_.minZ = profile_.maxZ = std::nullopt;
  }
  static void take(const Interval &at, std::optional<double> &least,
                   std::optional<double> &greatest) {
    least = least ? std::min(*least, at.value()) : at.value();
    greatest = greatest ? std::max(*greatest, at.value()) : at.value();
  }

  /// By how much a coordinate changes from the first point to the last; `absent` when not known.
  double change(Interval ProfileBlock::*to, double absent) const {
    const Interval &head = profile_.blocks.front().*to;
    const Interval &tail = profile_.blocks[profile_.lastCut - 1].*to;
    return tail.isConstant() && head.isConstant() ? tail.value() - head.value() : absent;
  }
  /// Which side the code of compensation says.
  Side sideByCode() const {
    const bool forward = change(&ProfileBlock::toZ, -1) <= 0;
    Side side = Side::Unknown;
    for (size_t i = 0; i < profile_.blocks.size() && side == Side::Unknown; ++i)
      for (const CodeUse &use : profile_.blocks[i].codes) {
        const Action action = ctx_.code(use).action;
        if (action == Action::CompensationRight)
          side = forward ? Side::Outside : Side::Inside;
        else if (action == Action::CompensationLeft)
          side = forward ? Side::Inside : Side::Outside;
      }
    return side;
  }
  /// Which side is cut: the side of compensation says it, else whether the contour rises or falls
  /// from its first to its last point, else where the tool starts.
  Side side() const {
    constexpr double step = 1e-4;
    const Side byStart = !startX_ || !allKnown_                    ? Side::Unknown
                         : *startX_ >= profile_.reachesX.hi - step ? Side::Outside
                         : *startX_ <= profile_.reachesX.lo + step ? Side::Inside
                                                                   : Side::Unknown;
    if (ctx_.dialect().codes[ctx_.outcome().flow.code].cycle == CycleKind::RoughFace)
      return byStart; // a face contour falls on an outside part
    const double rise = change(&ProfileBlock::toX, 0);
    const Side byRise = std::fabs(rise) < step ? Side::Unknown
                        : rise > 0             ? Side::Outside
                                               : Side::Inside;
    const Side byCode = sideByCode();
    // From outside of all its points, down and up again: the contour begins with the face.
    const ProfileBlock &last = profile_.blocks[profile_.lastCut - 1];
    if (byCode == Side::Unknown && byStart == Side::Outside && last.toX.isConstant() &&
        profile_.reachesX.lo < last.toX.value() - step)
      return byStart;
    if (byCode == Side::Unknown)
      return byRise != Side::Unknown ? byRise : byStart;
    return byCode == byRise || byRise == Side::Unknown ? byCode : byStart;
  }

  const RuleContext &ctx_;
  const Skippable way_;
  SkippedBlocks &skipped_;
  const Executor &executor_ = ctx_.unit().executor();
  Outcome outcome_;
  Profile profile_;
  std::optional<double> startX_; ///< where the cycle begins
  bool allKnown_ = true;         ///< the end points of the contour
};

} // namespace

Profile readProfile(const RuleContext &ctx) {
  SkippedBlocks skipped;
  return ProfileReading(ctx, Skippable::Undecided, skipped).run();
}

llvm::SmallVector<ProfileWay, 2> profileWays(const RuleContext &ctx) {
  SkippedBlocks skipped;
  llvm::SmallVector<ProfileWay, 2> ways(1);
  ways[0].profile = ProfileReading(ctx, Skippable::Run, skipped).run();
  ways[0].skippable = skipped.first;
  ways[0].always = skipped.first.empty();
  if (ways[0].always)
    return ways;
  ProfileWay &without = ways.emplace_back();
  without.profile = ProfileReading(ctx, Skippable::LeftOut, skipped).run();
  without.skippable = skipped.first;
  without.leavesOut = true;
  without.always = false;
  for (ProfileWay &way : ways)
    way.profile.known &= !skipped.severalLevels;
  return ways;
}

} // namespace ncvet
