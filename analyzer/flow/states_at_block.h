// The machine's states at one block, on all ways that lead there.
#pragma once

#include "analyzer/flow/observed_block.h"
#include "analyzer/rule/analysis_limits.h"
#include "analyzer/rule/selection.h"

#include <atomic>

namespace ncvet {

class StraightRuns;

/// The states before and after the block of `unit` that begins at `offset`, when the file `entry`
/// runs with all that it calls. At most eight paths are told apart.
StatesAt statesAt(Project &project, FileUnit &entry, const FileUnit &unit, uint32_t offset,
                  const AnalysisLimits &limits = {}, const std::atomic<bool> *cancel = nullptr);

/// The same for a block of `unit` itself, with what checks of it under these rules have followed.
StatesAt statesAt(Project &project, FileUnit &unit, uint32_t offset, const RuleSelection &rules,
                  const AnalysisLimits &limits, const std::atomic<bool> *cancel,
                  StraightRuns &runs);
/// The same after a check has followed all of this text: rules need not hear of it again.
StatesAt statesAfterCheck(Project &project, FileUnit &unit, uint32_t offset,
                          const AnalysisLimits &limits, const std::atomic<bool> *cancel,
                          StraightRuns &runs);

} // namespace ncvet
