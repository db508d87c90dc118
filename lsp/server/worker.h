// A thread that does one task after the other; without threads, tasks that wait to be done.
#pragma once

#include "formats/text/threads.h"

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace ncvet::lsp {

/// Tasks are done in the order in which they come. What is left at the end is dropped.
class Worker {
public:
  using Task = std::function<void()>;

  Worker() {
    if (hasThreads)
      thread_ = std::thread([this] { run(); });
  }
  ~Worker() { stop(); }
  Worker(const Worker &) = delete;
  Worker &operator=(const Worker &) = delete;

  void post(Task task);
  /// Without threads: does the next task; false when there is none.
  bool doNext();
  /// Waits for the running task; nothing is done after it.
  void stop();

private:
  void run();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Task> tasks_;
  bool stopping_ = false;
  std::thread thread_; // last: it uses all of the above
};

} // namespace ncvet::lsp
