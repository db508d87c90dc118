// The tool path of a program for reports that draw it: motions with the modes under which they are
// made.
#pragma once

#include "analyzer/flow/analyze.h"
#include "formats/finding/tool_path.h"

namespace ncvet {

/// Follows the main program of `unit` along the one path that `trace` follows, as far as
/// `mostMoves`. The path beside compensated contours is added where a tool's radius is known.
ToolPath traceToolPath(Project &project, FileUnit &unit, const AnalysisLimits &limits,
                       size_t mostMoves);

/// What is known of the machine, of a mill or lathe of that dialect.
PathMachine pathMachine(const MachineProfile &profile, const Dialect &dialect);

} // namespace ncvet
