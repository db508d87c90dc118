// The outside of the work as the straight cuts of a program's text turn it.
#include "analyzer/facts/turned_shape.h"

#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/program/block_reading.h"

#include <cmath>

namespace ncvet {

namespace {

constexpr size_t mostCuts = 400; // of programs with more nothing is told: they are generated

double between(double a, double b, double part) { return a + (b - a) * part; }

} // namespace

/// Reads the text from block to block. Whatever could move the work, or cut it in a way that the
/// text does not show, ends it: nothing is told then.
class ShapeReader {
public:
  ShapeReader(TurnedShape &shape, const Dialect &dialect) : shape_(shape), dialect_(dialect) {}

  /// False: nothing is told of the program.
  bool read(const Block &block) {
    constexpr AddressMask turning = lettersMask("XZUW");
    if (!block.items.empty() || block.skip >= 0 ||
        std::max({shape_.along_.size(), shape_.in_.size(), shape_.stops_.size()}) > mostCuts ||
        (block.hasAny((dialect_.axisWords | dialect_.incrementWords) & ~turning)))
      return false;
    moves_ = true;
    for (const CodeIndex code : codesOf(dialect_, block))
      if (!take(dialect_.codes[code], block))
        return false;
    if (block.has(letterAddress('T')))
      forget();
    at_ = block.begin;
    if (moves_)
      move(block);
    return true;
  }

private:
  enum class Motion : uint8_t { None, Rapid, Linear, Arc };

  bool take(const CodeInfo &code, const Block &block) {
    switch (code.action) {
    case Action::Rapid:
      motion_ = Motion::Rapid;
      return true;
    case Action::Linear:
      motion_ = Motion::Linear;
      return true;
    case Action::ArcCw:
    case Action::ArcCcw:
      motion_ = Motion::Arc;
      return true;
    case Action::MachineMove:
    case Action::ReferenceReturn:
      forget();
      moves_ = false;
      return true;
    case Action::Cycle:
      if (makesHole(code.cycle) && (!x_ || std::fabs(*x_) <= onAxis))
        drills(block.begin);
      forget();
      moves_ = false;
      motion_ = Motion::None;
      return leavesShape(code);
    case Action::Thread:
      forget();
      motion_ = Motion::None;
      return true;
    case Action::WorkOffset:
      if (offset_ && offset_ != &code)
        return false;
      offset_ = &code;
      return true;
    case Action::ProgramStop:
      forget();
      shape_.stops_.push_back(block.begin);
      return true;
    case Action::Incremental:
    case Action::DiameterOff:
    case Action::CallProgram:
    case Action::CallLocal:
    case Action::MacroCall:
    case Action::MacroModal:
    case Action::LocalShift:
    case Action::DataInput:
    case Action::FrameSet:
    case Action::FrameAdd:
      return false;
    default:
      return code.action != Action::PresetPosition || !block.hasAny(lettersMask("XZUW"));
    }
  }

  /// Cycles that cut what the text shows, or nothing of the outside.
  static bool leavesShape(const CodeInfo &code) {
    const CycleKind kind = code.cycle;
    if (turnsProfile(kind))
      return code.letter == 'G'; // others name a contour, which may be in another file
    return makesHole(kind) || cutsThread(kind) || kind == CycleKind::ThreadInfeed;
  }

  void move(const Block &block) {
    const bool computed = block.hasAny(dialect_.incrementWords);
    const Word *const xWord = block.find(letterAddress('X'));
    const Word *const zWord = block.find(letterAddress('Z'));
    if (!xWord && !zWord && !computed)
      return;
    const auto x = xWord || computed ? number(xWord) : x_,
               z = zWord || computed ? number(zWord) : z_;
    const bool known = x && z && x_ && z_;
    if (motion_ == Motion::Linear || motion_ == Motion::Arc) {
      if (known)
        cut(*x, *z);
      else
        side_ = 0;
    } else {
      if (x && x_ && *x != *x_) // a bar that bores comes back inwards, whatever it has done last
        side_ = *x > *x_ ? 1 : -1;
      endRun();
    }
    x_ = x;
    z_ = z;
  }

  static std::optional<double> number(const Word *word) {
    return word && word->isNumber() && !word->has(wordIncremental) ? std::optional(word->value())
                                                                   : std::nullopt;
  }

  void cut(double x, double z) {
    const TurnedShape::Cut cut{unsigned(shape_.stops_.size()), *x_, *z_, x, z,
                               motion_ == Motion::Linear};
    if (x != *x_)
      side_ = x > *x_ ? 1 : -1;
    if (z != *z_)
      run_.push_back(cut);
    else if (x < *x_)
      shape_.in_.push_back(cut);
    if (z != *z_ && std::fabs(x) <= onAxis)
      drills(at_);
    else if (z == *z_ && x <= 0 && *x_ > 0 && !shape_.face_)
      shape_.face_ = {at_, z};
  }

  /// What was cut since the last rapid move is the outside where the tool went outwards last.
  void endRun() {
    for (TurnedShape::Cut &cut : run_) {
      cut.told &= side_ > 0;
      if (std::fabs(cut.fromX) > onAxis || std::fabs(cut.toX) > onAxis)
        shape_.along_.push_back(cut);
    }
    run_.clear();
    side_ = 0;
  }

  void drills(uint32_t block) { shape_.drilled_ = std::min(shape_.drilled_, block); }

  void forget() {
    endRun();
    x_.reset();
    z_.reset();
  }

  static constexpr double onAxis = 0.1; // a drill

  TurnedShape &shape_;
  const Dialect &dialect_;
  const CodeInfo *offset_ = nullptr;
  Motion motion_ = Motion::None;
  bool moves_ = true; ///< the axis words of the block are those of a move
  int side_ = 0;      ///< which way the last X of the cut went: 1 outwards
  std::optional<double> x_, z_;
  uint32_t at_ = 0; ///< the block
  std::vector<TurnedShape::Cut> run_;
};

TurnedShape::TurnedShape(const FileIndex &index, const ProgramInfo &program,
                         const Dialect &dialect) {
  ShapeReader reader(*this, dialect);
  for (const Block &block : blocks(index.reader(), program.body, program.end))
    if (!reader.read(block)) {
      along_.clear();
      in_.clear();
      face_.reset();
      return;
    }
}

unsigned TurnedShape::sectionOf(uint32_t block) const {
  return unsigned(llvm::count_if(stops_, [&](uint32_t stop) { return stop < block; }));
}

std::optional<double> TurnedShape::diameter(At at) const {
  const unsigned section = sectionOf(at.block);
  std::optional<double> least;
  for (const Cut &cut : along_) {
    const double low = std::min(cut.fromZ, cut.toZ), high = std::max(cut.fromZ, cut.toZ);
    if (cut.section != section || at.z < low || at.z > high)
      continue;
    if (!cut.told && at.z > low && at.z < high)
      return std::nullopt;
    if (!cut.told)
      continue;
    const double x = between(cut.fromX, cut.toX, (at.z - cut.fromZ) / (cut.toZ - cut.fromZ));
    least = std::min(least.value_or(x), x);
  }
  return least;
}

std::optional<double> TurnedShape::faceBefore(uint32_t block) const {
  return face_ && face_->first < block && block < drilled_ && stops_.empty()
             ? std::optional(face_->second)
             : std::nullopt;
}

bool TurnedShape::isTurned(At at) const {
  const unsigned section = sectionOf(at.block);
  return llvm::any_of(along_, [&](const Cut &cut) {
    return cut.section == section && at.z > std::min(cut.fromZ, cut.toZ) &&
           at.z < std::max(cut.fromZ, cut.toZ);
  });
}

bool TurnedShape::isOpened(At at, double x, double near) const {
  const unsigned section = sectionOf(at.block);
  return llvm::any_of(in_, [&](const Cut &cut) {
    return cut.section == section && cut.toX <= x && std::fabs(cut.toZ - at.z) <= near;
  });
}

std::optional<double> TurnedShape::fedFrom(At at, double x) const {
  constexpr double same = 1e-6;
  const unsigned section = sectionOf(at.block);
  for (const Cut &cut : in_)
    if (cut.section == section && std::fabs(cut.toX - x) < same && std::fabs(cut.toZ - at.z) < same)
      return cut.fromX;
  return std::nullopt;
}

const TurnedShape &TurnedShapes::of(const RuleContext &ctx) const {
  const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
  return *known_.of({ctx.source().id(), program.begin}, [&] {
    return std::make_shared<const TurnedShape>(ctx.index(), program, ctx.dialect());
  });
}

std::optional<TurnedMove> turnedMove(const RuleContext &ctx) {
  const MachineState &before = ctx.before(), &after = ctx.after();
  const auto unit = millimetresPer(ctx.dialect(), after);
  if (!unit || !after.frames.empty() || before.may(Fact::UnknownCode) || ctx.callDepth() > 0 ||
      !(ctx.dialect().isLathe() || turnsWork(ctx.dialect(), after)))
    return std::nullopt;
  for (const Axis axis : {Axis::X, Axis::Z})
    for (const MachineState *const state : {&before, &after})
      if (!state->at(axis).isConstant() || state->inMachineCoordinates(axis))
        return std::nullopt;
  const double x = diameterFactor(ctx.dialect()) / *unit;
  return TurnedMove{before.at(Axis::X).value() * x, before.at(Axis::Z).value() / *unit,
                    after.at(Axis::X).value() * x, after.at(Axis::Z).value() / *unit, *unit};
}

std::optional<double> rapidIntoTurned(const TurnedShapes &shapes, const RuleContext &ctx) {
  constexpr double beside = 0.05, deep = 0.5, near = 8; // mm
  const auto move = turnedMove(ctx);
  if (!move || move->toX >= move->fromX || move->toX < 0)
    return std::nullopt;
  const TurnedShape &shape = shapes.of(ctx);
  const TurnedShape::At at{ctx.block().begin, move->toZ};
  const auto left = shape.diameter(at);
  const auto next = shape.diameter({at.block, at.z + beside / move->unit});
  // At an end of the work the tool may be beside it.
  if (!left || !next || !shape.isTurned({at.block, at.z - beside / move->unit}) ||
      move->fromX < *left || move->toX > std::min(*left, *next) - deep / move->unit ||
      shape.isOpened(at, move->toX + deep / move->unit, near / move->unit))
    return std::nullopt;
  return left;
}

/// At rapid along Z alone, out of the work again.
static bool leadsBack(const Dialect &dialect, const Block &block, double from) {
  const Word *const z = block.find(letterAddress('Z'));
  return block.items.empty() && findCode(dialect, block, {Action::Rapid}) && z && z->isNumber() &&
         !z->has(wordIncremental) && z->value() > from &&
         axesOf(dialect, block) == 1u << unsigned(Axis::Z);
}

std::optional<double> rapidPassInTurned(const TurnedShapes &shapes, const RuleContext &ctx) {
  constexpr double beside = 0.05, deep = 0.5, near = 8; // mm
  const auto move = turnedMove(ctx);
  if (!move || move->toX != move->fromX || move->toX <= 0)
    return std::nullopt;
  const TurnedShape &shape = shapes.of(ctx);
  const TurnedShape::At at{ctx.block().begin, move->toZ + beside / move->unit};
  const auto left = shape.diameter(at);
  if (!left || move->toX > *left - deep / move->unit || shape.isTurned({at.block, move->fromZ}) ||
      shape.isOpened(at, move->toX + deep / move->unit, near / move->unit))
    return std::nullopt;
  // Outwards and back beside the work: through a bore it goes back where it came.
  BlocksAhead ahead(ctx);
  Block out, home;
  if (!ahead.next(out) || !out.items.empty() || out.has(letterAddress('Z')) || !ahead.next(home) ||
      !leadsBack(ctx.dialect(), home, move->toZ))
    return std::nullopt;
  const Word *const x = out.find(letterAddress('X'));
  return x && x->isNumber() && !x->has(wordIncremental) && x->value() >= *left + deep / move->unit
             ? left
             : std::nullopt;
}

bool rapidOutOfGroove(const TurnedShapes &shapes, const RuleContext &ctx) {
  constexpr double beside = 0.05, deep = 0.5, wide = 6, furthest = 12, least = 4; // mm
  const auto move = turnedMove(ctx);
  if (!move || move->fromX < least / move->unit ||
      std::fabs(move->toZ - move->fromZ) <= wide / move->unit)
    return false;
  const TurnedShape &shape = shapes.of(ctx);
  const uint32_t here = ctx.block().begin;
  const auto from = shape.fedFrom({here, move->fromZ}, move->fromX);
  if (!from)
    return false;
  const double way = move->toZ > move->fromZ ? 1 / move->unit : -1 / move->unit;
  // Both at the groove's edge and beyond the tool's width the work is larger, and no other tool
  // or stroke has made room.
  for (const double distance : {beside, wide}) {
    const auto left = shape.diameter({here, move->fromZ + way * distance});
    if (!left || *left < move->fromX + deep / move->unit || *from < *left)
      return false;
  }
  for (double distance = 1; distance <= furthest; ++distance)
    if (shape.isOpened({here, move->fromZ + way * distance}, move->fromX, 0.4 / move->unit))
      return false;
  return true;
}

} // namespace ncvet
