// The budgets of an analysis.
#pragma once

#include <cstdint>

namespace ncvet {

/// Budgets, each with its reason. The defaults suit batch use.
struct AnalysisLimits {
  /// Blocks executed again (loops, calls), statements counted as several: one to two seconds.
  uint64_t repeatedBlocks = 3'000'000;
  /// Calls inside calls: no control allows more than ten, the rest is room for findings.
  unsigned callDepth = 32;
  /// Findings of one rule in one file: more are noise.
  unsigned findingsPerRule = 1000;
  /// Bytes that the process may hold; 0: as many as it takes. Who asks for less than an analysis
  /// takes is told how far it came.
  uint64_t memory = 0;
};

} // namespace ncvet
