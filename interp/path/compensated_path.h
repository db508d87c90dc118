// Puts radius compensation into a path: the motions of the tool's centre.
#pragma once

#include "formats/dialect/machine.h"
#include "interp/geometry/contour_fit.h"

#include "llvm/ADT/STLFunctionalExtras.h"
#include "llvm/ADT/SmallVector.h"

namespace ncvet {

/// How the tool goes round an outside corner.
enum class OutsideCorner : uint8_t {
  Arc,      ///< round the corner's point
  Lines,    ///< on to where the paths meet, or along a square's sides where the corner is sharp
  ArcOfNext ///< as Arc, by the block of the second element: after what is between the two, and
            ///< straight when that element is a rapid move
};

/// What controls do differently.
struct CompensationHabits {
  OutsideCorner outside = OutsideCorner::Arc;
  /// The path on ends square to itself, and the first corner lies between it and the first element;
  /// else it ends beside where that element begins.
  bool entryAcross = false;
  double straight = 0; ///< radians: elements whose directions differ by less meet without a corner
};

/// Those that the profile states, else those of the control.
CompensationHabits habitsOf(const Dialect &dialect, const MachineProfile &machine);

/// Takes moves one after the other and gives on where the tool's centre goes. Each waits for the
/// next one in the plane, which tells where the path beside it ends. Moves without compensation, or
/// with a radius that is zero or not known, are given on as they are.
class CompensatedPath {
public:
  using Take = llvm::function_ref<void(uint64_t tag, const Move &)>;

  CompensatedPath(const Dialect &dialect, const CompensationHabits &habits)
      : dialect_(dialect), habits_(habits) {}

  /// `tag` comes back with the move, and with what is put in after it.
  void add(uint64_t tag, const Move &move, Take take);
  /// Nothing follows: what waits is given on.
  void finish(Take take);
  /// Nothing waits, and the last move ended on the path.
  bool isIdle() const { return !waiting_ && !on_; }
  /// Whether both, in which nothing waits, make the same of what follows.
  bool goesOnAs(const CompensatedPath &other) const {
    return isIdle() && other.isIdle() && programmed_ == other.programmed_ &&
           centre_ == other.centre_;
  }

private:
  struct Tagged {
    uint64_t tag = 0;
    Move move;
  };
  void meet(const ContourElement &next, const Tagged &after, Take take);
  void give(Tagged &tagged, const Vector &end, Take take);
  void goAlongLines(const ContourElement &next, Take take);
  void goRound(const ContourElement &element, const ContourElement &next, const Tagged &like,
               Take take);
  bool isStraight(const ContourElement &next) const;
  std::optional<ContourElement> entryOf(const std::optional<ContourElement> &element) const;
  void flush(Take take);

  const Dialect &dialect_;
  CompensationHabits habits_;
  Place programmed_; ///< where the last programmed move ended
  Place centre_;     ///< where the tool's centre is
  std::optional<Tagged> waiting_;
  /// Of the waiting move; none: it builds compensation up, and ends beside the next one's begin.
  std::optional<ContourElement> element_;
  double left_ = 0;         ///< mm, of the waiting move
  double furtherTurns_ = 0; ///< of the waiting arc, beside the one that leads to its end
  llvm::SmallVector<Tagged, 4> between_; ///< what is between it and the next one
  bool on_ = false;                      ///< the last move ended beside the path
};

} // namespace ncvet
