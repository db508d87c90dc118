// Looks ahead in the text for rules: the next block, and the blocks of a turning profile.
#include "analyzer/facts/lookahead.h"

#include "analyzer/facts/profile_ways.h"
#include "formats/dialect/measure.h"
#include "formats/dialect/stored_names.h"
#include "interp/evaluate/expression.h"

#include <cmath>

namespace ncvet {

namespace {

/// Longer profiles than this are no contour that anybody wrote.
constexpr size_t maxProfileBlocks = 2000;

bool readFrom(const FileIndex &index, uint32_t offset, uint32_t end, Block &next) {
  while (offset < end) {
    index.read(offset, next);
    if (next.kind == BlockKind::Tape && next.isEmpty())
      return false;
    if (!next.isEmpty())
      return true;
    offset = next.next;
  }
  return false;
}

} // namespace

bool readNext(const RuleContext &ctx, Block &next) {
  return readFrom(ctx.index(), ctx.block().next, ctx.index().programAt(ctx.block().begin).end,
                  next);
}

bool readOn(const FileIndex &index, Block &block) {
  const uint32_t from = block.next;
  return readFrom(index, from, index.programAt(block.begin).end, block);
}

SourceRange wordsRange(const RuleContext &ctx, const Block &block) {
  SourceRange range{ctx.source().id(), block.end, block.begin};
  for (const Word &word : block.words) {
    range.begin = std::min(range.begin, word.offset);
    range.end = std::max(range.end, block.endOf(word));
  }
  if (range.begin >= range.end)
    range = {ctx.source().id(), block.begin, std::max(block.end, block.begin + 1)};
  return range;
}

namespace {

/// Reads the block with content that is before `at`.
bool readBackFrom(const RuleContext &ctx, uint32_t at, Block &block) {
  const uint32_t first = ctx.index().programAt(ctx.block().begin).body, behind = at;
  while (at > first) {
    at = std::max(first, ctx.source().lines().lineBegin(at - 1));
    ctx.index().read(at, block);
    if (!block.isEmpty())
      return block.next <= behind;
  }
  return false;
}

} // namespace

bool readPrevious(const RuleContext &ctx, Block &previous) {
  return readBackFrom(ctx, ctx.block().begin, previous);
}

bool readBack(const RuleContext &ctx, Block &block) {
  return readBackFrom(ctx, block.begin, block);
}

llvm::SmallVector<CodeIndex, 6> codesOf(const Dialect &dialect, const Block &block) {
  llvm::SmallVector<CodeIndex, 6> codes;
  for (const Word &word : block.words)
    if (const CodeIndex code = codeOf(dialect, word); code != noCode)
      codes.push_back(code);
  return codes;
}

const CodeInfo *findCode(const Dialect &dialect, const Block &block,
                         std::initializer_list<Action> actions) {
  for (const CodeIndex code : codesOf(dialect, block))
    if (llvm::is_contained(actions, dialect.codes[code].action))
      return &dialect.codes[code];
  return nullptr;
}

bool hasMotionCode(const Dialect &dialect, const Block &block) {
  for (const CodeIndex code : codesOf(dialect, block)) {
    const CodeInfo &info = dialect.codes[code];
    if (isMotion(info.action) || info.action == Action::Cycle)
      return true;
  }
  return false;
}

namespace {

/// Offsets of a profile's first block and of its last one.
using ProfileEnds = std::optional<std::pair<uint32_t, uint32_t>>;

/// Of the blocks between two numbers.
ProfileEnds numberedProfile(const RuleContext &ctx, const Flow &flow) {
  if (flow.first < 0 || flow.last < 0)
    return std::nullopt;
  const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
  const auto first = ctx.index().block(program, flow.first, ctx.block().begin);
  if (!first)
    return std::nullopt;
  const auto last = ctx.index().block(program, flow.last, *first ? *first - 1 : 0);
  return last && *last > *first ? ProfileEnds({*first, *last}) : std::nullopt;
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
    Block block;
    ctx.index().read(*head, block);
    const uint32_t first = block.next;
    uint32_t last = first;
    for (uint32_t at = first; at < program.end; at = block.next) {
      ctx.index().read(at, block);
      if (!block.items.empty()) {
        const Item &item = block.items.front();
        const bool ends = item.kind == ItemKind::Structure && item.structure == Structure::EndSub;
        return ends && last > first ? ProfileEnds({first, last}) : std::nullopt;
      }
      last = at;
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

Profile readProfileAs(const RuleContext &ctx, Skippable way, SkippedBlocks &skipped) {
  Profile profile;
  const Flow &flow = ctx.outcome().flow;
  ProfileEnds ends;
  if (flow.kind == FlowKind::Profile)
    ends = numberedProfile(ctx, flow);
  else if (flow.kind == FlowKind::Contour)
    ends = bracketedProfile(ctx, flow);
  if (!ends)
    return profile;
  const auto [first, last] = *ends;
  MachineState state = ctx.after(), before;
  state.profile = 1;
  for (const Axis axis : {Axis::X, Axis::Z})
    if (state.inMachineCoordinates(axis))
      state.at(axis) = Interval::unknown();
  const double startX = state.at(Axis::X).isConstant() ? state.at(Axis::X).value() : NAN;
  const Executor executor(ctx.dialect(), ctx.machine(), ctx.source().id());
  Outcome outcome;
  constexpr uint16_t both = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Z);
  for (uint32_t offset = first; offset <= last && profile.blocks.size() < maxProfileBlocks;) {
    ProfileBlock &entry = profile.blocks.emplace_back();
    ctx.index().read(offset, entry.block);
    offset = entry.block.next;
    if (entry.block.isEmpty()) {
      profile.blocks.pop_back();
      continue;
    }
    if (entry.block.skip >= 0) {
      if (skipped.first.empty())
        skipped.first = wordsRange(ctx, entry.block);
      skipped.severalLevels |= skipped.level >= 0 && skipped.level != entry.block.skip;
      skipped.level = entry.block.skip;
    }
    if (!entry.block.items.empty() || (entry.block.skip >= 0 && way == Skippable::Undecided))
      return profile; // what it does decides itself at run time
    if (entry.block.skip >= 0 && way == Skippable::LeftOut) {
      profile.blocks.pop_back();
      continue;
    }
    before = state;
    executor.execute(entry.block, before, state, outcome);
    entry.range = wordsRange(ctx, entry.block);
    entry.codes.assign(outcome.codes.begin(), outcome.codes.end());
    entry.fromX = before.at(Axis::X);
    entry.fromZ = before.at(Axis::Z);
    entry.toX = state.at(Axis::X);
    entry.toZ = state.at(Axis::Z);
    for (const Event &event : outcome.events)
      if (event.kind == EventKind::Motion) {
        entry.moves = (event.axes & both) != 0;
        entry.axes = event.axes;
        entry.motion = event.motion;
        entry.motionKnown = event.certain;
      }
  }
  if (profile.blocks.size() >= maxProfileBlocks || profile.blocks.empty())
    return profile;
  profile.known = true;
  // The last block only leaves the contour when it is a rapid or cancels compensation.
  profile.lastCut = profile.blocks.size();
  const ProfileBlock &end = profile.blocks.back();
  bool leaves = !end.moves || end.motion == MotionKind::Rapid;
  for (const CodeUse &use : end.codes)
    leaves |= ctx.code(use).action == Action::CompensationOff;
  if (leaves && profile.blocks.size() > 1)
    --profile.lastCut;
  bool allKnown = true;
  for (size_t i = 0; i < profile.lastCut; ++i) {
    const ProfileBlock &entry = profile.blocks[i];
    if (!entry.moves)
      continue;
    if (entry.toX.isConstant()) {
      profile.reachesX.lo = std::min(profile.reachesX.lo, entry.toX.value());
      profile.reachesX.hi = std::max(profile.reachesX.hi, entry.toX.value());
    }
    allKnown &= entry.toX.isConstant() && (i == 0 || entry.toZ.isConstant());
    if (!allKnown)
      continue;
    const double x = entry.toX.value();
    profile.minX = profile.minX ? std::min(*profile.minX, x) : x;
    profile.maxX = profile.maxX ? std::max(*profile.maxX, x) : x;
    if (!entry.toZ.isConstant())
      continue;
    const double z = entry.toZ.value();
    profile.minZ = profile.minZ ? std::min(*profile.minZ, z) : z;
    profile.maxZ = profile.maxZ ? std::max(*profile.maxZ, z) : z;
  }
  if (!allKnown || !profile.minX)
    profile.minX = profile.maxX = profile.minZ = profile.maxZ = std::nullopt;
  if (profile.reachesX.lo > profile.reachesX.hi)
    return profile;
  // Which side is cut: the side of compensation says it, else whether the contour rises or falls
  // from its first to its last point, else where the tool starts.
  const ProfileBlock &head = profile.blocks.front();
  const ProfileBlock &tail = profile.blocks[profile.lastCut - 1];
  constexpr double step = 1e-4;
  const double rise =
      tail.toX.isConstant() && head.toX.isConstant() ? tail.toX.value() - head.toX.value() : 0;
  const double run =
      tail.toZ.isConstant() && head.toZ.isConstant() ? tail.toZ.value() - head.toZ.value() : -1;
  Side byCode = Side::Unknown;
  for (size_t i = 0; i < profile.blocks.size() && byCode == Side::Unknown; ++i)
    for (const CodeUse &use : profile.blocks[i].codes) {
      const Action action = ctx.code(use).action;
      if (action == Action::CompensationRight)
        byCode = run <= 0 ? Side::Outside : Side::Inside;
      else if (action == Action::CompensationLeft)
        byCode = run <= 0 ? Side::Inside : Side::Outside;
    }
  const Side byRise = std::fabs(rise) < step ? Side::Unknown
                      : rise > 0             ? Side::Outside
                                             : Side::Inside;
  const Side byStart = std::isnan(startX) || !allKnown        ? Side::Unknown
                       : startX >= profile.reachesX.hi - step ? Side::Outside
                       : startX <= profile.reachesX.lo + step ? Side::Inside
                                                              : Side::Unknown;
  const bool facing = ctx.dialect().codes[flow.code].cycle == CycleKind::RoughFace;
  if (facing)
    profile.side = byStart; // a face contour falls on an outside part
  else if (byCode != Side::Unknown && (byCode == byRise || byRise == Side::Unknown))
    profile.side = byCode;
  else if (byCode == Side::Unknown && byRise != Side::Unknown)
    profile.side = byRise;
  else
    profile.side = byStart;
  return profile;
}

} // namespace

Profile readProfile(const RuleContext &ctx) {
  SkippedBlocks skipped;
  return readProfileAs(ctx, Skippable::Undecided, skipped);
}

llvm::SmallVector<ProfileWay, 2> profileWays(const RuleContext &ctx) {
  SkippedBlocks skipped;
  llvm::SmallVector<ProfileWay, 2> ways(1);
  ways[0].profile = readProfileAs(ctx, Skippable::Run, skipped);
  ways[0].skippable = skipped.first;
  ways[0].always = skipped.first.empty();
  if (ways[0].always)
    return ways;
  ProfileWay &without = ways.emplace_back();
  without.profile = readProfileAs(ctx, Skippable::LeftOut, skipped);
  without.skippable = skipped.first;
  without.leavesOut = true;
  without.always = false;
  for (ProfileWay &way : ways)
    way.profile.known &= !skipped.severalLevels;
  return ways;
}

const Word *wordOf(const Block &block, const CodeInfo &code, Role role) {
  for (const WordSpec &spec : code.words)
    if (spec.role == role)
      if (const Word *word = wordFor(block, spec))
        return word;
  return nullptr;
}

const Word *assignsWordOf(const Block &block, const CodeInfo &code) {
  if (!block.has(variableAddress))
    return nullptr;
  for (const WordSpec &spec : code.words)
    if (const Word *word = spec.variable ? assignmentOf(block, spec.variable) : nullptr)
      return word;
  return nullptr;
}

AddressMask addressesOf(const CodeInfo &code, Role role) {
  AddressMask mask = 0;
  for (const WordSpec &spec : code.words)
    if (spec.role == role)
      mask |= spec.any;
  return mask;
}

std::optional<double> kept(const MachineState &state, const CodeInfo &code, Role role) {
  for (const WordSpec &spec : code.words)
    if (spec.role == role && spec.variable) {
      const Value value = readVariable(state, int64_t(givenVariable(spec, state)));
      return value.isConstant() ? std::optional(value.number.value()) : std::nullopt;
    }
  const CycleWords &words = state.cycle;
  for (const WordSpec &spec : code.words)
    if (spec.role == role && spec.position && spec.position <= words.value.size()) {
      const unsigned place = spec.position - 1;
      if (!(words.present >> place & 1) || std::isnan(words.value[place]))
        return std::nullopt;
      return words.value[place];
    }
  const AddressMask mask = addressesOf(code, role);
  for (char letter = 'A'; letter <= 'Z'; ++letter)
    if ((mask & maskOf(letter)) && words.has(letter)) {
      if (std::isnan(words.get(letter)))
        return std::nullopt;
      return words.get(letter);
    }
  return std::nullopt;
}

std::optional<double> valueOf(const RuleContext &ctx, const CodeInfo &code, Role role) {
  const Word *word = wordOf(ctx.block(), code, role);
  if (!word || word->has(wordNoValue))
    return std::nullopt;
  const Interval value = ctx.value(*word);
  if (!value.isConstant())
    return std::nullopt;
  return value.value();
}

std::optional<double> millimetresPer(const Dialect &dialect, const MachineState &state) {
  const GroupIndex group = dialect.group(StandardGroup::Units);
  if (group == noGroup || state.group(group) == groupUnset)
    return 1;
  switch (state.activeAction(dialect, StandardGroup::Units)) {
  case Action::Inch:
    return 25.4;
  case Action::Metric:
    return 1;
  default:
    return std::nullopt;
  }
}

std::optional<double> endOf(const RuleContext &ctx, Axis axis, const Interval &start) {
  const std::optional<double> unit = millimetresPer(ctx.dialect(), ctx.after());
  if (!unit)
    return std::nullopt;
  const Dialect &dialect = ctx.dialect();
  for (const Word &word : ctx.block().words) {
    const AddressInfo &address = dialect.addresses[word.address];
    if (address.axis != axis ||
        (address.kind != AddressKind::Axis && address.kind != AddressKind::Increment))
      continue;
    if (word.has(wordNoValue))
      return std::nullopt;
    const Interval value = ctx.value(word);
    if (!value.isConstant())
      return std::nullopt;
    const bool incremental = address.kind == AddressKind::Increment || word.has(wordIncremental) ||
                             (dialect.group(StandardGroup::Distance) != noGroup &&
                              ctx.after().active(dialect, StandardGroup::Distance) != groupUnset &&
                              ctx.after().isActive(dialect, StandardGroup::Distance,
                                                   {Action::Incremental}) != Truth::No);
    if (!incremental)
      return value.value() * *unit;
    if (!start.isConstant())
      return std::nullopt;
    return start.value() + value.value() * *unit;
  }
  return std::nullopt;
}

bool comesFromBelow(const MachineState &state) {
  return state.commons.given(storedKey(StoredName::Below)) == Truth::Yes;
}

bool makesHole(CycleKind kind) {
  switch (kind) {
  case CycleKind::Drill:
  case CycleKind::DrillDwell:
  case CycleKind::Peck:
  case CycleKind::ChipBreak:
  case CycleKind::Tap:
  case CycleKind::TapLeft:
  case CycleKind::RigidTap:
  case CycleKind::RigidTapLeft:
  case CycleKind::Ream:
  case CycleKind::ReamDwell:
  case CycleKind::BoreStop:
  case CycleKind::BoreManual:
  case CycleKind::BoreDwellManual:
  case CycleKind::FineBore:
  case CycleKind::BackBore:
    return true;
  default:
    return false;
  }
}

bool taps(CycleKind kind) {
  return kind == CycleKind::Tap || kind == CycleKind::TapLeft || kind == CycleKind::RigidTap ||
         kind == CycleKind::RigidTapLeft;
}

bool cutsThread(CycleKind kind) {
  return kind == CycleKind::ThreadPass || kind == CycleKind::ThreadMulti;
}

llvm::StringRef verbOf(CycleKind kind) {
  if (taps(kind))
    return "taps";
  switch (kind) {
  case CycleKind::Ream:
  case CycleKind::ReamDwell:
  case CycleKind::BoreStop:
  case CycleKind::BoreManual:
  case CycleKind::BoreDwellManual:
  case CycleKind::FineBore:
  case CycleKind::BackBore:
    return "bores";
  case CycleKind::TurnPass:
    return "turns";
  case CycleKind::FacePass:
    return "faces";
  case CycleKind::ThreadPass:
  case CycleKind::ThreadMulti:
    return "cuts the thread";
  case CycleKind::Measure:
    return "measures";
  case CycleKind::Face:
  case CycleKind::Contour:
  case CycleKind::Pocket:
  case CycleKind::Slot:
    return "mills";
  default:
    return "drills";
  }
}

const Word *undefinedElement(const RuleContext &ctx) {
  const Block &block = ctx.block();
  // What a called program uses its caller may have defined; main programs open with a mark.
  if (block.words.size() != 1 || !block.items.empty() || ctx.callDepth() > 0 ||
      ctx.before().profile == 1 || ctx.before().compensation != phaseOff ||
      ctx.index().tapeMarks().empty())
    return nullptr;
  const Word &word = block.words.front();
  const AddressInfo &address = ctx.dialect().addresses[word.address];
  if (address.kind != AddressKind::Element)
    return nullptr;
  const llvm::StringRef name = ctx.text(word), text = ctx.source().text();
  for (size_t at = text.find_insensitive(name); at != llvm::StringRef::npos;
       at = text.find_insensitive(name, at + 1))
    if (text.substr(at + name.size()).ltrim(" \t").startswith("=") &&
        (at == 0 || !llvm::isAlnum(text[at - 1])))
      return nullptr;
  return &word;
}

unsigned lineOf(const RuleContext &ctx, const Origin &origin) {
  return ctx.source().lines().lineOf(origin.begin);
}

} // namespace ncvet
