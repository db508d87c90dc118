// A measurement outside of its series, or a series that is not closed.
#include "analyzer/rule/switch_left_on.h"

namespace ncvet {
namespace {

/// What the tables say of its codes is reported for it.
class ProbeSeriesUnbalanced final : public LeftOnRule {
public:
  ProbeSeriesUnbalanced() : LeftOnRule("probe-series-unbalanced") {}
};

} // namespace
NCVET_RULE(ProbeSeriesUnbalanced, probe_series_unbalanced)
} // namespace ncvet
