// The threads of `ncvet check`.
#pragma once

#include "analyzer/cli/check_worker.h"

namespace ncvet::cli {

struct WorkOptions {
  const char *what;   ///< is done, for people
  size_t threads;     ///< at most
  bool trace = false; ///< times are recorded
};

/// Calls `work` for all jobs, on several threads. What is in one group is done one after the other,
/// by one of them; the largest groups first, so that no thread is left alone with a long one in the
/// end. Gives what the threads have kept.
std::vector<Worker> workOn(std::vector<std::vector<Job *>> groups, const WorkOptions &options,
                           llvm::function_ref<void(Job &, Worker &)> work);

} // namespace ncvet::cli
