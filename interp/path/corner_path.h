// Puts the corners between two moves where the program asks for them: chamfers, roundings, and
// lines whose end only the next block tells.
#pragma once

#include "interp/geometry/contour_element.h"
#include "interp/state/executed_block.h"

#include <optional>

namespace ncvet {

/// What a block's words ask for at the end of its move.
struct CornerRequest {
  enum class Kind : uint8_t { None, Legs, Across, Rounding };
  Kind kind = Kind::None; ///< chamfer by its legs, by its own length, or rounding
  double size = 0;        ///< mm, above zero
  /// Direction of a straight line in degrees from the plane's first axis.
  std::optional<double> angle;
  Place said;           ///< the point that the words give, which need not be the line's end
  uint16_t axes = 0;    ///< bit per axis that the block programs
  bool shifts = false;  ///< coordinates are others after the block
  bool farther = false; ///< of two intersections, the second one along the line
};

/// Whether the letter of a rotary axis is a chamfer in this block: beside a move of the other axes,
/// while the main spindle turns and the feed counts by its turns, so that it cannot be positioned.
bool isCornerOfAxis(const Dialect &dialect, const Block &block, const MachineState &state);

/// The words of a control that ask for corners, looked up once.
class CornerWords {
public:
  explicit CornerWords(const Dialect &dialect);
  CornerRequest read(const ExecutedBlock &executed) const;

private:
  AddressMask legs_ = 0, across_ = 0, rounding_ = 0, angle_ = 0, all_ = 0;
};

/// Takes moves one after the other, and gives them on with the corners put in.
class CornerPath {
public:
  using Take = llvm::function_ref<void(uint64_t tag, const Move &)>;

  explicit CornerPath(const Dialect &dialect) : dialect_(dialect), travel_(dialect, plane_) {}

  /// `tag` comes back with the move, and with what is put in after it.
  void add(uint64_t tag, const Move &move, const CornerRequest &corner,
           const std::array<Axis, 2> &plane, Take take);
  /// Nothing follows: what waits is given on as it is.
  void finish(Take take);
  /// Straight moves to known places, with no corner at their ends, need not be added while this
  /// holds; `resume` tells where they have led.
  bool isIdle() const { return !waiting_ && !resolved_; }
  /// `last`: the last one of the moves that were not added, begun at `from`.
  void resume(const Place &from, const Move &last);
  /// Whether both, in which nothing waits, make the same of what follows.
  bool goesOnAs(const CornerPath &other) const {
    return isIdle() && other.isIdle() && from_ == other.from_ && direction_ == other.direction_ &&
           directionPlane_ == other.directionPlane_ && plane_ == other.plane_;
  }

private:
  struct Waiting {
    uint64_t tag = 0;
    Move move;
    CornerRequest corner;
    std::array<Axis, 2> plane{Axis::X, Axis::Y};
  };
  void resolve(Waiting &first, Waiting &second, Take take);
  bool putCorner(Waiting &first, Waiting &second, Take take);
  void give(uint64_t tag, const Move &move, Take take);
  void carry(Move &move, const CornerRequest &corner) const;
  void findCentre(Move &move) const;

  const Dialect &dialect_;
  std::optional<Waiting> waiting_;
  Place from_;            ///< where the waiting move begins
  uint32_t resolved_ = 0; ///< bit per axis whose place only this class knows
  /// Direction in which the last move of a plane ended, with that plane's axes.
  std::optional<std::array<double, 2>> direction_;
  std::array<Axis, 2> directionPlane_{};
  std::array<Axis, 2> plane_{Axis::X, Axis::Y}; ///< the active one
  ContourPlane travel_;                         ///< of the last move that was given on
};

} // namespace ncvet
