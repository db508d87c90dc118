// Puts files that call one another into an order in which callers come first.
#pragma once

#include "analyzer/cli/check_job.h"

#include <map>

namespace ncvet::cli {

/// Jobs whose files call one another.
struct CallGroup {
  std::vector<Job *> jobs; ///< callers before what they call, as far as there are no circles
  /// Of jobs in circles of calls, see `OuterCalls::circle`.
  std::map<const Job *, std::shared_ptr<const std::vector<std::string>>> circles{};
};

/// Groups of jobs of which no one calls one of another group, by their texts.
std::vector<CallGroup> groupsByCalls(llvm::ArrayRef<Job *> jobs, Session &session);

} // namespace ncvet::cli
