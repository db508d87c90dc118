// What is said of blocks that no path reaches.
#pragma once

#include "analyzer/flow/flow_run.h"
#include "analyzer/reuse/run_cache.h"

namespace ncvet {

/// Reads the blocks of the file that were not executed: what the control cannot read stops it when
/// the program is loaded. Only what the text alone decides is told to the rules. `runs`, when
/// given, holds text of which nothing was to be said.
void inspectUnreached(FlowRun &run, StraightRuns *runs);

} // namespace ncvet
