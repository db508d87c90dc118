// Puts radius compensation into a path: the motions of the tool's centre.
#pragma once

#include "interp/contour_fit.h"

#include "llvm/ADT/STLFunctionalExtras.h"
#include "llvm/ADT/SmallVector.h"

namespace ncvet {

/// How the tool goes round an outside corner.
enum class OutsideCorner : uint8_t {
  Arc,  ///< round the corner's point
  Lines ///< on to where the ways meet, or along a square's sides where the corner is sharp
};

/// Takes moves one after the other and gives on where the tool's centre goes. Each waits for the
/// next one in the plane, which tells where the way beside it ends. Moves without compensation, or
/// with a radius that is zero or not known, are given on as they are.
class CompensatedPath {
public:
  using Take = llvm::function_ref<void(uint64_t tag, const Move &)>;

  CompensatedPath(const Dialect &dialect, OutsideCorner corners)
      : dialect_(dialect), corners_(corners) {}

  /// `tag` comes back with the move, and with what is put in behind it.
  void add(uint64_t tag, const Move &move, Take take);
  /// Nothing follows: what waits is given on.
  void finish(Take take);

private:
  struct Tagged {
    uint64_t tag = 0;
    Move move;
  };
  void meet(const ContourElement &next, Take take);
  void give(Tagged &tagged, const Vector &end, Take take);
  void goAlongLines(const ContourElement &next, Take take);
  void flush(Take take);

  const Dialect &dialect_;
  OutsideCorner corners_;
  Place programmed_; ///< where the last programmed move ended
  Place centre_;     ///< where the tool's centre is
  std::optional<Tagged> waiting_;
  std::optional<ContourElement> element_; ///< of the waiting move; none: it builds compensation up
  double left_ = 0;                       ///< mm, of the waiting move
  llvm::SmallVector<Tagged, 4> behind_;   ///< what stands between it and the next one
  bool on_ = false;                       ///< the last move ended beside the path
};

} // namespace ncvet
