// What the formulas of a cycle give for its motions, and what a cycle does its own way.
#pragma once

#include "formats/dialect/dialect.h"

namespace ncvet {

/// A quantity of a cycle, by the name that tables give it. Lengths are in the program's unit, X of
/// allowances as it is programmed; levels and places are absolute.
enum class Measure : uint8_t {
  // turning along a contour
  AllowanceX, ///< what finishing leaves, as X is programmed
  AllowanceZ,
  LastCutX, ///< radius: what roughing leaves besides, for one more pass along the contour
  LastCutZ,
  SpreadX, ///< radius: from the first of the repeated contours to the last one
  SpreadZ,
  Retract, ///< away from the work between two passes, or to break the chip
  // threads
  Height,        ///< radius: depth of the thread
  FirstCut,      ///< radius: depth of the first pass
  LeastCut,      ///< radius: no pass takes less
  LastCut,       ///< radius: what the last pass takes, or all finishing passes
  FinishPasses,  ///< passes at the finishing allowance, or without infeed
  RunOut,        ///< length of the retract from the thread along it, in leads
  RunOutAngle,   ///< degrees
  FlankAngle,    ///< degrees between the flanks; the infeed follows half of it
  ConstantDepth, ///< not 0: each pass is as deep as the first
  BothFlanks,    ///< not 0: straight in, no flank is followed
  // along the tool axis
  Back,       ///< level of the return
  Approach,   ///< level from which the tool is fed
  Top,        ///< level from which depths count; left out: that of the approach
  Bottom,     ///< level of the last depth
  BottomRest, ///< what is left there
  FirstDepth, ///< level of the first peck
  Reduction,  ///< by which each peck is smaller than the one before; none is smaller than it
  Step,       ///< from one depth to the next
  MostStep,   ///< the same, when the control may take less
  ChipBreak,  ///< not 0: between two pecks the tool stays in the hole
  Dwell,      ///< seconds at the bottom; below zero: turns of the spindle
  DwellTop,   ///< the same outside the hole
  // areas in the plane
  CentreFirst, ///< place along the plane's first axis
  CentreSecond,
  Length,    ///< along the first axis
  Width,     ///< along the second one
  Radius,    ///< of a circle
  Rounding,  ///< radius of the corners
  Angle,     ///< degrees from the first axis to the length
  SideRest,  ///< what is left at the walls
  Count,     ///< of like areas
  Direction, ///< 2: clockwise round the area
  Island,    ///< 1: the area is what stays
  FeedDown,  ///< mm/min
  FeedAlong,
  // passes along a turned contour
  FirstDistance, ///< from the contour, of the first pass
  LastDistance,
  Pockets, ///< 0: all is cut, 1: but the pockets, 2: these alone
  Across,  ///< not 0: levels run along X
  // threads from place to place
  Lead,  ///< of the thread, after the place `index()` where that is one of a chain
  Inside ///< 1: the thread is cut in a bore
};
llvm::ArrayRef<llvm::StringLiteral> measureNames();
/// Of `Measure::Direction`, as G02.
constexpr double clockwiseDirection = 2;

/// How a control makes the motions of a cycle.
enum class CycleTrait : uint8_t {
  FollowsContour, ///< each roughing pass ends along the contour, up to the pass before
  ReturnsByAxes,  ///< back to the start the axis that leaves the work goes first
  IgnoresCorners, ///< corners and lines by angle in the contour do not count
  WantsHole,      ///< goes straight down where a hole must be
  StartsHere,     ///< begins where the tool is, or at the axis words of its block; stays down
  Turned,         ///< makes passes along a turned contour, see `ProfilePasses`
  TurnsContour,   ///< the contour that its word names is turned; how it is roughed is not known
  KeepsWords      ///< goes on with the words of a cycle of this trait that was in force
};
llvm::ArrayRef<llvm::StringLiteral> cycleTraitNames();

/// Whether the cycle has that trait.
inline bool has(const CodeInfo &code, CycleTrait trait) {
  return code.traits >> unsigned(trait) & 1;
}

/// The cycle's formula for a quantity; null when it has none.
inline const Formula *formulaOf(const CodeInfo &code, Measure what) {
  for (const CycleMeasure &measure : code.measures)
    if (measure.what == what)
      return &measure.formula;
  return nullptr;
}

} // namespace ncvet
