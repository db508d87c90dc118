// Fixes that put a block before one that something names: it is to be run by those who come from
// there, too.
#pragma once

#include "analyzer/flow/flow_run.h"
#include "formats/finding/finding.h"

namespace ncvet {

/// Where a run has led, of `unit` and the files that it calls.
struct NamedTargets {
  Project &project;
  FileUnit &unit;
  const UsedTargets &used;
};

/// A block that is put in before the target of a jump is passed over by the jump: it goes after
/// the target's number or label, which becomes its own. Where that cannot be written the fix is
/// taken away.
void keepTargetsFirst(const NamedTargets &named, std::vector<Finding> &findings);

} // namespace ncvet
