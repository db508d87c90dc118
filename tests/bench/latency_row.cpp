// Prints the table of the editor's times.
#include "latency_row.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <numeric>
#include <string>

namespace ncvet::bench {

double cpuOf(pid_t process) {
  clockid_t clock;
  timespec used{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &used) != 0)
    return 0;
  return double(used.tv_sec) + double(used.tv_nsec) * 1e-9;
}

long memoryOf(pid_t process, const char *line) {
  const std::string wanted = line;
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string text; std::getline(status, text);)
    if (text.rfind(wanted, 0) == 0)
      return std::stol(text.substr(wanted.size()));
  return 0;
}

void Times::begin() {
  cpuSince_ = cpuOf(process_);
  since_ = std::chrono::steady_clock::now();
}

void Times::end() {
  const auto took = std::chrono::steady_clock::now() - since_;
  wall_.push_back(std::chrono::duration<double, std::milli>(took).count());
  cpu_.push_back((cpuOf(process_) - cpuSince_) * 1e3);
}

double Times::sum() const { return std::accumulate(wall_.begin(), wall_.end(), 0.0); }

double Times::at(std::vector<double> all, size_t percent) {
  std::sort(all.begin(), all.end());
  return all.empty() ? 0 : all[std::min(all.size() - 1, all.size() * percent / 100)];
}

void printHead() {
  std::printf("%-50s %8s %8s %7s  %-13s %8s %8s %6s\n", "milliseconds", "p50", "p99", "goal", "",
              "CPU p50", "p99", "times");
}

void printRow(const char *what, double goal, const Times &times) {
  const bool inTime = times.wall(99) <= goal, byCpu = times.cpu(99) <= goal;
  std::printf("%-50s %8.1f %8.1f %7.0f  %-13s %8.1f %8.1f %6zu\n", what, times.wall(50),
              times.wall(99), goal,
              inTime  ? "met"
              : byCpu ? "missed (load)"
                      : "missed",
              times.cpu(50), times.cpu(99), times.count());
  std::fflush(stdout);
}

void printValue(const char *what, double goal, double value, bool least) {
  const bool met = least ? value >= goal : value <= goal;
  std::printf("%-50s %8.1f %8s %7.0f  %s\n", what, value, "", goal, met ? "met" : "missed");
  std::fflush(stdout);
}

void printMissing(const char *what, const char *why) {
  std::printf("%-50s not measured: %s\n", what, why);
  std::fflush(stdout);
}

} // namespace ncvet::bench
