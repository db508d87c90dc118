// One of several checks that follow each other.
#pragma once

#include <atomic>
#include <string>
#include <vector>

namespace ncvet::cli {

struct CheckRound {
  const std::atomic<bool> &cancel;    ///< ends the check, without a report
  std::vector<std::string> read = {}; ///< programs, configurations, tables
  bool cancelled = false;             ///< it was ended
};

} // namespace ncvet::cli
