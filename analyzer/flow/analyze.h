// The facade: checks one program with everything that it calls.
#pragma once

#include "analyzer/flow/analysis_result.h"
#include "analyzer/program/project.h"
#include "analyzer/rule/analysis_limits.h"
#include "analyzer/rule/selection.h"

#include <atomic>

namespace ncvet {

class StraightRuns;
struct OuterCalls; // analyzer/flow/outer_calls.h

/// Checks the file `unit` of `project` with all that it calls. `cancel`, when given, ends the
/// analysis early (it is looked at every 256 blocks). `runs`, when given, holds what earlier
/// analyses of the file have followed, moved with its text, under the same rules; the result is the
/// same. `outer`: when the file is one of many.
AnalysisResult analyze(Project &project, FileUnit &unit, const RuleSelection &rules,
                       const AnalysisLimits &limits = {}, const std::atomic<bool> *cancel = nullptr,
                       StraightRuns *runs = nullptr, const OuterCalls *outer = nullptr);

} // namespace ncvet
