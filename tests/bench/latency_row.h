// A row of the table of the editor's times: what was measured, beside what is aimed at.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <vector>

namespace ncvet::bench {

/// Seconds of the processors that a process has used.
double cpuOf(pid_t process);
/// A line of /proc about the memory of a process, in KiB: `VmRSS:` now, `VmHWM:` at the most.
long memoryOf(pid_t process, const char *line = "VmRSS:");

/// Milliseconds that something took, each time that it was done: by the clock, and of the
/// processors.
class Times {
public:
  explicit Times(pid_t process) : process_(process) {}

  void begin();
  void end();
  size_t count() const { return wall_.size(); }
  double sum() const;
  /// That `percent` of all times do not pass.
  double wall(size_t percent) const { return at(wall_, percent); }
  double cpu(size_t percent) const { return at(cpu_, percent); }

private:
  static double at(std::vector<double> all, size_t percent);

  pid_t process_;
  std::chrono::steady_clock::time_point since_;
  double cpuSince_ = 0;
  std::vector<double> wall_, cpu_;
};

/// What the columns are.
void printHead();
/// 50 and 99 of 100 times, what is aimed at for the latter, and whether that is met. Where only the
/// clock misses it and the processors do not, something else ran beside it.
void printRow(const char *what, double goal, const Times &times);
/// One value; `least`: no less than the goal is aimed at.
void printValue(const char *what, double goal, double value, bool least = false);
/// What could not be measured, and why.
void printMissing(const char *what, const char *why);

} // namespace ncvet::bench
