// Progress of long work, on standard error when it is a terminal.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>

namespace ncvet::cli {

/// Shows `ncvet: check 120 of 4000` from the second second on. Several threads may step.
class Progress {
public:
  Progress(const char *what, size_t total);
  ~Progress();
  Progress(const Progress &) = delete;
  Progress &operator=(const Progress &) = delete;
  void step();

private:
  using Clock = std::chrono::steady_clock;

  const char *what_;
  size_t total_;
  bool shown_;
  std::atomic<size_t> done_ = 0;
  std::atomic<Clock::rep> due_; ///< when the line is written next
  std::atomic<bool> written_ = false;
};

} // namespace ncvet::cli
