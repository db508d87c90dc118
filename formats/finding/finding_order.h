// The order in which findings are told.
#pragma once

#include "formats/finding/finding.h"

#include <tuple>

namespace ncvet {

/// Findings are ordered by file, place, rule and end of the place: `file` and `rule` give what
/// orders files and rules, names where people read them, numbers where only one order is wanted.
template <typename File, typename Rule>
auto placeInOrder(const Finding &finding, const File &file, const Rule &rule) {
  return std::make_tuple(file(finding.range.file), finding.range.begin, rule(finding.rule),
                         finding.range.end);
}

} // namespace ncvet
