// The threads of `ncvet check`.
#include "analyzer/cli/workers.h"

#include "analyzer/cli/progress.h"
#include "formats/text/threads.h"

#include "llvm/Support/TimeProfiler.h"

#include <atomic>
#include <thread>

namespace ncvet::cli {

namespace {

uint64_t bytesOf(const std::vector<Job *> &group) {
  uint64_t bytes = 0;
  for (const Job *job : group)
    bytes += job->bytes;
  return bytes;
}

} // namespace

std::vector<Worker> workOn(std::vector<std::vector<Job *>> groups, const WorkOptions &options,
                           llvm::function_ref<void(Job &, Worker &)> work) {
  llvm::stable_sort(groups, [](const auto &a, const auto &b) { return bytesOf(a) > bytesOf(b); });
  Progress progress(options.what, groups.size());
  std::atomic<size_t> next = 0;
  const auto run = [&](Worker &worker) {
    for (size_t index; (index = next++) < groups.size(); progress.step())
      for (Job *const job : groups[index]) {
        const llvm::TimeTraceScope trace(options.what, job->input.display);
        work(*job, worker);
      }
  };
  const size_t count =
      hasThreads ? std::min(std::max<size_t>(1, options.threads), groups.size()) : 1;
  std::vector<Worker> workers(std::max<size_t>(1, count));
  if (workers.size() == 1) {
    run(workers.front());
    return workers;
  }
  std::vector<std::thread> threads;
  for (Worker &worker : workers)
    threads.emplace_back([&] {
      if (options.trace)
        llvm::timeTraceProfilerInitialize(0, "ncvet");
      run(worker);
      if (options.trace)
        llvm::timeTraceProfilerFinishThread();
    });
  for (std::thread &thread : threads)
    thread.join();
  return workers;
}

} // namespace ncvet::cli
