// Whether a round tool that runs beside a contour reaches each of its elements.
#pragma once

#include "interp/geometry/contour_element.h"

#include "llvm/ADT/ArrayRef.h"

namespace ncvet {

/// How the paths beside two elements that follow each other meet.
struct CornerFit {
  enum class Kind : uint8_t {
    Smooth,  ///< end to end
    Inside,  ///< they cross: both are cut off there
    Outside, ///< the tool goes round the corner
    Apart,   ///< an inside corner in which they do not cross
    None     ///< one of them does not exist: an inside arc has no room for the tool
  };
  Kind kind = Kind::None;
  double ofFirst = 0;  ///< mm that the path beside the first element loses at its end
  double ofSecond = 0; ///< mm that the path beside the second element loses at its beginning
  double gain = 0;     ///< Outside: mm by which either may go on towards the other
  double sine = 0;     ///< of the angle by which the contour turns
  Vector meet{0, 0};   ///< Inside: where they cross; Smooth: where they join
};

/// `left`: distance of the tool's centre in mm, below zero on the right.
CornerFit fitCorner(const ContourElement &first, const ContourElement &second, double left);
/// As above. `in`, `out`: unit vectors along the first element's end and the second one's begin.
CornerFit fitCorner(const ContourElement &first, const ContourElement &second, const Vector &in,
                    const Vector &out, double left);
/// As above, of a control that takes directions which differ by no more than `nearly` radians for
/// one (0: none does): such elements meet end to end, or the second one leads straight back. Back
/// from or onto an arc that the tool passes on its outer side it stays on that side, and goes round
/// the end of everything else (rs274 of LinuxCNC 2.9).
CornerFit fitCorner(const ContourElement &first, const ContourElement &second, const Vector &in,
                    const Vector &out, double left, double nearly);

/// What does not fit.
enum class Misfit : uint8_t {
  Fits,
  Arc,    ///< an inside arc is smaller than the tool
  Corner, ///< the paths beside an element and its next one do not meet
  Element ///< the corners at its two ends leave nothing of the path beside an element
};

/// What is before and after an element; null for the path on or off, which the tool takes from
/// and to the point beside the element's end.
struct Neighbours {
  const ContourElement *before = nullptr, *after = nullptr;
  bool unknownBefore = false, unknownAfter = false; ///< something does, but it is not known
};

/// What the two corners of an element take of the path beside it.
struct ElementCorners {
  CornerFit begin, end;                             ///< None: nothing is there
  bool unknownBefore = false, unknownAfter = false; ///< something does, but it is not known
};

/// A cut that is not deeper (mm) is rounding of a program, not a fault.
constexpr double shallowCut = 0.01;

/// `exact`: a path beside an element that turns back is a misfit although the tool stays clear of
/// the contour there, as where it goes down a step that is lower than its radius. `slack`: how far
/// (mm) it may cut into a neighbour; with none of it an inside arc has to be larger than the tool.
Misfit misfit(const ContourElement &element, const Neighbours &neighbours, double left, bool exact,
              double slack = shallowCut);
/// As above, of corners that are known already.
Misfit misfit(const ContourElement &element, const ElementCorners &corners, double left, bool exact,
              double slack = shallowCut);

/// The largest radius (mm) whose paths fit everywhere beside that contour, on its left or its
/// right; none when any does. Its first two and last two elements, which may be paths on and off,
/// count as no material for the other elements.
std::optional<double> largestFit(llvm::ArrayRef<ContourElement> contour, bool onLeft);
/// The largest radius for which `misfit` is none.
std::optional<double> largestFit(const ContourElement &element, const Neighbours &neighbours,
                                 bool onLeft, bool exact);

} // namespace ncvet
