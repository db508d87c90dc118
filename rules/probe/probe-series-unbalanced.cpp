// A measurement outside of its series.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ProbeSeriesUnbalanced final : public Rule {
public:
  /// The tables say when; what they say is reported for it.
  void listen(Subscriptions &) override {}
};

} // namespace
NCVET_RULE(ProbeSeriesUnbalanced, probe_series_unbalanced)
} // namespace ncvet
