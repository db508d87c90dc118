// Which brackets of loops and structured flow belong together in a program.
#pragma once

#include "formats/readers/reader.h"

#include "llvm/ADT/DenseMap.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace ncvet {

/// What is left out when control goes past a bracket. Two of them are apart, or one holds the
/// other.
struct FlowPart {
  uint32_t head;
  uint32_t past;  ///< offset of the first block after it
  uint32_t outer; ///< index of the smallest part that holds it; `~0u`: none
};

/// Offsets of blocks.
struct FlowShape {
  /// From a bracket to where control goes when the part after it is not run: from a loop's head
  /// after its end, from IF after its ELSE or ENDIF, from ELSE after ENDIF.
  llvm::DenseMap<uint32_t, uint32_t> past;
  /// From a loop's end to its head.
  llvm::DenseMap<uint32_t, uint32_t> back;
  /// From a branch (ELSEIF) or an exit of a loop to where control goes on.
  llvm::DenseMap<uint32_t, uint32_t> out;
  /// From a bracket whose label an earlier one of its program carries to that one. Those in
  /// branches of one IF that exclude each other do not count: the control reads the one that it
  /// takes.
  llvm::DenseMap<uint32_t, uint32_t> duplicates;
  std::vector<uint32_t> mismatched; ///< brackets without their partner, sorted
  std::vector<uint32_t> strayExits; ///< exits that are in no loop with their label, sorted
  std::vector<FlowPart> parts;      ///< those of `past`, by their heads
  unsigned depth = 0;               ///< of the deepest nesting
  /// The program holds a condition or a jump: not every run of it comes by the same blocks.
  bool branches = false;

  /// Whether the block is a bracket without its partner.
  bool isMismatched(uint32_t at) const {
    return std::binary_search(mismatched.begin(), mismatched.end(), at);
  }
  /// Head of a part that holds `target` and not `from`; none when no part does.
  std::optional<uint32_t> partEntered(uint32_t from, uint32_t target) const;
};

FlowShape readShape(const Reader &reader, uint32_t begin, uint32_t end);

} // namespace ncvet
