// What the analysis of a program found.
#pragma once

#include "analyzer/flow/outer_calls.h"
#include "formats/finding/finding.h"

#include <string>
#include <vector>

namespace ncvet {

struct AnalysisResult {
  std::vector<Finding> findings; ///< sorted by file, position, rule; suppressions not yet applied
  uint64_t blocks = 0;           ///< blocks with content in the file
  bool complete = true;          ///< false: cut short by a budget
  std::vector<std::string> cuts; ///< why, one line each
  bool postponed = false;        ///< see `OuterCalls`: nothing was found out
  bool asksOuter = false;        ///< what `OuterCalls` says of some call was asked for
  bool restsOnOthers = false;    ///< on what earlier checks have found out of called programs
  uint64_t work = 0;             ///< done, counted as `AnalysisLimits::repeatedBlocks`
  /// By the path of another file: begins of its blocks whose calls of further files were followed,
  /// and came back.
  FollowedCallsOfFiles followed;
};

} // namespace ncvet
