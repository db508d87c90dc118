// Frames: how the coordinates that a program writes lie in those of its work offset.
#pragma once

#include "interp/value/shared_list.h"
#include "interp/value/value.h"

#include "llvm/ADT/SmallVector.h"

#include <array>
#include <optional>

namespace ncvet {

/// An affine map of X, Y and Z: `turn` times the point, plus `shift`. Lengths in millimetres, X of
/// a lathe as programmed. A shift that is NaN is not known.
struct Frame {
  std::array<std::array<double, 3>, 3> turn{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<double, 3> shift{};

  static Frame shifted(const std::array<double, 3> &by);
  /// Turned about the axis 0, 1 or 2 through `centre`, in degrees, counter-clockwise.
  static Frame turned(unsigned axis, double degrees, const std::array<double, 3> &centre);
  /// Lengths from `centre` multiplied; a factor of -1 mirrors.
  static Frame scaled(const std::array<double, 3> &factors, const std::array<double, 3> &centre);

  /// The whole map: its rows, each of three factors and a shift.
  static Frame ofRows(const std::array<double, 12> &rows);

  /// By how much lengths along the axis 0, 1 or 2 are stretched.
  double stretchOf(size_t axis) const;
  /// Whether lengths are the same inside and outside.
  bool keepsLengths() const;
  /// Whether a circle in the plane of two axes stays one, in that plane.
  bool keepsCircles(size_t a, size_t b) const;
  /// Whether what turns counter-clockwise in the plane of two axes turns clockwise outside.
  bool mirrors(size_t a, size_t b) const;

  /// None when it flattens space: a factor of zero.
  std::optional<Frame> inverse() const;
  /// First `inner`, then `outer`.
  friend Frame operator*(const Frame &outer, const Frame &inner);
  friend bool operator==(const Frame &a, const Frame &b) {
    return a.turn == b.turn && a.shift == b.shift;
  }
};

using Point3 = std::array<Interval, 3>;

/// The map of a place of which some coordinates may not be known: each result is known when all
/// that it is made of are.
Point3 operator*(const Frame &frame, const Point3 &place);

/// The frames in force, in the order in which they were switched on: a later one lies in the
/// earlier ones. Copies share their storage until one of them is changed.
class FrameStack {
public:
  bool empty() const { return !data_; }
  /// From programmed coordinates to those of the work offset; none when one of them is not known.
  std::optional<Frame> total() const;
  /// The frame with that name; none: there is none, or it is not known.
  std::optional<Frame> find(uint8_t name) const;
  bool has(uint8_t name) const;
  /// Replaces the frame with that name, or lays a new one into the others; `nullopt`: not known.
  void put(uint8_t name, const std::optional<Frame> &frame);
  void remove(uint8_t name);
  void clear() { data_ = nullptr; }

  /// What is certain in both: they are the same, or nothing is known.
  static FrameStack join(const FrameStack &a, const FrameStack &b);
  friend bool operator==(const FrameStack &a, const FrameStack &b);
  uint64_t hash() const;

private:
  struct Entry {
    uint8_t name;
    std::optional<Frame> frame;
  };
  using Entries = llvm::SmallVector<Entry, 2>;
  llvm::IntrusiveRefCntPtr<SharedList<Entries>>
      data_; ///< null: programmed coordinates are those of the offset
};

} // namespace ncvet
