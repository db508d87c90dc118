// Groups and members of a dialect's tables, as bit sets that are tested with every block.
#pragma once

#include "formats/dialect/machine.h"

namespace ncvet {

/// What the transfer function asks of tables and profile with every block, looked up once.
struct ModeMasks {
  GroupIndex motion, cycle, units, distance, polar, language, diameter, feedMode;
  uint64_t everyBlock = 0; ///< groups that every block depends on
  uint64_t cancelled = 0;  ///< members of the cycle group that mean "no cycle"
  uint64_t inch = 0, metric = 0;
  uint64_t incremental = 0;
  uint64_t polarOn = 0;
  uint64_t foreign = 0;          ///< members of the language group that are not the control's own
  uint64_t diameterOn = 0;       ///< words of X are diameters, its coordinates radii
  uint64_t diameterAbsolute = 0; ///< … where they are no increments
  uint64_t timeOfBlock = 0;      ///< feed modes in which every block has an F of its own
  bool pointlessIsIncrement = false; ///< the profile reads `X100` as 0.1 mm

  ModeMasks(const Dialect &dialect, const MachineProfile &machine);
};

} // namespace ncvet
