// Frames: how the coordinates that a program writes lie in those of its work offset.
#include "interp/geometry/frame.h"

#include "interp/geometry/direction.h"

#include "llvm/ADT/Hashing.h"
#include "llvm/ADT/STLExtras.h"
#include "llvm/ADT/bit.h"
#include <Eigen/Geometry>

#include <cmath>

namespace ncvet {

namespace {

using Map = Eigen::Transform<double, 3, Eigen::AffineCompact>;
using SpaceVector = Eigen::Vector3d;

/// A coefficient this small is the rounding of a zero: cos 90 degrees.
constexpr double zero = 1e-15;

Map mapOf(const Frame &frame) {
  Map map;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      map.linear()(i, j) = frame.turn[size_t(i)][size_t(j)];
    map.translation()(i) = frame.shift[size_t(i)];
  }
  return map;
}

Frame frameOf(const Map &map) {
  Frame frame;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double x = map.linear()(i, j);
      frame.turn[size_t(i)][size_t(j)] = std::fabs(x) < zero ? 0 : x;
    }
    frame.shift[size_t(i)] = map.translation()(i);
  }
  return frame;
}

SpaceVector vectorOf(const std::array<double, 3> &v) { return {v[0], v[1], v[2]}; }

/// `linear` with `centre` kept where it is.
Map about(const SpaceVector &centre, const Eigen::Matrix3d &linear) {
  Map map;
  map.linear() = linear;
  // Axis by axis: a centre that is not known spoils only what is turned or scaled about it.
  const Eigen::Matrix3d rest = Eigen::Matrix3d::Identity() - linear;
  for (int i = 0; i < 3; ++i) {
    map.translation()(i) = 0;
    for (int j = 0; j < 3; ++j)
      if (std::fabs(rest(i, j)) > zero)
        map.translation()(i) += rest(i, j) * centre(j);
  }
  return map;
}

} // namespace

Frame Frame::shifted(const std::array<double, 3> &by) {
  Frame frame;
  frame.shift = by;
  return frame;
}

Frame Frame::turned(unsigned axis, double degrees, const std::array<double, 3> &centre) {
  const Eigen::AngleAxisd rotation(radiansOf(degrees), SpaceVector::Unit(int(axis)));
  return frameOf(about(vectorOf(centre), rotation.toRotationMatrix()));
}

Frame Frame::scaled(const std::array<double, 3> &factors, const std::array<double, 3> &centre) {
  return frameOf(about(vectorOf(centre), vectorOf(factors).asDiagonal()));
}

Frame Frame::ofRows(const std::array<double, 12> &rows) {
  constexpr size_t width = 4;
  Frame frame;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j)
      frame.turn[i][j] = rows[i * width + j];
    frame.shift[i] = rows[i * width + 3];
  }
  return frame;
}

double Frame::stretchOf(size_t axis) const { return mapOf(*this).linear().col(int(axis)).norm(); }

bool Frame::keepsLengths() const {
  constexpr double same = 1e-9;
  const Eigen::Matrix3d linear = mapOf(*this).linear();
  const Eigen::Matrix3d products = linear.transpose() * linear;
  return (products - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= same;
}

bool Frame::keepsCircles(size_t a, size_t b) const {
  const size_t normal = 3 - a - b;
  const bool tilts =
      turn[normal][a] != 0 || turn[normal][b] != 0 || turn[a][normal] != 0 || turn[b][normal] != 0;
  constexpr double sameLength = 1e-9;
  return !tilts && std::fabs(stretchOf(a) - stretchOf(b)) < sameLength;
}

bool Frame::mirrors(size_t a, size_t b) const {
  return turn[a][a] * turn[b][b] - turn[a][b] * turn[b][a] < 0;
}

std::optional<Frame> Frame::inverse() const {
  const Map map = mapOf(*this);
  if (std::fabs(map.linear().determinant()) < zero)
    return std::nullopt;
  Map back;
  back.linear() = map.linear().inverse();
  back.translation().setZero();
  Frame frame = frameOf(back);
  const auto shifted = frame * Frame::shifted(shift);
  for (size_t i = 0; i < 3; ++i)
    frame.shift[i] = -shifted.shift[i];
  return frame;
}

Frame operator*(const Frame &outer, const Frame &inner) {
  Map map;
  map.linear() = mapOf(outer).linear() * mapOf(inner).linear();
  map.translation().setZero();
  Frame frame = frameOf(map);
  // By hand: a shift that is not known must not reach the axes that do not depend on it.
  for (size_t i = 0; i < 3; ++i) {
    frame.shift[i] = outer.shift[i];
    for (size_t j = 0; j < 3; ++j)
      if (outer.turn[i][j] != 0)
        frame.shift[i] += outer.turn[i][j] * inner.shift[j];
  }
  return frame;
}

Point3 operator*(const Frame &frame, const Point3 &place) {
  Point3 result;
  for (size_t i = 0; i < 3; ++i) {
    Interval sum =
        std::isnan(frame.shift[i]) ? Interval::unknown() : Interval::exactly(frame.shift[i]);
    for (size_t j = 0; j < 3; ++j)
      if (frame.turn[i][j] != 0)
        sum = place[j].isUnknown() || sum.isUnknown() ? Interval::unknown()
                                                      : sum + place[j] * frame.turn[i][j];
    result[i] = sum;
  }
  return result;
}

std::optional<Frame> FrameStack::total() const {
  Frame result;
  if (data_)
    for (const Entry &entry : data_->entries) {
      if (!entry.frame)
        return std::nullopt;
      result = result * *entry.frame;
    }
  return result;
}

std::optional<Frame> FrameStack::find(uint8_t name) const {
  if (data_)
    for (const Entry &entry : data_->entries)
      if (entry.name == name)
        return entry.frame;
  return std::nullopt;
}

bool FrameStack::has(uint8_t name) const {
  return data_ && llvm::any_of(data_->entries, [&](const Entry &e) { return e.name == name; });
}

void FrameStack::put(uint8_t name, const std::optional<Frame> &frame) {
  if (frame && *frame == Frame()) // G52 with zeros
    return remove(name);
  auto &entries = ownEntries(data_);
  for (Entry &entry : entries)
    if (entry.name == name) {
      entry.frame = frame;
      return;
    }
  entries.push_back({name, frame});
}

void FrameStack::remove(uint8_t name) {
  if (!data_)
    return;
  auto &entries = ownEntries(data_);
  llvm::erase_if(entries, [&](const Entry &entry) { return entry.name == name; });
  if (entries.empty())
    data_ = nullptr;
}

FrameStack FrameStack::join(const FrameStack &a, const FrameStack &b) {
  if (a == b)
    return a;
  FrameStack unknown;
  constexpr uint8_t noName = 0xFF;
  unknown.put(noName, std::nullopt);
  return unknown;
}

namespace {
bool same(const std::optional<Frame> &a, const std::optional<Frame> &b) {
  if (!a || !b)
    return !a && !b;
  for (size_t i = 0; i < 3; ++i) // a shift that is not known equals itself
    if (a->turn[i] != b->turn[i] ||
        llvm::bit_cast<uint64_t>(a->shift[i]) != llvm::bit_cast<uint64_t>(b->shift[i]))
      return false;
  return true;
}
} // namespace

bool operator==(const FrameStack &a, const FrameStack &b) {
  if (a.data_ == b.data_)
    return true;
  if (!a.data_ || !b.data_)
    return false;
  const auto &left = a.data_->entries, &right = b.data_->entries;
  return std::equal(left.begin(), left.end(), right.begin(), right.end(),
                    [](const FrameStack::Entry &x, const FrameStack::Entry &y) {
                      return x.name == y.name && same(x.frame, y.frame);
                    });
}

uint64_t FrameStack::hash() const {
  uint64_t result = 0;
  if (data_)
    for (const Entry &entry : data_->entries) {
      result = llvm::hash_combine(result, entry.name, entry.frame.has_value());
      if (entry.frame)
        for (size_t i = 0; i < 3; ++i) {
          result = llvm::hash_combine(result, llvm::bit_cast<uint64_t>(entry.frame->shift[i]));
          for (const double x : entry.frame->turn[i])
            result = llvm::hash_combine(result, llvm::bit_cast<uint64_t>(x));
        }
    }
  return result;
}

} // namespace ncvet
