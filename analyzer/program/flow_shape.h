// Which brackets of loops and structured flow belong together in a program.
#pragma once

#include "formats/readers/reader.h"

#include "llvm/ADT/DenseMap.h"

#include <vector>

namespace ncvet {

/// Offsets of blocks.
struct FlowShape {
  /// From a bracket to where control goes when the part after it is not run: from a loop's head
  /// after its end, from IF after its ELSE or ENDIF, from ELSE after ENDIF.
  llvm::DenseMap<uint32_t, uint32_t> past;
  /// From a loop's end to its head.
  llvm::DenseMap<uint32_t, uint32_t> back;
  /// From a branch (ELSEIF) or an exit of a loop to where control goes on.
  llvm::DenseMap<uint32_t, uint32_t> out;
  /// From a bracket whose label an earlier one of its program carries to that one.
  llvm::DenseMap<uint32_t, uint32_t> duplicates;
  std::vector<uint32_t> mismatched; ///< brackets without their partner
  std::vector<uint32_t> strayExits; ///< exits that are in no loop with their label
  unsigned depth = 0;               ///< of the deepest nesting
  /// The program holds a condition or a jump: not every run of it comes by the same blocks.
  bool branches = false;
};

FlowShape readShape(const Reader &reader, uint32_t begin, uint32_t end);

} // namespace ncvet
