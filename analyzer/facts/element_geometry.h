// Named elements of a contour as points, lines and circles of the plane.
#pragma once

#include "analyzer/rule/rule.h"

#include <map>
#include <optional>

namespace ncvet {

/// A point, a straight line without ends, or a whole circle; millimetres in the plane of X and Y.
struct ElementGeometry {
  enum class Kind : uint8_t { Point, Line, Circle };
  Kind kind = Kind::Point;
  double x = 0, y = 0;   ///< the point, one of the line, or the circle's centre
  double size = 0;       ///< direction of the line in degrees, or the circle's radius
  uint32_t switches = 0; ///< of the dialect that may have been on: they may move what is defined
};

/// The element that the current block defines: `P1 = X0 Y0`, `L1 = G1 X0 Y0 RC45`,
/// `O1 = G2 I0 J0 R20`. None when its words are not known, the plane is another one, or a
/// frame is on.
std::optional<ElementGeometry> definedElement(const RuleContext &ctx);

/// What the program has defined so far, by name and number.
class ElementTable {
public:
  /// At a block that defines an element.
  void define(const RuleContext &ctx);
  /// The element that the word names, or null when it is not known.
  const ElementGeometry *find(const Word &word) const;
  const auto &remembered() const { return elements_; }

private:
  std::map<std::pair<AddressId, int64_t>, ElementGeometry> elements_;
};

/// Whether the two have a point in common, within a hundredth of a millimetre; two points are taken
/// as joined by a line.
bool meet(const ElementGeometry &a, const ElementGeometry &b);

} // namespace ncvet
