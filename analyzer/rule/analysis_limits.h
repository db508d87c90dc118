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
};

} // namespace ncvet
