// The direction in which the move before the current block ends, as far as the text tells it.
#include "analyzer/facts/direction_before.h"

#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/path_ahead.h"
#include "interp/geometry/circle.h"

namespace ncvet {

namespace {

/// Blocks that are read back for the last coordinate of an axis.
constexpr unsigned mostRead = 40;
constexpr double leastLength = 1e-6;

/// Coordinates of the plane, as they are written; a diameter is made a radius.
struct Written {
  std::array<std::optional<double>, 2> at;

  bool isWhole() const { return at[0] && at[1]; }
  Point point() const { return {*at[0], *at[1]}; }
};

/// A block whose coordinates are those of its words.
bool isPlain(const Dialect &dialect, const Block &block) {
  return block.items.empty() && block.skip < 0 && !block.hasAny(dialect.incrementWords) &&
         llvm::none_of(codesOf(dialect, block), [&](CodeIndex index) {
           const Action action = dialect.codes[index].action;
           return namesTarget(action) || action == Action::MachineMove ||
                  action == Action::ReferenceReturn || action == Action::Incremental;
         });
}

/// Whether what was written before the block still holds after it.
bool keepsCoordinates(const Dialect &dialect, const Block &block) {
  return llvm::all_of(codesOf(dialect, block), [&](CodeIndex index) {
    const CodeInfo &code = dialect.codes[index];
    return isMotion(code.action) || code.action == Action::Absolute ||
           code.action == Action::CompensationLeft || code.action == Action::CompensationRight ||
           code.action == Action::CompensationOff ||
           (code.letter == 'M' && code.action != Action::ToolChange) ||
           (code.group != noGroup && code.group == dialect.group(StandardGroup::LengthOffset));
  });
}

class TextBefore {
public:
  TextBefore(const RuleContext &ctx, std::array<Axis, 2> axes) : ctx_(ctx), axes_(axes) {
    for (size_t i = 0; i < 2; ++i) {
      const Interval share = shareOfDiameter(dialect(), ctx.before(), axes[i], Truth::No);
      isKnown_ &= share.isConstant();
      shares_[i] = share.lo / dialect().lengthsPerUnit(axes[i]);
    }
  }

  /// Reads back to the last move, and to the coordinates of its ends.
  bool read() {
    bool more = isKnown_ && readPrevious(ctx_, move_);
    while (more && isPlain(dialect(), move_) && keepsCoordinates(dialect(), move_) &&
           !axesOf(dialect(), move_))
      more = readBack(ctx_, move_);
    if (!more || !isPlain(dialect(), move_))
      return false;
    take(move_, end_);
    Block block = move_;
    for (unsigned i = 0; i < mostRead && !start_.isWhole(); ++i) {
      if (!keepsCoordinates(dialect(), block) || !readBack(ctx_, block) ||
          !isPlain(dialect(), block))
        return false;
      take(block, start_);
    }
    for (size_t i = 0; i < 2; ++i)
      if (!end_.at[i])
        end_.at[i] = start_.at[i];
    return start_.isWhole();
  }

  const Block &move() const { return move_; }
  Point start() const { return start_.point(); }
  Point end() const { return end_.point(); }

private:
  const Dialect &dialect() const { return ctx_.dialect(); }

  void take(const Block &block, Written &written) const {
    for (const Word &word : block.words)
      for (size_t i = 0; i < 2; ++i) {
        const AddressInfo &address = dialect().addresses[word.address];
        if (address.kind == AddressKind::Axis && address.axis == axes_[i] && word.isNumber() &&
            !written.at[i])
          written.at[i] = word.value() * shares_[i];
      }
  }

  const RuleContext &ctx_;
  const std::array<Axis, 2> axes_;
  std::array<double, 2> shares_{1, 1}; ///< millimetres of a coordinate, by its reading
  bool isKnown_ = true;
  Block move_;
  Written start_, end_;
};

/// Centre of the arc of a block by its words, from that start.
std::optional<Point> centreWritten(const RuleContext &ctx, const TextBefore &text, bool clockwise) {
  const ArcWords &current = ctx.arcWords(); // of the same plane
  if (const Word *radius = text.move().find(ctx.dialect().arcRadius))
    return radius->isNumber() ? centreByRadius(text.start(), text.end(), radius->value(), clockwise)
                              : std::nullopt;
  Point centre = text.start();
  for (size_t i = 0; i < 2; ++i)
    if (const Word *word = text.move().find(current.centreAddress[i])) {
      if (!word->isNumber())
        return std::nullopt;
      centre[i] += word->value();
    }
  return centre;
}

} // namespace

std::optional<Vector> directionBefore(const RuleContext &ctx) {
  const Dialect &dialect = ctx.dialect();
  const MachineState &before = ctx.before();
  const CodeInfo *motion = before.activeCode(dialect, StandardGroup::Motion);
  if (!motion || (motion->action != Action::Linear && !isArc(motion->action)) ||
      !keepsLengths(before.frames) ||
      (dialect.group(StandardGroup::Distance) != noGroup &&
       before.isActive(dialect, StandardGroup::Distance, {Action::Absolute}) != Truth::Yes))
    return std::nullopt;
  TextBefore text(ctx, ctx.arcWords().axes);
  if (!text.read())
    return std::nullopt;
  const Vector way = text.end() - text.start();
  if (motion->action == Action::Linear)
    return way.norm() < leastLength ? std::nullopt : std::optional<Vector>(way.normalized());
  const bool clockwise = motion->action == Action::ArcCw;
  const auto centre = centreWritten(ctx, text, clockwise);
  if (!centre || distance(*centre, text.end()) < leastLength)
    return std::nullopt;
  return Vector(leftOf(text.end() - *centre).normalized() * (clockwise ? -1 : 1));
}

} // namespace ncvet
