// The motions of cycles that mill along a contour, level by level.
#include "interp/cycles/contour_cycle.h"

namespace ncvet {

namespace {

class ContourMilling {
public:
  ContourMilling(const ContourCycle &cycle, llvm::function_ref<void(const Move &)> give)
      : cycle_(cycle), give_(give), at_(cycle.start) {}

  void run(llvm::ArrayRef<Move> contour) {
    aside();
    go(MoveKind::Rapid, cycle_.approach);
    for (const Interval &level : cycle_.levels) {
      go(MoveKind::Linear, level, cycle_.feedDown);
      along(contour, level);
      aside();
      go(MoveKind::Linear, level);
    }
    go(MoveKind::Rapid, cycle_.back);
  }

private:
  void give(const Move &move) {
    if (++given_ <= mostContourMoves)
      give_(move);
  }
  /// Beside the contour, nobody knows where.
  void aside() {
    for (unsigned i = 0; i < 3; ++i)
      if (i != unsigned(cycle_.tool))
        at_.to[i] = Interval::unknown();
  }
  void go(MoveKind kind, const Interval &level, const std::optional<Interval> &feed = {}) {
    at_.to[size_t(cycle_.tool)] = level;
    Move move = kind == MoveKind::Rapid ? at_ : cycle_.feed;
    move.kind = kind;
    move.to = at_.to;
    move.machineAxes = 0;
    if (feed)
      move.feed = *feed;
    give(move);
  }
  void along(llvm::ArrayRef<Move> contour, const Interval &level) {
    for (Move move : contour) {
      if (!cycle_.onContour) {
        aside();
        return go(MoveKind::Linear, level);
      }
      if (move.kind == MoveKind::Rapid)
        move.kind = MoveKind::Linear;
      move.to[size_t(cycle_.tool)] = level;
      move.feed = cycle_.feed.feed;
      move.feedMode = cycle_.feed.feedMode;
      at_.to = move.to;
      give(move);
    }
  }

  const ContourCycle &cycle_;
  const llvm::function_ref<void(const Move &)> give_;
  Move at_; ///< where the tool is
  size_t given_ = 0;
};

} // namespace

void millContour(const ContourCycle &cycle, llvm::ArrayRef<Move> contour,
                 llvm::function_ref<void(const Move &)> give) {
  ContourMilling(cycle, give).run(contour);
}

} // namespace ncvet
