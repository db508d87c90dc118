// A thread that does one task after the other; without threads, tasks that wait to be done.
#include "lsp/server/worker.h"

namespace ncvet::lsp {

void Worker::post(Task task) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopping_)
      return;
    tasks_.push_back(std::move(task));
  }
  wake_.notify_one();
}

bool Worker::doNext() {
  Task task;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopping_ || tasks_.empty())
      return false;
    task = std::move(tasks_.front());
    tasks_.pop_front();
  }
  task();
  return true;
}

void Worker::stop() {
  std::deque<Task> left;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    left.swap(
        tasks_); // they are dropped outside of the lock: what they hold may have a word to say
  }
  wake_.notify_one();
  if (thread_.joinable())
    thread_.join();
}

void Worker::run() {
  while (true) {
    Task task;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      wake_.wait(lock, [this] { return stopping_ || !tasks_.empty(); });
      if (stopping_)
        return;
      task = std::move(tasks_.front());
      tasks_.pop_front();
    }
    task();
  }
}

} // namespace ncvet::lsp
