// A probe that nothing has qualified.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class ProbeNotCalibrated final : public Rule {
public:
  /// The tables say when; what they say is reported for it.
  void listen(Subscriptions &) override {}
};

} // namespace
NCVET_RULE(ProbeNotCalibrated, probe_not_calibrated)
} // namespace ncvet
