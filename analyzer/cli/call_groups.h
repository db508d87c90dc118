// Puts files that call one another into an order in which callers come first.
#pragma once

#include "analyzer/cli/check_job.h"

namespace ncvet::cli {

/// Groups of jobs of which no one calls one of another group, by their texts: each in an order in
/// which callers come before what they call, as far as they do not call each other in circles.
std::vector<std::vector<Job *>> groupsByCalls(llvm::ArrayRef<Job *> jobs, Session &session);

} // namespace ncvet::cli
