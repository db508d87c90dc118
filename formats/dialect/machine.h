// A machine profile: what a program alone cannot tell about the machine that will run it.
#pragma once

#include "formats/dialect/dialect.h"

#include <map>

namespace ncvet {

struct AxisLimits {
  std::optional<double> min, max; ///< machine coordinates, mm or degrees
};

struct ToolData {
  std::string kind; ///< endmill, ballmill, …, turning, grooving, threading, probe; empty: unknown
  std::optional<double> radius, length, pitch, width; ///< mm
  std::optional<int> tip;                             ///< nose direction 0…9
};

/// A box; where it has no bound it has no end.
struct Stock {
  std::array<std::optional<double>, 3> min, max; ///< work coordinates, X Y Z
};

/// Everything optional: where a value is absent, the rules that need it stay silent.
struct MachineProfile {
  std::string dialect;
  std::array<AxisLimits, axisCount> axes;
  std::optional<double> spindleMin, spindleMax; ///< 1/min
  std::optional<double> feedMax, rapid;         ///< mm/min
  bool hasTools = false;                        ///< a tool list was given, even an empty one
  std::map<int, ToolData> tools;
  /// Machine coordinates of a work offset's origin, by code name ("G54"); of the place to which a
  /// code leads ("G28"); of the shift over all work offsets ("G92").
  std::map<std::string, std::array<std::optional<double>, axisCount>> offsets;
  std::optional<Stock> stock;
  std::vector<Stock> clamps;            ///< and all else beside the part that a tool must go round
  llvm::StringMap<std::string> options; ///< text form of the JSON value

  /// Value of an option, or none when the profile does not say.
  std::optional<llvm::StringRef> option(llvm::StringRef name) const;
  std::optional<double> number(llvm::StringRef name) const;
  /// An option that gives names to names; empty when the profile does not say.
  std::map<std::string, std::string> names(llvm::StringRef name) const;
};

} // namespace ncvet
