// What one run of a command takes: time, memory, instructions.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ncvet::bench {

/// What one command took.
struct Measured {
  double cpuSeconds = 0;     ///< user and system time
  double seconds = 0;        ///< wall clock, from fork to the end
  long peakKiB = 0;          ///< largest resident set
  uint64_t instructions = 0; ///< in user mode; 0: this machine does not let them be counted
  bool failed = false;       ///< could not start, was killed, or ended with an unexpected status
};

/// Runs a command once, its output to /dev/null.
Measured runOnce(const std::vector<std::string> &command);

/// Instructions of a command, counted by Callgrind at a fiftieth of the speed; 0: there is none.
uint64_t countByCallgrind(const std::vector<std::string> &command);

} // namespace ncvet::bench
