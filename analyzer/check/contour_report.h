// The compensated contours of a program, with the largest tool radius for which each stays whole.
#pragma once

#include "analyzer/program/project.h"
#include "analyzer/rule/analysis_limits.h"

#include <optional>
#include <vector>

namespace ncvet {

struct CompensatedContour {
  const FileUnit *unit = nullptr;
  uint32_t begin = 0; ///< offset of the block along which compensation is built up
  bool onLeft = false;
  size_t elements = 0;
  bool whole = true;             ///< false: not all of its elements are known
  std::optional<double> largest; ///< mm; none: any tool that is made fits
};

/// The contours in the order of their blocks, each once, however often it runs.
std::vector<CompensatedContour> compensatedContours(Project &project, FileUnit &unit,
                                                    const AnalysisLimits &limits);

} // namespace ncvet
